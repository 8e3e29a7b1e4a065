#include "parallel/exact_loop.hpp"

#include <algorithm>

namespace carom {

namespace {

bool later(const HeapEntry& a, const HeapEntry& b) {
  return b.event.before(a.event);
}

}  // namespace

void put_off(ExactField& field, std::uint32_t i, const NextEvent& next, double exit, double cross) {
  const double first = std::min(exit, cross);
  if (next.time <= first && next.time < field.horizon) {
    const std::uint32_t partner = is_wall(next.id2) ? next.id2 : next.other;
    const bool known = next.other_version == 0;
    field.put_off(i, next.time, known ? partner : nobody,
                  known && next.clear && next.time + clear_share * field.length < cross);
  } else if (first < field.horizon) {
    field.put_off(i, first, exit <= cross ? leaving : nobody);
  } else {
    field.put_off(i, field.horizon, nobody);
  }
}

void ExactLoop::run_block(std::uint32_t begin, std::uint32_t end) {
  joint_ = false;
  begin_ = begin;
  size_ = end - begin;
  last_.time = -never;
  arena_.heap.clear();
  // Most of the block is looked at several times, in no order: asked for in order first, it comes much faster.
  lists_.prefetch(begin, end);
  for (std::uint32_t i = begin; i < end; ++i) {
    __builtin_prefetch(&field_.flight[i]);
    if (field_.in_slice(field_.due[i])) push_due(i);
  }
  run();
}

std::uint32_t ExactLoop::solve(const std::vector<std::uint32_t>& disks) {
  joint_ = true;
  last_.time = -never;
  arena_.heap.clear();
  component_ = static_cast<std::uint32_t>(arena_.components.size());
  arena_.components.push_back({nobody, nobody, 0});
  for (const std::uint32_t i : disks) {
    look_around(add_member(i));
  }
  run();
  return component_;
}

void ExactLoop::run() {
  std::vector<HeapEntry>& heap = arena_.heap;
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end(), later);
    const HeapEntry e = heap.back();
    heap.pop_back();
    process(e);
  }
}

void ExactLoop::process(const HeapEntry& e) {
  const std::uint32_t owner = field_.flight[e.disk].owner;
  if (owner != nobody) {
    // Held by somebody else, who answers for it then; or given up; or on a new path, which has an event of its own.
    if (!is_at_hand(owner) || component_of(member_of(owner)).status != ComponentStatus::solved) return;
    if (arena_.members[member_of(owner)].version != e.version) return;
  }
  if (e.event.other == nobody) {
    look_again(e.disk);
  } else if (e.event.other != e.disk) {
    process_pair(e);
  } else {
    const std::uint32_t m = hold(e.disk);
    last_ = e.event;
    meet_side(m, e.event);
  }
}

void ExactLoop::process_pair(const HeapEntry& e) {
  if (!is_ready(e)) return;
  const std::uint32_t m = hold(e.disk);
  const std::uint32_t other = hold(e.event.other);
  if (arena_.components[unite(m, other)].status != ComponentStatus::solved) return;
  last_ = e.event;
  meet_disk(m, other, e.event);
}

// Is the event's other disk on the path that the event was found with, and can it have no event before? If not, sees to
// what has to be done first.
bool ExactLoop::is_ready(const HeapEntry& e) {
  const std::uint32_t j = e.event.other;
  if (!joint_ && !is_own(j)) {
    conflict(e.disk, nobody);
    return false;
  }
  const std::uint32_t owner = field_.flight[j].owner;
  if (owner == nobody) {
    if (!joint_) return true;
    if (take_in(j)) push(e.disk, e.version, e.event);
    return false;
  }
  if (!is_at_hand(owner)) {
    conflict(e.disk, owner);
    return false;
  }
  if (arena_.members[member_of(owner)].version == e.event.other_version) return true;
  look_again(e.disk);
  return false;
}

// A joint solution takes in whom its members meet. If the newcomer may have an event before those that have happened,
// all starts over, with him from the beginning; returns false then. It would not do to look for that event first: it
// may be one with a member on the path that he has left since.
bool ExactLoop::take_in(std::uint32_t disk) {
  add_member(disk);
  if (field_.due[disk] > last_.time) {
    if (field_.in_slice(field_.due[disk])) push_due(disk);
    return true;
  }
  start_over();
  return false;
}

void ExactLoop::start_over() {
  const Component c = arena_.components[component_];
  last_.time = -never;
  arena_.heap.clear();
  for (std::uint32_t m = c.first; m != nobody; m = arena_.members[m].next_member) {
    const std::uint32_t next = arena_.members[m].next_member;
    const std::uint32_t disk = arena_.members[m].disk;
    arena_.members[m] = fresh_member(disk, component_);
    field_.sketch[disk] = field_.units.sketch(field_.flight[disk].path);
    arena_.members[m].next_member = next;
  }
  for (std::uint32_t m = c.first; m != nobody; m = arena_.members[m].next_member) look_around(m);
}

void ExactLoop::push(std::uint32_t disk, std::uint32_t version, const NextEvent& event) {
  arena_.heap.push_back({event, disk, version});
  std::push_heap(arena_.heap.begin(), arena_.heap.end(), later);
}

// What is known of a disk since an earlier slice. An event found then still stands if the partner's path has not
// changed in that slice or since; one found in an earlier window has its time from paths that began then.
void ExactLoop::push_due(std::uint32_t i) {
  const Flight& f = field_.flight[i];
  NextEvent e{field_.due[i], 0, 0, nobody, 0};
  if (f.partner < leaving && is_wall(f.partner)) {
    e = {e.time, f.id, f.partner, i, 0};
  } else if (f.partner < leaving && !is_held(f.partner)) {
    const Flight& other = field_.flight[f.partner];
    const bool stands = other.changed < f.looked_in();
    const bool stood = f.looked_in() == 0 && other.changed == 0;
    const double t = stands ? e.time : stood ? scan_.clear_meeting(i, f.partner) : never;
    if (t != never) e = {t, std::min(f.id, other.id), std::max(f.id, other.id), f.partner, 0};
    if (t != never && !field_.in_slice(t)) {
      field_.put_off(i, t, f.partner, true);
      return;
    }
  }
  push(i, 0, e);
}

// When disk i leaves its list's range; never, if that is after its next event.
double ExactLoop::exit_after(std::uint32_t i, const PathSegment& path, double from, double next) const {
  const double g = field_.rules.gravity;
  if (lists_.stays(i, path, from, std::min(next, field_.horizon), g)) return never;
  return lists_.exit_time(i, path, from, std::min(field_.slice_end, field_.length), g);
}

// The earliest event of disk i on this path. Neighbours that others hold are left out; a member's are noted, to be
// looked at when both are solved.
NextEvent ExactLoop::look_from(std::uint32_t i, const PathSegment& path, double from, std::uint32_t member) {
  const auto path_at_hand = [&](std::uint32_t j) { return path_of(j); };
  NextEvent next;
  if (joint_) {
    const auto outside = [&](std::uint32_t j) -> const PathSegment* {
      if (member != nobody) arena_.cross_pairs.push_back({member, field_.flight[j].owner});
      return nullptr;
    };
    const auto sketched = [&](std::uint32_t j) { return !is_held(j); };
    next = scan_.earliest(i, path, from, sketched, path_at_hand, outside);
  } else {
    bool borders = false;
    const auto outside = [&](std::uint32_t j) -> const PathSegment* {
      borders = true;
      return &field_.flight[j].path;
    };
    const auto sketched = [&](std::uint32_t j) { return is_own(j); };
    next = scan_.earliest(i, path, from, sketched, path_at_hand, outside);
    if (member != nobody) arena_.members[member].borders = borders;
  }
  next.other_version = version_of(next.other);
  return next;
}

// The time has come up to which nothing could happen to the disk.
void ExactLoop::look_again(std::uint32_t i) {
  const std::uint32_t owner = field_.flight[i].owner;
  if (owner != nobody) {
    if (is_at_hand(owner)) look_around(member_of(owner));
    return;
  }
  const PathSegment& path = field_.flight[i].path;
  const NextEvent next = look_from(i, path, std::max(path.start, field_.slice_start), nobody);
  const double exit = exit_after(i, path, field_.slice_start, next.time);
  if (field_.in_slice(exit)) {
    arena_.roaming.push_back(i);
    return;
  }
  put_off(field_, i, next, exit, never);
  if (field_.in_slice(next.time)) push(i, 0, next);
}

// Finds the member's earliest event on its present path.
void ExactLoop::look_around(std::uint32_t m) {
  const std::uint32_t i = arena_.members[m].disk;
  const PathSegment path = arena_.members[m].now.path;
  const double from = std::max(path.start, field_.slice_start);
  const NextEvent next = look_from(i, path, from, m);
  const double exit = exit_after(i, path, from, next.time);
  Member& member = arena_.members[m];
  member.next = next;
  member.exit = exit;
  member.looked = true;
  Component& component = component_of(m);
  // What happens after a member left its list's range is unknown; what happens before may still turn it round.
  if (field_.in_slice(exit) && !(next.time < exit)) {
    if (component.status == ComponentStatus::solved) component.status = ComponentStatus::roams;
    return;
  }
  if (field_.in_slice(next.time)) push(i, member.version, next);
}

// The disk's member, made now if nobody holds it.
std::uint32_t ExactLoop::hold(std::uint32_t i) {
  const std::uint32_t owner = field_.flight[i].owner;
  return owner == nobody ? add_member(i) : member_of(owner);
}

// Takes a disk, on its path at the start of the slice, as a component of its own or for the joint one.
std::uint32_t ExactLoop::add_member(std::uint32_t i) {
  const auto m = static_cast<std::uint32_t>(arena_.members.size());
  field_.flight[i].owner = handle_of(arena_.number, m);
  if (joint_) {
    arena_.members.push_back(fresh_member(i, component_));
    Component& c = arena_.components[component_];
    arena_.members.back().next_member = c.first;
    c = {m, c.first == nobody ? m : c.last, c.count + 1, c.status};
  } else {
    arena_.members.push_back(fresh_member(i, static_cast<std::uint32_t>(arena_.components.size())));
    arena_.components.push_back({m, m, 1});
  }
  return m;
}

Member ExactLoop::fresh_member(std::uint32_t i, std::uint32_t component) const {
  Member member;
  member.disk = i;
  member.component = component;
  member.now.path = field_.flight[i].path;
  if (!field_.last_contact.empty()) member.now.last_contact = field_.last_contact[i];
  if (!field_.burst.empty()) member.burst = field_.burst[i];
  return member;
}

// Makes one component of the two members'; returns its number.
std::uint32_t ExactLoop::unite(std::uint32_t a, std::uint32_t b) {
  std::uint32_t into = arena_.members[a].component;
  std::uint32_t from = arena_.members[b].component;
  if (into == from) return into;
  if (arena_.components[into].count < arena_.components[from].count) std::swap(into, from);
  Component& c = arena_.components[into];
  Component& absorbed = arena_.components[from];
  for (std::uint32_t m = absorbed.first; m != nobody; m = arena_.members[m].next_member) {
    arena_.members[m].component = into;
  }
  arena_.members[c.last].next_member = absorbed.first;
  c.last = absorbed.last;
  c.count += absorbed.count;
  // What has to be solved again outweighs a collapse, which outweighs success.
  const auto weight = [](ComponentStatus s) {
    return s == ComponentStatus::solved ? 0 : s == ComponentStatus::collapsed ? 1 : 2;
  };
  if (weight(absorbed.status) > weight(c.status)) {
    c.status = absorbed.status;
    c.id1 = absorbed.id1;
    c.id2 = absorbed.id2;
    c.time = absorbed.time;
  }
  absorbed = {nobody, nobody, 0};
  return into;
}

// Disk i meets a disk that somebody else holds, or a disk of another block.
void ExactLoop::conflict(std::uint32_t i, std::uint32_t owner) {
  const std::uint32_t m = hold(i);
  component_of(m).status = ComponentStatus::conflict;
  arena_.conflicts.push_back({handle_of(arena_.number, m), owner});
}

void ExactLoop::meet_side(std::uint32_t m, const NextEvent& e) {
  Member& member = arena_.members[m];
  const Side side = wall_side(e.id2);
  const Impact outcome = meet_side_at(field_.rules, e.time, side, field_.disks->mass_of(member.disk), member.now);
  member.gone = field_.rules.box.side(side) == SideKind::sink;
  begin_piece(m, e, true, outcome);
  if (member.gone) {
    member.next = {};
    member.exit = never;
  } else {
    look_around(m);
  }
}

void ExactLoop::meet_disk(std::uint32_t m, std::uint32_t other, const NextEvent& e) {
  const Disks& d = *field_.disks;
  std::uint32_t first = m;
  std::uint32_t second = other;
  if (field_.flight[arena_.members[first].disk].id != e.id1) std::swap(first, second);
  Member& a = arena_.members[first];
  Member& b = arena_.members[second];
  const Impact outcome = collide_at(field_.rules, e.time, d.mass_of(a.disk), d.mass_of(b.disk), a.now, b.now);
  begin_piece(first, e, true, outcome);
  begin_piece(second, e, false, outcome);
  look_around(first);
  look_around(second);
}

void ExactLoop::begin_piece(std::uint32_t m, const NextEvent& e, bool counts, const Impact& outcome) {
  Member& member = arena_.members[m];
  ++member.version;
  const PathSegment& path = member.now.path;
  field_.sketch[member.disk] = field_.units.sketch(path);
  scan_.saw_speed(path.vx * path.vx + path.vy * path.vy);
  arena_.pieces.push_back({member.now.path, member.last_piece, counts ? e.id2 : nobody, outcome});
  member.last_piece = static_cast<std::uint32_t>(arena_.pieces.size() - 1);
  if (field_.burst.empty() || !member.burst.add(e.time, field_.length)) return;
  Component& c = component_of(m);
  c = {c.first, c.last, c.count, ComponentStatus::collapsed, e.id1, e.id2, e.time};
}

}  // namespace carom
