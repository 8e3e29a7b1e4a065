// Square and hexagonal lattices that fill a box evenly.
#pragma once

#include <optional>

#include "core/base/types.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// Lengths that hold a whole number of diameters up to lattice_rounding count as holding them: 0.3 / 0.1 is just
// below 3.
inline constexpr double lattice_rounding = 1.0 + 1e-12;

// Height of an equilateral triangle of unit side, sqrt(3) / 2.
inline constexpr double triangle_height = 0.86602540378443864676;

// rows x columns sites, spaced evenly: columns run along x, odd rows are shifted by shift along x. Periodic axes are
// divided evenly by the spacing, so that the lattice closes; along the others the outermost disks keep a radius or
// more from the side.
struct Lattice {
  Count columns = 0, rows = 0;
  double spacing_x = 0.0, spacing_y = 0.0;  // length
  double first_x = 0.0, first_y = 0.0;      // of the site in column 0, row 0
  double shift = 0.0;                       // length; 0 on a square lattice
};

// The lattice with room for count disks of this diameter whose cells are the least distorted from squares (from equal
// triangles); nullopt if there is none. Precondition: count > 0, the box holds one disk.
std::optional<Lattice> square_lattice(const Domain& box, Count count, double diameter);
std::optional<Lattice> hexagonal_lattice(const Domain& box, Count count, double diameter);

// The most disks of this diameter that square_lattice or hexagonal_lattice has room for.
Count square_capacity(const Domain& box, double diameter);
Count hexagonal_capacity(const Domain& box, double diameter);

// The site of disk k of count: every site if they are as many, otherwise the empty ones are spread evenly.
Vec2 lattice_site(const Lattice& lattice, Count k, Count count);

}  // namespace carom
