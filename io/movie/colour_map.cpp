#include "io/movie/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace carom {

namespace {

// viridis (van der Walt and Smith 2015) at eighths; linear interpolation is within 4 of 255 of the original.
constexpr std::array<Colour, viridis_stops + 1> viridis_eighths{{{68, 1, 84},
                                                                 {71, 44, 122},
                                                                 {59, 81, 139},
                                                                 {44, 113, 142},
                                                                 {33, 144, 141},
                                                                 {39, 173, 129},
                                                                 {92, 200, 99},
                                                                 {170, 220, 50},
                                                                 {253, 231, 37}}};

}  // namespace

Colour viridis(double value) {
  const double place = std::clamp(value, 0.0, 1.0) * viridis_stops;
  const auto k = std::min(static_cast<std::size_t>(place), std::size_t{viridis_stops - 1});
  const double f = place - static_cast<double>(k);
  const Colour& a = viridis_eighths[k];
  const Colour& b = viridis_eighths[k + 1];
  return {a.red + f * (b.red - a.red), a.green + f * (b.green - a.green), a.blue + f * (b.blue - a.blue)};
}

}  // namespace carom
