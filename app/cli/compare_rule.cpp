#include "app/cli/compare_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

#include "app/cli/option_values.hpp"
#include "core/base/input_message.hpp"

namespace carom {

namespace {

double tolerance_of(const std::string& text) {
  const double tolerance = number_of("--tolerance", text);
  if (!(tolerance >= 0.0)) fail_input("--tolerance", fmt::format("is {}", tolerance), "expected a number of 0 or more");
  return tolerance;
}

void read_fields(const std::string& text, CompareRule& rule) {
  const std::vector<std::string_view> names(compared_quantities.begin(), compared_quantities.end());
  rule.fields.fill(false);
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      fail_input("--fields", fmt::format("there is no field {}", in_quotes(word)), expected_one_of(names, word));
    }
    rule.fields[static_cast<std::size_t>(found - names.begin())] = true;
  }
}

void read_times(const std::string& text, CompareRule& rule) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) {
    fail_input("--times", fmt::format("is {}", in_quotes(text)), "expected FROM:TO, as in --times 0:2.5 or --times 5:");
  }
  if (colon > 0) rule.from = number_of("--times", text.substr(0, colon));
  if (colon + 1 < text.size()) rule.to = number_of("--times", text.substr(colon + 1));
  if (rule.from > rule.to) {
    fail_input("--times", fmt::format("is {}", in_quotes(text)), "expected the earlier time first");
  }
}

}  // namespace

std::optional<CompareRule> compare_rule(const std::string& tolerance, const std::string& fields,
                                        const std::string& times, const std::string& at) {
  if (tolerance.empty() && fields.empty() && times.empty() && at.empty()) return std::nullopt;
  CompareRule rule;
  if (!tolerance.empty()) rule.tolerance = tolerance_of(tolerance);
  if (!fields.empty()) read_fields(fields, rule);
  if (!times.empty()) read_times(times, rule);
  if (!at.empty()) rule.at = number_of("--at", at);
  if (!times.empty() && !at.empty()) fail_input("--at", "cannot be used with --times", "expected one of them");
  return rule;
}

}  // namespace carom
