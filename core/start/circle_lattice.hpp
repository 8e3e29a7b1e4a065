// Square and hexagonal lattices in a circle.
#pragma once

#include <vector>

#include "core/base/types.hpp"

namespace carom {

// With a site at the centre. Lengths.
struct CircleLattice {
  bool hexagonal = false;
  double reach = 0.0;     // largest distance of a site from the centre
  double diameter = 0.0;  // least distance of two sites, above 0
};

// The sites seen from the centre, count of them, row by row from below: those nearest to the centre on a lattice as
// wide as it can be. Empty where they do not fit. From + - * / and sqrt alone. Precondition: count > 0, reach >= 0.
std::vector<Vec2> circle_sites(const CircleLattice& lattice, Count count);

// How many sites fit.
Count circle_capacity(const CircleLattice& lattice);

}  // namespace carom
