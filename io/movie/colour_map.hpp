// From a number in [0, 1] to a colour: viridis, perceptually uniform and safe for the colour-blind.
#pragma once

namespace carom {

struct Colour {
  double red = 0.0, green = 0.0, blue = 0.0;  // in [0, 255], sRGB
};

inline constexpr int viridis_stops = 8;  // equal parts in which it is a straight line

// From dark violet at 0 through blue and green to yellow at 1; values outside have the colour of the nearer end.
Colour viridis(double value);

}  // namespace carom
