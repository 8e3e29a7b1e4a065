#include "parallel/exact_component.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

// Relative room for rounding in bounds: far above that of doubles, far below what would cost anything.
constexpr double bound_margin = 1e-9;

// A time before which the pair cannot meet; infinite (or not a number, where nothing moves) when it cannot meet at all
// from time `from` on.
void find_bounds(NeighbourBatch& batch, std::uint32_t count, double from) {
  for (std::uint32_t k = 0; k < count; ++k) {
    const double dx = batch.dx[k];
    const double dy = batch.dy[k];
    const double dvx = batch.dvx[k];
    const double dvy = batch.dvy[k];
    const double near = batch.reach[k] * (1.0 + bound_margin);
    const double a = dvx * dvx + dvy * dvy;
    const double b = dx * dvx + dy * dvy;
    const double discriminant = b * b - a * (dx * dx + dy * dy - near * near);
    const double now = b + a * from;
    const double t = (-b - std::sqrt(std::max(discriminant, 0.0))) / a;
    const double early = t - bound_margin * std::abs(t);
    // Receding clearly, not just by rounding: now > 1e-10 near |dv|.
    const double receding = now * std::abs(now) - 1e-20 * (near * near * a);
    const double missing = discriminant < 0.0 ? never : early;
    batch.bound[k] = receding > 0.0 ? never : missing;
  }
}

}  // namespace

// The earliest event of disk i on this path. visit(j) says how disk j is to be seen.
template <class Visit>
NextEvent ComponentSolver::earliest(std::uint32_t i, const PathSegment& path, Visit&& visit) {
  const Domain& box = field_.rules.box;
  const bool far = !(std::max(field_.fastest2, path.vx * path.vx + path.vy * path.vy) <= field_.safe_speed2);
  NextEvent best = earliest_at_sides(i, path, far);
  best.bound = best.time;
  const Ray ray = ray_of(path, field_.rules.gravity);
  const double from = std::max(path.start, field_.slice_start);
  const double own_radius = field_.disks->radius_of(i);
  const bool own_column = !field_.disks->radius.empty();
  const bool around_x = box.periodic_x();
  const bool around_y = box.periodic_y();
  const ExactLists::Neighbours list = lists_.of(i);
  NeighbourBatch& batch = batch_;
  for (std::uint32_t first = 0; first < list.count; first += NeighbourBatch::size) {
    const std::uint32_t last = std::min(list.count, first + NeighbourBatch::size);
    std::uint32_t n = 0;
    for (std::uint32_t k = first; k < last; ++k) {
      const std::uint32_t j = list.first[k];
      const Seen seen = visit(j);
      if (seen.path == nullptr) continue;
      const Ray& other = *seen.ray;
      batch.path[n] = seen.path;
      batch.version[n] = seen.version;
      batch.disk[n] = j;
      batch.reach[n] = own_radius + (own_column ? field_.disks->radius[j] : own_radius);
      const double dx = other.x - ray.x;
      const double dy = other.y - ray.y;
      batch.dx[n] = around_x ? nearest_image(dx, box.width) : dx;
      batch.dy[n] = around_y ? nearest_image(dy, box.height) : dy;
      batch.dvx[n] = other.vx - ray.vx;
      batch.dvy[n] = other.vy - ray.vy;
      ++n;
    }
    if (far) {
      std::fill_n(batch.bound, n, from);
    } else {
      find_bounds(batch, n, from);
    }
    for (std::uint32_t k = 0; k < n; ++k) {
      if (batch.bound[k] <= best.time && batch.bound[k] < never) meet_exactly(i, path, k, best);
    }
  }
  return best;
}

// The exact formula for neighbour k of the batch; `best` becomes this meeting if it comes first.
void ComponentSolver::meet_exactly(std::uint32_t i, const PathSegment& path, std::uint32_t k, NextEvent& best) const {
  const std::uint32_t j = batch_.disk[k];
  const PathSegment& other = *batch_.path[k];
  const Disks& d = *field_.disks;
  const ExactRules& rules = field_.rules;
  const bool in_order = d.id[i] < d.id[j];
  const double reach = d.radius_of(i) + d.radius_of(j);
  const double t = in_order ? meeting_time(path, other, reach, rules.box, rules.gravity, field_.horizon)
                            : meeting_time(other, path, reach, rules.box, rules.gravity, field_.horizon);
  const double bound = std::min(best.bound, batch_.bound[k]);
  const NextEvent e{t, in_order ? d.id[i] : d.id[j], in_order ? d.id[j] : d.id[i], j, batch_.version[k]};
  if (t < never && e.before(best)) best = e;
  best.bound = bound;
}

NextEvent ComponentSolver::earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far) const {
  const Disks& d = *field_.disks;
  const Domain& box = field_.rules.box;
  const double g = field_.rules.gravity;
  NextEvent best;
  const auto look = [&](Side side) {
    const NextEvent e{side_time(path, side, d.radius_of(i), box, g, field_.horizon), d.id[i], wall_partner(side), i, 0};
    if (e.time < never && e.before(best)) best = e;
  };
  const unsigned near = lists_.sides_near(i);
  if (near != 0) {
    for (const Side side : all_sides) {
      if ((near >> static_cast<unsigned>(side) & 1U) != 0) look(side);
    }
  }
  if (!far) return best;
  // Crossing events can only happen to a disk that flies far within the window.
  const double span = (field_.horizon - path.start) * (1.0 + 1e-9);
  if (box.periodic_x() && std::abs(path.vx) * span >= longest_flight * box.width) {
    look(path.vx > 0.0 ? Side::right : Side::left);
  }
  if (box.periodic_y() && (std::abs(path.vy) + g * span) * span >= longest_flight * box.height) {
    look(path.vy > 0.0 ? Side::top : Side::bottom);
  }
  return best;
}

void ComponentSolver::look_at(std::uint32_t i) {
  if (owner_of(i) != nobody) return;
  const double exit = lists_.exit_time(i, field_.path[i], field_.slice_start, std::min(field_.slice_end, field_.length),
                                       field_.rules.gravity);
  if (field_.in_slice(exit)) {
    arena_.roaming.push_back(i);
    return;
  }
  const NextEvent alone = earliest(i, field_.path[i], [&](std::uint32_t j) {
    return Seen{&field_.path[j], &field_.ray[j], 0};
  });
  if (!field_.in_slice(alone.time)) {
    const double due = std::min({alone.bound, exit, field_.horizon});
    std::atomic_ref<double>(field_.due[i]).store(due, std::memory_order_relaxed);
    return;
  }
  clock_ = -never;
  component_ = static_cast<std::uint32_t>(arena_.components.size());
  arena_.components.push_back({static_cast<std::uint32_t>(arena_.members.size()), 0});
  if (add_member(i)) {
    Member& member = arena_.members.back();
    member.next = alone;
    member.due = std::min(exit, field_.horizon);
    run();
  } else {
    arena_.components.pop_back();
  }
}

std::uint32_t ComponentSolver::solve(const std::vector<std::uint32_t>& disks) {
  clock_ = -never;
  component_ = static_cast<std::uint32_t>(arena_.components.size());
  arena_.components.push_back({static_cast<std::uint32_t>(arena_.members.size()), 0});
  for (const std::uint32_t i : disks) {
    if (add_member(i)) look_around(static_cast<std::uint32_t>(arena_.members.size() - 1));
  }
  run();
  return component_;
}

// Makes disk i a member, on its path at the start of the slice; false if another component holds it. Its events are
// looked for when its due time comes; a member that gets a new path is looked at then. The claim comes before that
// look: of two components that claim neighbouring disks at the same time, at least one then sees the other's claim.
bool ComponentSolver::add_member(std::uint32_t i) {
  const auto m = static_cast<std::uint32_t>(arena_.members.size());
  arena_.members.push_back(fresh_member(i));
  std::uint32_t expected = nobody;
  if (!std::atomic_ref<std::uint32_t>(field_.owner[i]).compare_exchange_strong(expected, handle(m))) {
    arena_.members.pop_back();
    return false;
  }
  ++arena_.components[component_].count;
  if (arena_.members[m].next.time > clock_) return true;
  look_around(m);
  if (!(arena_.members[m].next.time > clock_)) start_over();
  return true;
}

// A disk taken in late has an event before those that have happened: with it from the beginning, they may not.
void ComponentSolver::start_over() {
  const Component& c = arena_.components[component_];
  clock_ = -never;
  for (std::uint32_t m = c.first; m < c.first + c.count; ++m) {
    arena_.members[m] = fresh_member(arena_.members[m].disk);
  }
}

Member ComponentSolver::fresh_member(std::uint32_t i) const {
  Member member;
  member.disk = i;
  member.component = component_;
  member.now.path = field_.path[i];
  if (!field_.last_contact.empty()) member.now.last_contact = field_.last_contact[i];
  if (!field_.burst.empty()) member.burst = field_.burst[i];
  member.next.time = member.next.bound = due_of(i);
  return member;
}

// Finds the member's earliest event on its present path.
void ComponentSolver::look_around(std::uint32_t m) {
  const std::uint32_t i = arena_.members[m].disk;
  const PathSegment path = arena_.members[m].now.path;
  const double from = std::max(path.start, field_.slice_start);
  const double exit = lists_.exit_time(i, path, from, std::min(field_.slice_end, field_.length), field_.rules.gravity);
  const NextEvent next = earliest(i, path, [&](std::uint32_t j) {
    const std::uint32_t owner = owner_of(j);
    if (owner == nobody) return Seen{&field_.path[j], &field_.ray[j], 0};
    if (!is_ours(owner)) {
      arena_.cross_pairs.push_back({m, owner});
      return Seen{};
    }
    const Member& other = arena_.members[member_of(owner)];
    if (other.gone) return Seen{};
    member_ray_ = ray_of(other.now.path, field_.rules.gravity);
    return Seen{&other.now.path, &member_ray_, other.version};
  });
  Member& member = arena_.members[m];
  member.next = next;
  member.due = std::min(exit, field_.horizon);
  Component& component = arena_.components[component_];
  // What happens after a member left its list's range is unknown; what happens before may still turn it round.
  if (field_.in_slice(exit) && !(next.time < exit) && component.status == ComponentStatus::solved) {
    component.status = ComponentStatus::roams;
  }
}

std::uint32_t ComponentSolver::first_due() const {
  const Component& c = arena_.components[component_];
  std::uint32_t first = c.first;
  for (std::uint32_t m = c.first + 1; m < c.first + c.count; ++m) {
    if (arena_.members[m].next.before(arena_.members[first].next)) first = m;
  }
  return first;
}

// Event by event, until the slice holds none any more.
void ComponentSolver::run() {
  while (arena_.components[component_].status == ComponentStatus::solved) {
    const std::uint32_t m = first_due();
    const NextEvent e = arena_.members[m].next;
    if (!field_.in_slice(e.time)) return;
    if (e.other == nobody) {
      look_around(m);
      continue;
    }
    if (e.other != arena_.members[m].disk && !take_in(m, e)) continue;
    clock_ = e.time;
    happen(m, e);
  }
}

// The other disk of the event becomes a member if it isn't one. True when the event may happen: nobody was taken in,
// and the other disk is still on the path that the event was found with.
bool ComponentSolver::take_in(std::uint32_t m, const NextEvent& e) {
  const std::uint32_t owner = owner_of(e.other);
  if (owner != nobody && is_ours(owner)) {
    if (arena_.members[member_of(owner)].version == e.other_version) return true;
    look_around(m);
    return false;
  }
  if (owner == nobody && add_member(e.other)) return false;
  arena_.components[component_].status = ComponentStatus::conflict;
  arena_.conflicts.push_back({handle(m), owner_of(e.other)});
  return false;
}

void ComponentSolver::happen(std::uint32_t m, const NextEvent& e) {
  const Disks& d = *field_.disks;
  if (is_wall(e.id2)) {
    Member& member = arena_.members[m];
    const Side side = wall_side(e.id2);
    const Impact outcome = meet_side_at(field_.rules, e.time, side, d.mass_of(member.disk), member.now);
    member.gone = field_.rules.box.side(side) == SideKind::sink;
    begin_piece(m, e, true, outcome);
    if (member.gone) {
      member.next = {};
      member.due = never;
    } else {
      look_around(m);
    }
    return;
  }
  std::uint32_t first = m;
  std::uint32_t second = member_of(owner_of(e.other));
  if (d.id[arena_.members[first].disk] != e.id1) std::swap(first, second);
  Member& a = arena_.members[first];
  Member& b = arena_.members[second];
  const Impact outcome = collide_at(field_.rules, e.time, d.mass_of(a.disk), d.mass_of(b.disk), a.now, b.now);
  begin_piece(first, e, true, outcome);
  begin_piece(second, e, false, outcome);
  look_around(first);
  look_around(second);
}

void ComponentSolver::begin_piece(std::uint32_t m, const NextEvent& e, bool counts, const Impact& outcome) {
  Member& member = arena_.members[m];
  ++member.version;
  arena_.pieces.push_back({member.now.path, member.last_piece, counts ? e.id2 : nobody, outcome});
  member.last_piece = static_cast<std::uint32_t>(arena_.pieces.size() - 1);
  if (field_.burst.empty() || !member.burst.add(e.time, field_.length)) return;
  Component& c = arena_.components[component_];
  c = {c.first, c.count, ComponentStatus::collapsed, e.id1, e.id2, e.time};
}

}  // namespace carom
