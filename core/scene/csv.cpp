#include "core/scene/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include "core/base/input_file.hpp"
#include "core/base/input_message.hpp"

namespace carom {

namespace {

std::string_view trim(std::string_view s) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = s.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(blanks) - first + 1);
}

// The whole field as a number, independent of the locale.
std::optional<double> parse_number(std::string_view field) {
  field = trim(field);
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return value;
}

bool starts_like_name(std::string_view field) {
  field = trim(field);
  if (field.empty()) return false;
  const char c = field[0];
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '"' || c == '_';
}

// A line of two names, such as "x,y" or "vx [m/s], vy [m/s]".
bool is_header(std::string_view line) {
  const std::size_t comma = line.find(',');
  if (comma == std::string_view::npos) return false;
  const std::string_view first = line.substr(0, comma);
  const std::string_view second = line.substr(comma + 1);
  return starts_like_name(first) && starts_like_name(second) && !parse_number(first) && !parse_number(second);
}

// A heading in the wrong order, such as "y,x" or "vy [m/s], vx [m/s]".
bool has_y_first(std::string_view heading) {
  const std::size_t comma = heading.find(',');
  const std::string_view first = trim(heading.substr(0, comma)), second = trim(heading.substr(comma + 1));
  const auto [a, b] = std::mismatch(first.begin(), first.end(), second.begin(), second.end());
  if (a == first.end() || b == second.end()) return false;
  const bool swapped = (*a == 'y' && *b == 'x') || (*a == 'Y' && *b == 'X');
  return swapped && std::equal(a + 1, first.end(), b + 1, second.end());
}

// A name of a heading such as vx, "v_x" or Velocity x.
bool names_velocity(std::string_view field) {
  const std::size_t first = std::min(field.find_first_not_of(" \t\""), field.size());
  return first < field.size() && (field[first] == 'v' || field[first] == 'V');
}

// The text of what was expected if the heading names other quantities than are to be read; else empty.
std::string_view other_heading(std::string_view heading, CsvPairs pairs) {
  if (has_y_first(heading)) return "expected x first, then y";
  const std::size_t comma = heading.find(',');
  const std::string_view first = heading.substr(0, comma), second = heading.substr(comma + 1);
  if (pairs == CsvPairs::places && names_velocity(first) && names_velocity(second)) {
    return "expected places, as in \"x,y\"";
  }
  return {};
}

}  // namespace

std::vector<Vec2> parse_csv_pairs(std::string_view text, const std::string& name, std::string_view key,
                                  CsvPairs pairs) {
  constexpr std::string_view expected = "expected two finite numbers \"x,y\"";
  std::vector<Vec2> rows;
  bool first_line = true;
  std::size_t line_number = 0;
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  while (!text.empty()) {
    ++line_number;
    const std::size_t end = text.find('\n');
    const std::string_view line = trim(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line[0] == '#') continue;
    const bool header = first_line && is_header(line);
    first_line = false;
    if (header) {
      const std::string_view other = other_heading(line, pairs);
      if (other.empty()) continue;
      fail_input(fmt::format("{}:{}: {}", name, line_number, key), fmt::format("has columns {}", in_quotes(line)),
                 other);
    }
    const std::size_t comma = line.find(',');
    const bool pair = comma != std::string_view::npos;
    const std::optional<double> x = pair ? parse_number(line.substr(0, comma)) : std::nullopt;
    const std::optional<double> y = pair ? parse_number(line.substr(comma + 1)) : std::nullopt;
    if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) {
      fail_input(fmt::format("{}:{}: {}", name, line_number, key), fmt::format("cannot read {}", in_quotes(line)),
                 expected);
    }
    rows.push_back({*x, *y});
  }
  return rows;
}

}  // namespace carom
