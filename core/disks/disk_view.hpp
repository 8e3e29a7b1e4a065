// The columns of the disks for kernels. Whether radius and mass are columns or constants is part of the type, decided
// once for a scene and never for each disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/disks/disks.hpp"

namespace carom {

// Stands for the spin of disks that have none.
struct NoSpin {};

// What collisions need besides one number for the restitution. under_law: a RestitutionLaw. rough: the Surfaces of
// rough disks, and perhaps a law. sheared: the Shear of the box, and perhaps a law and Surfaces.
enum class ContactKind : std::uint8_t { plain, under_law, rough, sheared };

template <bool own_radius, bool own_mass, ContactKind kind = ContactKind::plain>
struct DiskView {
  static constexpr bool has_mass = own_mass;
  static constexpr bool may_have_law = kind != ContactKind::plain;
  static constexpr bool has_law = kind == ContactKind::under_law;
  static constexpr bool is_sheared = kind == ContactKind::sheared;
  static constexpr bool may_be_rough = is_sheared || kind == ContactKind::rough;
  double* x;
  double* y;
  double* vx;
  double* vy;
  const DiskId* id;
  const double* radius_column;
  const double* mass_column;
  double common_radius;
  double common_mass;
  [[no_unique_address]] std::conditional_t<may_be_rough, double*, NoSpin> spin{};  // null of smooth disks

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

template <bool own_radius, bool own_mass, ContactKind kind = ContactKind::plain>
DiskView<own_radius, own_mass, kind> view_of(Disks& d) {
  DiskView<own_radius, own_mass, kind> view{d.x.data(),      d.y.data(),    d.vx.data(),     d.vy.data(),  d.id.data(),
                                            d.radius.data(), d.mass.data(), d.common_radius, d.common_mass};
  if constexpr (decltype(view)::may_be_rough) view.spin = d.spin.data();
  return view;
}

// Calls kernel(view) with the view type that fits the columns present.
template <ContactKind kind = ContactKind::plain, class Kernel>
decltype(auto) with_view(Disks& d, Kernel&& kernel) {
  if (d.radius.empty()) {
    return d.mass.empty() ? kernel(view_of<false, false, kind>(d)) : kernel(view_of<false, true, kind>(d));
  }
  return d.mass.empty() ? kernel(view_of<true, false, kind>(d)) : kernel(view_of<true, true, kind>(d));
}

}  // namespace carom
