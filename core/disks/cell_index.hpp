// Equal cells along one side of the box: their number, and the cell of a coordinate.
#pragma once

#include <algorithm>
#include <cmath>

namespace carom {

// Number of cells along a side of this length: no cell is shorter than `least` (length), and there are at most `most`
// (>= 1), which bounds memory. Cells are longer than `least` by more than cell_index may round, so that two places
// within `least` of each other never lie two cells apart.
inline double cells_along(double length, double least, double most) {
  return std::max(1.0, std::floor(std::min(length / least * (1.0 - 0x1p-40), most)));
}

// The cell of a coordinate, which is given in units of cells; outside the side, the nearest cell. A length is converted
// to cells by a division, or, in loops over all disks, by a product with cells per length. The two may differ in the
// last bit, so a grid must use the same one throughout.
template <class Index>
Index cell_index(double coordinate, Index cells) {
  const double last = static_cast<double>(cells - 1);
  return static_cast<Index>(coordinate < 0.0 ? 0.0 : coordinate < last ? coordinate : last);
}

}  // namespace carom
