// How large and how small the numbers of a scene may be: the ranges in which no product of the formulas overflows or
// vanishes, and no count leaves its type.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/types.hpp"

namespace carom {

// What a number measures.
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

// The numbers that a dimension may have: 0 where the key allows it, or a size from least to most.
struct Magnitudes {
  Dimension dimension;
  std::string_view noun;  // "length"
  std::string_view unit;  // "length^2 / time"
  double least, most;
  std::string_view why;
};

// Lengths L, times T and masses m are free within many more powers of ten than any physics has; the rest follows from
// them. A double holds 1e-308 to 1e308. The largest products are v^2 L^2 (the discriminant of a contact time, and its
// cross product squared) and the square of a momentum.
inline constexpr std::array<Magnitudes, 10> magnitudes{{
    {Dimension::none, "number", "", 0.0, 1e308, "counted or compared with numbers of its own kind"},
    {Dimension::length, "length", "length", 1e-30, 1e30, "L^2 stays within 1e-60 and 1e60"},
    {Dimension::time, "time", "time", 1e-30, 1e30, "t^2 stays within 1e-60 and 1e60"},
    {Dimension::mass, "mass", "mass", 1e-50, 1e50, "sums and products of two masses stay within 1e-100 and 1e100"},
    {Dimension::speed, "speed", "length / time", 0.0, 1e60,
     "L / T; v^2 L^2 of a contact time stays below 1e180. No speed is too small: it only moves nothing"},
    {Dimension::acceleration, "acceleration", "length / time^2", 1e-90, 1e90, "L / T^2; g L is a speed squared"},
    {Dimension::diffusion, "diffusion coefficient", "length^2 / time", 1e-90, 1e90, "L^2 / T; D t is a length squared"},
    {Dimension::density, "density", "mass / length^2", 1e-110, 1e110, "m / L^2"},
    {Dimension::energy, "energy", "mass length^2 / time^2", 1e-170, 1e170, "m v^2"},
    {Dimension::frequency, "rate", "1 / time", 1e-30, 1e30, "1 / T"},
}};

// Numbers against each other.
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
    {"steps t_end / dt, frames t_end / every, samples and half periods of vibrations likewise", most_steps,
     "2^53: their numbers are doubles, which hold whole numbers up to there"},
    {"disks rate t_end that a source is to give", most_emissions,
     "2^50: their times k / rate stay apart by more than the rounding of time"},
    {"longer side of the box over the smallest radius", most_radii,
     "2^40: places have 53 bits, which leaves 13 for a radius; above 10^9 a run warns"},
    {"crossings of the box by the fastest disk until t_end", most_crossings,
     "2^53: the time of one must not vanish in that of all"},
    {"disks, those from sources included", static_cast<double>(most_disks), "ids have 32 bits, walls take some"},
}};

constexpr const Magnitudes& magnitudes_of(Dimension d) {
  return magnitudes[static_cast<std::size_t>(d)];
}

// Is it 0, or of a size within the range of the dimension?
bool in_range(Dimension dimension, double value);

// "expected a length from 1e-30 to 1e+30".
std::string expected_range(Dimension dimension);

}  // namespace carom
