#include "app/sweep/sweep_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "core/base/input_message.hpp"

namespace carom {

namespace {

constexpr std::string_view expected = "expected KEY=FROM:TO:COUNT, of two values or more, or KEY=VALUE,VALUE,...";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = text.find('\n', begin);
    lines.push_back(text.substr(begin, end - begin));
    if (end == std::string::npos) return lines;
    begin = end + 1;
  }
}

// Splits text at the commas or colons that are not within the brackets, braces or quotes of a scene's values.
std::vector<std::string> split_values(const std::string& text, char at) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = 0;
  bool escaped = false;  // the character before it was a backslash, so a quote does not end the string
  for (const char c : text) {
    if (c == at && depth == 0 && quote == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += c;
    if (escaped) {
      escaped = false;
    } else if (quote != 0) {
      escaped = quote == '"' && c == '\\';
      quote = c == quote ? char{0} : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else {
      depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
    }
  }
  return values;
}

template <class T>
T number_in(const std::string& text, const std::string& word) {
  T value{};
  const char* const end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  if (result.ec != std::errc{} || result.ptr != end) {
    fail_input("--over", fmt::format("{}: {} is not a number", in_quotes(text), in_quotes(word)), expected);
  }
  return value;
}

std::optional<double> number_of(const std::string& word) {
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  return result.ec == std::errc{} && result.ptr == end ? std::optional(value) : std::nullopt;
}

std::vector<std::string> range_values(const std::string& text, const std::vector<std::string>& parts) {
  constexpr int most_values = 1'000'000;
  const auto from = number_in<double>(text, parts[0]), to = number_in<double>(text, parts[1]);
  const int count = number_in<int>(text, parts[2]);
  if (!std::isfinite(from) || !std::isfinite(to - from) || count < 1 || count > most_values ||
      (count == 1 && from != to)) {
    fail_input("--over", fmt::format("{} is not a range", in_quotes(text)), expected);
  }
  std::vector<std::string> values;
  for (int k = 0; k < count; ++k) {
    // Both ends are exact, and a value has the same text in whatever way the range is divided: 0.5, 0.55, not
    // 0.55000000000000004.
    const double share = count == 1 ? 0.0 : static_cast<double>(k) / (count - 1);
    const double value = k + 1 == count ? to : from + (to - from) * share;
    values.push_back(fmt::format("{}", number_of(fmt::format("{:.15g}", value)).value_or(value)));
  }
  return values;
}

// Checks that every seed fits into 64 bits, and that there are not more runs than a machine could do.
void check_number_of_runs(const std::vector<SweepAxis>& axes, std::uint64_t seed, int seeds) {
  constexpr double most_runs = 1e6;
  const std::uint64_t beyond = std::numeric_limits<std::uint64_t>::max() - seed;  // number of seeds after the first
  if (static_cast<std::uint64_t>(seeds) - 1 > beyond) {
    fail_input("--seeds", fmt::format("{} seeds from {} on exceed 2^64 - 1", seeds, seed),
               fmt::format("expected at most {}, or a smaller seed of the scene", beyond + 1));
  }
  double runs = seeds;
  for (const SweepAxis& axis : axes) runs *= static_cast<double>(axis.values.size());
  if (runs > most_runs) fail_input("sweep", fmt::format("{:g} runs are too many", runs), "expected at most 1000000");
}

// Makes 1.0 and 1 the same.
std::string plain(const std::string& value) {
  const std::optional<double> number = number_of(value);
  return number && value.find_first_of(".e") != std::string::npos ? fmt::format("{}", *number) : value;
}

// " KEY=VALUE" for each key that a run changes.
std::string changes_of(const SweepRun& run) {
  std::string text;
  for (const auto& [key, value] : run.overrides) text += fmt::format(" {}={}", key, plain(value));
  return text;
}

// Runs are distinguished by what they change: two with the same changes would take each other's names.
void check_values(const std::string& text, const std::vector<std::string>& values) {
  std::set<std::string> seen;
  for (const std::string& value : values) {
    if (value.empty()) fail_input("--over", fmt::format("{} has an empty value", in_quotes(text)), expected);
    if (!seen.insert(plain(value)).second) {
      fail_input("--over", fmt::format("{} has the value {} twice", in_quotes(text), value),
                 "expected different values; --seeds N makes several runs of one");
    }
  }
}

}  // namespace

SweepAxis parse_sweep_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    fail_input("--over", fmt::format("is {}", in_quotes(text)), expected);
  }
  SweepAxis axis{text.substr(0, equals), {}};
  if (axis.key == "seed") fail_input("--over", fmt::format("is {}", in_quotes(text)), "expected --seeds N for seeds");
  const std::string values = text.substr(equals + 1);
  const std::vector<std::string> parts = split_values(values, ':');
  if (parts.size() == 3) {
    axis.values = range_values(text, parts);
  } else if (parts.size() > 1 && number_of(parts[0])) {
    fail_input("--over", fmt::format("{} is not a range", in_quotes(text)), expected);
  } else {
    axis.values = split_values(values, ',');
  }
  check_values(text, axis.values);
  return axis;
}

std::vector<SweepRun> sweep_runs(const SceneChanges& changes, const std::vector<SweepAxis>& axes, std::uint64_t seed,
                                 int seeds) {
  check_number_of_runs(axes, seed, seeds);
  std::vector<SweepRun> runs;
  std::vector<std::size_t> at(axes.size(), 0);
  for (bool more = true; more;) {
    for (int s = 0; s < seeds; ++s) {
      SweepRun run{fmt::format("{:04}", runs.size() + 1), changes.overrides, 0};
      for (std::size_t a = 0; a < axes.size(); ++a) run.overrides.push_back({axes[a].key, axes[a].values[at[a]]});
      run.overrides.push_back({"seed", fmt::format("{}", seed + static_cast<std::uint64_t>(s))});
      runs.push_back(std::move(run));
    }
    more = false;
    for (std::size_t a = axes.size(); a-- > 0 && !more;) {
      at[a] = (at[a] + 1) % axes[a].values.size();
      more = at[a] != 0;
    }
  }
  return runs;
}

std::string sweep_identity(const std::string& scene_text, const std::vector<SweepRun>& runs) {
  std::string text;
  for (const SweepRun& run : runs) text += run.name + changes_of(run) + '\n';
  return text + "\n" + scene_text;
}

std::string take_names(const std::string& identity, const std::string& scene_text, std::vector<SweepRun>& runs) {
  const std::size_t end = identity.find("\n\n");
  if (end == std::string::npos || identity.substr(end + 2) != scene_text) return "the scene has changed since";
  std::map<std::string, std::string> names;  // of the existing runs, by what they change
  std::size_t last = 0;
  for (const std::string& line : lines_of(identity.substr(0, end))) {
    const std::size_t name_end = std::min(line.find(' '), line.size());
    names.emplace(line.substr(name_end), line.substr(0, name_end));
    std::size_t number = 0;
    std::from_chars(line.data(), line.data() + name_end, number);
    last = std::max(last, number);
  }
  for (SweepRun& run : runs) {
    const auto there = names.find(changes_of(run));
    run.name = there != names.end() ? there->second : fmt::format("{:04}", ++last);
    if (there != names.end()) names.erase(there);
  }
  return names.empty() ? "" : fmt::format("this one lacks its run{}", names.begin()->first);
}

}  // namespace carom
