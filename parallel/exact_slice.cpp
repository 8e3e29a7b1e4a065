#include "parallel/exact_slice.hpp"

#include <algorithm>
#include <limits>

#include "core/window_plan.hpp"

namespace carom {

namespace {

// Disks a block: a block's paths and lists fit in the second-level cache together.
constexpr std::size_t look_block = 2048;

bool stands(const Component& c) {
  return c.status == ComponentStatus::solved || c.status == ComponentStatus::collapsed;
}

// The pieces of a member's path through the slice, the one it starts with first; each ends where the next one starts.
void unroll(const ExactField& field, const Member& m, const std::vector<Piece>& pieces,
            std::vector<PathSegment>& path) {
  path.clear();
  for (std::uint32_t p = m.last_piece; p != nobody; p = pieces[p].before) path.push_back(pieces[p].path);
  path.push_back(field.flight[m.disk].path);
  std::reverse(path.begin(), path.end());
}

}  // namespace

void ExactSlices::begin_window() {
  const std::size_t n = field_.flight.size();
  block_ = std::max(executor_.grain(look_block), n / (most_arenas / 2) + 1);
  const std::size_t blocks = (n + block_ - 1) / block_;
  arenas_.resize(blocks + 1);
  for (std::size_t a = 0; a < arenas_.size(); ++a) arenas_[a].number = static_cast<std::uint32_t>(a);
  tallies_.assign(blocks + 1, {});
  log_.resize(blocks + 1);
  for (auto& log : log_) log.clear();
  gone_seen_.assign(blocks + 1, 0);
  fastest2_.assign(blocks + 1, 0.0);
  any_gone_ = false;
  field_.slice = 0;
}

bool ExactSlices::run(double start, double end, double window_start) {
  field_.slice_start = start;
  field_.slice_end = end;
  if (field_.slice < 0xffffU) ++field_.slice;
  list_leaving();
  look();
  cross();
  if (!join()) {
    release_all();
    return false;
  }
  fail_if_collapsed(window_start);
  commit();
  return true;
}

// Disks that leave the range of their lists in this slice are listed anew where they are at its start.
void ExactSlices::list_leaving() {
  executor_.run(arenas_.size() - 1, [&](std::size_t b) {
    arenas_[b].roaming.clear();
    const std::size_t end = std::min(field_.flight.size(), (b + 1) * block_);
    for (std::size_t i = b * block_; i < end; ++i) {
      if (field_.in_slice(field_.due[i]) && field_.flight[i].partner == leaving) {
        arenas_[b].roaming.push_back(static_cast<std::uint32_t>(i));
      }
    }
  });
  waiting_.clear();
  for (std::size_t b = 0; b + 1 < arenas_.size(); ++b) {
    waiting_.insert(waiting_.end(), arenas_[b].roaming.begin(), arenas_[b].roaming.end());
  }
  list_anew(waiting_);
}

void ExactSlices::look() {
  joint().clear();
  executor_.run(arenas_.size() - 1, [&](std::size_t b) {
    arenas_[b].clear();
    const std::size_t end = std::min(field_.flight.size(), (b + 1) * block_);
    ExactLoop(field_, lists_, arenas_[b])
        .run_block(static_cast<std::uint32_t>(b * block_), static_cast<std::uint32_t>(end));
  });
}

void ExactSlices::cross() {
  executor_.run(arenas_.size() - 1, [&](std::size_t a) { cross_check(arenas_[a], 0, arenas_[a].conflicts); });
}

// Looks at the arena's cross pairs from number `begin` on. Components that meet go to `conflicts`; otherwise the member
// learns when it will meet the other after the slice.
void ExactSlices::cross_check(ExactArena& arena, std::size_t begin, std::vector<Conflict>& conflicts) {
  for (std::size_t k = begin; k < arena.cross_pairs.size(); ++k) {
    const CrossPair pair = arena.cross_pairs[k];
    Member& a = arena.members[pair.member];
    const ExactArena& other = arenas_[arena_of(pair.other)];
    const Member& b = other.members[member_of(pair.other)];
    if (!stands(arena.components[a.component]) || !stands(other.components[b.component])) continue;
    const double t = first_meeting(a, arena.pieces, b, other.pieces);
    if (field_.in_slice(t)) {
      conflicts.push_back({handle_of(arena.number, pair.member), pair.other});
    } else {
      a.cross = std::min(a.cross, t);
    }
  }
}

// When the paths of two members of different components first meet, each segment up to and including its end.
double ExactSlices::first_meeting(const Member& a, const std::vector<Piece>& pieces_a, const Member& b,
                                  const std::vector<Piece>& pieces_b) const {
  thread_local std::vector<PathSegment> path_a;
  thread_local std::vector<PathSegment> path_b;
  unroll(field_, a, pieces_a, path_a);
  unroll(field_, b, pieces_b, path_b);
  const Flight& flight_a = field_.flight[a.disk];
  const Flight& flight_b = field_.flight[b.disk];
  const bool in_order = flight_a.id < flight_b.id;
  const std::vector<PathSegment>& first = in_order ? path_a : path_b;
  const std::vector<PathSegment>& second = in_order ? path_b : path_a;
  const Member& m1 = in_order ? a : b;
  const Member& m2 = in_order ? b : a;
  const double reach = flight_a.radius + flight_b.radius;
  // The segment that begins where a disk left through a sink is no path.
  const std::size_t n1 = first.size() - (m1.gone ? 1 : 0);
  const std::size_t n2 = second.size() - (m2.gone ? 1 : 0);
  double earliest = never;
  for (std::size_t i = 0; i < n1; ++i) {
    const double end1 = i + 1 < first.size() ? first[i + 1].start : never;
    for (std::size_t j = 0; j < n2; ++j) {
      const double end2 = j + 1 < second.size() ? second[j + 1].start : never;
      const double end = std::min(end1, end2);
      if (std::max(first[i].start, second[j].start) > end) continue;
      const double t = meeting_time(first[i], second[j], reach, field_.rules.box, field_.rules.gravity, field_.horizon);
      if (t <= end) earliest = std::min(earliest, t);
    }
  }
  return earliest;
}

// A member is on its path from the slice's start again. Whoever looked around meanwhile may have left it to the
// member's new path to answer for the pair; so the disk has to look before anything happens to it, whoever takes it in.
void ExactSlices::free_disk(std::uint32_t i) {
  field_.flight[i].owner = nobody;
  field_.put_off(i, field_.slice_start, nobody);
}

void ExactSlices::release(ExactArena& arena, Component& c, std::vector<std::uint32_t>& disks) {
  c.status = ComponentStatus::conflict;
  for (std::uint32_t m = c.first; m != nobody; m = arena.members[m].next_member) {
    const std::uint32_t i = arena.members[m].disk;
    if (field_.flight[i].owner != handle_of(arena.number, m)) continue;
    free_disk(i);
    disks.push_back(i);
  }
}

void ExactSlices::release_all() {
  for (ExactArena& arena : arenas_) {
    for (const Member& m : arena.members) {
      free_disk(m.disk);
    }
  }
}

// What cannot stand is solved again, together with whom it meets, until nothing meets.
bool ExactSlices::join() {
  waiting_.clear();
  listed_anew_.clear();
  for (std::size_t a = 0; a + 1 < arenas_.size(); ++a) {
    ExactArena& arena = arenas_[a];
    for (const Conflict& c : arena.conflicts) {
      release(arena, component_of(c.a), waiting_);
      if (c.b != nobody) release(arenas_[arena_of(c.b)], component_of(c.b), waiting_);
    }
    for (Component& c : arena.components) {
      if (c.count > 0 && !stands(c)) release(arena, c, waiting_);
    }
  }
  for (const ExactArena& arena : arenas_) {
    for (const std::uint32_t i : arena.roaming) {
      if (field_.flight[i].owner != nobody) continue;  // its component found that it turns round in time
      list_once(i);
      waiting_.push_back(i);
    }
  }
  ExactLoop solver(field_, lists_, joint());
  std::vector<std::uint32_t> group;
  for (std::size_t k = 0; k < waiting_.size(); ++k) {
    if (field_.flight[waiting_[k]].owner != nobody) continue;
    group.assign(1, waiting_[k]);
    if (!solve_together(solver, group)) return false;
  }
  return true;
}

// Solves the component that grows from the group; whoever it meets in a standing component joins the group with that
// component's members, and so on. False if a disk goes too far within the slice.
bool ExactSlices::solve_together(ExactLoop& solver, std::vector<std::uint32_t>& group) {
  ExactArena& arena = joint();
  std::vector<Conflict> conflicts;
  for (;;) {
    const std::size_t pairs_before = arena.cross_pairs.size();
    const std::size_t conflicts_before = arena.conflicts.size();
    const std::uint32_t number = solver.solve(group);
    conflicts.assign(arena.conflicts.begin() + static_cast<std::ptrdiff_t>(conflicts_before), arena.conflicts.end());
    const ComponentStatus status = arena.components[number].status;
    if (status == ComponentStatus::roams && !list_roamers(number)) return false;
    if (stands(arena.components[number])) cross_check(arena, pairs_before, conflicts);
    if (conflicts.empty() && status != ComponentStatus::roams) return true;
    group.clear();
    release(arena, arena.components[number], group);
    for (const Conflict& c : conflicts) {
      if (c.b != nobody) release(arenas_[arena_of(c.b)], component_of(c.b), group);
    }
  }
}

// Lists the members anew that leave the range of their lists.
bool ExactSlices::list_roamers(std::uint32_t number) {
  const Component c = joint().components[number];
  for (std::uint32_t m = c.first; m != nobody; m = joint().members[m].next_member) {
    const Member& member = joint().members[m];
    if (!field_.in_slice(member.exit)) continue;
    if (!list_once(member.disk)) return false;
  }
  return true;
}

// Around where the disk is at the slice's start; false if that has been done in this slice already.
bool ExactSlices::list_once(std::uint32_t i) {
  if (!listed_anew_.insert(i).second) return false;
  list_anew(std::span(&i, 1));
  return true;
}

void ExactSlices::list_anew(std::span<const std::uint32_t> which) {
  places_.clear();
  for (const std::uint32_t i : which) {
    PathSegment p = carried_to(field_.flight[i].path, field_.slice_start, field_.rules.gravity);
    wrap_into(p, field_.rules.box);
    places_.push_back({p.x, p.y});
    field_.put_off(i, field_.slice_start, nobody);  // what was known held for the old list
  }
  lists_.list_anew(which, places_, *field_.disks, executor_);
}

void ExactSlices::fail_if_collapsed(double window_start) const {
  const Component* first = nullptr;
  const auto before = [](const Component& a, const Component& b) {
    if (a.time != b.time) return a.time < b.time;
    return a.id1 != b.id1 ? a.id1 < b.id1 : a.id2 < b.id2;
  };
  if (field_.burst.empty()) return;
  for (const ExactArena& arena : arenas_) {
    for (const Component& c : arena.components) {
      if (c.status == ComponentStatus::collapsed && (first == nullptr || before(c, *first))) first = &c;
    }
  }
  if (first != nullptr) fail_collapse(first->id1, first->id2, window_start + first->time);
}

void ExactSlices::commit() {
  executor_.run(arenas_.size(), [&](std::size_t a) { commit_arena(a); });
  for (const unsigned char seen : gone_seen_) any_gone_ = any_gone_ || seen != 0;
  for (const double v2 : fastest2_) field_.fastest2 = std::max(field_.fastest2, v2);
}

// The member's path through the slice, and before it the one that it began the window with.
void ExactSlices::log_pieces(const ExactArena& arena, const Member& m, std::vector<LoggedPiece>& log) const {
  const PathSegment& path = field_.flight[m.disk].path;
  if (path.start == 0.0) log.push_back({m.disk, false, path});
  const std::size_t first = log.size();
  for (std::uint32_t p = m.last_piece; p != nobody; p = arena.pieces[p].before) {
    log.push_back({m.disk, m.gone && p == m.last_piece, arena.pieces[p].path});
  }
  std::reverse(log.begin() + static_cast<std::ptrdiff_t>(first), log.end());
}

void ExactSlices::commit_arena(std::size_t a) {
  ExactArena& arena = arenas_[a];
  ImpactTally& tally = tallies_[a];
  double& fastest2 = fastest2_[a];
  for (const Member& m : arena.members) {
    if (!stands(arena.components[m.component])) continue;
    Flight& flight = field_.flight[m.disk];
    flight.owner = nobody;
    if (m.gone) {
      field_.put_off(m.disk, never, nobody);
    } else if (m.looked) {
      put_off(field_, m.disk, m.next, m.exit, m.cross);
    }
    if (m.version == 0) continue;
    PathSegment& path = flight.path;
    for (std::uint32_t p = m.last_piece; p != nobody; p = arena.pieces[p].before) {
      if (arena.pieces[p].partner != nobody) tally.add(arena.pieces[p].partner, arena.pieces[p].outcome);
    }
    if (keeps_paths_) log_pieces(arena, m, log_[a]);
    path = m.now.path;
    flight.changed = field_.slice;
    fastest2 = std::max(fastest2, path.vx * path.vx + path.vy * path.vy);
    if (!field_.last_contact.empty()) field_.last_contact[m.disk] = m.now.last_contact;
    if (!field_.burst.empty()) field_.burst[m.disk] = m.burst;
    if (!m.gone) continue;
    // Nobody can meet a path that is not a number.
    path.x = path.y = std::numeric_limits<double>::quiet_NaN();
    gone_seen_[a] = 1;
  }
}

ImpactTally ExactSlices::tally() const {
  ImpactTally sum = tallies_.front();
  for (std::size_t k = 1; k < tallies_.size(); ++k) sum.add(tallies_[k]);
  return sum;
}

Count ExactSlices::events() const {
  Count events = 0;
  for (const ImpactTally& t : tallies_) events += t.collisions + t.wall_collisions;
  return events;
}

}  // namespace carom
