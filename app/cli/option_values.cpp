#include "app/cli/option_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/duration.hpp"
#include "core/base/input_message.hpp"
#include "core/scene/scene_names.hpp"

namespace carom {

namespace {

void check_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, seed);
  if (result.ec != std::errc{} || result.ptr != end) {
    fail_input("--seed", fmt::format("is {}", in_quotes(text)), "expected a whole number from 0 to 2^64 - 1");
  }
}

void check_method(const std::string& text) {
  if (std::find(method_words.begin(), method_words.end(), text) == method_words.end()) {
    fail_input("--method", fmt::format("there is no method {}", in_quotes(text)), expected_one_of(method_words, text));
  }
}

}  // namespace

double number_of(const std::string& option, const std::string& text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc::result_out_of_range && result.ptr == end) {
    fail_input(option, fmt::format("is {}, beyond the range of a double", text), "expected a number such as 0.01");
  }
  if (result.ec != std::errc{} || result.ptr != end || !std::isfinite(value)) {
    fail_input(option, fmt::format("{} is not a number", in_quotes(text)), "expected a number such as 0.01");
  }
  return value;
}

int count_of(const std::string& option, const std::string& text, int most) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc::result_out_of_range || value > most) {
    fail_input(option, fmt::format("is {}", in_quotes(text)),
               fmt::format("expected a whole number from 1 to {}", most));
  }
  if (result.ec != std::errc{} || result.ptr != end || value < 1) {
    fail_input(option, fmt::format("is {}", in_quotes(text)), "expected a whole number of 1 or more");
  }
  return value;
}

std::array<double, 2> pair_of(const std::string& option, const std::string& text, char between,
                              const std::string& expected) {
  const std::size_t at = text.find(between);
  if (at == std::string::npos) fail_input(option, fmt::format("is {}", in_quotes(text)), expected);
  return {number_of(option, text.substr(0, at)), number_of(option, text.substr(at + 1))};
}

double walltime_of(const std::string& text) {
  if (text.empty()) return std::numeric_limits<double>::infinity();
  const std::optional<double> seconds = parse_duration(text);
  if (!seconds) fail_input("--max-walltime", fmt::format("is {}", in_quotes(text)), expected_duration);
  return *seconds;
}

std::size_t size_of(const std::string& option, const std::string& text) {
  constexpr std::array<std::pair<std::string_view, double>, 5> units{
      {{"", 1.0}, {"B", 1.0}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}}};
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const auto& [name, factor] : units) {
    if (error != std::errc() || unit != name || !(value * factor >= 1.0) || value * factor > 1e15) continue;
    return static_cast<std::size_t>(value * factor);
  }
  fail_input(option, fmt::format("is {}", in_quotes(text)), "expected a size, as in 64MB, 500kB or 1GB");
}

std::string toml_value(const std::string& option, const std::string& text) {
  if (option == "--method") {
    check_method(text);
    return fmt::format("\"{}\"", text);
  }
  if (option == "--seed") {
    check_seed(text);
    return text;
  }
  return fmt::format("{}", number_of(option, text));
}

}  // namespace carom
