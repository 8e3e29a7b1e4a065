// Contacts that bear load: a pile under gravity. A contact that would bounce for less than a step is not an impact but
// a support; all supports of a step are solved together for the impulses that stop the approach and never pull, by
// sweeps of Gauss and Seidel from the loads of the step before (sequential impulses with warm starting, Catto 2005; the
// non-smooth contact dynamics of Moreau and Jean). A settled pile is a fixed point: its loads cancel gravity exactly.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/contact_event.hpp"
#include "core/resolve.hpp"
#include "core/state.hpp"

namespace carom {

// Approach speed, in units of g dt, up to which a contact is a support and not an impact. A step adds g dt to a disk's
// speed and a stack of n disks passes on n g dt at its foot, so the bound must exceed the height of piles in disks for
// their foot to stay at rest; larger values take restitution from slow impacts inside crowds (a first-order error: the
// bound goes to 0 with dt). Only disks with two or more contacts can be squeezed; one that just lies on a wall needs 2.
inline constexpr double squeezed_rest = 64.0;
inline constexpr double lying_rest = 2.0;

// Sweeps over the supports end when no impulse changed a relative velocity by more than this times g dt, or after
// most_sweeps: what is left then is passed on to the next step with the loads. More sweeps settle tall piles sooner.
inline constexpr double settled_change = 1e-3;
inline constexpr int most_load_sweeps = 16;

// Overlap, in units of g dt^2, that is left to a loaded contact so that rounding cannot lose it from one step to the
// next.
inline constexpr double contact_slop = 2.0;

struct Support {
  DiskId id1, id2;
  std::uint32_t i1, i2;
  double nx, ny;     // from first to second, or into the wall
  double inverse1;   // 1 / mass of the first
  double inverse2;   // 1 / mass of the second, 0 for a wall
  double effective;  // mass that the contact feels
  double impulse;    // accumulated, >= 0; mass length / time
};

inline bool by_ids(const ContactEvent& a, const ContactEvent& b) {
  return a.id1 != b.id1 ? a.id1 < b.id1 : a.id2 < b.id2;
}
inline bool by_ids(const ContactLoad& a, const ContactEvent& b) {
  return a.id1 != b.id1 ? a.id1 < b.id1 : a.id2 < b.id2;
}

// Force on the contact in the step before; 0 if it bore none. loads are in order of (id1, id2).
inline double load_of(const std::vector<ContactLoad>& loads, const ContactEvent& e) {
  const auto it = std::lower_bound(loads.begin(), loads.end(), e,
                                   [](const ContactLoad& a, const ContactEvent& b) { return by_ids(a, b); });
  return it != loads.end() && it->id1 == e.id1 && it->id2 == e.id2 ? it->force : 0.0;
}

// Relative velocity along the line of centres (or of the disk away from the wall); < 0: approaching. length / time.
template <class View>
double normal_velocity(const View& d, const Domain& box, const ContactEvent& e) {
  if (is_wall(e.id2)) return -outward_speed(wall_side(e.id2), d.vx[e.i1], d.vy[e.i1]);
  const Relative r = relative(d, e.i1, e.i2, box);
  const double distance2 = r.distance2();
  return distance2 > 0.0 ? r.approach() / std::sqrt(distance2) : 0.0;
}

// Is this contact a support? loaded: it bore load in the step before; squeezed: one of its disks has another contact.
template <class View>
bool is_support(const View& d, const StepRules& rules, const ContactEvent& e, bool loaded, bool squeezed) {
  if (loaded && squeezed) return true;
  const double speed = std::abs(normal_velocity(d, rules.box, e));
  if (squeezed) return speed <= squeezed_rest * rules.gravity * rules.dt;
  const bool lies = is_wall(e.id2) && rules.box.wall_restitution < 1.0;
  return lies && speed <= lying_rest * rules.gravity * rules.dt;
}

template <class View>
Support make_support(const View& d, const StepRules& rules, const ContactEvent& e, double force) {
  Support s{e.id1, e.id2, e.i1, e.i2, 0.0, 0.0, 1.0 / d.mass(e.i1), 0.0, 0.0, force * rules.dt};
  if (is_wall(e.id2)) {
    const Side side = wall_side(e.id2);
    s.nx = side == Side::left ? -1.0 : side == Side::right ? 1.0 : 0.0;
    s.ny = side == Side::bottom ? -1.0 : side == Side::top ? 1.0 : 0.0;
    s.i2 = e.i1;
    s.effective = d.mass(e.i1);
    return s;
  }
  const Relative r = relative(d, e.i1, e.i2, rules.box);
  const double distance = std::sqrt(r.distance2());
  s.nx = distance > 0.0 ? r.dx / distance : 1.0;
  s.ny = distance > 0.0 ? r.dy / distance : 0.0;
  s.inverse2 = 1.0 / d.mass(e.i2);
  s.effective = reduced_mass(d.mass(e.i1), d.mass(e.i2));
  return s;
}

// Equal and opposite, so momentum is conserved to rounding; a wall takes its share away.
template <class View>
void apply_impulse(const View& d, const Support& s, double impulse) {
  const double jx = impulse * s.nx;
  const double jy = impulse * s.ny;
  d.vx[s.i1] -= jx * s.inverse1;
  d.vy[s.i1] -= jy * s.inverse1;
  if (s.inverse2 > 0.0) {
    d.vx[s.i2] += jx * s.inverse2;
    d.vy[s.i2] += jy * s.inverse2;
  }
}

// One support's part of a sweep: the impulse that stops the approach, never less than 0 in total.
// Returns by how much it changed the relative velocity.
template <class View>
double relax(const View& d, Support& s) {
  double u = -(d.vx[s.i1] * s.nx + d.vy[s.i1] * s.ny);
  if (s.inverse2 > 0.0) u += d.vx[s.i2] * s.nx + d.vy[s.i2] * s.ny;
  const double total = std::max(0.0, s.impulse - s.effective * u);
  const double change = total - s.impulse;
  s.impulse = total;
  apply_impulse(d, s, change);
  return std::abs(change) / s.effective;
}

}  // namespace carom
