#include "parallel/exact/event_processor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/physics/event_order.hpp"
#include "core/step/window_length.hpp"

namespace carom {

namespace {

// Is there nothing but straight paths and collisions of disks of one mass?
bool is_plain(const WindowState& window) {
  return window.rules.gravity == 0.0 && window.rules.common_mass && window.last_contact.empty() && window.burst.empty();
}

constexpr Count events_between_polls = 4096;

}  // namespace

template <bool tiled>
EventProcessor<tiled>::EventProcessor(WindowState& window, NeighbourLists& lists, Worker& worker)
    : window_(window),
      lists_(lists),
      worker_(worker),
      safe_times_(window, lists, worker),
      predictor_(window, lists),
      record_(window.record.data()),
      is_plain_(is_plain(window)),
      reduced_mass_(reduced_mass(window.disks->common_mass, window.disks->common_mass)) {}

template <bool tiled>
void EventProcessor<tiled>::enter_all(std::size_t expected) {
  const auto disks = static_cast<std::uint32_t>(window_.record.size());
  EventCalendar& calendar = worker_.calendar;
  calendar.begin(window_.slice_start, window_.slice_stop(), disks, expected);
  for (std::uint32_t i = 0; i < disks; ++i) calendar.insert(i, window_.next_event_time[i]);
  // As nothing has happened yet, these may be predicted in any order, and the first page of the calendar stays short.
  for (std::uint32_t i = 0; i < disks; ++i) {
    if (window_.next_event_time[i] <= 0.0) predict_next_event<false>(i, 0.0);
  }
}

template <bool tiled>
void EventProcessor<tiled>::leave_all() {
  const auto disks = static_cast<std::uint32_t>(window_.record.size());
  for (std::uint32_t i = 0; i < disks; ++i) window_.next_event_time[i] = worker_.calendar.time_of(i);
}

template <bool tiled>
void EventProcessor<tiled>::run() {
  if constexpr (tiled) {
    run_queue();
  } else {
    run_calendar();
  }
  worker_.fastest2 = std::max(worker_.fastest2, predictor_.fastest2());
}

template <bool tiled>
void EventProcessor<tiled>::run_calendar() {
  const auto order = [this](std::uint32_t a, std::uint32_t b) { return comes_first(a, b); };
  const auto soon = [this](std::uint32_t k) {
    __builtin_prefetch(&record_[k]);
    lists_.prefetch(k);
  };
  std::uint32_t i = 0;
  while (!worker_.ended && worker_.calendar.find_first(i, order, soon)) {
    process(i, worker_.calendar.time_of(i));
    if (worker_.until_poll-- == 0) poll_watch();
  }
}

template <bool tiled>
void EventProcessor<tiled>::run_queue() {
  const auto name_event = [this](QueuedEvent& event) { name(event); };
  const auto prefetch = [this](std::uint32_t disk) {
    __builtin_prefetch(&record_[disk & ~safe_time_bit]);
    lists_.prefetch(disk & ~safe_time_bit);
  };
  QueuedEvent e;
  while (!worker_.ended && worker_.queue.pop(e, name_event, prefetch)) {
    process(e);
    if (worker_.until_poll-- == 0) poll_watch();
  }
}

// Of disks whose next events are at the same time: in canonical order; what is not a contact comes first.
template <bool tiled>
bool EventProcessor<tiled>::comes_first(std::uint32_t a, std::uint32_t b) const {
  QueuedEvent first{0.0, 0, 0, a};
  QueuedEvent second{0.0, 0, 0, b};
  name(first);
  name(second);
  return event_order(first, second);
}

template <bool tiled>
void EventProcessor<tiled>::poll_watch() {
  worker_.until_poll = events_between_polls;
  if (!window_.go_on || window_.go_on()) return;
  worker_.given_up = worker_.ended = true;
}

// The ids of the disk's next event. An entry that is invalid by now may get any.
template <bool tiled>
void EventProcessor<tiled>::name(QueuedEvent& e) const {
  if ((e.disk & safe_time_bit) != 0) return;
  const DiskRecord& f = record_[e.disk];
  if (!f.partner.is_contact()) return;
  const DiskId partner = f.partner.is_disk() ? record_[f.partner.index()].id : f.partner.wall_id();
  e.id1 = std::min(f.id, partner);
  e.id2 = std::max(f.id, partner);
}

// Single queue.
template <bool tiled>
void EventProcessor<tiled>::process(std::uint32_t i, double time) {
  const Partner partner = record_[i].partner;
  if (partner.is_disk()) {
    if (record_[partner.index()].version == record_[i].partner_version) {
      collide_pair(i, partner.index(), time);
      return;
    }
  } else if (partner.is_wall()) {
    meet_side(i, time);
    return;
  } else if (partner.is_relist()) {
    relist(i, time);
  }
  predict_next_event<false>(i, time);
}

template <bool tiled>
void EventProcessor<tiled>::process(const QueuedEvent& e) {
  const std::uint32_t i = e.disk & ~safe_time_bit;
  if (!is_resolved(i)) return;
  if (i != e.disk) {
    safe_times_.reach(i, e.time);
    return;
  }
  if (window_.next_event_time[i] != e.time) return;  // invalid: the disk's events have been predicted again
  const DiskRecord& f = record_[i];
  if (f.partner.is_disk()) {
    process_pair(i, e);
  } else if (f.partner.is_wall()) {
    if (e.id1 == f.id && e.id2 == f.partner.wall_id()) meet_side(i, e.time);
  } else if (f.partner.is_relist() && !relist(i, e.time)) {
    safe_times_.block(i, e.time, serial_pass);
  } else {
    predict_next_event<false>(i, e.time);
  }
}

template <bool tiled>
void EventProcessor<tiled>::process_pair(std::uint32_t i, const QueuedEvent& e) {
  const std::uint32_t j = record_[i].partner.index();
  const DiskId id = record_[i].id;
  const DiskId other = record_[j].id;
  // An event of the same time may have taken this one's place in the queue; then there is another entry for it.
  if (e.id1 != std::min(id, other) || e.id2 != std::max(id, other)) return;
  if (!is_resolved(j)) {
    safe_times_.block(i, e.time, safe_times_.blocking_tile(j));
  } else if (record_[j].version == record_[i].partner_version) {
    collide_pair(i, j, e.time);
  } else {
    predict_next_event<false>(i, e.time);
  }
}

// Finds and schedules the earliest event of the disk on its present path; nothing happens to it up to `from`. When it
// has to be relisted is extrapolated no further than gravity bends the path little: that is later than `from` then,
// however long the window is, so that relisting always makes progress.
template <bool tiled>
template <bool newest>
void EventProcessor<tiled>::predict_next_event(std::uint32_t i, double from) {
  DiskRecord& record = record_[i];
  from = std::max(from, record.path.start);
  const NextEvent next = predictor_.template earliest<newest>(i);
  // The events of lasting contacts are predicted again when the next window starts.
  double at = next.lasting ? window_.next_start : window_.horizon;
  Partner partner;
  if (next.time < at) {
    at = next.time;
    partner = next.partner;
    if (partner.is_disk()) record.partner_version = record_[partner.index()].version;
  }
  if (!lists_.stays_listed(i, record.path, from, at, window_.rules.gravity)) {
    const double relist_at = lists_.earliest_relist_time(i, record.path, from, from, window_.rules.gravity);
    if (relist_at < at) {
      at = relist_at;
      partner = Partner::relist();
    }
  }
  schedule(i, at, partner);
}

template <bool tiled>
void EventProcessor<tiled>::schedule(std::uint32_t i, double time, Partner partner) {
  record_[i].partner = partner;
  if constexpr (tiled) {
    window_.next_event_time[i] = time;
    QueuedEvent e{time, 0, 0, i};
    if (!window_.in_slice(time)) return;
    name(e);
    worker_.queue.push(e);
  } else {
    worker_.calendar.move(i, time, [this](std::uint32_t a, std::uint32_t b) { return comes_first(a, b); });
  }
}

// False if that would change the lists of another region.
template <bool tiled>
bool EventProcessor<tiled>::relist(std::uint32_t i, double time) {
  PathSegment p = carried_to(record_[i].path, time, window_.rules.gravity);
  wrap_into(p, window_.rules.box);
  if (!lists_.relist(i, {p.x, p.y}, *window_.disks, worker_.region, worker_.found)) return false;
  ++worker_.relisted;
  if constexpr (tiled) {
    safe_times_.mark_relisted(i);
    if (!worker_.is_serial) push_safe_time(i, time);
  }
  return true;
}

template <bool tiled>
ExactDisk EventProcessor<tiled>::disk(std::uint32_t i) const {
  ExactDisk now{record_[i].path};
  if (!window_.last_contact.empty()) now.last_contact = window_.last_contact[i];
  return now;
}

template <bool tiled>
void EventProcessor<tiled>::meet_side(std::uint32_t i, double time) {
  const Side side = record_[i].partner.side();
  const DiskId partner = record_[i].partner.wall_id();
  ExactDisk now = disk(i);
  const Impact impact = meet_side_at(window_.rules, time, side, window_.disks->mass_of(i), now);
  worker_.tally.add(partner, impact);
  const bool gone = window_.rules.box.side(side) == SideKind::sink;
  const EventMark event{time, record_[i].id, partner};
  begin_segment(i, now, gone, event);
  if (gone) {
    schedule(i, never, Partner::none());
  } else {
    predict_next_event<!tiled>(i, time);
  }
  if (!window_.burst.empty() && loses_energy(window_.rules, partner, impact)) count_burst(i, event);
}

template <bool tiled>
void EventProcessor<tiled>::collide_pair(std::uint32_t i, std::uint32_t j, double time) {
  if (is_plain_) {
    collide_plain_pair(i, j, time);
  } else {
    collide_any_pair(i, j, time);
  }
}

// In a plain scene: the same as below without what such a scene does not have.
template <bool tiled>
void EventProcessor<tiled>::collide_plain_pair(std::uint32_t i, std::uint32_t j, double time) {
  if (record_[i].id > record_[j].id) std::swap(i, j);
  PathSegment p = record_[i].path;
  PathSegment q = record_[j].path;
  // The speed bound excluded this collision, so it does not hold.
  if (!(std::max(p.start, q.start) <= time) || (tiled && (window_.is_done(i) || window_.is_done(j)))) [[unlikely]] {
    worker_.too_fast = worker_.ended = true;
    return;
  }
  const Impact impact =
      collide_paths<false>(window_.rules.box, 0.0, time, equal_shares, reduced_mass_, window_.rules.restitution, p, q);
  if (impact.happened) worker_.tally.add_collision(impact.virial);
  begin_plain_segment(i, j, p);
  begin_plain_segment(j, i, q);
  predict_next_event<!tiled>(i, time);
  predict_next_event<!tiled>(j, time);
}

template <bool tiled>
void EventProcessor<tiled>::begin_plain_segment(std::uint32_t i, std::uint32_t partner, const PathSegment& path) {
  DiskRecord& f = record_[i];
  if (window_.keeps_paths) log_segment(i, false, path);
  f.path = path;
  if (++f.version > most_paths_of_disk || ++worker_.segments > window_.most_paths) [[unlikely]] {
    worker_.crowded = EventMark{path.start, std::min(f.id, record_[partner].id), std::max(f.id, record_[partner].id)};
    worker_.ended = true;
  }
  const double v2 = path.vx * path.vx + path.vy * path.vy;
  predictor_.note_speed(v2);
  if constexpr (tiled) {
    if (v2 > window_.speed_limit2) worker_.too_fast = worker_.ended = true;
    if (!worker_.is_serial && (window_.mark[i] & has_unresolved_neighbour) != 0) safe_times_.push(i, path.start);
  }
}

template <bool tiled>
void EventProcessor<tiled>::log_segment(std::uint32_t i, bool gone, const PathSegment& path) {
  if (record_[i].version == 0) worker_.log.push_back({i, false, record_[i].path});
  worker_.log.push_back({i, gone, path});
}

template <bool tiled>
void EventProcessor<tiled>::collide_any_pair(std::uint32_t i, std::uint32_t j, double time) {
  if (record_[i].id > record_[j].id) std::swap(i, j);
  const Disks& d = *window_.disks;
  const DiskId id1 = record_[i].id;
  const DiskId id2 = record_[j].id;
  ExactDisk a = disk(i);
  ExactDisk b = disk(j);
  // The speed bound excluded this collision, so it does not hold.
  if ((tiled && (window_.is_done(i) || window_.is_done(j))) || !(std::max(a.path.start, b.path.start) <= time)) {
    worker_.too_fast = worker_.ended = true;
    return;
  }
  const Impact impact = collide_at(window_.rules, time, d.mass_of(i), d.mass_of(j), a, b);
  worker_.tally.add(id2, impact);
  const EventMark event{time, id1, id2};
  begin_segment(i, a, false, event);
  begin_segment(j, b, false, event);
  predict_next_event<!tiled>(i, time);
  predict_next_event<!tiled>(j, time);
  if (window_.burst.empty() || !loses_energy(window_.rules, id2, impact)) return;
  count_burst(i, event);
  count_burst(j, event);
}

template <bool tiled>
void EventProcessor<tiled>::begin_segment(std::uint32_t i, const ExactDisk& now, bool gone, const EventMark& event) {
  DiskRecord& f = record_[i];
  if (window_.keeps_paths) log_segment(i, gone, now.path);
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
  } else if (tiled && !worker_.is_serial && (window_.mark[i] & has_unresolved_neighbour) != 0) {
    push_safe_time(i, now.path.start);
  }
}

// A disk whose impacts pile up is deferred to the serial pass; in tiled mode the window is then run again without
// tiles.
template <bool tiled>
void EventProcessor<tiled>::count_burst(std::uint32_t i, const EventMark& event) {
  if (!window_.burst[i].add(event.time, window_.length)) return;
  if (!worker_.collapse) worker_.collapse = event;
  worker_.ended = worker_.ended || worker_.is_serial;
  if (tiled && !worker_.is_serial && window_.progress[i].is(Progress::active))
    safe_times_.block(i, event.time, serial_pass);
}

template class EventProcessor<false>;
template class EventProcessor<true>;

}  // namespace carom
