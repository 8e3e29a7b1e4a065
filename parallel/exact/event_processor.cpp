#include "parallel/exact/event_processor.hpp"

#include <algorithm>
#include <cmath>

#include "core/physics/event_order.hpp"
#include "parallel/exact/contact_outcomes.inl"
#include "parallel/exact/prefetch_event.hpp"
#include "parallel/exact/relisting.inl"

namespace carom {

namespace {

PairKind kind_of_pairs(const WindowState& window) {
  const ExactRules& rules = window.rules;
  if (!window.spin.empty()) return PairKind::any;
  if (rules.box.shear.acts()) return PairKind::sheared;
  if (!rules.constant || !window.last_contact.empty()) return PairKind::smooth;
  const bool elastic = rules.common_mass && window.burst.empty() && !rules.gravity.acts();
  return elastic ? PairKind::elastic_of_one_mass : PairKind::of_constant_restitution;
}

constexpr Count events_between_polls = 4096;
// The calendar is laid out for at most this many events a disk; windows aim at two.
constexpr double most_events_a_disk = 2.2;
// Windows with less than one event for this many disks count as short.
constexpr double disks_per_event = 8.0;

}  // namespace

template <Scope scope>
EventProcessor<scope>::EventProcessor(WindowState& window, NeighbourLists& lists, Worker& worker)
    : window_(window),
      lists_(lists),
      worker_(worker),
      safe_times_(window, lists, worker),
      predictor_(window, lists),
      record_(window.record.data()),
      pairs_(kind_of_pairs(window)),
      is_straight_(!window.rules.gravity.acts() && !window.rules.box.shear.acts()),
      fall_(window.rules.gravity),
      reduced_mass_(reduced_mass(window.disks->common_mass, window.disks->common_mass)),
      inner_part_(window.rules.box) {}

template <Scope scope>
void EventProcessor<scope>::enter_all(double events_a_disk) {
  const auto last = std::min(static_cast<std::uint32_t>(window_.record.size()), worker_.region.last_disk);
  EventCalendar& calendar = worker_.calendar;
  const std::uint32_t first = worker_.region.first_disk;
  const auto disks = static_cast<double>(last - first);
  const double expected = std::min(events_a_disk, most_events_a_disk) * disks;
  calendar.begin(window_.slice_start, window_.length, window_.entries_of(first, last, worker_.number),
                 events_a_disk > 0.0 ? static_cast<std::size_t>(expected) + 1 : 0, window_.looks_ahead);
  const auto is_active = [this](std::uint32_t i) { return !has_regions || record_[i].progress.is_active(); };
  const CalendarEntry* const entry = window_.entry.data();
  // In a short window most events come after its end: their disks stay out of the calendar until they get another
  // event.
  const double last_time = disks_per_event * expected < disks ? window_.length : never;
  calendar.insert_all(
      [=](std::uint32_t i) { return entry[i].time > 0.0 && entry[i].time <= last_time && is_active(i); });
  // Disks whose events are due now may be predicted in any order: all paths begin now, and nothing has happened yet.
  for (std::uint32_t i = first; i < last; ++i) {
    if (!(entry[i].time > 0.0) && is_active(i)) predict_next_event<true, true>(i, 0.0);
  }
}

template <Scope scope>
void EventProcessor<scope>::enter(std::uint32_t i) {
  worker_.calendar.move(i, window_.next_event_time(i),
                        [this](std::uint32_t a, std::uint32_t b) { return comes_first(a, b); });
}

template <Scope scope>
void EventProcessor<scope>::replace_path(std::uint32_t i) {
  const double now = window_.slice_stop();
  const PathSegment p = carried_to(record_[i].path, now, window_.rules.gravity);
  if (!lists_.stays_in_skin(i, p.x, p.y, 0.0)) relist(i, now, relist_distance(i));
  show_images_if_far(i, now);
  predict_next_event<false>(i, now);
}

template <Scope scope>
void EventProcessor<scope>::push_next_event(std::uint32_t i) {
  if (window_.in_slice(window_.next_event_time(i))) worker_.queue.push({window_.next_event_time(i), 0, 0, i});
}

template <Scope scope>
void EventProcessor<scope>::run() {
  if constexpr (scope == Scope::all || scope == Scope::part) run_all();
  if constexpr (scope == Scope::region) run_region();
  if constexpr (scope == Scope::border) run_border();
  tally_virials();
  worker_.fastest2 = std::max(worker_.fastest2, predictor_.fastest2());
}

// Finds the disk with the first event in the calendar.
template <Scope scope>
inline bool EventProcessor<scope>::find_first(std::uint32_t& i, double& time) {
  const auto order = [this](std::uint32_t a, std::uint32_t b) { return comes_first(a, b); };
  const auto soon = [this](std::uint32_t k, int stage) __attribute__((always_inline)) {
    prefetch_event(record_, lists_, worker_, k, stage);
  };
  return worker_.calendar.find_first(i, time, order, soon);
}

template <Scope scope>
void EventProcessor<scope>::run_all() {
  std::uint32_t i = 0;
  double time = 0.0;
  Count until_poll = worker_.until_poll;
  while (!worker_.ended && find_first(i, time)) {
    if (scope == Scope::part && !window_.in_slice(time)) [[unlikely]]
      break;
    process(i, time);
    if (until_poll-- == 0) until_poll = poll_watch();
  }
  worker_.until_poll = until_poll;
}

template <Scope scope>
void EventProcessor<scope>::run_region() {
  std::uint32_t i = 0;
  Count until_poll = worker_.until_poll;
  while (!worker_.ended) {
    double time = never;
    if (!find_first(i, time)) time = never;
    const double safe_time = safe_times_.first();
    if (safe_time <= time && safe_time < never) {
      SafeTimeDue due;
      if (safe_times_.reach_first(due)) block(due.disk, due.time);
    } else if (window_.in_slice(time)) {
      process(i, time);
    } else {
      break;
    }
    if (until_poll-- == 0) until_poll = poll_watch();
  }
  worker_.until_poll = until_poll;
}

template <Scope scope>
void EventProcessor<scope>::run_border() {
  const auto name_event = [this](QueuedEvent& event) { name(event); };
  const auto prefetch = [this](std::uint32_t disk) {
    __builtin_prefetch(&record_[disk]);
    lists_.prefetch(disk);
  };
  QueuedEvent e;
  while (!worker_.ended && worker_.queue.pop(e, name_event, prefetch)) {
    process_border(e);
    if (worker_.until_poll-- == 0) worker_.until_poll = poll_watch();
  }
}

// Does the event of disk a come before that of disk b at the same time? The order is the canonical one, in which
// anything but a contact comes first.
template <Scope scope>
bool EventProcessor<scope>::comes_first(std::uint32_t a, std::uint32_t b) const {
  // In most cases the two events are the same one: the two disks touch each other.
  if (record_[a].partner.is(b) && record_[b].partner.is(a)) [[likely]]
    return false;
  QueuedEvent first{0.0, 0, 0, a};
  QueuedEvent second{0.0, 0, 0, b};
  name(first);
  name(second);
  return event_order(first, second);
}

// Asks whether to continue; returns the number of events after which to ask again.
template <Scope scope>
Count EventProcessor<scope>::poll_watch() {
  if (window_.go_on && !window_.go_on()) worker_.given_up = worker_.ended = true;
  return events_between_polls;
}

// Sets the ids of the disk's next event. If that is invalid by now, the ids may be any.
template <Scope scope>
void EventProcessor<scope>::name(QueuedEvent& e) const {
  const DiskRecord& f = record_[e.disk];
  if (!f.partner.is_contact()) return;
  const DiskId partner = f.partner.is_disk() ? record_[f.partner.index()].id : f.partner.wall_id();
  e.id1 = std::min(f.id, partner);
  e.id2 = std::max(f.id, partner);
}

// Processes a disk's event of the calendar.
template <Scope scope>
inline void EventProcessor<scope>::process(std::uint32_t i, double time) {
  const Partner partner = record_[i].partner;
  if (partner.is_disk()) [[likely]] {
    process_pair(i, partner.index(), time);
  } else {
    process_other(i, time);
  }
}

// Processes an event that is not a contact with a disk.
template <Scope scope>
void EventProcessor<scope>::process_other(std::uint32_t i, double time) {
  const Partner partner = record_[i].partner;
  if (partner.is_wall()) {
    meet_side(i, time);
  } else if (partner.is_relist()) {
    relist_and_predict(i, time);
  } else if (partner.is_obstacle()) {
    meet_obstacle(i, time);
  } else {
    predict_next_event<false>(i, time);
  }
}

template <Scope scope>
inline void EventProcessor<scope>::process_pair(std::uint32_t i, std::uint32_t j, double time) {
  if (scope == Scope::region && !record_[j].progress.is_active()) {
    block(i, time);
  } else if (record_[j].version == record_[i].partner_version) {
    collide_pair(i, j, time);
  } else {
    predict_next_event<false>(i, time);
  }
}

template <Scope scope>
void EventProcessor<scope>::predict_next_slice(std::uint32_t i) {
  if (std::isnan(record_[i].path.x)) {
    window_.set_next_event_time(i, never);
    record_[i].partner = Partner::none();
    return;
  }
  const auto [time, partner] = next_event(i, window_.slice_stop(), predictor_.earliest(i));
  window_.set_next_event_time(i, time);
  record_[i].partner = partner;
}

// Border: processes an event of the queue. It is invalid if the disk's events have been predicted again since it was
// queued. If the disk then has another event at the same time, that has its own entry.
template <Scope scope>
void EventProcessor<scope>::process_border(const QueuedEvent& e) {
  const std::uint32_t i = e.disk;
  if (window_.next_event_time(i) != e.time) return;
  QueuedEvent present = e;
  present.id1 = present.id2 = 0;
  name(present);
  if (present.id1 == e.id1 && present.id2 == e.id2) process(i, e.time);
}

// The disk's next event, if `next` is the earliest one on its present path and it has none up to `from`. The time at
// which it must be relisted is extrapolated only as far as gravity bends the path little. That time is later than
// `from`, however long the window is, so relisting always makes progress.
template <Scope scope>
ScheduledEvent EventProcessor<scope>::next_event(std::uint32_t i, double from, const NextEvent& next) {
  DiskRecord& record = record_[i];
  from = std::max(from, record.path.start);
  // Disks in lasting contacts are predicted again when the next window starts.
  ScheduledEvent event{next.lasting ? window_.next_start : window_.horizon, Partner::none()};
  if (next.time < event.time) {
    event = {next.time, next.partner};
    if (next.partner.is_disk()) record.partner_version = record_[next.partner.index()].version;
  } else if (!next.lasting) {
    event.time = window_.last_look(i);
  }
  const RelistDistance& relist = relist_distance(i);
  if (stays_listed(i, from, event.time, relist)) return event;
  const double relist_at = is_straight_
                               ? lists_.relist_time_straight(i, record.path, from, relist)
                               : lists_.earliest_relist_time(i, record.path, from, from, window_.rules.gravity, relist);
  if (scope == Scope::border && from < window_.slice_stop() && window_.in_slice(relist_at)) {
    put_off_relisting(i);
    // Slices are so short that this should not happen.
    if (!stays_listed(i, from, std::min(event.time, window_.slice_stop()), lists_.relist_distance_elsewhere()))
      worker_.too_fast = worker_.ended = true;
    return event;
  }
  return relist_at < event.time ? ScheduledEvent{relist_at, Partner::relist()} : event;
}

template <Scope scope>
inline bool EventProcessor<scope>::stays_listed(std::uint32_t i, double from, double until,
                                                const RelistDistance& relist) const {
  const PathSegment& path = record_[i].path;
  return is_straight_ ? lists_.stays_listed(i, path, from, until, relist)
                      : lists_.stays_listed_bent(i, path, from, until, window_.rules.gravity, relist);
}

// In nearly all cases the kernel alone finds the first event, and the disk stays listed until then.
template <Scope scope>
template <bool newest, bool enters>
void EventProcessor<scope>::predict_next_event(std::uint32_t i, double from) {
  const ListRow& row = lists_.rows().row(i);
  if (!predictor_.kernel_tells(row)) [[unlikely]]
    return predict_from_all(i, from);
  const FirstContact first = predictor_.template first_in<newest>(row, record_[i], is_near_border(i));
  if (!(first.time <= window_.horizon)) [[unlikely]] {
    if (first.is_ambiguous()) return predict_from_all(i, from);
    return schedule_no_contact(i, from);
  }
  if (first.leaves_list()) [[unlikely]] {
    const Partner partner = EventPredictor::partner_in(row, i, first);
    if (scope == Scope::border || !is_straight_) return schedule_next(i, from, {first.time, partner});
    const PathSegment& path = record_[i].path;
    const double relist_at = lists_.relist_time_straight(i, path, std::max(from, path.start), relist_distance(i));
    if (relist_at < first.time) return schedule(i, relist_at, Partner::relist());
  }
  const Partner partner = EventPredictor::partner_in(row, i, first);
  record_[i].partner_version = record_[partner.index()].version;
  if constexpr (enters) {
    record_[i].partner = partner;
    const auto order = [this](std::uint32_t a, std::uint32_t b) { return comes_first(a, b); };
    worker_.calendar.enter(i, first.time, order);
  } else {
    schedule(i, first.time, partner);
  }
}

// As schedule_next, for a disk without any contact up to the horizon while it stays listed.
template <Scope scope>
void EventProcessor<scope>::schedule_no_contact(std::uint32_t i, double from) {
  if (scope == Scope::border || !is_straight_) return schedule_next(i, from, {});
  const PathSegment& path = record_[i].path;
  const double look = window_.last_look(i);
  if (lists_.stays_listed(i, path, from, look, relist_distance(i))) return schedule(i, look, Partner::none());
  const double relist_at = lists_.relist_time_straight(i, path, std::max(from, path.start), relist_distance(i));
  relist_at < look ? schedule(i, relist_at, Partner::relist()) : schedule(i, look, Partner::none());
}

template <Scope scope>
void EventProcessor<scope>::predict_from_all(std::uint32_t i, double from) {
  schedule_next(i, from, predictor_.earliest(i));
}

template <Scope scope>
void EventProcessor<scope>::schedule_next(std::uint32_t i, double from, const NextEvent& next) {
  const auto [time, partner] = next_event(i, from, next);
  // If relisting is due at the very end of the window, which belongs to its last slice, it is done when the slice ends.
  if (scope == Scope::border && partner.is_relist() && window_.in_slice(time)) put_off_relisting(i);
  schedule(i, time, partner);
}

// Predicts a disk whose path begins at this time. Outside the border pass, no neighbour's path begins later.
template <Scope scope>
void EventProcessor<scope>::predict_after_event(std::uint32_t i, double time) {
  predict_next_event<scope != Scope::border>(i, time);
}

template <Scope scope>
inline void EventProcessor<scope>::schedule(std::uint32_t i, double time, Partner partner) {
  record_[i].partner = partner;
  if constexpr (scope == Scope::border) {
    window_.set_next_event_time(i, time);
    QueuedEvent e{time, 0, 0, i};
    if (!window_.in_slice(time) || partner.is_relist()) return;
    name(e);
    worker_.queue.push(e);
  } else {
    worker_.calendar.move(i, time, [this](std::uint32_t a, std::uint32_t b) { return comes_first(a, b); });
  }
}

template class EventProcessor<Scope::all>;
template class EventProcessor<Scope::part>;
template class EventProcessor<Scope::region>;
template class EventProcessor<Scope::border>;

}  // namespace carom
