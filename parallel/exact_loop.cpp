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
    field.put_off(i, next.time, next.other_version == 0 ? partner : nobody);
  } else if (first < field.horizon) {
    field.put_off(i, first, exit <= cross ? leaving : nobody);
  } else {
    field.put_off(i, field.horizon, nobody);
  }
}

std::vector<HeapEntry>& ExactLoop::heap_of_this_thread() {
  thread_local std::vector<HeapEntry> heap;
  return heap;
}

void ExactLoop::run_block(std::uint32_t begin, std::uint32_t end) {
  joint_ = false;
  begin_ = begin;
  end_ = end;
  last_.time = -never;
  heap_.clear();
  // Most of the block is looked at several times, in no order: asked for in order first, it comes much faster.
  for (std::uint32_t i = begin; i < end; ++i) {
    __builtin_prefetch(&field_.flight[i]);
    lists_.prefetch(i);
    if (field_.in_slice(field_.due_of(i)) && field_.owner_of(i) == nobody) push_due(i);
  }
  run();
}

std::uint32_t ExactLoop::solve(const std::vector<std::uint32_t>& disks) {
  joint_ = true;
  last_.time = -never;
  heap_.clear();
  component_ = static_cast<std::uint32_t>(arena_.components.size());
  arena_.components.push_back({nobody, nobody, 0});
  for (const std::uint32_t i : disks) {
    const std::uint32_t m = add_member(i);
    if (m != nobody) look_around(m);
  }
  run();
  return component_;
}

void ExactLoop::run() {
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const HeapEntry e = heap_.back();
    heap_.pop_back();
    process(e);
  }
}

void ExactLoop::process(const HeapEntry& e) {
  const std::uint32_t owner = field_.owner_of(e.disk);
  if (owner != nobody) {
    // Held by somebody else, who answers for it then; or given up; or on a new path, which has an event of its own.
    if (!is_at_hand(owner) || component_of(member_of(owner)).status != ComponentStatus::solved) return;
    if (arena_.members[member_of(owner)].version != e.version) return;
  }
  if (e.event.other == nobody) {
    look_again(e.disk);
  } else if (!joint_ && e.event.before(last_)) {
    // A disk of another block answered for this pair. What happened since did not know of it.
    conflict(e.disk, e.event.other);
  } else if (e.event.other != e.disk) {
    process_pair(e);
  } else {
    const std::uint32_t m = hold(e.disk);
    if (m == nobody) return;
    last_ = e.event;
    meet_side(m, e.event);
  }
}

void ExactLoop::process_pair(const HeapEntry& e) {
  const std::uint32_t j = e.event.other;
  if (!is_ready(e)) return;
  const std::uint32_t m = hold(e.disk);
  if (m == nobody) return;  // another thread, which was faster, answers for it now
  const std::uint32_t other = hold(j);
  if (other == nobody) {
    conflict(e.disk, j);
    return;
  }
  if (arena_.components[unite(m, other)].status != ComponentStatus::solved) return;
  last_ = e.event;
  meet_disk(m, other, e.event);
}

// Is the event's other disk on the path that the event was found with, and can it have no event before? If not, sees to
// what has to be done first.
bool ExactLoop::is_ready(const HeapEntry& e) {
  const std::uint32_t j = e.event.other;
  const std::uint32_t owner = field_.owner_of(j);
  if (owner == nobody) {
    if (joint_) {
      if (take_in(j)) push(e.disk, e.version, e.event);
      return false;
    }
    const double due = field_.due_of(j);
    const bool own = j >= begin_ && j < end_;
    if (due < e.event.time || (!own && due == e.event.time && field_.partner_of(j) != e.disk)) {
      conflict(e.disk, j);
      return false;
    }
    return true;
  }
  if (!is_at_hand(owner)) {
    conflict(e.disk, j);
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
  if (field_.due_of(disk) > last_.time) {
    if (field_.in_slice(field_.due_of(disk))) push_due(disk);
    return true;
  }
  start_over();
  return false;
}

void ExactLoop::start_over() {
  const Component c = arena_.components[component_];
  last_.time = -never;
  heap_.clear();
  for (std::uint32_t m = c.first; m != nobody; m = arena_.members[m].next_member) {
    const std::uint32_t next = arena_.members[m].next_member;
    arena_.members[m] = fresh_member(arena_.members[m].disk, component_);
    arena_.members[m].next_member = next;
  }
  for (std::uint32_t m = c.first; m != nobody; m = arena_.members[m].next_member) look_around(m);
}

void ExactLoop::push(std::uint32_t disk, std::uint32_t version, const NextEvent& event) {
  heap_.push_back({event, disk, version});
  std::push_heap(heap_.begin(), heap_.end(), later);
}

// What is known of a disk since an earlier slice. An event found then still stands if the partner's path has not
// changed in that slice or since.
void ExactLoop::push_due(std::uint32_t i) {
  const Flight& f = field_.flight[i];
  const double due = field_.due_of(i);
  const std::uint32_t partner = field_.partner_of(i);
  NextEvent e{due, 0, 0, nobody, 0};
  if (partner < leaving && is_wall(partner)) {
    e = {due, f.id, partner, i, 0};
  } else if (partner < leaving) {
    const Flight& other = field_.flight[partner];
    const std::uint32_t owner = field_.owner_of(partner);
    if (other.changed < f.looked && owner == nobody) {
      e = {due, std::min(f.id, other.id), std::max(f.id, other.id), partner, 0};
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

// Events so far of the disk that an event is with; 0 if it is no member at hand.
std::uint32_t ExactLoop::version_of(std::uint32_t other) {
  if (other == nobody) return 0;
  const std::uint32_t owner = field_.owner_of(other);
  return is_at_hand(owner) ? arena_.members[member_of(owner)].version : 0;
}

// The time has come up to which nothing could happen to the disk.
void ExactLoop::look_again(std::uint32_t i) {
  const std::uint32_t owner = field_.owner_of(i);
  if (owner != nobody) {
    if (is_at_hand(owner)) look_around(member_of(owner));
    return;
  }
  const PathSegment& path = field_.flight[i].path;
  const double from = std::max(path.start, field_.slice_start);
  NextEvent next = scan_.earliest(i, path, from, [&](std::uint32_t j) -> const PathSegment* {
    const std::uint32_t held = field_.owner_of(j);
    if (!is_at_hand(held)) return &field_.flight[j].path;
    const Member& other = arena_.members[member_of(held)];
    return other.gone ? nullptr : &other.now.path;
  });
  if (next.other != i) next.other_version = version_of(next.other);
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
  NextEvent next = scan_.earliest(i, path, from, [&](std::uint32_t j) -> const PathSegment* {
    const std::uint32_t owner = field_.owner_of(j);
    if (owner == nobody) return &field_.flight[j].path;
    if (!is_at_hand(owner)) {
      arena_.cross_pairs.push_back({m, owner});
      return nullptr;
    }
    const Member& other = arena_.members[member_of(owner)];
    return other.gone ? nullptr : &other.now.path;
  });
  if (next.other != i) next.other_version = version_of(next.other);
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

// The disk's member, claimed if nobody holds it; nobody if somebody else does.
std::uint32_t ExactLoop::hold(std::uint32_t i) {
  const std::uint32_t owner = field_.owner_of(i);
  if (owner == nobody) return add_member(i);
  return is_at_hand(owner) ? member_of(owner) : nobody;
}

// Claims a disk, on its path at the start of the slice, as a component of its own or for the joint one. Returns nobody
// if another thread was faster.
std::uint32_t ExactLoop::add_member(std::uint32_t i) {
  const auto m = static_cast<std::uint32_t>(arena_.members.size());
  std::uint32_t expected = nobody;
  const bool claimed = std::atomic_ref<std::uint32_t>(field_.flight[i].owner)
                           .compare_exchange_strong(expected, handle_of(arena_.number, m));
  if (!claimed) return nobody;
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

// Disk i meets a disk that somebody else holds or that may have an event before.
void ExactLoop::conflict(std::uint32_t i, std::uint32_t other) {
  const std::uint32_t m = hold(i);
  if (m == nobody) return;
  component_of(m).status = ComponentStatus::conflict;
  arena_.conflicts.push_back({handle_of(arena_.number, m), field_.owner_of(other)});
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
  scan_.saw_speed(path.vx * path.vx + path.vy * path.vy);
  arena_.pieces.push_back({member.now.path, member.last_piece, counts ? e.id2 : nobody, outcome});
  member.last_piece = static_cast<std::uint32_t>(arena_.pieces.size() - 1);
  if (field_.burst.empty() || !member.burst.add(e.time, field_.length)) return;
  Component& c = component_of(m);
  c = {c.first, c.last, c.count, ComponentStatus::collapsed, e.id1, e.id2, e.time};
}

}  // namespace carom
