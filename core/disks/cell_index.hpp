// Equal cells along one side of the box: how many, and which of them holds a place.
#pragma once

#include <algorithm>
#include <cmath>

namespace carom {

// Number of cells along a side of this length: none shorter than `least` (length), and at most `most` (>= 1), which
// bounds memory. Shorter by a little more than cell_index rounds, so that two places within `least` of each other never
// lie two cells apart.
inline double cells_along(double length, double least, double most) {
  return std::max(1.0, std::floor(std::min(length / least * (1.0 - 0x1p-40), most)));
}

// The cell that holds a coordinate given in cells from the start of the side; the nearest one for what lies outside.
// A length becomes cells by division by the side's or a cell's length, or, in loops over all disks, by a product with
// cells per length. The quotient and the product may differ in the last bit: one grid uses one of them throughout.
template <class Index>
Index cell_index(double coordinate, Index cells) {
  const double last = static_cast<double>(cells - 1);
  return static_cast<Index>(coordinate < 0.0 ? 0.0 : coordinate < last ? coordinate : last);
}

}  // namespace carom
