// The loads of all supports of a step, solved together: impulses that stop the approach of their disks and never pull.
// A linear complementarity problem, symmetric and positive; solved by sweeps of projected Gauss and Seidel, forward and
// back, from the loads of the step before (Catto 2005), accelerated by a nonsmooth conjugate gradient (Silcowitz, Niebe
// and Erleben 2010). A settled pile is a fixed point: its loads cancel gravity exactly.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/exact_sum.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/resolve.hpp"

namespace carom {

// Cycles (a sweep forward and one back) end when none of a cycle's impulses changed a relative velocity by more than
// this times g dt, or times the largest change of the first cycle; or after so many: what is left then is passed on to
// the next step with the loads. With fewer while disks land, overlaps grow (10^4 disks poured into a box 457 mean
// diameters high: 3.8 % with 12, 1.3 % with 24); with fewer at rest, tremors.
inline constexpr double settled_change = 5e-4;
inline constexpr int landing_cycles = 24;
inline constexpr int resting_cycles = 12;
// A change in the first cycle, in units of g dt, above which something lands.
inline constexpr double landing_change = 4.0;
// But where a change is left that would press disks together by more than this share of the sum of their radii in a
// step, they go on up to most_cycles: a heap that lands on a tall pile is stopped by its foot, hundreds of layers
// below.
inline constexpr double pressing_share = 1e-3;
inline constexpr int most_cycles = 256;
// In a high pile that trembles they go on too, up to so many times its height in layers: a load passes on by a few
// layers a cycle, and with too few of them a pile sways, which opens contacts and keeps it swaying. It trembles where a
// cycle changes relative velocities by an amount between these, in units of g dt (root mean square, by the mass that
// contacts feel); larger changes are those of disks that land.
inline constexpr double cycles_a_layer = 0.2;
inline constexpr double calm_change = 3e-4;
inline constexpr double trembling_change = 0.1;

struct Support {
  std::uint32_t i1, i2;     // where the disks are stored; twice the same for a wall
  double nx, ny;            // from first to second, or into the wall
  double inverse1;          // 1 / mass of the first
  double second;            // 1 / mass of the second; of a wall that moves, its speed towards the disk; else 0
  double effective;         // mass that the contact feels
  double contact_distance;  // sum of radii (the radius, at a wall); length
  double impulse;           // accumulated, >= 0; mass length / time
  double counted = 0.0;     // of it, in an earlier round of the step
  double before = 0.0;      // impulse when the cycle began
  double direction = 0.0;   // of the conjugate gradient; mass length / time
};

inline bool is_wall_support(const Support& s) {
  return s.i1 == s.i2;
}

// force: what the contact bore in the step, or the round, before; mass length / time^2.
template <class View>
Support make_support(const View& d, const StepRules& rules, const ContactEvent& e, double force) {
  const double impulse = force * rules.dt;
  Support s{
      e.i1, e.i2, 0.0, 0.0, 1.0 / d.mass(e.i1), 0.0, 0.0, d.radius(e.i1), impulse, rules.round == 0 ? 0.0 : impulse};
  if (is_obstacle(e.id2)) {
    const ObstacleGap gap = gap_to(d, rules.box, e.i1, e.id2);
    s.nx = -gap.nx;
    s.ny = -gap.ny;
    s.i2 = e.i1;
    s.effective = d.mass(e.i1);
    s.second = gap.velocity.x * gap.nx + gap.velocity.y * gap.ny;
    return s;
  }
  if (is_wall(e.id2)) {
    const Side side = wall_side(e.id2);
    s.nx = side == Side::left ? -1.0 : side == Side::right ? 1.0 : 0.0;
    s.ny = side == Side::bottom ? -1.0 : side == Side::top ? 1.0 : 0.0;
    s.i2 = e.i1;
    s.effective = d.mass(e.i1);
    s.second = rules.box.place(side).speed;
    return s;
  }
  const Relative r = relative(d, e.i1, e.i2, rules.box);
  const double distance = std::sqrt(r.distance2());
  s.nx = distance > 0.0 ? r.dx / distance : 1.0;
  s.ny = distance > 0.0 ? r.dy / distance : 0.0;
  s.second = 1.0 / d.mass(e.i2);
  s.contact_distance += d.radius(e.i2);
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
  if (!is_wall_support(s)) {
    d.vx[s.i2] += jx * s.second;
    d.vy[s.i2] += jy * s.second;
  }
}

// A load acts all through the step, not at its end: the way that it moves the disks by, impulse dt / (2 m). So a pile
// at rest stays where it is to rounding.
template <class View>
void shift_by_load(const View& d, const Support& s, double dt) {
  const double jx = s.impulse * s.nx * (0.5 * dt);
  const double jy = s.impulse * s.ny * (0.5 * dt);
  d.x[s.i1] -= jx * s.inverse1;
  d.y[s.i1] -= jy * s.inverse1;
  if (!is_wall_support(s)) {
    d.x[s.i2] += jx * s.second;
    d.y[s.i2] += jy * s.second;
  }
}

// What the support bore in this round: impulse (r1 + r2), the virial, or at a wall the impulse itself.
inline double borne(const Support& s) {
  const double impulse = s.impulse - s.counted;
  return is_wall_support(s) ? impulse : impulse * s.contact_distance;
}

// One support's part of a sweep: the impulse that stops the approach, never less than 0 in total.
// Returns by how much it changed the relative velocity.
template <class View>
double relax(const View& d, Support& s) {
  double u = -(d.vx[s.i1] * s.nx + d.vy[s.i1] * s.ny);
  u += is_wall_support(s) ? -s.second : d.vx[s.i2] * s.nx + d.vy[s.i2] * s.ny;
  const double total = std::max(0.0, s.impulse - s.effective * u);
  const double change = total - s.impulse;
  s.impulse = total;
  apply_impulse(d, s, change);
  return std::abs(change) / s.effective;
}

// What a cycle changed.
struct CycleFigures {
  double largest = 0.0;  // change of a relative velocity; length / time
  double strain = 0.0;   // the same over the sum of radii; 1 / time
  ExactSum square;       // of the changes of the impulses over the masses they feel; mass length^2 / time^2
};

template <class View>
void relax_forward(const View& d, Support& s, CycleFigures& figures) {
  s.before = s.impulse;
  figures.largest = std::max(figures.largest, relax(d, s));
}

template <class View>
void relax_back(const View& d, Support& s, CycleFigures& figures) {
  figures.largest = std::max(figures.largest, relax(d, s));
  const double change = s.impulse - s.before;
  figures.strain = std::max(figures.strain, std::abs(change) / (s.effective * s.contact_distance));
  figures.square.add(change * change / s.effective);
}

// On from the cycle's impulses by beta times the direction taken before; the direction turns by the cycle's change.
// Impulses may become negative here: the next cycle ends that.
template <class View>
void extrapolate(const View& d, Support& s, double beta) {
  const double step = beta * s.direction;
  s.direction = step + (s.impulse - s.before);
  if (beta == 0.0) return;
  s.impulse += step;
  apply_impulse(d, s, step);
}

// What all supports bear and feel.
struct SupportTotals {
  ExactSum impulse;  // mass length / time
  ExactSum mass;     // effective

  void add(const Support& s) {
    impulse.add(s.impulse);
    mass.add(s.effective);
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

// fall: g dt; square: what is left after the usual cycles. The height in layers is the mean load over the weight of a
// disk: a pile of N disks has 2 N contacts (without friction it stands on no more), so that they feel together the mass
// of the pile, and the sum of their loads times diameters, its virial, is its weight times its height.
inline CalmingCycles calming_cycles(const SupportTotals& totals, double fall, double square) {
  const double mass = totals.mass.value();
  const double trembling = trembling_change * fall;
  if (square > trembling * trembling * mass) return {};
  const double layers = totals.impulse.value() / (fall * mass);
  const double calm = calm_change * fall;
  return {static_cast<int>(std::min(cycles_a_layer * layers, static_cast<double>(most_cycles))), calm * calm * mass};
}

// sweeps.cycle() relaxes all supports forward and back and returns its CycleFigures; sweeps.extrapolate(beta) calls
// extrapolate on all, in order; sweeps.totals() adds them all up. The loads of the step before have been applied.
template <class Sweeps>
void solve_supports(const StepRules& rules, Sweeps&& sweeps) {
  const double fall = rules.gravity.size * rules.dt;
  double settled = settled_change * fall;
  int usual_cycles = resting_cycles;
  const double pressing = pressing_share / rules.dt;
  double square = 0.0;
  CalmingCycles calming;
  for (int cycle = 1; cycle <= most_cycles; ++cycle) {
    const CycleFigures figures = sweeps.cycle();
    if (cycle == 1) {
      settled = std::max(settled, settled_change * figures.largest);
      if (figures.largest > landing_change * fall) usual_cycles = landing_cycles;
    }
    if (figures.largest <= settled || cycle == most_cycles) return;
    const double now = figures.square.value();
    if (cycle == usual_cycles) calming = calming_cycles(sweeps.totals(), fall, now);
    const bool calm = cycle >= calming.most || now <= calming.square;
    if (cycle >= usual_cycles && figures.strain <= pressing && calm) return;
    // Fletcher and Reeves; where the changes grow, the gradient begins anew.
    sweeps.extrapolate(square > 0.0 && now < square ? now / square : 0.0);
    square = now;
  }
}

}  // namespace carom
