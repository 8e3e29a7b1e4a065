#include "parallel/exact/exact_events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/step/window_length.hpp"

namespace carom {

namespace {

// In QueuedEvent::disk: it comes into doubt.
constexpr std::uint32_t doubt_bit = 0x80000000U;
// A disk that was to come into doubt and has more time after all, as long as this share of the slice, is asked again.
constexpr double patience = 1.0 / 16.0;
constexpr Count events_between_looks = 4096;

}  // namespace

void ExactPart::begin_window() {
  tally = {};
  log.clear();
  any_gone = false;
  fastest2 = 0.0;
  paths = 0;
  collapse.reset();
  crowded.reset();
  is_void = given_up = ended = false;
}

void ExactEvents::run() {
  const auto name_event = [this](QueuedEvent& event) { name(event); };
  const auto ask_for = [this](std::uint32_t disk) {
    __builtin_prefetch(&field_.flight[disk & ~doubt_bit]);
    lists_.prefetch(disk & ~doubt_bit);
  };
  QueuedEvent e;
  while (!part_.ended && part_.queue.pop(e, name_event, ask_for)) {
    process(e);
    if (part_.until_look-- == 0) ask_to_go_on();
  }
  part_.fastest2 = std::max(part_.fastest2, scan_.fastest2());
}

void ExactEvents::ask_to_go_on() {
  part_.until_look = events_between_looks;
  if (!field_.go_on || field_.go_on()) return;
  part_.given_up = part_.ended = true;
}

// The ids of the event that the disk is due for. What is void by now may get any.
void ExactEvents::name(QueuedEvent& e) const {
  if ((e.disk & doubt_bit) != 0) return;
  const Flight& f = field_.flight[e.disk];
  if (f.partner >= leaving) return;
  const DiskId partner = is_wall(f.partner) ? f.partner : field_.flight[f.partner].id;
  e.id1 = std::min(f.id, partner);
  e.id2 = std::max(f.id, partner);
}

void ExactEvents::process(const QueuedEvent& e) {
  const std::uint32_t i = e.disk & ~doubt_bit;
  if (!is_known(i)) return;
  if (i != e.disk) {
    see_deadline(i, e.time);
    return;
  }
  if (field_.due[i] != e.time) return;  // void since the disk looked again
  const Flight& f = field_.flight[i];
  if (f.partner == leaving && !list_anew(i, e.time)) {
    doubt(i, e.time, no_tile);
  } else if (f.partner >= leaving) {
    look(i, e.time);
  } else if (!is_wall(f.partner)) {
    process_pair(i, e);
  } else if (e.id1 == f.id && e.id2 == f.partner) {
    meet_side(i, e.time);
  }
}

void ExactEvents::process_pair(std::uint32_t i, const QueuedEvent& e) {
  const std::uint32_t j = field_.flight[i].partner;
  const DiskId id = field_.flight[i].id;
  const DiskId other = field_.flight[j].id;
  // An event of the same time may have taken this one's place in the queue; then there is another entry for it.
  if (e.id1 != std::min(id, other) || e.id2 != std::max(id, other)) return;
  if (!is_known(j)) {
    doubt(i, e.time, root_of(j));
  } else if (field_.flight[j].version == field_.flight[i].partner_version) {
    meet_disk(i, j, e.time);
  } else {
    look(i, e.time);
  }
}

// The tile that an unknown disk waits for.
std::uint32_t ExactEvents::root_of(std::uint32_t i) const {
  if (field_.standing[i] != waiting) return part_.doubts[field_.standing[i]].root;
  return (field_.mark[i] & at_edge) != 0 ? no_tile : lists_.tile_of(i);
}

// Before this time, no earlier than `time`, the unknown disk cannot have reached disk i on its present path; `never` if
// not within the slice.
double ExactEvents::reached_by(std::uint32_t i, double time, std::uint32_t unknown) const {
  const Flight& f = field_.flight[i];
  const Flight& u = field_.flight[unknown];
  const double g = field_.rules.gravity;
  const std::uint32_t standing = field_.standing[unknown];
  const double until = standing == waiting ? field_.slice_start : part_.doubts[standing].until;
  const double from = std::max(time, until);
  const PathSegment p = carried_to(f.path, from, g);
  const PathSegment q = carried_to(u.path, until, g);
  const Relative r = relative(p, q, field_.rules.box);
  // Both towards each other, the unknown one since its motion is unknown.
  const double speed = std::sqrt(f.path.vx * f.path.vx + f.path.vy * f.path.vy) + g * field_.length + field_.bound;
  const double reach = f.radius + u.radius + field_.slack + field_.bound * (from - until);
  const double most = reach + speed * (std::min(field_.slice_end, field_.length) - from);
  const double distance2 = r.distance2();
  if (distance2 > most * most * (1.0 + 1e-9)) return never;
  return from + std::max(std::sqrt(distance2) - reach, 0.0) / speed;
}

ExactEvents::Deadline ExactEvents::deadline(std::uint32_t i, double time) const {
  Deadline first;
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (field_.is_known(j)) return;
    first.any = true;
    const double t = reached_by(i, time, j);
    if (t < first.time) {
      first.time = t;
      first.root = root_of(j);
    }
  });
  return first;
}

void ExactEvents::watch(std::uint32_t i, double time) {
  const Deadline end = deadline(i, time);
  if (!end.any) return;
  field_.mark[i] |= wary;
  if (field_.in_slice(end.time)) part_.queue.push({end.time, 0, 0, i | doubt_bit});
}

// The disk may have changed its path since it was to come into doubt now.
void ExactEvents::see_deadline(std::uint32_t i, double time) {
  const Deadline end = deadline(i, time);
  const double slice = std::min(field_.slice_end, field_.length) - field_.slice_start;
  if (end.time <= time + patience * slice) {
    doubt(i, time, end.root);
  } else if (field_.in_slice(end.time)) {
    part_.queue.push({end.time, 0, 0, i | doubt_bit});
  }
}

// Disk i's motion is not known from now on, so in a while neither is that of those near it.
void ExactEvents::doubt(std::uint32_t i, double time, std::uint32_t root) {
  field_.standing[i] = static_cast<std::uint32_t>(part_.doubts.size());
  part_.doubts.push_back({i, root, time});
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (field_.standing[j] == settled) return;
    field_.mark[j] |= wary;
    if (field_.standing[j] != at_hand) return;
    const double until = reached_by(j, time, i);
    if (field_.in_slice(until)) part_.queue.push({until, 0, 0, j | doubt_bit});
  });
}

// When disk i leaves its list's range; never, if that is after its next event. Asked no further ahead than gravity
// bends the path little: the answer is later than `from` then, however long the window is, so listing anew always gets
// on.
double ExactEvents::exit_after(std::uint32_t i, double from, double next) const {
  const double g = field_.rules.gravity;
  const PathSegment& path = field_.flight[i].path;
  if (lists_.stays(i, path, from, std::min(next, field_.horizon), g)) return never;
  return lists_.exit_time(i, path, from, from, g);
}

// Finds the earliest event of the disk on its present path. Nothing happens to it up to `from`.
void ExactEvents::look(std::uint32_t i, double from) {
  from = std::max(from, field_.flight[i].path.start);
  bool lasting = false;
  const NextEvent next = scan_.earliest(i, lasting);
  const double exit = exit_after(i, from, next.time);
  // What lasts is looked at anew when the next window starts.
  const double until = lasting ? field_.next_start : field_.horizon;
  if (std::min(exit, next.time) >= until) {
    expect(i, until, nobody, 0, 0);
  } else if (exit < next.time) {
    expect(i, exit, leaving, 0, 0);
  } else if (is_wall(next.id2)) {
    expect(i, next.time, next.id2, next.id1, next.id2);
  } else {
    field_.flight[i].partner_version = field_.flight[next.other].version;
    expect(i, next.time, next.other, next.id1, next.id2);
  }
}

void ExactEvents::expect(std::uint32_t i, double time, std::uint32_t partner, DiskId id1, DiskId id2) {
  field_.due[i] = time;
  field_.flight[i].partner = partner;
  if (field_.in_slice(time)) part_.queue.push({time, id1, id2, i});
}

// False if that would touch what others work on.
bool ExactEvents::list_anew(std::uint32_t i, double time) {
  PathSegment p = carried_to(field_.flight[i].path, time, field_.rules.gravity);
  wrap_into(p, field_.rules.box);
  if (!lists_.list_anew(i, {p.x, p.y}, *field_.disks, part_.lists, part_.found)) return false;
  ++part_.listed;
  if (!field_.standing.empty()) mark_listed(i);
  if (!part_.alone) watch(i, time);
  return true;
}

// Disk i has a new list, and is in other ones than before. At once: those keep him, however soon he is listed again.
void ExactEvents::mark_listed(std::uint32_t i) {
  const auto mark_border = [&](std::uint32_t a, std::uint32_t b) {
    if (lists_.tile_of(b) > lists_.tile_of(a) || (field_.mark[b] & at_edge) != 0) field_.mark[a] |= at_border;
  };
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (region_of(i) != region_of(j)) {
      mark_edge(i);
      mark_edge(j);
    }
    mark_border(i, j);
    mark_border(j, i);
  });
}

void ExactEvents::mark_edge(std::uint32_t i) {
  if ((field_.mark[i] & at_edge) != 0) return;
  field_.mark[i] |= at_edge;
  part_.edge.push_back(i);
  lists_.for_each_neighbour(i, [&](std::uint32_t j) { field_.mark[j] |= at_border; });
}

ExactDisk ExactEvents::disk(std::uint32_t i) const {
  ExactDisk now{field_.flight[i].path};
  if (!field_.last_contact.empty()) now.last_contact = field_.last_contact[i];
  return now;
}

void ExactEvents::meet_side(std::uint32_t i, double time) {
  const DiskId partner = field_.flight[i].partner;
  const Side side = wall_side(partner);
  ExactDisk now = disk(i);
  const Impact impact = meet_side_at(field_.rules, time, side, field_.disks->mass_of(i), now);
  part_.tally.add(partner, impact);
  const bool gone = field_.rules.box.side(side) == SideKind::sink;
  const EventMark event{time, field_.flight[i].id, partner};
  begin_path(i, now, gone, event);
  if (gone) {
    expect(i, never, nobody, 0, 0);
  } else {
    look(i, time);
  }
  if (!field_.burst.empty() && loses_energy(field_.rules, partner, impact)) count_burst(i, event);
}

void ExactEvents::meet_disk(std::uint32_t i, std::uint32_t j, double time) {
  if (field_.flight[i].id > field_.flight[j].id) std::swap(i, j);
  const Disks& d = *field_.disks;
  const DiskId id1 = field_.flight[i].id;
  const DiskId id2 = field_.flight[j].id;
  ExactDisk a = disk(i);
  ExactDisk b = disk(j);
  // One of them was thought to be out of reach.
  if (field_.is_settled(i) || field_.is_settled(j) || !(std::max(a.path.start, b.path.start) <= time)) {
    part_.is_void = part_.ended = true;
    return;
  }
  const Impact impact = collide_at(field_.rules, time, d.mass_of(i), d.mass_of(j), a, b);
  part_.tally.add(id2, impact);
  const EventMark event{time, id1, id2};
  begin_path(i, a, false, event);
  begin_path(j, b, false, event);
  look(i, time);
  look(j, time);
  if (field_.burst.empty() || !loses_energy(field_.rules, id2, impact)) return;
  count_burst(i, event);
  count_burst(j, event);
}

void ExactEvents::begin_path(std::uint32_t i, const ExactDisk& now, bool gone, const EventMark& event) {
  Flight& f = field_.flight[i];
  if (field_.keeps_paths) {
    if (f.version == 0) part_.log.push_back({i, false, f.path});
    part_.log.push_back({i, gone, now.path});
  }
  f.path = now.path;
  if (++f.version > most_paths_of_disk || ++part_.paths > field_.most_paths) [[unlikely]] {
    part_.crowded = event;
    part_.ended = true;
  }
  const double v2 = f.path.vx * f.path.vx + f.path.vy * f.path.vy;
  scan_.saw_speed(v2);
  if (v2 > field_.allowed2) part_.is_void = part_.ended = true;
  if (!field_.last_contact.empty()) field_.last_contact[i] = now.last_contact;
  if (gone) {
    // Nobody can meet a path that is not a number.
    f.path.x = f.path.y = std::numeric_limits<double>::quiet_NaN();
    part_.any_gone = true;
  } else if (!part_.alone && (field_.mark[i] & wary) != 0) {
    watch(i, now.path.start);
  }
}

// A disk whose events pile up is left to whoever sees everybody; with tiles, the window is done again without.
void ExactEvents::count_burst(std::uint32_t i, const EventMark& event) {
  if (!field_.burst[i].add(event.time, field_.length)) return;
  if (!part_.collapse) part_.collapse = event;
  part_.ended = part_.ended || part_.alone;
  if (!part_.alone && field_.standing[i] == at_hand) doubt(i, event.time, no_tile);
}

}  // namespace carom
