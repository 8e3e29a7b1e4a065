// The columns of the disks as kernels see them: radius and mass are a column or a constant, decided once per scene by
// type, never per disk.
#pragma once

#include "core/disks/disks.hpp"

namespace carom {

// under_law: collisions ask a RestitutionLaw, where others take one number.
template <bool own_radius, bool own_mass, bool under_law = false>
struct DiskView {
  static constexpr bool has_mass = own_mass;
  static constexpr bool has_law = under_law;
  double* x;
  double* y;
  double* vx;
  double* vy;
  const DiskId* id;
  const double* radius_column;
  const double* mass_column;
  double common_radius;
  double common_mass;

  double radius(std::size_t i) const {
    if constexpr (own_radius) {
      return radius_column[i];
    } else {
      return common_radius;
    }
  }
  double mass(std::size_t i) const {
    if constexpr (own_mass) {
      return mass_column[i];
    } else {
      return common_mass;
    }
  }
};

template <bool own_radius, bool own_mass, bool under_law = false>
DiskView<own_radius, own_mass, under_law> view_of(Disks& d) {
  return {d.x.data(),      d.y.data(),    d.vx.data(),     d.vy.data(),  d.id.data(),
          d.radius.data(), d.mass.data(), d.common_radius, d.common_mass};
}

// Calls kernel(view) with the view type that fits the columns present.
template <bool under_law = false, class Kernel>
decltype(auto) with_view(Disks& d, Kernel&& kernel) {
  if (d.radius.empty()) {
    return d.mass.empty() ? kernel(view_of<false, false, under_law>(d)) : kernel(view_of<false, true, under_law>(d));
  }
  return d.mass.empty() ? kernel(view_of<true, false, under_law>(d)) : kernel(view_of<true, true, under_law>(d));
}

}  // namespace carom
