// The outcomes of contacts: the part of EventProcessor that begins segments. Included only by event_processor.cpp, so
// that it is inlined there.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "core/step/window_length.hpp"
#include "parallel/exact/event_processor.hpp"
#include "parallel/exact/plain_collision.hpp"

namespace carom {

template <Scope scope>
ExactDisk EventProcessor<scope>::disk(std::uint32_t i) const {
  ExactDisk now{record_[i].path, record_[i].id, window_.disks->mass_of(i)};
  if (!window_.last_contact.empty()) now.last_contact = window_.last_contact[i];
  if (!window_.thermal_hits.empty()) now.thermal_hits = window_.thermal_hits[i];
  if (!window_.spin.empty()) {
    now.spin = window_.spin[i];
    now.radius = record_[i].radius;
  }
  return now;
}

template <Scope scope>
void EventProcessor<scope>::meet_side(std::uint32_t i, double time) {
  const Side side = record_[i].partner.side();
  const DiskId partner = record_[i].partner.wall_id();
  ExactDisk now = disk(i);
  const WallImpact impact = meet_side_at(window_.rules, time, side, now);
  if (counts(i)) worker_.tally.add_wall(partner, impact);
  const SinkNumber sink = sink_of(window_.rules.box, partner);
  const EventMark event{time, record_[i].id, partner};
  begin_segment(i, now, sink != no_sink ? LoggedSegment::gone : LoggedSegment::no_disk, event);
  if (sink != no_sink) {
    take(i, sink, time);
  } else {
    predict_after_event(i, time);
  }
  if (!window_.burst.empty() && impact.lost_energy) count_burst(i, event);
}

template <Scope scope>
void EventProcessor<scope>::meet_obstacle(std::uint32_t i, double time) {
  const DiskId partner = record_[i].partner.wall_id();
  ExactDisk now = disk(i);
  const WallImpact impact = meet_obstacle_at(window_.rules, time, record_[i].partner.place(), now);
  if (counts(i)) worker_.tally.add_wall(partner, impact);
  const EventMark event{time, record_[i].id, partner};
  const SinkNumber sink = sink_of(window_.rules.box, partner);
  begin_segment(i, now, sink != no_sink ? LoggedSegment::gone : LoggedSegment::no_disk, event);
  if (sink != no_sink) return take(i, sink, time);
  predict_after_event(i, time);
  if (!window_.burst.empty() && impact.lost_energy) count_burst(i, event);
}

template <Scope scope>
void EventProcessor<scope>::take(std::uint32_t i, SinkNumber sink, double time) {
  if (counts(i)) worker_.tally.add_taken(sink, window_.length - time);
  schedule(i, never, Partner::none());
}

template <Scope scope>
inline void EventProcessor<scope>::collide_pair(std::uint32_t i, std::uint32_t j, double time) {
  switch (pairs_) {
    case PairKind::elastic_of_one_mass:
      return collide_smooth_pair<PairKind::elastic_of_one_mass>(FreeFlight{}, i, j, time);
    case PairKind::of_constant_restitution:
      return is_straight_ ? collide_smooth_pair<PairKind::of_constant_restitution>(FreeFlight{}, i, j, time)
                          : collide_smooth_pair<PairKind::of_constant_restitution>(fall_, i, j, time);
    case PairKind::smooth:
      return is_straight_ ? collide_smooth_pair<PairKind::smooth>(FreeFlight{}, i, j, time)
                          : collide_smooth_pair<PairKind::smooth>(fall_, i, j, time);
    case PairKind::sheared:
      return collide_smooth_pair<PairKind::sheared>(FreeFlight{}, i, j, time);
    case PairKind::any:
      return collide_any_pair(i, j, time);
  }
}

// collide_any_pair for kinds of pairs that need less.
template <Scope scope>
template <PairKind kind, class Flight>
void EventProcessor<scope>::collide_smooth_pair(const Flight& flight, std::uint32_t i, std::uint32_t j, double time) {
  constexpr bool elastic_of_one_mass = kind == PairKind::elastic_of_one_mass;
  constexpr bool constant = is_constant(kind);
  if (record_[i].id > record_[j].id) std::swap(i, j);
  DiskRecord& a = record_[i];
  DiskRecord& b = record_[j];
  // A collision that the speed bound excludes: so the bound does not hold.
  if (!(std::max(a.path.start, b.path.start) <= time) || is_over(i) || is_over(j)) [[unlikely]] {
    worker_.too_fast = worker_.ended = true;
    return;
  }
  const bool inside = (lists_.rows().row(i).is_inside() && lists_.rows().row(j).is_inside()) ||
                      inner_part_.holds(time, flight, a.path, b.path);
  if (kind == PairKind::sheared && !inside) return collide_any_pair(i, j, time);
  if (window_.keeps_paths) [[unlikely]] {
    log_start(i);
    log_start(j);
  }
  const Disks& disks = *window_.disks;
  const bool common_mass = elastic_of_one_mass || window_.rules.common_mass;
  const Shares share = common_mass ? equal_shares : shares(disks.mass_of(i), disks.mass_of(j));
  const auto collide = [&](const auto& restitution) __attribute__((always_inline)) {
    return inside ? collide_plainly(time, flight, share, restitution, a.path, b.path)
                  : collide_across<Flight::falls>(time, share, restitution, a.path, b.path);
  };
  PlainCollision outcome;
  PairRestitution pair{.value = window_.rules.restitution, .elastic = false, .held = false};
  if constexpr (!constant) {
    outcome = collide([&](const Relative& r) { return (pair = pair_restitution(i, j, time, r)).value; });
  } else {
    outcome = collide(ConstantRestitution{pair.value});
  }
  if (outcome.happened) {
    if (counts(i)) tally_smooth_pair<kind>(i, j, outcome, pair);
    if (!constant && !window_.last_contact.empty()) window_.last_contact[i] = window_.last_contact[j] = time;
  }
  const EventMark event{time, a.id, b.id};
  begin_paths(i, j, outcome.fastest2, event);
  predict_after_event(i, time);
  predict_after_event(j, time);
  if (elastic_of_one_mass || window_.burst.empty() || !outcome.happened || !(pair.value < 1.0)) return;
  count_burst(i, event);
  count_burst(j, event);
}

// Counts the collision of disks i and j, with what follows from it for the virial.
template <Scope scope>
template <PairKind kind>
inline void EventProcessor<scope>::tally_smooth_pair(std::uint32_t i, std::uint32_t j, const PlainCollision& outcome,
                                                     const PairRestitution& pair) {
  const Disks& disks = *window_.disks;
  const bool common_mass = kind == PairKind::elastic_of_one_mass || window_.rules.common_mass;
  const double reduced = common_mass ? reduced_mass_ : reduced_mass(disks.mass_of(i), disks.mass_of(j));
  const double virial = reduced * outcome.change;
  if (kind == PairKind::sheared) shear_virials_[virial_count_] = virial * outcome.shear_share;
  virials_[virial_count_++] = virial;
  if (virial_count_ == virials_.size()) [[unlikely]]
    tally_virials();
  if (!is_constant(kind)) worker_.tally.inaccurate += pair.held ? 1 : 0;
}

// Disks i and j, which have just met, are on new paths. fastest2: the larger v^2.
template <Scope scope>
inline void EventProcessor<scope>::begin_paths(std::uint32_t i, std::uint32_t j, double fastest2,
                                               const EventMark& event) {
  DiskRecord& a = record_[i];
  DiskRecord& b = record_[j];
  if (window_.keeps_paths) [[unlikely]] {
    worker_.log.push_back({i, j, a.path});
    worker_.log.push_back({j, i, b.path});
  }
  worker_.segments += segments_of(i) + segments_of(j);
  if constexpr (scope == Scope::part) note_contact(a, b);
  ++a.version;
  ++b.version;
  if (std::max(a.version, b.version) > most_paths_of_disk || worker_.segments > window_.most_paths) [[unlikely]] {
    worker_.crowded = event;
    worker_.ended = true;
  }
  predictor_.note_speed(fastest2);
  if (has_regions && fastest2 > window_.speed_limit2) worker_.too_fast = worker_.ended = true;
  if constexpr (scope == Scope::region) {
    if (a.progress.has(DiskProgress::has_unresolved_neighbour)) safe_times_.push(i, event.time);
    if (b.progress.has(DiskProgress::has_unresolved_neighbour)) safe_times_.push(j, event.time);
  }
}

// Part: marks a ghost that an own disk has met. The own disk's path is right only if the ghost's path here was that in
// its owner.
template <Scope scope>
inline void EventProcessor<scope>::note_contact(DiskRecord& a, DiskRecord& b) {
  const bool ghost = a.progress.has(DiskProgress::ghost);
  if (ghost == b.progress.has(DiskProgress::ghost)) [[likely]]
    return;
  (ghost ? a : b).progress.set(DiskProgress::met_own);
}

// Restitution of disks i and j, whose relative motion is r, under a law or the TC model.
template <Scope scope>
PairRestitution EventProcessor<scope>::pair_restitution(std::uint32_t i, std::uint32_t j, double time,
                                                        const Relative& r) const {
  const std::vector<double>& last = window_.last_contact;
  return restitution_of_pair(window_.rules, time, record_[i].id, record_[j].id,
                             last.empty() ? -never : std::max(last[i], last[j]), r);
}

// The collision of disks that may be on two sides of a border along a period.
template <Scope scope>
template <bool falls, class RestitutionOf>
PlainCollision EventProcessor<scope>::collide_across(double time, Shares share, RestitutionOf restitution,
                                                     PathSegment& p, PathSegment& q) const {
  const ExactRules& rules = window_.rules;
  const PairImpact impact = collide_paths<falls>(rules.box, rules.gravity, time, share, 1.0, restitution, p, q);
  return {impact.happened, impact.virial, 0.0, std::max(p.vx * p.vx + p.vy * p.vy, q.vx * q.vx + q.vy * q.vy)};
}

template <Scope scope>
void EventProcessor<scope>::tally_virials() {
  worker_.tally.add_collisions(std::span<const double>(virials_).first(virial_count_));
  if (pairs_ == PairKind::sheared)
    worker_.tally.add_shears(std::span<const double>(shear_virials_).first(virial_count_));
  virial_count_ = 0;
}

// Logs the disk's first path of the window, if the disk is still on it.
template <Scope scope>
void EventProcessor<scope>::log_start(std::uint32_t i) {
  if (record_[i].version == 0) worker_.log.push_back({i, LoggedSegment::no_disk, record_[i].path});
}

template <Scope scope>
void EventProcessor<scope>::log_segment(std::uint32_t i, std::uint32_t partner, const PathSegment& path) {
  log_start(i);
  worker_.log.push_back({i, partner, path});
}

// After log_segment: logs the spin of a rough disk, which is `now` from here on.
template <Scope scope>
void EventProcessor<scope>::log_spin(std::uint32_t i, double now) {
  if (record_[i].version == 0) worker_.spin_log.push_back(window_.spin[i]);
  worker_.spin_log.push_back(now);
}

template <Scope scope>
void EventProcessor<scope>::collide_any_pair(std::uint32_t i, std::uint32_t j, double time) {
  if (record_[i].id > record_[j].id) std::swap(i, j);
  ExactDisk a = disk(i);
  ExactDisk b = disk(j);
  // A collision that the speed bound excludes: so the bound does not hold.
  if (!(std::max(a.path.start, b.path.start) <= time) || is_over(i) || is_over(j)) {
    worker_.too_fast = worker_.ended = true;
    return;
  }
  const PairImpact impact = collide_at(window_.rules, time, a, b);
  if (counts(i)) worker_.tally.add_pair(impact);
  if constexpr (scope == Scope::part) note_contact(record_[i], record_[j]);
  const EventMark event{time, a.id, b.id};
  begin_segment(i, a, j, event);
  begin_segment(j, b, i, event);
  predict_after_event(i, time);
  predict_after_event(j, time);
  if (window_.burst.empty() || !impact.lost_energy) return;
  count_burst(i, event);
  count_burst(j, event);
}

template <Scope scope>
void EventProcessor<scope>::begin_segment(std::uint32_t i, const ExactDisk& now, std::uint32_t partner,
                                          const EventMark& event) {
  DiskRecord& f = record_[i];
  if (window_.keeps_paths) log_segment(i, partner, now.path);
  if (!window_.spin.empty()) {
    if (window_.keeps_paths) log_spin(i, now.spin);
    window_.spin[i] = now.spin;
  }
  f.path = now.path;
  worker_.segments += segments_of(i);
  if (++f.version > most_paths_of_disk || worker_.segments > window_.most_paths) [[unlikely]] {
    worker_.crowded = event;
    worker_.ended = true;
  }
  const double v2 = f.path.vx * f.path.vx + f.path.vy * f.path.vy;
  predictor_.note_speed(v2);
  if (v2 > window_.speed_limit2) worker_.too_fast = worker_.ended = true;
  if (!window_.last_contact.empty()) window_.last_contact[i] = now.last_contact;
  if (!window_.thermal_hits.empty()) window_.thermal_hits[i] = now.thermal_hits;
  if (partner == LoggedSegment::gone) {
    // No path meets one that is not a number.
    f.path.x = f.path.y = std::numeric_limits<double>::quiet_NaN();
    worker_.any_gone = true;
  } else if (scope == Scope::region && record_[i].progress.has(DiskProgress::has_unresolved_neighbour)) {
    safe_times_.push(i, now.path.start);
  }
}

// Counts an impact that loses energy. In a region, a disk whose impacts pile up waits for the border pass, and the
// window is run again without regions.
template <Scope scope>
void EventProcessor<scope>::count_burst(std::uint32_t i, const EventMark& event) {
  if (!window_.burst[i].add(event.time, window_.length)) return;
  if (!worker_.collapse) worker_.collapse = event;
  if constexpr (scope == Scope::region) {
    if (record_[i].progress.is_active()) block(i, event.time);
  } else {
    worker_.ended = true;
  }
}

}  // namespace carom
