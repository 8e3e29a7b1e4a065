#include "core/base/duration.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace carom {

std::optional<double> parse_duration(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{}) return std::nullopt;
  std::string_view unit(rest, static_cast<std::size_t>(end - rest));
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  const double factor = unit.empty() || unit == "s" ? 1.0 : unit == "min" ? 60.0 : unit == "h" ? 3600.0 : 0.0;
  const double seconds = factor * value;
  if (!(seconds > 0.0) || !std::isfinite(seconds)) return std::nullopt;
  return seconds;
}

}  // namespace carom
