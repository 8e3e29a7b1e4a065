// What happens at an event of the exact method: two disks collide, or a disk reaches a side or an obstacle. Both
// engines call this.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/types.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/side_motion.hpp"
#include "core/physics/exact_path.hpp"
#include "core/physics/obstacle_path.hpp"
#include "core/physics/parting.hpp"
#include "core/physics/resolve.hpp"

namespace carom {

// The restitution of disk pairs and at obstacles is at least this. With e = 0, two disks (or a disk and an inner wall)
// would keep no relative speed along the normal; by rounding they might still approach, and collide at the same moment
// for ever. The value is far above rounding and far below what any measurement can see.
inline constexpr double least_rebound = 0x1p-40;

// The constants of a run.
struct ExactRules {
  Domain box;
  Gravity gravity;                      // length / time^2
  double restitution = 1.0;             // of disk pairs, `least_rebound` at least
  double contact_time = -1.0;           // TC model; time, < 0: off
  std::uint64_t seed = 0;               // with thermal sides
  bool common_mass = true;              // pairs share impulses half and half
  bool constant = true;                 // neither a law nor the TC model: restitution does not depend on the contact
  const RestitutionLaw* law = nullptr;  // of disks, where `restitution` is not all
  const Surfaces* surfaces = nullptr;   // where disks are rough

  bool tc() const { return contact_time >= 0.0; }
};

// What an event reads and writes of one disk.
struct ExactDisk {
  PathSegment path;
  DiskId id = 0;  // only read, as are mass and radius
  double mass = 1.0;
  double last_contact = -never;    // TC model: when it last collided, disk or wall; time in the window, may be < 0
  std::uint32_t thermal_hits = 0;  // reflections by thermal sides so far
  double spin = 0.0;               // angular velocity of a rough disk, counter-clockwise; 1 / time
  double radius = 0.0;             // of a rough disk
};

// TC model (Luding and McNamara 1998): e = 1 where one of the disks collided less than contact_time ago.
inline bool made_elastic(const ExactRules& rules, double s, double last_contact) {
  return rules.tc() && s - last_contact < rules.contact_time;
}

// May friction at contacts of this kind dissipate energy?
inline bool rubs_away(const ExactRules& rules, Touching which) {
  return rules.surfaces != nullptr && rules.surfaces->of(which).dissipates();
}

inline RoughDisk rough_disk(ExactDisk& a) {
  return {a.radius, a.path.vx, a.path.vy, a.spin};
}

// Friction at a wall or a fixed disk that has just changed the velocity of disk a by `pressed` along this normal.
inline void rub_against(const ExactRules& rules, Vec2 normal, Touching which, double pressed, ExactDisk& a) {
  if (rules.surfaces == nullptr) return;
  rub_wall(rules.surfaces->of(which), rules.surfaces->inertia, normal, pressed, rough_disk(a));
}

// Smooth disks: no friction.
struct NoRubbing {
  void operator()(const Relative& /*met*/, double /*change*/) const {}
};

// Two disks (smaller id first) collide at time s; their new segments p and q start there. share and reduced_mass: of
// their masses. restitution(r): of disks whose relative motion is r. rub(r, change): applies friction, given what
// collide() returned. gravity: false if g is 0. wraps: false if neither disk nor the line between them crosses a
// periodic side.
template <bool gravity, bool wraps = true, class RestitutionOf, class Rub = NoRubbing>
[[gnu::always_inline]] inline PairImpact collide_paths(const Domain& box, const Gravity& g, double s, Shares share,
                                                       double reduced_mass, const RestitutionOf& restitution,
                                                       PathSegment& p, PathSegment& q, const Rub& rub = {}) {
  const bool begin_now = both_begin_at(s, p, q);
  drift<gravity>(p.x, p.y, p.vx, p.vy, s - p.start, g);
  drift<gravity>(q.x, q.y, q.vx, q.vy, s - q.start, g);
  p.start = q.start = s;
  const Relative r = wraps ? relative(p, q, box) : Relative{q.x - p.x, q.y - p.y, q.vx - p.vx, q.vy - p.vy};
  PairImpact outcome;
  if (r.approach() < 0.0 && r.distance2() > 0.0) {
    const double e = restitution(r);
    const double change = collide(r, share, e, p.vx, p.vy, q.vx, q.vy);
    rub(r, change);
    if (begin_now) [[unlikely]]
      part_disks(r, share, 0.0, p, q);
    outcome = {.virial = reduced_mass * change, .happened = true, .lost_energy = e < 1.0};
  }
  if constexpr (wraps) {
    wrap_into(p, box);
    wrap_into(q, box);
  }
  return outcome;
}

// The same in a sheared box, for disks of these masses. rough: false if rub does nothing.
template <class RestitutionOf, class Rub>
[[gnu::noinline, gnu::cold]] PairImpact collide_sheared(const Domain& box, double s, double mass_p, double mass_q,
                                                        const RestitutionOf& restitution, bool rough, const Rub& rub,
                                                        PathSegment& p, PathSegment& q) {
  const bool begin_now = both_begin_at(s, p, q);
  p = carried_to(p, s, 0.0);
  q = carried_to(q, s, 0.0);
  const Relative r = relative_in_shear(p, q, box);
  PairImpact outcome;
  if (r.approach() < 0.0 && r.distance2() > 0.0) {
    const double e = restitution(r);
    const double before = q.vx;
    const double jump = rows_to_nearest(q.y - p.y, box) * box.shear.jump;
    const double change = collide(r, shares(mass_p, mass_q), e, p.vx, p.vy, q.vx, q.vy);
    rub(r, change);
    if (begin_now) part_disks(r, shares(mass_p, mass_q), jump, p, q);
    outcome = {.virial = reduced_mass(mass_p, mass_q) * change, .happened = true, .lost_energy = e < 1.0};
    record_shear(outcome, r, rows_to_nearest(q.y - p.y, box), mass_q * (q.vx - before), rough, box.shear);
  }
  outcome.shear_work += wrap_with_work(p, mass_p, box);
  outcome.shear_work += wrap_with_work(q, mass_q, box);
  return outcome;
}

// The restitution of a contact of two disks.
struct PairRestitution {
  double value;
  bool elastic;  // by the TC model
  bool held;     // it would lose energy otherwise
};

// Restitution along the normal at time s, for relative motion r. last_contact: the last collision of either disk.
inline PairRestitution restitution_of_pair(const ExactRules& rules, double s, DiskId first, DiskId second,
                                           double last_contact, const Relative& r) {
  const double e = rules.law == nullptr
                       ? rules.restitution
                       : std::max(least_rebound, restitution_at(rules.law->of(rules.restitution, first, second),
                                                                speed_of_approach(r)));
  const bool elastic = made_elastic(rules, s, last_contact);
  return {elastic ? 1.0 : e, elastic, elastic && e < 1.0};
}

// Disks a and b, the one with the smaller id first, collide at time s; their new segments start there.
inline PairImpact collide_at(const ExactRules& rules, double s, ExactDisk& a, ExactDisk& b) {
  const Shares share = rules.common_mass ? equal_shares : shares(a.mass, b.mass);
  PairRestitution pair{.value = rules.restitution, .elastic = false, .held = false};
  const auto restitution = [&](const Relative& r) {
    if (!rules.constant) pair = restitution_of_pair(rules, s, a.id, b.id, std::max(a.last_contact, b.last_contact), r);
    return pair.value;
  };
  const auto rub = [&](const Relative& r, double change) {
    if (rules.surfaces == nullptr || pair.elastic) return;
    rub_disks(*rules.surfaces, r, share, change, rough_disk(a), rough_disk(b));
  };
  PairImpact outcome =
      rules.box.shear.acts()
          ? collide_sheared(rules.box, s, a.mass, b.mass, restitution, rules.surfaces != nullptr, rub, a.path, b.path)
          : collide_paths<true>(rules.box, rules.gravity, s, share, reduced_mass(a.mass, b.mass), restitution, a.path,
                                b.path, rub);
  if (outcome.happened) {
    const bool rubs = rubs_away(rules, Touching::disks);
    outcome.inaccurate = pair.held || (pair.elastic && rubs);
    outcome.lost_energy = outcome.lost_energy || (!pair.elastic && rubs);
    a.last_contact = b.last_contact = s;
  }
  return outcome;
}

// A disk that lies on the floor would collide infinitely often. Under the TC model it leaves the floor with at least
// this share of g contact_time, so that a hop lasts half a contact time or more. The energy of a hop, m (g t_c)^2 / 32,
// is of the order of what the model leaves to any disk at rest. It is added to the system at every contact with the
// floor, which bounds the cost of a pile: if only disks at rest received it, a pile would cool further and have four
// times as many collisions.
inline constexpr double least_hop = 0.25;

// The share of a wall's acceleration that counts in a hop: a vibrating wall presses a disk for half a period at most,
// which may be shorter than contact_time. towards: the wall's acceleration towards the disk; only its sign matters.
inline double hop_share(const ExactRules& rules, const SideMotion& motion, double towards) {
  const bool turns = rules.tc() && motion.vibrates() && towards > 0.0;
  return turns ? std::min(1.0, motion.half() / rules.contact_time) : 1.0;
}

// Disk a touches a thermal side at time s.
inline WallImpact meet_thermal_side(const ExactRules& rules, double s, Side side, ExactDisk& a) {
  PathSegment& p = a.path;
  const double before = outward_speed(side, p.vx, p.vy);
  WallImpact outcome{.happened = true};
  if (before > 0.0) {
    const double temperature = rules.box.temperature(side);
    const ThermalReflection reflected =
        reflect_thermally(side, temperature, a.mass, {rules.seed, a.id, a.thermal_hits++}, p.vx, p.vy);
    outcome.energy = reflected.energy;
    if (rules.surfaces != nullptr && rules.surfaces->walls.acts()) {
      outcome.energy +=
          spin_thermally(rules.surfaces->inertia, temperature, a.mass, a.radius, reflected.deviate, a.spin);
    }
    outcome.impulse = a.mass * (before - outward_speed(side, p.vx, p.vy));
  }
  a.last_contact = s;
  return outcome;
}

// Disk a touches a moving side at time s. Under the TC model it hops off a side that accelerates towards it, as off the
// floor.
inline WallImpact meet_moving_side(const ExactRules& rules, double s, Side side, ExactDisk& a) {
  PathSegment& p = a.path;
  const SidePlace place = rules.box.place_after(side, s);
  const bool elastic = made_elastic(rules, s, a.last_contact);
  const double e = elastic ? 1.0 : rules.box.restitution(side);
  const double approach = approach_speed(side, p.vx, p.vy, place);
  const bool loses = rules.box.restitution(side) < 1.0 || rubs_away(rules, Touching::wall);
  WallImpact outcome{.happened = true, .inaccurate = elastic && loses, .lost_energy = !elastic && loses};
  const double leaving = approach > 0.0 ? e * approach : -approach;
  double hop = 0.0;
  if (rules.tc()) {
    SidePlace pressing = place;
    pressing.acceleration *= hop_share(rules, rules.box.motions[static_cast<std::size_t>(side)], place.acceleration);
    hop = least_hop * approach_acceleration(side, rules.gravity, pressing) * rules.contact_time;
  }
  const double away = std::max(leaving, hop);
  if (approach > 0.0 || away > leaving) {
    const double kick = rebound(side, place, approach, away, p.vx, p.vy);
    if (!elastic && approach > 0.0) rub_against(rules, inward_normal(side), Touching::wall, kick, a);
    outcome.impulse = a.mass * kick;
    outcome.energy = outcome.impulse * place.speed;
  }
  a.last_contact = s;
  return outcome;
}

// Makes the disk leave the side with at least this speed; does nothing unless least > 0.
inline void hop_off(Side side, double least, PathSegment& p) {
  if (least > 0.0 && -outward_speed(side, p.vx, p.vy) < least) set_outward_speed(side, -least, p.vx, p.vy);
}

// Disk a reaches a side at time s: it bounces off a wall or crosses a periodic side. If the side is a sink, the caller
// removes the disk.
inline WallImpact meet_side_at(const ExactRules& rules, double s, Side side, ExactDisk& a) {
  PathSegment& p = a.path;
  p = carried_to(p, s, rules.gravity);
  WallImpact outcome;
  if (rules.box.is_thermal(side)) {
    outcome = meet_thermal_side(rules, s, side, a);
  } else if (rules.box.moves(side)) {
    outcome = meet_moving_side(rules, s, side, a);
  } else if (rules.box.side(side) == SideKind::wall) {
    const bool elastic = made_elastic(rules, s, a.last_contact);
    const double e = elastic ? 1.0 : rules.box.restitution(side);
    const double before = outward_speed(side, p.vx, p.vy);
    if (before > 0.0) bounce(side, e, p.vx, p.vy);
    if (!elastic && before > 0.0) {
      rub_against(rules, inward_normal(side), Touching::wall, before - outward_speed(side, p.vx, p.vy), a);
    }
    if (rules.tc()) hop_off(side, least_hop * outward_acceleration(side, rules.gravity) * rules.contact_time, p);
    const bool loses = rules.box.restitution(side) < 1.0 || rubs_away(rules, Touching::wall);
    outcome = {.impulse = a.mass * std::max(0.0, before - outward_speed(side, p.vx, p.vy)),
               .happened = true,
               .inaccurate = elastic && loses,
               .lost_energy = !elastic && loses};
    a.last_contact = s;
  }
  if (rules.box.shear.acts()) {
    outcome.energy = wrap_with_work(p, a.mass, rules.box);
  } else if (rules.box.side(side) != SideKind::sink) {
    wrap_into(p, rules.box);
  }
  return outcome;
}

// Disk a touches an obstacle at time s: it bounces along the shortest line to it. Under the TC model it hops as from
// the floor, in proportion to the part of gravity g that presses it against the obstacle.
inline WallImpact bounce_off_obstacle(const ExactRules& rules, double s, const Obstacle& o,
                                      const ShortestLine& shortest, const Gravity& g, ExactDisk& a) {
  PathSegment& p = a.path;
  const Vec2 apart = shortest.line;
  const double distance2 = shortest.length2;
  const double approach = apart.x * p.vx + apart.y * p.vy;
  const double distance = std::sqrt(distance2);
  WallImpact outcome;
  if (distance > 0.0) {
    double own = o.restitution;
    bool elastic = false;
    if (!rules.constant) {
      elastic = made_elastic(rules, s, a.last_contact);
      if (rules.law != nullptr) own = restitution_under_law(rules, a.id, o, std::max(0.0, -approach) / distance);
    }
    const double e = elastic ? 1.0 : std::max(own, least_rebound);
    double change = approach < 0.0 ? -(1.0 + e) * approach : 0.0;  // of the approach
    if (rules.tc()) {
      const double least = least_hop * rules.contact_time * g.against(apart.x, apart.y);
      change = std::max(change, least - approach);
    }
    p.vx += change / distance2 * apart.x;
    p.vy += change / distance2 * apart.y;
    const bool bounced = change > 0.0;
    const bool loses = own < 1.0 || rubs_away(rules, o.touching());
    if (!elastic && approach < 0.0) {
      rub_against(rules, {apart.x / distance, apart.y / distance}, o.touching(), change / distance, a);
    }
    outcome = {.impulse = a.mass * (change / distance),
               .happened = bounced,
               .inaccurate = elastic && loses,
               .lost_energy = bounced && !elastic && loses};
    if (bounced) a.last_contact = s;
  }
  return outcome;
}

// The same for a moving wall, in the frame of the wall.
[[gnu::noinline, gnu::cold]] inline WallImpact bounce_off_moving_wall(const ExactRules& rules, double s,
                                                                      const Obstacle& o, ExactDisk& a) {
  PathSegment& p = a.path;
  const PlacedObstacle now = placed(o, rules.box, s);
  const Vec2 wall = now.place.velocity;
  const Vec2 before{p.vx, p.vy};
  p.vx -= wall.x;
  p.vy -= wall.y;
  const ShortestLine shortest = shortest_line_wound(now.obstacle, p.x, p.y, rules.box);
  const double towards = now.place.acceleration.x * shortest.line.x + now.place.acceleration.y * shortest.line.y;
  const double share = hop_share(rules, rules.box.obstacles->motion_of(o).pace, towards);
  const Gravity felt(rules.gravity.left + share * now.place.acceleration.x,
                     rules.gravity.down + share * now.place.acceleration.y);
  WallImpact impact = bounce_off_obstacle(rules, s, now.obstacle, shortest, felt, a);
  if (!impact.happened) {
    p.vx = before.x;
    p.vy = before.y;
    return impact;
  }
  p.vx += wall.x;
  p.vy += wall.y;
  record_push(impact, a.mass, wall, before, p.vx, p.vy);
  return impact;
}

// After a bounce off an obstacle at time s, where the path p begins: makes sure that the disk recedes (parting.hpp).
[[gnu::noinline, gnu::cold]] inline void part_from_obstacle(const Domain& box, double s, const Obstacle& o,
                                                            PathSegment& p) {
  if (o.moves) {
    const PlacedObstacle now = placed(o, box, s);
    part_from_wall(shortest_line_wound(now.obstacle, p.x, p.y, box).line, now.place.velocity, p);
  } else {
    part_from_wall(shortest_line(o, p.x, p.y, box).line, {0.0, 0.0}, p);
  }
}

// Disk a touches obstacle k (its place in State::obstacles) at time s. If that is a sink, the caller removes the disk.
inline WallImpact meet_obstacle_at(const ExactRules& rules, double s, std::uint32_t k, ExactDisk& a) {
  PathSegment& p = a.path;
  const bool begins_now = !(s > p.start);
  p = carried_to(p, s, rules.gravity);
  const Obstacle& o = (*rules.box.obstacles)[k];
  if (o.kind == ObstacleKind::sink) return {};
  const WallImpact outcome =
      o.moves ? bounce_off_moving_wall(rules, s, o, a)
              : bounce_off_obstacle(rules, s, o, shortest_line(o, p.x, p.y, rules.box), rules.gravity, a);
  if (begins_now && outcome.happened) [[unlikely]]
    part_from_obstacle(rules.box, s, o, p);
  wrap_into(p, rules.box);
  return outcome;
}

// The time of an event and the ids of its disks.
struct EventMark {
  double time = never;      // in the window
  DiskId id1 = 0, id2 = 0;  // id2 may be a wall_partner
};

// May any of the run's contacts lose energy?
inline bool dissipates(const ExactRules& rules) {
  const Domain& box = rules.box;
  if (rules.surfaces != nullptr && rules.surfaces->dissipate()) return true;
  return rules.restitution < 1.0 || (rules.law != nullptr && rules.law->dissipates()) || box.walls_dissipate() ||
         (box.obstacles != nullptr && box.obstacles->dissipates());
}

// Inelastic collapse: more than collapse_events inelastic impacts of one disk within the share collapse_share of the
// window's length. Elastic impacts do not count: a light disk between a wall and a disk of 10^14 times its mass has
// 15,707,963 collisions, and then no more.
inline constexpr std::uint32_t collapse_events = 256;
inline constexpr double collapse_share = 1e-12;

// Counts a disk's inelastic impacts within a vanishing time.
struct Burst {
  double begin = -never;  // time in the window
  std::uint32_t events = 0;

  // Counts an impact at time s. Returns true if that is an inelastic collapse.
  bool add(double s, double window) {
    if (s - begin > collapse_share * window) *this = {s, 0};
    return ++events > collapse_events;
  }
};

}  // namespace carom
