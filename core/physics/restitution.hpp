// The restitution of a contact: two disks have a number or a RestitutionLaw, walls and obstacles have numbers of their
// own.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/disks/disk_view.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/disks/restitution_law.hpp"
#include "core/disks/roughness.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/disk_pair.hpp"

namespace carom {

// v^(1/5), from + - * / alone, so that its bits are the same everywhere; within a unit in the last place. With v = x
// 2^(5 q), x in [1, 32), the root is y 2^q, where y^5 = x is solved by a fixed number of Newton iterations. So the root
// of 32^q v has the bits of the root of v, times 2^q. Precondition: v >= 0 and finite.
inline double fifth_root(double v) {
  if (v == 0.0) return 0.0;
  double unit = 1.0;
  if (v < 0x1p-1000) {  // denormal numbers too
    v *= 0x1p+200;
    unit = 0x1p-40;
  }
  constexpr int bias = 1023, mantissa = 52, shift = 1025;  // shift: a multiple of 5, above the bias
  const auto bits = std::bit_cast<std::uint64_t>(v);
  const int exponent = static_cast<int>(bits >> mantissa) - bias;
  const int q = (exponent + shift) / 5 - shift / 5;
  const auto power_of_two = [](int k) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(k + bias) << mantissa);
  };
  const double x = v * power_of_two(-5 * q);
  // The tangent at x = 8: above the root by a quarter of it at most, which six iterations take to below rounding.
  double y = 1.2126 + 0.0379 * x;
  for (int k = 0; k < 6; ++k) {
    const double y2 = y * y;
    y -= (y - x / (y2 * y2)) * 0.2;
  }
  return y * power_of_two(q) * unit;
}

// Restitution of two disks (one may be fixed) that approach along the line of centres at this speed; length / time, >=
// 0. With a viscosity it is the leading order of viscoelastic spheres (Schwager and Poeschel 1998).
inline double restitution_at(const Restitution& r, double speed) {
  if (r.viscosity == 0.0) return r.least;
  return std::max(r.least, 1.0 - r.viscosity * fifth_root(speed));
}

// Speed of approach along the line of centres; length / time. Preconditions: distance2() > 0, approach() <= 0.
inline double speed_of_approach(const Relative& r) {
  return -r.approach() / std::sqrt(r.distance2());
}

// Rules: StepRules or ExactRules, which have the number `restitution`, `law` (null where the number is all), `surfaces`
// (null where all are smooth) and `box`.

// Calls kernel(view) with the view type for these rules: sheared, rough, under a law or plain (ContactKind).
template <class Rules, class Kernel>
decltype(auto) with_view(Disks& d, const Rules& rules, Kernel&& kernel) {
  if (rules.box.shear.acts()) return with_view<ContactKind::sheared>(d, kernel);
  if (rules.surfaces != nullptr) return with_view<ContactKind::rough>(d, kernel);
  return rules.law == nullptr ? with_view(d, kernel) : with_view<ContactKind::under_law>(d, kernel);
}

// Restitution of disks i and j, whose relative motion is r.
template <class View, class Rules>
double pair_restitution(const View& d, const Rules& rules, std::uint32_t i, std::uint32_t j, const Relative& r) {
  if constexpr (View::may_have_law) {
    if (View::has_law || rules.law != nullptr) {
      return restitution_at(rules.law->of(rules.restitution, d.id[i], d.id[j]), speed_of_approach(r));
    }
  }
  return rules.restitution;
}

// Restitution of the disk with this id at an obstacle that it approaches at this speed (length / time), under a law,
// which holds for fixed disks as for others. Precondition: rules.law is not null.
template <class Rules>
double restitution_under_law(const Rules& rules, DiskId id, const Obstacle& o, double speed) {
  if (o.is_segment()) return o.restitution;
  return restitution_at(rules.law->of(rules.restitution, id, o.id), speed);
}

// Restitution of disk i at an obstacle that it approaches at this speed; length / time.
template <class View, class Rules>
double obstacle_restitution(const View& d, const Rules& rules, std::uint32_t i, const Obstacle& o, double speed) {
  if constexpr (View::may_have_law) {
    if (View::has_law || rules.law != nullptr) return restitution_under_law(rules, d.id[i], o, speed);
  }
  return o.restitution;
}

// Restitution at a wall or an obstacle, without a law.
inline double restitution_of_wall(const Domain& box, DiskId partner) {
  return is_obstacle(partner) ? (*box.obstacles)[obstacle_of(partner)].restitution
                              : box.restitution(wall_side(partner));
}

// The id of the disk, fixed or not, that stands behind a contact's partner; nothing for a wall. partner:
// ContactEvent::id2.
inline std::optional<DiskId> other_disk(const Domain& box, DiskId partner) {
  if (!is_wall(partner)) return partner;
  if (!is_obstacle(partner) || (*box.obstacles)[obstacle_of(partner)].is_segment()) return {};
  return (*box.obstacles)[obstacle_of(partner)].id;
}

// May a contact of the disk with this id lose energy? partner: ContactEvent::id2.
template <class Rules>
bool may_lose_energy(const Rules& rules, DiskId id, DiskId partner) {
  const std::optional<DiskId> other = other_disk(rules.box, partner);
  if (rules.surfaces != nullptr) {
    const bool thermal = is_wall(partner) && !is_obstacle(partner) &&
                         rules.box.is_thermal(wall_side(partner));  // it draws velocities and has no friction
    if (!thermal && rules.surfaces->of(other ? Touching::disks : Touching::wall).dissipates()) return true;
  }
  if (rules.law != nullptr && other) return rules.law->of(rules.restitution, id, *other).least < 1.0;
  return (is_wall(partner) ? restitution_of_wall(rules.box, partner) : rules.restitution) < 1.0;
}

// The same for a contact found in a step.
template <class View, class Rules>
bool may_lose_energy(const View&, const Rules& rules, const ContactEvent& e) {
  if constexpr (View::may_have_law) {
    return may_lose_energy(rules, e.id1, e.id2);
  } else {
    return (is_wall(e.id2) ? restitution_of_wall(rules.box, e.id2) : rules.restitution) < 1.0;
  }
}

}  // namespace carom
