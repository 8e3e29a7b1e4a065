// The loads of all supports of a step, solved together: impulses >= 0 that stop the approach of their disks. This is a
// symmetric, positive linear complementarity problem. It is solved by projected Gauss-Seidel sweeps, forward and back,
// which start from the loads of the step before (Catto 2005) and are accelerated by Nesterov's momentum (Mazhar, Heyn,
// Negrut and Tasora 2015, for projected gradients; here a cycle of two sweeps takes the place of a gradient step). A
// settled pile is a fixed point: its loads cancel gravity exactly.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/exact_sum.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/resolve.hpp"

namespace carom {

// Every watched_cycles-th cycle (a sweep forward and one back) is checked for convergence. The cycles end when no
// impulse changed a relative velocity by more than settled_change times g dt, or times the largest change of the first
// cycle; or after resting_cycles, or landing_cycles where disks land. The remaining error goes on to the next step with
// the loads. With fewer cycles while disks land, overlaps grow (10^4 disks poured into a box 457 mean diameters high:
// 3.8 % with 12, 1.3 % with 24); with fewer at rest, piles tremble.
inline constexpr int watched_cycles = 4;  // the numbers of cycles below are multiples of it
inline constexpr double settled_change = 5e-4;
inline constexpr int landing_cycles = 24;
inline constexpr int resting_cycles = 12;
// A change in the first cycle, in units of g dt, above which something lands.
inline constexpr double landing_change = 4.0;
// While the last change would press disks together by more than this share of the sum of their radii in a step, cycles
// go on, up to most_cycles: a heap that lands on a tall pile is stopped by its foot, hundreds of layers below.
inline constexpr double pressing_share = 1e-3;
inline constexpr int most_cycles = 256;
// In a high pile that trembles they go on too, up to cycles_a_layer times its height in layers: a load passes on by a
// few layers in a cycle, and with too few cycles a pile sways, which opens contacts and keeps it swaying. A pile
// trembles if a cycle changes relative velocities by between calm_change and trembling_change, in units of g dt (root
// mean square, weighted by the effective mass of contacts); larger changes mean that disks land. 10^5 disks 300 layers
// high still trembled with 0.1 in place of 1.
inline constexpr double cycles_a_layer = 0.2;
inline constexpr double calm_change = 3e-4;
inline constexpr double trembling_change = 1.0;

// What a sweep reads of a support.
struct Support {
  double nx, ny;              // from first to second, or into the wall
  double inverse1, inverse2;  // 1 / mass; a wall's is 0
  double wall_speed;          // towards the disk, length / time; 0 where both are disks
  double effective;           // mass that the contact feels
  std::uint32_t i1, i2;       // where the disks are stored; twice the same for a wall
};

// The other columns of the supports of a step.
struct SupportSet {
  std::vector<double> impulse;  // accumulated, >= 0 after a sweep; mass length / time
  std::vector<double> last;     // after the cycle before
  std::vector<double>
      before;  // impulse at the start of a cycle under Watch::all; after it, its term of CycleFigures::square
  std::vector<double> ahead;             // after a cycle under Watch::all: its term of CycleFigures::ahead
  std::vector<double> counted;           // part of `impulse` that an earlier round of the step has counted
  std::vector<double> contact_distance;  // sum of radii (the radius, at a wall)
  std::vector<Vec2> v, last_v;  // velocities of the disks in contact, by storage index; last_v: after the cycle before
};

inline bool is_wall_support(const Support& s) {
  return s.i1 == s.i2;
}

template <class View>
Support make_support(const View& d, const StepRules& rules, const ContactEvent& e) {
  Support s{0.0, 0.0, 1.0 / d.mass(e.i1), 0.0, 0.0, d.mass(e.i1), e.i1, e.i1};
  if (is_obstacle(e.id2)) {
    const ObstacleGap gap = gap_to(d, rules.box, e.i1, e.id2);
    s.nx = -gap.nx;
    s.ny = -gap.ny;
    s.wall_speed = gap.velocity.x * gap.nx + gap.velocity.y * gap.ny;
  } else if (is_wall(e.id2)) {
    const Side side = wall_side(e.id2);
    s.nx = side == Side::left ? -1.0 : side == Side::right ? 1.0 : 0.0;
    s.ny = side == Side::bottom ? -1.0 : side == Side::top ? 1.0 : 0.0;
    s.wall_speed = rules.box.place(side).speed;
  } else {
    const Relative r = relative(d, e.i1, e.i2, rules.box);
    const double distance = std::sqrt(r.distance2());
    s.i2 = e.i2;
    s.inverse2 = 1.0 / d.mass(e.i2);
    s.nx = distance > 0.0 ? r.dx / distance : 1.0;
    s.ny = distance > 0.0 ? r.dy / distance : 0.0;
    s.effective = reduced_mass(d.mass(e.i1), d.mass(e.i2));
  }
  return s;
}

// Initialises the columns of support k, whose contact is e. force: that of the contact in the step, or the round,
// before; mass length / time^2.
template <class View>
void begin_support(SupportSet& set, std::size_t k, const View& d, const StepRules& rules, const ContactEvent& e,
                   double force) {
  set.impulse[k] = force * rules.dt;
  set.counted[k] = rules.round == 0 ? 0.0 : set.impulse[k];
  set.contact_distance[k] = is_wall(e.id2) ? d.radius(e.i1) : d.radius(e.i1) + d.radius(e.i2);
}

// Equal and opposite changes of momentum, so that it is conserved to rounding; a wall does not move.
inline void apply_impulse(Vec2* v, const Support& s, double impulse) {
  v[s.i1].x -= impulse * (s.nx * s.inverse1);
  v[s.i1].y -= impulse * (s.ny * s.inverse1);
  if (!is_wall_support(s)) {
    v[s.i2].x += impulse * (s.nx * s.inverse2);
    v[s.i2].y += impulse * (s.ny * s.inverse2);
  }
}

// A load acts all through the step, not only at its end: it displaces the disks by impulse dt / (2 m). So a pile at
// rest stays where it is to rounding.
template <class View>
void shift_by_load(const View& d, const Support& s, double impulse, double dt) {
  const double j = impulse * (0.5 * dt);
  d.x[s.i1] -= j * (s.nx * s.inverse1);
  d.y[s.i1] -= j * (s.ny * s.inverse1);
  if (!is_wall_support(s)) {
    d.x[s.i2] += j * (s.nx * s.inverse2);
    d.y[s.i2] += j * (s.ny * s.inverse2);
  }
}

// What support k bore in this round: impulse (r1 + r2), its virial, or at a wall the impulse itself. s: support k.
inline double borne(const SupportSet& set, std::size_t k, const Support& s) {
  const double impulse = set.impulse[k] - set.counted[k];
  return is_wall_support(s) ? impulse : impulse * set.contact_distance[k];
}

// Reduces an impulse by `less`, but not below 0; returns the change.
inline double change_impulse(double& impulse, double less) {
  const double before = impulse;
  impulse = std::max(0.0, before - less);
  return impulse - before;
}

// One support's part of a sweep: the impulse that stops the approach, never less than 0 in total.
// Returns by how much it changed that.
inline double relax(Vec2* v, const Support& s, double& impulse) {
  const Vec2& first = v[s.i1];
  const Vec2& second = v[s.i2];
  const double first_along = first.x * s.nx + first.y * s.ny;
  const double second_along = is_wall_support(s) ? -s.wall_speed : second.x * s.nx + second.y * s.ny;
  const double change = change_impulse(impulse, s.effective * (second_along - first_along));
  apply_impulse(v, s, change);
  return change;
}

// Which figures of a cycle are computed. Few cycles compute all: the figures cost more than the sweeps.
enum class Watch : std::uint8_t { nothing, largest, all };

// What a cycle changed.
struct CycleFigures {
  double largest = 0.0;  // change of a relative velocity; length / time
  double strain = 0.0;   // the same over the sum of radii; 1 / time
  ExactSum square;       // of the changes of the impulses over the masses they feel; mass length^2 / time^2
  ExactSum ahead;        // of the changes times those since the cycle before, likewise: < 0 where momentum overshoots

  void add(const CycleFigures& other) {
    largest = std::max(largest, other.largest);
    strain = std::max(strain, other.strain);
    square.add(other.square);
    ahead.add(other.ahead);
  }
};

// Support k's part of the sweep forward, and of the sweep back. s: support k.
template <Watch watch>
void relax_forward(SupportSet& set, std::size_t k, const Support& s, CycleFigures& figures) {
  if constexpr (watch == Watch::all) set.before[k] = set.impulse[k];
  const double change = relax(set.v.data(), s, set.impulse[k]);
  if constexpr (watch != Watch::nothing) figures.largest = std::max(figures.largest, std::abs(change) / s.effective);
}

template <Watch watch>
void relax_back(SupportSet& set, std::size_t k, const Support& s, CycleFigures& figures) {
  const double back = relax(set.v.data(), s, set.impulse[k]);
  if constexpr (watch != Watch::nothing) figures.largest = std::max(figures.largest, std::abs(back) / s.effective);
  if constexpr (watch == Watch::all) {
    const double change = set.impulse[k] - set.before[k];
    const double by_mass = change / s.effective;
    figures.strain = std::max(figures.strain, std::abs(by_mass) / set.contact_distance[k]);
    set.before[k] = change * by_mass;
    set.ahead[k] = (set.impulse[k] - set.last[k]) * by_mass;
  }
}

// After a cycle under Watch::all: adds the terms of supports [begin, end).
inline void add_products(const SupportSet& set, std::size_t begin, std::size_t end, CycleFigures& figures) {
  figures.square.add({set.before.data() + begin, end - begin});
  figures.ahead.add({set.ahead.data() + begin, end - begin});
}

// Extrapolates impulses by `momentum` times their change since the end of the cycle before. They may become negative
// here; the next cycle corrects that. Velocities depend linearly on impulses, so they are extrapolated in the same way,
// disk by disk.
inline void extrapolate_impulses(SupportSet& set, std::size_t begin, std::size_t end, double momentum) {
  double* const impulses = set.impulse.data();
  double* const last = set.last.data();
  for (std::size_t k = begin; k < end; ++k) {
    const double impulse = impulses[k];
    const double on = impulse + momentum * (impulse - last[k]);
    impulses[k] = momentum != 0.0 ? on : impulse;
    last[k] = impulse;
  }
}

inline void extrapolate_velocity(Vec2& v, Vec2& last, double momentum) {
  const Vec2 now = v;
  const Vec2 before = last;
  last = now;
  if (momentum != 0.0) v = {now.x + momentum * (now.x - before.x), now.y + momentum * (now.y - before.y)};
}

// Sums over all supports, for calming_cycles.
struct SupportTotals {
  ExactSum impulse;  // mass length / time
  ExactSum mass;     // effective

  void add(double its_impulse, double its_mass) {
    impulse.add(its_impulse);
    mass.add(its_mass);
  }
  void add(const SupportTotals& other) {
    impulse.add(other.impulse);
    mass.add(other.mass);
  }
};

// How many cycles to go on for, beyond the usual ones, and down to which sum of squares (CycleFigures::square).
struct CalmingCycles {
  int most = 0;
  double square = 0.0;  // mass length^2 / time^2
};

// fall: g dt; square: CycleFigures::square after the usual cycles. The height in layers is the mean load over the
// weight of a disk. It follows from the totals, since a pile of N disks without friction has about 2 N contacts: their
// effective masses, half a disk's each, add up to the mass of the pile, and the sum of load times diameter, the virial,
// is its weight times its height.
inline CalmingCycles calming_cycles(const SupportTotals& totals, double fall, double square) {
  const double mass = totals.mass.value();
  const double trembling = trembling_change * fall;
  if (square > trembling * trembling * mass) return {};
  const double layers = totals.impulse.value() / (fall * mass);
  const double calm = calm_change * fall;
  return {static_cast<int>(std::min(cycles_a_layer * layers, static_cast<double>(most_cycles))), calm * calm * mass};
}

// The first two cycles are watched too, since supports may have settled from the start.
inline Watch watch_in(int cycle) {
  return cycle % watched_cycles == 0 ? Watch::all : cycle <= 2 ? Watch::largest : Watch::nothing;
}

template <class Sweeps>
CycleFigures run_cycle(Watch watch, const Sweeps& sweeps) {
  switch (watch) {
    case Watch::all:
      return sweeps.template cycle<Watch::all>();
    case Watch::largest:
      return sweeps.template cycle<Watch::largest>();
    case Watch::nothing:
      break;
  }
  return sweeps.template cycle<Watch::nothing>();
}

// sweeps.cycle<watch>() relaxes all supports forward and back and returns its CycleFigures;
// sweeps.extrapolate(momentum) extrapolates all impulses and velocities; sweeps.totals() adds all supports up. The
// loads of the step before have been applied.
template <class Sweeps>
void solve_supports(const StepRules& rules, const Sweeps& sweeps) {
  const double fall = rules.gravity.size * rules.dt;
  double settled = settled_change * fall;
  int usual_cycles = resting_cycles;
  const double pressing = pressing_share / rules.dt;
  CalmingCycles calming;
  int age = 0;  // of the momentum, in cycles
  for (int cycle = 1;; ++cycle) {
    const Watch watch = watch_in(cycle);
    const CycleFigures figures = run_cycle(watch, sweeps);
    if (cycle == 1) {
      settled = std::max(settled, settled_change * figures.largest);
      if (figures.largest > landing_change * fall) usual_cycles = landing_cycles;
    }
    if (watch != Watch::nothing && figures.largest <= settled) return;
    if (watch == Watch::all) {
      if (cycle == most_cycles) return;
      const double now = figures.square.value();
      if (cycle == usual_cycles) calming = calming_cycles(sweeps.totals(), fall, now);
      const bool calm = cycle >= calming.most || now <= calming.square;
      if (cycle >= usual_cycles && figures.strain <= pressing && calm) return;
      if (figures.ahead.value() < 0.0) age = 0;
    }
    sweeps.extrapolate(age / (age + 3.0));
    ++age;
  }
}

}  // namespace carom
