// The columns of the disks as kernels see them: radius and mass are a column or a constant, decided once per scene by
// type, never per disk.
#pragma once

#include "core/disks/disks.hpp"

namespace carom {

template <bool own_radius, bool own_mass>
struct DiskView {
  static constexpr bool has_mass = own_mass;
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

template <bool own_radius, bool own_mass>
DiskView<own_radius, own_mass> view_of(Disks& d) {
  return {d.x.data(),      d.y.data(),    d.vx.data(),     d.vy.data(),  d.id.data(),
          d.radius.data(), d.mass.data(), d.common_radius, d.common_mass};
}

// Calls kernel(view) with the view type that fits the columns present.
template <class Kernel>
decltype(auto) with_view(Disks& d, Kernel&& kernel) {
  if (d.radius.empty()) {
    return d.mass.empty() ? kernel(view_of<false, false>(d)) : kernel(view_of<false, true>(d));
  }
  return d.mass.empty() ? kernel(view_of<true, false>(d)) : kernel(view_of<true, true>(d));
}

}  // namespace carom
