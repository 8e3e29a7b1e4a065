#include "parallel/exact_sequence.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/window_plan.hpp"

namespace carom {

void ExactSequence::run(std::size_t expected, double window_start, std::vector<LoggedPiece>* log) {
  field_.slice_start = 0.0;
  field_.slice_end = never;
  scan_ = ExactScan(field_, lists_);
  version_.assign(field_.flight.size(), {});
  tally_ = {};
  log_ = log;
  window_start_ = window_start;
  any_gone_ = false;
  queue_.begin(0.0, field_.length, expected);
  for (std::uint32_t i = 0; i < field_.flight.size(); ++i) {
    if (field_.due[i] <= field_.length) queue_.push({field_.due[i], 0, 0, i});
  }
  QueuedEvent e;
  while (queue_.pop(e, [this](QueuedEvent& event) { name(event); })) process(e);
}

// The ids of the event that the disk is due for. What is void by now may get any.
void ExactSequence::name(QueuedEvent& e) const {
  const Flight& f = field_.flight[e.disk];
  if (f.partner >= leaving) return;
  const DiskId partner = is_wall(f.partner) ? f.partner : field_.flight[f.partner].id;
  e.id1 = std::min(f.id, partner);
  e.id2 = std::max(f.id, partner);
}

void ExactSequence::process(const QueuedEvent& e) {
  const std::uint32_t i = e.disk;
  if (field_.due[i] != e.time) return;  // void since the disk looked again
  const Flight& f = field_.flight[i];
  if (f.partner == leaving) list_anew(i, e.time);
  if (f.partner >= leaving) {
    look(i, e.time);
  } else if (!is_wall(f.partner)) {
    process_pair(i, e);
  } else if (e.id1 == f.id && e.id2 == f.partner) {
    meet_side(i, e.time);
  }
}

void ExactSequence::process_pair(std::uint32_t i, const QueuedEvent& e) {
  const std::uint32_t j = field_.flight[i].partner;
  const DiskId id = field_.flight[i].id;
  const DiskId other = field_.flight[j].id;
  // An event of the same time may have taken this one's place in the queue; then there is another entry for it.
  if (e.id1 != std::min(id, other) || e.id2 != std::max(id, other)) return;
  if (version_[j].own == version_[i].partner) {
    meet_disk(i, j, e.time);
  } else {
    look(i, e.time);
  }
}

// When disk i leaves its list's range; never, if that is after its next event. Asked no further ahead than gravity
// bends the path little: the answer is later than `from` then, however long the window is, so listing anew always gets
// on.
double ExactSequence::exit_after(std::uint32_t i, double from, double next) const {
  const double g = field_.rules.gravity;
  const PathSegment& path = field_.flight[i].path;
  if (lists_.stays(i, path, from, std::min(next, field_.horizon), g)) return never;
  return lists_.exit_time(i, path, from, from, g);
}

// Finds the earliest event of the disk on its present path. Nothing happens to it up to `from`.
void ExactSequence::look(std::uint32_t i, double from) {
  const Flight& f = field_.flight[i];
  from = std::max(from, f.path.start);
  const NextEvent next = scan_.earliest(i, from);
  const double exit = exit_after(i, from, next.time);
  if (std::min(exit, next.time) >= field_.horizon) {
    expect(i, field_.horizon, nobody, 0, 0);
  } else if (exit < next.time) {
    expect(i, exit, leaving, 0, 0);
  } else if (is_wall(next.id2)) {
    expect(i, next.time, next.id2, next.id1, next.id2);
  } else {
    version_[i].partner = version_[next.other].own;
    expect(i, next.time, next.other, next.id1, next.id2);
  }
}

void ExactSequence::expect(std::uint32_t i, double time, std::uint32_t partner, DiskId id1, DiskId id2) {
  field_.due[i] = time;
  field_.flight[i].partner = partner;
  if (time <= field_.length) queue_.push({time, id1, id2, i});
}

void ExactSequence::list_anew(std::uint32_t i, double time) {
  PathSegment p = carried_to(field_.flight[i].path, time, field_.rules.gravity);
  wrap_into(p, field_.rules.box);
  const Vec2 place{p.x, p.y};
  lists_.list_anew({&i, 1}, {&place, 1}, *field_.disks, executor_);
}

ExactDisk ExactSequence::disk(std::uint32_t i) const {
  ExactDisk now{field_.flight[i].path};
  if (!field_.last_contact.empty()) now.last_contact = field_.last_contact[i];
  return now;
}

void ExactSequence::meet_side(std::uint32_t i, double time) {
  const DiskId partner = field_.flight[i].partner;
  const Side side = wall_side(partner);
  ExactDisk now = disk(i);
  tally_.add(partner, meet_side_at(field_.rules, time, side, field_.disks->mass_of(i), now));
  const bool gone = field_.rules.box.side(side) == SideKind::sink;
  begin_path(i, now, gone);
  count_burst(i, time, field_.flight[i].id, partner);
  if (gone) {
    expect(i, never, nobody, 0, 0);
  } else {
    look(i, time);
  }
}

void ExactSequence::meet_disk(std::uint32_t i, std::uint32_t j, double time) {
  if (field_.flight[i].id > field_.flight[j].id) std::swap(i, j);
  const Disks& d = *field_.disks;
  const DiskId id1 = field_.flight[i].id;
  const DiskId id2 = field_.flight[j].id;
  ExactDisk a = disk(i);
  ExactDisk b = disk(j);
  tally_.add(id2, collide_at(field_.rules, time, d.mass_of(i), d.mass_of(j), a, b));
  begin_path(i, a, false);
  begin_path(j, b, false);
  count_burst(i, time, id1, id2);
  count_burst(j, time, id1, id2);
  look(i, time);
  look(j, time);
}

void ExactSequence::begin_path(std::uint32_t i, const ExactDisk& now, bool gone) {
  Flight& f = field_.flight[i];
  if (log_ != nullptr) {
    if (version_[i].own == 0) log_->push_back({i, false, f.path});
    log_->push_back({i, gone, now.path});
  }
  f.path = now.path;
  ++version_[i].own;
  scan_.saw_speed(f.path.vx * f.path.vx + f.path.vy * f.path.vy);
  if (!field_.last_contact.empty()) field_.last_contact[i] = now.last_contact;
  if (!gone) return;
  // Nobody can meet a path that is not a number.
  f.path.x = f.path.y = std::numeric_limits<double>::quiet_NaN();
  any_gone_ = true;
}

void ExactSequence::count_burst(std::uint32_t i, double time, DiskId id1, DiskId id2) {
  if (field_.burst.empty() || !field_.burst[i].add(time, field_.length)) return;
  fail_collapse(id1, id2, window_start_ + time);
}

}  // namespace carom
