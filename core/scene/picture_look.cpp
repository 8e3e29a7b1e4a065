#include "core/scene/picture_look.hpp"

#include <fmt/format.h>

#include <cmath>

namespace carom {

std::string complaint_of_fps(double fps) {
  constexpr double least = 0.1, most = 1000.0;
  return fps >= least && fps <= most ? "" : fmt::format("expected from {} to {} frames a second", least, most);
}

std::string complaint_of_size(double width, double height) {
  constexpr double least = 320.0, most = 8192.0;
  const auto good = [](double x) { return x >= least && x <= most && std::fmod(x, 2.0) == 0.0; };
  if (good(width) && good(height)) return "";
  return fmt::format("expected a width and a height in pixels, even numbers from {} to {}", least, most);
}

std::string complaint_of_range(ColourBy colour, double low, double high) {
  if (colour == ColourBy::group) return "groups have colours of their own; expected another colour, or no range";
  return low < high ? "" : "expected two numbers, the lower first";
}

}  // namespace carom
