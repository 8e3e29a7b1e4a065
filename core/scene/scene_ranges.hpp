// The ranges of the numbers of a scene, such that no product in the formulas overflows or underflows, and every count
// fits its type.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/types.hpp"

namespace carom {

// The dimension of a number.
enum class Dimension : std::uint8_t {
  none,
  length,
  time,
  mass,
  speed,
  acceleration,
  diffusion,
  density,
  energy,
  frequency
};

// The magnitudes allowed for a dimension, from least to most; also 0, if the key allows it.
struct Magnitudes {
  Dimension dimension;
  std::string_view noun;  // "length"
  std::string_view unit;  // "length^2 / time"
  double least, most;
  std::string_view why;
};

// The ranges of lengths L, times T and masses m are far wider than any application needs; the others follow from them.
// A double holds 1e-308 to 1e308. The largest products are v^2 L^2 (the discriminant of a contact time and the square
// of its cross product) and the square of a momentum.
inline constexpr std::array<Magnitudes, 10> magnitudes{{
    {Dimension::none, "number", "", 0.0, 1e308, "counted or compared with numbers of its own kind"},
    {Dimension::length, "length", "length", 1e-30, 1e30, "L^2 stays within 1e-60 and 1e60"},
    {Dimension::time, "time", "time", 1e-30, 1e30, "t^2 stays within 1e-60 and 1e60"},
    {Dimension::mass, "mass", "mass", 1e-50, 1e50, "sums and products of two masses stay within 1e-100 and 1e100"},
    {Dimension::speed, "speed", "length / time", 0.0, 1e60,
     "L / T; v^2 L^2 of a contact time stays below 1e180. Any small speed is allowed, though it may move nothing"},
    {Dimension::acceleration, "acceleration", "length / time^2", 1e-90, 1e90, "L / T^2; g L is a speed squared"},
    {Dimension::diffusion, "diffusion coefficient", "length^2 / time", 1e-90, 1e90, "L^2 / T; D t is a length squared"},
    {Dimension::density, "density", "mass / length^2", 1e-110, 1e110, "m / L^2"},
    {Dimension::energy, "energy", "mass length^2 / time^2", 1e-170, 1e170, "m v^2"},
    {Dimension::frequency, "rate", "1 / time", 1e-30, 1e30, "1 / T"},
}};

// Bounds on combinations of numbers.
inline constexpr double most_steps = 0x1p53;
inline constexpr double most_emissions = 0x1p50;
inline constexpr double most_radii = 0x1p40;
inline constexpr double most_crossings = 0x1p53;
inline constexpr Count most_disks = 4'000'000'000;

struct Proportion {
  std::string_view what;
  double most;
  std::string_view why;
};
inline constexpr std::array<Proportion, 5> proportions{{
    {"steps t_end / dt, frames t_end / every, samples, half periods of vibrations", most_steps,
     "2^53: their numbers are doubles, which hold whole numbers up to there"},
    {"disks from a source, rate t_end", most_emissions,
     "2^50: their times k / rate differ by more than the rounding of time"},
    {"longer side of the box over the smallest radius", most_radii,
     "2^40: positions have 53 bits, so a radius has 13; above 10^9 a run warns"},
    {"crossings of the box by the fastest disk until t_end", most_crossings,
     "2^53: the time of one crossing must not vanish in t_end"},
    {"disks, with those from sources", static_cast<double>(most_disks), "ids have 32 bits, and walls use some of them"},
}};

constexpr const Magnitudes& magnitudes_of(Dimension d) {
  return magnitudes[static_cast<std::size_t>(d)];
}

// Is the number 0, or its magnitude within the range of the dimension?
bool in_range(Dimension dimension, double value);

// "expected a length from 1e-30 to 1e+30".
std::string expected_range(Dimension dimension);

}  // namespace carom
