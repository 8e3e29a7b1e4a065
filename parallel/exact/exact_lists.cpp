#include "parallel/exact/exact_lists.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/huge_pages.hpp"
#include "core/physics/boundary.hpp"
#include "parallel/cells/tiled_grid.hpp"

namespace carom {

namespace {

// Disks whose lists share a vector where there are no tiles: enough that vectors are few, few enough to share out among
// threads.
constexpr std::size_t disks_per_block = 4096;
// Up to so many disks everybody is in everybody's list: nothing to keep in order, and windows of few disks are long.
constexpr std::size_t everybody_below = 40;
// Twice the roam and a diameter reach this many spacings: about eleven neighbours. Longer lists are looked through more
// often, shorter ones made more often.
constexpr double reach_in_spacings = 2.0;
// In very dense systems the roam is at least this share of a mean diameter.
constexpr double least_roam = 0.08;
// The roam in units of spots, whose rounding must not count.
constexpr double least_units = 1024.0;
// Single precision finds a few too many rather than one too few.
constexpr double single_margin = 1.0 + 1e-5;
// Runs of disks that the kernel looks through in one call.
constexpr std::size_t runs_at_once = 16;
constexpr double two_to_31 = 2147483648.0;
// Share of the roam that gravity may bend a path by before exit_time is asked again.
constexpr double bend_share = 0.1;

}  // namespace

void FoundDisks::grow(std::size_t disks) {
  room.resize(2 * (disks + nearby_room));
}

void ExactLists::choose_roam(const Disks& d, double share) {
  const double n = static_cast<double>(d.size());
  if (d.size() <= everybody_below) {
    roam_ = range_ = HUGE_VAL;
    return;
  }
  double radius = d.common_radius;
  if (!d.radius.empty()) {
    radius = 0.0;
    for (const double r : d.radius) radius += r;
    radius /= n;
  }
  const double spacing = std::sqrt(box_.width * box_.height / n);
  roam_ = std::max({0.5 * (reach_in_spacings * spacing - 2.0 * radius), least_roam * 2.0 * radius,
                    least_units * std::max(unit_x_, unit_y_)});
  range_ = share * roam_;
}

void ExactLists::sort(Disks& d, std::size_t disks_per_tile, const Executor& executor) {
  const double largest = largest_radius_;
  std::vector<std::size_t> count(class_of_radius(smallest_radius(d), largest) + 1, 0);
  if (count.size() == 1) count[0] = d.size();
  if (count.size() > 1) {
    for (const double r : d.radius) ++count[class_of_radius(r, largest)];
  }
  if (disks_per_tile > 0) {
    make_tiled_grid(box_, largest, count, disks_per_tile, grid_);
  } else {
    // About two disks a cell: lists reach over several cells, and each costs as much to visit, empty or not.
    for (std::size_t& c : count) c = c / 4 + 1;
    make_grid(box_, largest, count, grid_);
  }
  sort_into_cells(d, grid_, executor, cells_);
  head_.assign(grid_.keys, none);
  next_.assign(d.size(), unchained);
}

void ExactLists::build(Disks& d, const Domain& box, std::size_t disks_per_tile, double share,
                       const Executor& executor) {
  box_ = box;
  unit_x_ = box.width / (box.periodic_x() ? 2.0 * two_to_31 : two_to_31);
  unit_y_ = box.height / (box.periodic_y() ? 2.0 * two_to_31 : two_to_31);
  choose_roam(d, share);
  const std::size_t n = d.size();
  largest_radius_ = largest_radius(d);
  grid_.tiles = 1;
  grid_.tile_keys = 0;
  // Rows give way to what sorting needs.
  if (disks_per_tile > 0) std::vector<Row>().swap(rows_);
  if (!everybody()) sort(d, disks_per_tile, executor);
  if (rows_.capacity() < n) resize_in_huge_pages(rows_, n);
  rows_.resize(n);
  if (spot_.capacity() < n) resize_in_huge_pages(spot_, n);
  spot_.resize(n);
  executor.for_ranges(n, disks_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) spot_[i] = spot_at(d.x[i], d.y[i]);
  });
  if (grid_.tile_keys > 0) {
    wide_.resize(grid_.tiles);
    executor.run(wide_.size(), [&](std::size_t t) {
      const auto tile = static_cast<std::uint32_t>(t);
      list_block(d, t, first_disk_of(tile), first_disk_of(tile + 1));
    });
  } else {
    wide_.resize(executor.blocks(n, disks_per_block));
    executor.for_ranges(n, disks_per_block,
                        [&](std::size_t b, std::size_t begin, std::size_t end) { list_block(d, b, begin, end); });
  }
}

void ExactLists::list_block(const Disks& d, std::size_t home, std::size_t begin, std::size_t end) {
  thread_local FoundDisks found;
  wide_[home].clear();
  ListsPart everything;
  everything.nobody_moved = true;
  for (std::size_t k = begin; k < end; ++k) {
    const auto i = static_cast<std::uint32_t>(k);
    rows_[i].home = static_cast<std::uint16_t>(home);
    rows_[i].sides = static_cast<std::uint8_t>(find_sides(d, i));
    find_neighbours(d, i, spot_[i], everything, found);
    fill(i, found.disks());
  }
}

// Round a period the whole number wraps by itself; between walls a rounding error may lead outside.
Spot ExactLists::spot_at(double x, double y) const {
  const auto units = [](double c, double unit, bool periodic) {
    const auto whole = static_cast<std::int64_t>(c / unit);
    return static_cast<std::uint32_t>(periodic ? whole : std::clamp(whole, std::int64_t{0}, std::int64_t{1} << 31));
  };
  return {units(x, unit_x_, box_.periodic_x()), units(y, unit_y_, box_.periodic_y())};
}

bool ExactLists::find_neighbours(const Disks& d, std::uint32_t i, Spot spot, const ListsPart& part,
                                 FoundDisks& found) const {
  const double per_length = everybody() ? 0.0 : 1.0 / roam_;
  const double distance = d.radius_of(i) + 2.0 * roam_;
  const auto single = [&](double length) { return static_cast<float>(length * per_length); };
  // Everybody is near where lengths are nothing.
  const NearbyFrame frame{spot,
                          single(unit_x_),
                          single(unit_y_),
                          everybody() ? 0.0F : single(distance * single_margin),
                          single(d.common_radius * single_margin),
                          per_length * single_margin,
                          i};
  // Who was listed anew since is found where he is now.
  const NearbyColumns columns{spot_.data(), d.radius.empty() ? nullptr : d.radius.data(),
                              everybody() || part.nobody_moved ? nullptr : next_.data(),
                              std::min(static_cast<std::uint32_t>(spot_.size()), part.last_disk)};
  std::array<DiskRun, runs_at_once> runs;
  std::size_t held = 0;
  std::size_t disks = 0;  // in the runs
  std::size_t n = 0;
  const auto search = [&] {
    if (found.room.size() < n + disks + nearby_room) found.grow(n + disks);
    n += nearby_(frame, columns, runs.data(), held, found.room.data() + n);
    held = disks = 0;
  };
  const auto run = [&](std::uint32_t first, std::uint32_t last) {
    if (held == runs.size()) search();
    runs[held++] = {first, last};
    disks += last - first;
  };
  const auto see = [&](std::uint32_t j) {
    if (found.room.size() < n + nearby_room) found.grow(n);
    found.room[n] = j;
    n += is_nearby(frame, spot_[j], radius_in(frame, columns, j)) && j != i;
  };
  const Vec2 place = place_at(spot);
  const bool inside = visit_runs_near(place, distance, part, run, see);
  search();
  found.count = n;
  return inside;
}

unsigned ExactLists::find_sides(const Disks& d, std::uint32_t i) const {
  unsigned sides = 0;
  const Vec2 place = place_of(i);
  for (const Side side : all_sides) {
    if (box_.side(side) == SideKind::periodic) continue;
    const double gap = -reach_beyond(side, place.x, place.y, d.radius_of(i), box_);
    if (gap <= roam_) sides |= 1U << static_cast<unsigned>(side);
  }
  return sides;
}

void ExactLists::sort_along(std::vector<double>& column, const Executor& executor) {
  if (everybody()) return;
  std::vector<double>& sorted = cells_.column;
  executor.for_ranges(column.size(), disks_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) sorted[i] = column[cells_.order[i]];
  });
  column.swap(sorted);
}

void ExactLists::release_scratch() {
  if (grid_.tile_keys > 0) release_sort_scratch(cells_);
}

double ExactLists::exit_time(std::uint32_t i, const PathSegment& path, double from, double until, double g) const {
  if (everybody()) return never;
  const PathSegment p = carried_to(path, from, g);
  const Vec2 place = place_of(i);
  double dx = p.x - place.x;
  double dy = p.y - place.y;
  if (box_.periodic_x()) dx = nearest_image(dx, box_.width);
  if (box_.periodic_y()) dy = nearest_image(dy, box_.height);
  double room = range_ * (1.0 - 1e-9);
  double ahead = never;
  if (g > 0.0) {
    // The straight path, less what gravity can bend it by in the time looked ahead.
    ahead = std::max(std::sqrt(2.0 * bend_share * range_ / g), until - from);
    room -= 0.5 * g * ahead * ahead;
    if (!(room > 0.0)) return from;
  }
  const double c = room * room - (dx * dx + dy * dy);
  if (!(c > 0.0)) return from;
  const double a = p.vx * p.vx + p.vy * p.vy;
  if (a == 0.0) return from + ahead;
  const double b = dx * p.vx + dy * p.vy;
  const double root = std::sqrt(b * b + a * c);
  const double t = b > 0.0 ? c / (b + root) : (root - b) / a;
  return from + std::min(t, ahead);
}

// A straight path whose ends are in a circle is in it; gravity bends it by g t^2 / 8 at most.
bool ExactLists::stays(std::uint32_t i, const PathSegment& path, double from, double until, double g) const {
  if (everybody()) return true;
  const double bend = 0.125 * g * (until - from) * (until - from);
  const double room = range_ * (1.0 - 1e-9) - bend;
  const Vec2 place = place_of(i);
  const auto inside = [&](double t) {
    const double s = t - path.start;
    double dx = path.x + path.vx * s - place.x;
    double dy = path.y + (path.vy - 0.5 * g * s) * s - place.y;
    if (box_.periodic_x()) dx = nearest_image(dx, box_.width);
    if (box_.periodic_y()) dy = nearest_image(dy, box_.height);
    return dx * dx + dy * dy < room * room;
  };
  // A straight path begins inside anyway; a bent one has to begin further inside.
  return room > 0.0 && inside(until) && (g == 0.0 || inside(from));
}

// Listed disks are within reach + 4 roam of each other, carried back to the window's start by two flights more; less
// than half a period in all, the nearest image is the right one.
double ExactLists::safe_speed2(double length, double g) const {
  double period = HUGE_VAL;
  if (box_.periodic_x()) period = std::min(period, box_.width);
  if (box_.periodic_y()) period = std::min(period, box_.height);
  if (period == HUGE_VAL) return HUGE_VAL;
  const double flight = 0.5 * (0.49 * period - 2.0 * largest_radius_ - 4.0 * roam_) - g * length * length;
  return flight > 0.0 ? (flight / length) * (flight / length) : -1.0;
}

std::uint32_t ExactLists::key_of_spot(const Disks& d, std::uint32_t i, Spot spot) const {
  const std::size_t level =
      d.radius.empty() || grid_.levels.size() == 1 ? 0 : class_of_radius(d.radius[i], grid_.levels[0].largest_radius);
  const Vec2 place = place_at(spot);
  return key_of(grid_.levels[level], place.x, place.y);
}

bool ExactLists::lists(std::uint32_t i, std::uint32_t j) const {
  const Row& row = rows_[i];
  const auto offset = static_cast<std::int32_t>(j - i);
  // All of the row, so that the compiler can take several at a time; those beyond count are 0.
  const auto sought = static_cast<std::int16_t>(offset);
  std::int16_t seen = 0;
  for (std::uint32_t k = 0; k < chunk; ++k) seen = static_cast<std::int16_t>(seen | -(row.offset[k] == sought));
  if (seen != 0 && sought == offset) return true;
  for (std::uint32_t w = row.more; w != none; w = wide_[row.home][w].next) {
    const WideRow& wide = wide_[row.home][w];
    if (std::find(wide.offset, wide.offset + wide.count, offset) != wide.offset + wide.count) return true;
  }
  return false;
}

// Disk i's list becomes these.
void ExactLists::fill(std::uint32_t i, std::span<const std::uint32_t> found) {
  Row& row = rows_[i];
  row.more = none;
  row.count = 0;
  std::fill(std::begin(row.offset), std::end(row.offset), std::int16_t{0});
  for (const std::uint32_t j : found) insert(i, j);
}

void ExactLists::insert(std::uint32_t i, std::uint32_t j) {
  Row& row = rows_[i];
  const auto offset = static_cast<std::int32_t>(j - i);
  if (row.count < chunk && offset == static_cast<std::int16_t>(offset)) {
    row.offset[row.count++] = static_cast<std::int16_t>(offset);
  } else {
    insert_wide(row, offset);
  }
}

void ExactLists::insert_wide(Row& row, std::int32_t offset) {
  std::vector<WideRow>& wide = wide_[row.home];
  if (row.more == none || wide[row.more].count == wide_chunk) {
    wide.push_back({{}, 0, row.more});
    row.more = static_cast<std::uint32_t>(wide.size() - 1);
  }
  WideRow& last = wide[row.more];
  last.offset[last.count++] = offset;
}

// Takes the disk out of the chain of this cell.
void ExactLists::unchain(std::uint32_t i, std::uint32_t key) {
  std::uint32_t* link = &head_[key];
  while (*link != i) link = &next_[*link];
  *link = next_[i];
}

bool ExactLists::list_anew(std::uint32_t i, Vec2 place, const Disks& d, const ListsPart& part, FoundDisks& found) {
  const Spot spot = spot_at(place.x, place.y);
  if (!find_neighbours(d, i, spot, part, found)) return false;
  const std::span<const std::uint32_t> near = found.disks();
  if (!everybody()) {
    if (!std::all_of(near.begin(), near.end(), [&](std::uint32_t j) { return part.holds(j); })) return false;
    const bool chained = next_[i] != unchained;
    const std::uint32_t old_key = chained ? key_of_spot(d, i, spot_[i]) : 0;
    if (chained && (old_key < part.first_key || old_key >= part.last_key)) return false;
    if (chained) unchain(i, old_key);
    const std::uint32_t key = key_of_spot(d, i, spot);
    next_[i] = head_[key];
    head_[key] = i;
  }
  spot_[i] = spot;
  rows_[i].sides = static_cast<std::uint8_t>(find_sides(d, i));
  fill(i, near);
  for (const std::uint32_t j : near) {
    if (!lists(j, i)) insert(j, i);
  }
  return true;
}

}  // namespace carom
