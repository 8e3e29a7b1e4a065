// Square and hexagonal lattices in a circle.
#pragma once

#include <vector>

#include "core/base/types.hpp"

namespace carom {

// One site is at the centre of the circle. All are lengths.
struct CircleLattice {
  bool hexagonal = false;
  double reach = 0.0;     // largest distance of a site from the centre
  double diameter = 0.0;  // least distance of two sites, above 0
};

// `count` sites relative to the centre, row by row from below: those nearest to the centre on the widest lattice that
// has so many. Empty if they do not fit. Uses + - * / and sqrt alone. Precondition: count > 0, reach >= 0.
std::vector<Vec2> circle_sites(const CircleLattice& lattice, Count count);

// The largest number of sites that fit.
Count circle_capacity(const CircleLattice& lattice);

}  // namespace carom
