#include "parallel/exact/event_processor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/step/window_length.hpp"

namespace carom {

namespace {

// In QueuedEvent::disk: it is the disk's safe time, not its next event.
constexpr std::uint32_t safe_time_bit = 0x80000000U;
// A disk whose safe time proves to be later than it was queued for, by at least this share of the slice, is queued
// again; otherwise it is blocked.
constexpr double worthwhile_share = 1.0 / 16.0;
constexpr Count events_between_polls = 4096;

}  // namespace

void EventProcessor::run() {
  const auto name_event = [this](QueuedEvent& event) { name(event); };
  const auto prefetch = [this](std::uint32_t disk) {
    __builtin_prefetch(&window_.record[disk & ~safe_time_bit]);
    lists_.prefetch(disk & ~safe_time_bit);
  };
  QueuedEvent e;
  while (!worker_.ended && worker_.queue.pop(e, name_event, prefetch)) {
    process(e);
    if (worker_.until_poll-- == 0) poll_watch();
  }
  worker_.fastest2 = std::max(worker_.fastest2, predictor_.fastest2());
}

void EventProcessor::poll_watch() {
  worker_.until_poll = events_between_polls;
  if (!window_.go_on || window_.go_on()) return;
  worker_.given_up = worker_.ended = true;
}

// The ids of the disk's next event. An entry that is invalid by now may get any.
void EventProcessor::name(QueuedEvent& e) const {
  if ((e.disk & safe_time_bit) != 0) return;
  const DiskRecord& f = window_.record[e.disk];
  if (!f.partner.is_contact()) return;
  const DiskId partner = f.partner.is_disk() ? window_.record[f.partner.index()].id : f.partner.wall_id();
  e.id1 = std::min(f.id, partner);
  e.id2 = std::max(f.id, partner);
}

void EventProcessor::process(const QueuedEvent& e) {
  const std::uint32_t i = e.disk & ~safe_time_bit;
  if (!is_resolved(i)) return;
  if (i != e.disk) {
    reach_safe_time(i, e.time);
    return;
  }
  if (window_.next_event_time[i] != e.time) return;  // invalid: the disk's events have been predicted again
  const DiskRecord& f = window_.record[i];
  if (f.partner.is_disk()) {
    process_pair(i, e);
  } else if (f.partner.is_wall()) {
    if (e.id1 == f.id && e.id2 == f.partner.wall_id()) meet_side(i, e.time);
  } else if (f.partner.is_relist() && !relist(i, e.time)) {
    block(i, e.time, serial_pass);
  } else {
    predict_next_event(i, e.time);
  }
}

void EventProcessor::process_pair(std::uint32_t i, const QueuedEvent& e) {
  const std::uint32_t j = window_.record[i].partner.index();
  const DiskId id = window_.record[i].id;
  const DiskId other = window_.record[j].id;
  // An event of the same time may have taken this one's place in the queue; then there is another entry for it.
  if (e.id1 != std::min(id, other) || e.id2 != std::max(id, other)) return;
  if (!is_resolved(j)) {
    block(i, e.time, blocking_tile(j));
  } else if (window_.record[j].version == window_.record[i].partner_version) {
    collide_pair(i, j, e.time);
  } else {
    predict_next_event(i, e.time);
  }
}

// The tile that has to be processed before the motion of this unresolved disk is known.
std::uint32_t EventProcessor::blocking_tile(std::uint32_t i) const {
  const DiskProgress progress = window_.progress[i];
  if (progress.is(Progress::blocked)) return worker_.blocked[progress.record()].tile;
  return (window_.mark[i] & lists_other_region) != 0 ? serial_pass : lists_.tile_of(i);
}

double EventProcessor::known_until(std::uint32_t unresolved) const {
  const DiskProgress progress = window_.progress[unresolved];
  return progress.is(Progress::blocked) ? worker_.blocked[progress.record()].safe_time : window_.slice_start;
}

// Before this time, no earlier than `time`, the unresolved disk cannot touch disk i on its present path; `never` if not
// within the slice.
double EventProcessor::safe_time_from(std::uint32_t i, double time, std::uint32_t unresolved) const {
  const DiskRecord& f = window_.record[i];
  const DiskRecord& u = window_.record[unresolved];
  const double g = window_.rules.gravity;
  const double until = known_until(unresolved);
  const double from = std::max(time, until);
  const PathSegment p = carried_to(f.path, from, g);
  const PathSegment q = carried_to(u.path, until, g);
  const Relative r = relative(p, q, window_.rules.box);
  // Both towards each other, since the motion of the unresolved one is unknown.
  const double speed =
      std::sqrt(f.path.vx * f.path.vx + f.path.vy * f.path.vy) + g * window_.length + window_.speed_bound;
  const double contact_distance = f.radius + u.radius + window_.slack + window_.speed_bound * (from - until);
  const double most = contact_distance + speed * (window_.slice_stop() - from);
  const double distance2 = r.distance2();
  if (distance2 > most * most * (1.0 + 1e-9)) return never;
  return from + std::max(std::sqrt(distance2) - contact_distance, 0.0) / speed;
}

EventProcessor::SafeTime EventProcessor::safe_time(std::uint32_t i, double time) const {
  SafeTime first;
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (window_.progress[j].is_resolved()) return;
    first.any = true;
    const double t = safe_time_from(i, time, j);
    if (t < first.time) {
      first.time = t;
      first.tile = blocking_tile(j);
    }
  });
  return first;
}

void EventProcessor::push_safe_time(std::uint32_t i, double time) {
  const SafeTime safe = safe_time(i, time);
  if (!safe.any) return;
  window_.mark[i] |= has_unresolved_neighbour;
  if (window_.in_slice(safe.time)) worker_.queue.push({safe.time, 0, 0, i | safe_time_bit});
}

// The safe time may be later by now, if the disk's path has changed since it was queued.
void EventProcessor::reach_safe_time(std::uint32_t i, double time) {
  const SafeTime safe = safe_time(i, time);
  const double slice = window_.slice_stop() - window_.slice_start;
  if (safe.time <= time + worthwhile_share * slice) {
    block(i, time, safe.tile);
  } else if (window_.in_slice(safe.time)) {
    worker_.queue.push({safe.time, 0, 0, i | safe_time_bit});
  }
}

// Disk i's motion is not known from now on, so that its active neighbours get safe times too.
void EventProcessor::block(std::uint32_t i, double time, std::uint32_t tile) {
  window_.progress[i] = DiskProgress::blocked(static_cast<std::uint32_t>(worker_.blocked.size()));
  worker_.blocked.push_back({i, tile, time});
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (window_.progress[j].is(Progress::done)) return;
    window_.mark[j] |= has_unresolved_neighbour;
    if (!window_.progress[j].is(Progress::active)) return;
    const double safe = safe_time_from(j, time, i);
    if (window_.in_slice(safe)) worker_.queue.push({safe, 0, 0, j | safe_time_bit});
  });
}

// When disk i has to be relisted; never, if that is after its next event. Extrapolates no further than gravity bends
// the path little: the result is later than `from` then, however long the window is, so that relisting always makes
// progress.
double EventProcessor::relist_time(std::uint32_t i, double from, double next) const {
  const double g = window_.rules.gravity;
  const PathSegment& path = window_.record[i].path;
  if (lists_.stays_listed(i, path, from, std::min(next, window_.horizon), g)) return never;
  return lists_.earliest_relist_time(i, path, from, from, g);
}

// Finds and schedules the earliest event of the disk on its present path. Nothing happens to it up to `from`.
void EventProcessor::predict_next_event(std::uint32_t i, double from) {
  from = std::max(from, window_.record[i].path.start);
  bool lasting = false;
  const NextEvent next = predictor_.earliest(i, lasting);
  const double relist_at = relist_time(i, from, next.time);
  // The events of lasting contacts are predicted again when the next window starts.
  const double until = lasting ? window_.next_start : window_.horizon;
  if (std::min(relist_at, next.time) >= until) {
    schedule(i, until, Partner::none(), 0, 0);
  } else if (relist_at < next.time) {
    schedule(i, relist_at, Partner::relist(), 0, 0);
  } else {
    if (next.partner.is_disk()) {
      window_.record[i].partner_version = window_.record[next.partner.index()].version;
    }
    schedule(i, next.time, next.partner, next.id1, next.id2);
  }
}

void EventProcessor::schedule(std::uint32_t i, double time, Partner partner, DiskId id1, DiskId id2) {
  window_.next_event_time[i] = time;
  window_.record[i].partner = partner;
  if (window_.in_slice(time)) worker_.queue.push({time, id1, id2, i});
}

// False if that would change the lists of another region.
bool EventProcessor::relist(std::uint32_t i, double time) {
  PathSegment p = carried_to(window_.record[i].path, time, window_.rules.gravity);
  wrap_into(p, window_.rules.box);
  if (!lists_.relist(i, {p.x, p.y}, *window_.disks, worker_.region, worker_.found)) return false;
  ++worker_.relisted;
  if (window_.mode == EngineMode::tiled) mark_relisted(i);
  if (!worker_.is_serial) push_safe_time(i, time);
  return true;
}

// Disk i has a new list, and is in other disks' lists than before. Marks are set at once: the neighbours keep disk i
// in their lists, however soon it is relisted.
void EventProcessor::mark_relisted(std::uint32_t i) {
  const auto mark_later_tile = [&](std::uint32_t a, std::uint32_t b) {
    if (lists_.tile_of(b) > lists_.tile_of(a) || (window_.mark[b] & lists_other_region) != 0) {
      window_.mark[a] |= lists_later_tile;
    }
  };
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (region_of(i) != region_of(j)) {
      mark_other_region(i);
      mark_other_region(j);
    }
    mark_later_tile(i, j);
    mark_later_tile(j, i);
  });
}

void EventProcessor::mark_other_region(std::uint32_t i) {
  if ((window_.mark[i] & lists_other_region) != 0) return;
  window_.mark[i] |= lists_other_region;
  worker_.border.push_back(i);
  lists_.for_each_neighbour(i, [&](std::uint32_t j) { window_.mark[j] |= lists_later_tile; });
}

ExactDisk EventProcessor::disk(std::uint32_t i) const {
  ExactDisk now{window_.record[i].path};
  if (!window_.last_contact.empty()) now.last_contact = window_.last_contact[i];
  return now;
}

void EventProcessor::meet_side(std::uint32_t i, double time) {
  const Side side = window_.record[i].partner.side();
  const DiskId partner = window_.record[i].partner.wall_id();
  ExactDisk now = disk(i);
  const Impact impact = meet_side_at(window_.rules, time, side, window_.disks->mass_of(i), now);
  worker_.tally.add(partner, impact);
  const bool gone = window_.rules.box.side(side) == SideKind::sink;
  const EventMark event{time, window_.record[i].id, partner};
  begin_segment(i, now, gone, event);
  if (gone) {
    schedule(i, never, Partner::none(), 0, 0);
  } else {
    predict_next_event(i, time);
  }
  if (!window_.burst.empty() && loses_energy(window_.rules, partner, impact)) count_burst(i, event);
}

void EventProcessor::collide_pair(std::uint32_t i, std::uint32_t j, double time) {
  if (window_.record[i].id > window_.record[j].id) std::swap(i, j);
  const Disks& d = *window_.disks;
  const DiskId id1 = window_.record[i].id;
  const DiskId id2 = window_.record[j].id;
  ExactDisk a = disk(i);
  ExactDisk b = disk(j);
  // The speed bound excluded this collision, so it does not hold.
  if (window_.is_done(i) || window_.is_done(j) || !(std::max(a.path.start, b.path.start) <= time)) {
    worker_.too_fast = worker_.ended = true;
    return;
  }
  const Impact impact = collide_at(window_.rules, time, d.mass_of(i), d.mass_of(j), a, b);
  worker_.tally.add(id2, impact);
  const EventMark event{time, id1, id2};
  begin_segment(i, a, false, event);
  begin_segment(j, b, false, event);
  predict_next_event(i, time);
  predict_next_event(j, time);
  if (window_.burst.empty() || !loses_energy(window_.rules, id2, impact)) return;
  count_burst(i, event);
  count_burst(j, event);
}

void EventProcessor::begin_segment(std::uint32_t i, const ExactDisk& now, bool gone, const EventMark& event) {
  DiskRecord& f = window_.record[i];
  if (window_.keeps_paths) {
    if (f.version == 0) worker_.log.push_back({i, false, f.path});
    worker_.log.push_back({i, gone, now.path});
  }
  f.path = now.path;
  if (++f.version > most_paths_of_disk || ++worker_.segments > window_.most_paths) [[unlikely]] {
    worker_.crowded = event;
    worker_.ended = true;
  }
  const double v2 = f.path.vx * f.path.vx + f.path.vy * f.path.vy;
  predictor_.note_speed(v2);
  if (v2 > window_.speed_limit2) worker_.too_fast = worker_.ended = true;
  if (!window_.last_contact.empty()) window_.last_contact[i] = now.last_contact;
  if (gone) {
    // No path meets one that is not a number.
    f.path.x = f.path.y = std::numeric_limits<double>::quiet_NaN();
    worker_.any_gone = true;
  } else if (!worker_.is_serial && (window_.mark[i] & has_unresolved_neighbour) != 0) {
    push_safe_time(i, now.path.start);
  }
}

// A disk whose impacts pile up is deferred to the serial pass; in tiled mode the window is then run again without
// tiles.
void EventProcessor::count_burst(std::uint32_t i, const EventMark& event) {
  if (!window_.burst[i].add(event.time, window_.length)) return;
  if (!worker_.collapse) worker_.collapse = event;
  worker_.ended = worker_.ended || worker_.is_serial;
  if (!worker_.is_serial && window_.progress[i].is(Progress::active)) block(i, event.time, serial_pass);
}

}  // namespace carom
