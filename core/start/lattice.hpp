// Square and hexagonal lattices that fill a box.
#pragma once

#include <optional>

#include "core/base/types.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// Tolerance for the number of diameters in a length: 0.3 / 0.1 is just below 3, but counts as 3.
inline constexpr double lattice_rounding = 1.0 + 1e-12;

// Height of an equilateral triangle of unit side, sqrt(3) / 2.
inline constexpr double triangle_height = 0.86602540378443864676;

// rows x columns sites; odd rows are shifted by `shift` along x. The spacing divides a periodic axis evenly, so that
// the lattice closes; along other axes the outermost disks are at least a radius away from the sides.
struct Lattice {
  Count columns = 0, rows = 0;
  double spacing_x = 0.0, spacing_y = 0.0;  // length
  double first_x = 0.0, first_y = 0.0;      // of the site in column 0, row 0
  double shift = 0.0;                       // length; 0 on a square lattice
};

// The lattice with room for count disks of this diameter whose cells are least distorted from squares (from equilateral
// triangles); nullopt if there is none. Precondition: count > 0, the box holds one disk.
std::optional<Lattice> square_lattice(const Domain& box, Count count, double diameter);
std::optional<Lattice> hexagonal_lattice(const Domain& box, Count count, double diameter);

// The most disks of this diameter that square_lattice or hexagonal_lattice has room for.
Count square_capacity(const Domain& box, double diameter);
Count hexagonal_capacity(const Domain& box, double diameter);

// The site of disk k of count. If there are more sites than disks, the empty sites are spread evenly.
Vec2 lattice_site(const Lattice& lattice, Count k, Count count);

}  // namespace carom
