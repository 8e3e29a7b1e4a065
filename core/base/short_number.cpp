#include "core/base/short_number.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace carom {

std::string duration_text(double seconds) {
  if (!(seconds < 1e8)) return "years";
  if (seconds < 10.0) return fmt::format("{:.2g} s", seconds);
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string short_number(double number) {
  constexpr std::array<const char*, 5> prefixes{"", " k", " M", " G", " T"};
  std::size_t k = 0;
  while (number >= 999.5 && k + 1 < prefixes.size()) {
    number /= 1000.0;
    ++k;
  }
  return fmt::format("{:.3g}{}", number, prefixes[k]);
}

std::string counted(std::uint64_t n, std::string_view what) {
  if (n == 1) return fmt::format("1 {}", what);
  if (what.back() == 'y') return fmt::format("{} {}ies", n, what.substr(0, what.size() - 1));
  return fmt::format("{} {}s", n, what);
}

}  // namespace carom
