// What happens at an event of the exact method: two disks collide, a disk meets a side. Both engines call this.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/base/types.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/exact_path.hpp"
#include "core/physics/obstacle_path.hpp"
#include "core/physics/resolve.hpp"

namespace carom {

// The constants of a run.
struct ExactRules {
  Domain box;
  Gravity gravity;                      // length / time^2
  double restitution = 1.0;             // of disk pairs
  double contact_time = -1.0;           // TC model; time, < 0: off
  std::uint64_t seed = 0;               // with thermal sides
  bool common_mass = true;              // pairs share impulses half and half
  const RestitutionLaw* law = nullptr;  // of disks, where `restitution` is not all
  bool constant = true;  // neither a law nor the TC model: a contact's restitution is a number that is known before

  bool tc() const { return contact_time >= 0.0; }
};

// What an event reads and writes of one disk.
struct ExactDisk {
  PathSegment path;
  double last_contact = -never;    // TC model: when it last collided, disk or wall; time in the window, may be < 0
  std::uint32_t thermal_hits = 0;  // reflections by thermal sides so far
};

// TC model (Luding and McNamara 1998): e = 1 where one of the disks collided less than contact_time ago.
inline bool made_elastic(const ExactRules& rules, double s, double last_contact) {
  return rules.tc() && s - last_contact < rules.contact_time;
}

// Two disks (smaller id first) collide at time s; their new segments p and q start there. share and reduced_mass: of
// their masses. restitution(r): of disks that approach as r says. gravity: may g be other than 0?
template <bool gravity, class RestitutionOf>
[[gnu::always_inline]] inline Impact collide_paths(const Domain& box, const Gravity& g, double s, Shares share,
                                                   double reduced_mass, const RestitutionOf& restitution,
                                                   PathSegment& p, PathSegment& q) {
  drift<gravity>(p.x, p.y, p.vx, p.vy, s - p.start, g);
  drift<gravity>(q.x, q.y, q.vx, q.vy, s - q.start, g);
  p.start = q.start = s;
  const Relative r = relative(p, q, box);
  Impact outcome;
  if (r.approach() < 0.0 && r.distance2() > 0.0) {
    const double e = restitution(r);
    outcome = {reduced_mass * collide(r, share, e, p.vx, p.vy, q.vx, q.vy), 0.0, true, false, e < 1.0};
  }
  wrap_into(p, box);
  wrap_into(q, box);
  return outcome;
}

// Disks a and b, which have these ids (the smaller one first), collide at time s; their new segments start there.
inline Impact collide_at(const ExactRules& rules, double s, DiskId id_a, DiskId id_b, double mass_a, double mass_b,
                         ExactDisk& a, ExactDisk& b) {
  const Shares share = rules.common_mass ? equal_shares : shares(mass_a, mass_b);
  bool held_elastic = false;  // by the TC model
  const auto restitution = [&](const Relative& r) {
    if (rules.constant) return rules.restitution;
    const double e = rules.law == nullptr
                         ? rules.restitution
                         : restitution_at(rules.law->of(rules.restitution, id_a, id_b), speed_of_approach(r));
    const bool elastic = made_elastic(rules, s, std::max(a.last_contact, b.last_contact));
    held_elastic = elastic && e < 1.0;
    return elastic ? 1.0 : e;
  };
  Impact outcome = collide_paths<true>(rules.box, rules.gravity, s, share, reduced_mass(mass_a, mass_b), restitution,
                                       a.path, b.path);
  if (outcome.happened) {
    outcome.inaccurate = held_elastic;
    a.last_contact = b.last_contact = s;
  }
  return outcome;
}

// A disk that lies on the floor would collide infinitely often. Under the TC model it leaves the floor with at least
// this share of g contact_time, so that its hops last half a contact time or more; their energy, m (g t_c)^2 / 32, is
// of the order of what the model leaves to any disk at rest. The energy is added to the system, which bounds what a
// pile costs: were it given only to disks at rest, a pile would cool further and have four times as many collisions.
inline constexpr double least_hop = 0.25;

// Disk a, which has this id, is at a thermal side at time s.
inline Impact meet_thermal_side(const ExactRules& rules, double s, Side side, double mass, DiskId id, ExactDisk& a) {
  PathSegment& p = a.path;
  const double before = outward_speed(side, p.vx, p.vy);
  Impact outcome{0.0, 0.0, true, false};
  if (before > 0.0) {
    outcome.energy =
        reflect_thermally(side, rules.box.temperature(side), mass, {rules.seed, id}, a.thermal_hits, p.vx, p.vy);
    outcome.virial = mass * (before - outward_speed(side, p.vx, p.vy));
  }
  a.last_contact = s;
  return outcome;
}

// Disk a is at a moving side at time s. Under the TC model it leaves a side that accelerates towards it with a hop, as
// it does from the floor.
inline Impact meet_moving_side(const ExactRules& rules, double s, Side side, double mass, ExactDisk& a) {
  PathSegment& p = a.path;
  const SidePlace place = rules.box.place(side).after(s);
  const bool elastic = made_elastic(rules, s, a.last_contact);
  const double e = elastic ? 1.0 : rules.box.restitution(side);
  const double approach = approach_speed(side, p.vx, p.vy, place);
  Impact outcome{0.0, 0.0, true, elastic && rules.box.restitution(side) < 1.0, e < 1.0};
  const double leaving = approach > 0.0 ? e * approach : -approach;
  const double hop =
      rules.tc() ? least_hop * approach_acceleration(side, rules.gravity, place) * rules.contact_time : 0.0;
  const double away = std::max(leaving, hop);
  if (approach > 0.0 || away > leaving) {
    outcome.virial = mass * rebound(side, place, approach, away, p.vx, p.vy);
    outcome.energy = outcome.virial * place.speed;
  }
  a.last_contact = s;
  return outcome;
}

// The disk leaves the side with at least this speed; no operation where that is not above 0.
inline void hop_off(Side side, double least, PathSegment& p) {
  if (least > 0.0 && -outward_speed(side, p.vx, p.vy) < least) set_outward_speed(side, -least, p.vx, p.vy);
}

// Disk a, which has this id, reaches a side at time s: it bounces off a wall or crosses a periodic side. What a sink
// takes, the caller removes.
inline Impact meet_side_at(const ExactRules& rules, double s, Side side, double mass, DiskId id, ExactDisk& a) {
  PathSegment& p = a.path;
  p = carried_to(p, s, rules.gravity);
  Impact outcome;
  if (rules.box.is_thermal(side)) {
    outcome = meet_thermal_side(rules, s, side, mass, id, a);
  } else if (rules.box.moves(side)) {
    outcome = meet_moving_side(rules, s, side, mass, a);
  } else if (rules.box.side(side) == SideKind::wall) {
    const bool elastic = made_elastic(rules, s, a.last_contact);
    const double e = elastic ? 1.0 : rules.box.restitution(side);
    const double before = outward_speed(side, p.vx, p.vy);
    if (before > 0.0) bounce(side, e, p.vx, p.vy);
    if (rules.tc()) hop_off(side, least_hop * outward_acceleration(side, rules.gravity) * rules.contact_time, p);
    outcome = {mass * std::max(0.0, before - outward_speed(side, p.vx, p.vy)), 0.0, true,
               elastic && rules.box.restitution(side) < 1.0, e < 1.0};
    a.last_contact = s;
  }
  if (rules.box.side(side) != SideKind::sink) wrap_into(p, rules.box);
  return outcome;
}

// Disk a, which has this id, touches obstacle k (its place in State::obstacles) at time s: it bounces along the
// shortest line to it; what a sink takes, the caller removes. Under the TC model it hops as from the floor, in
// proportion to the part of gravity that presses it against the obstacle.
inline Impact meet_obstacle_at(const ExactRules& rules, double s, std::uint32_t k, double mass, DiskId id,
                               ExactDisk& a) {
  PathSegment& p = a.path;
  p = carried_to(p, s, rules.gravity);
  const Obstacle& o = (*rules.box.obstacles)[k];
  if (o.kind == ObstacleKind::sink) return {};
  const ShortestLine shortest = shortest_line(o, p.x, p.y, rules.box);
  const Vec2 apart = shortest.line;
  const double distance2 = shortest.length2;
  const double approach = apart.x * p.vx + apart.y * p.vy;
  const double distance = std::sqrt(distance2);
  Impact outcome;
  if (distance > 0.0) {
    double own = o.restitution;
    bool elastic = false;
    if (!rules.constant) {
      elastic = made_elastic(rules, s, a.last_contact);
      if (rules.law != nullptr) own = restitution_under_law(rules, id, o, std::max(0.0, -approach) / distance);
    }
    const double e = elastic ? 1.0 : own;
    double change = approach < 0.0 ? -(1.0 + e) * approach : 0.0;  // of the approach
    if (rules.tc()) {
      const double least = least_hop * rules.contact_time * rules.gravity.against(apart.x, apart.y);
      change = std::max(change, least - approach);
    }
    p.vx += change / distance2 * apart.x;
    p.vy += change / distance2 * apart.y;
    const bool bounced = change > 0.0;
    outcome = {mass * (change / distance), 0.0, bounced, elastic && own < 1.0, bounced && e < 1.0};
    if (bounced) a.last_contact = s;
  }
  wrap_into(p, rules.box);
  return outcome;
}

// When an event happens and to which disks.
struct EventMark {
  double time = never;      // in the window
  DiskId id1 = 0, id2 = 0;  // id2 may be a wall_partner
};

// May any of the run's contacts lose energy?
inline bool dissipates(const ExactRules& rules) {
  const Domain& box = rules.box;
  return rules.restitution < 1.0 || (rules.law != nullptr && rules.law->dissipates()) || box.walls_dissipate() ||
         (box.obstacles != nullptr && box.obstacles->dissipates());
}

// Inelastic collapse: more than this many impacts of one disk that lose energy, within this share of the window's
// length. Elastic ones do not count: 15,707,963 collisions of a light disk between a wall and a heavy one 10^14 times
// its mass are as many as there are, and end.
inline constexpr std::uint32_t collapse_events = 256;
inline constexpr double collapse_share = 1e-12;

// Counts a disk's inelastic impacts within a vanishing time.
struct Burst {
  double begin = -never;  // time in the window
  std::uint32_t events = 0;

  // Returns true when the impacts pile up.
  bool add(double s, double window) {
    if (s - begin > collapse_share * window) *this = {s, 0};
    return ++events > collapse_events;
  }
};

}  // namespace carom
