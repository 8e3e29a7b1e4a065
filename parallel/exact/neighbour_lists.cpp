#include "parallel/exact/neighbour_lists.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/base/huge_pages.hpp"
#include "core/physics/boundary.hpp"
#include "parallel/cells/tiled_grid.hpp"

namespace carom {

namespace {

// Disks whose lists share a vector where there are no tiles: enough that vectors are few, few enough to share out among
// threads. Their number has 16 bits.
constexpr std::size_t disks_per_block = 4096;
constexpr std::size_t most_blocks = 65536;
// Twice the skin and a diameter make this many mean spacings: about eleven neighbours. Longer lists take longer to go
// through, shorter ones have to be renewed more often.
constexpr double cutoff_in_spacings = 2.0;
// In very dense systems the skin is at least this share of a mean diameter.
constexpr double least_skin = 0.08;
// The skin in units of fixed point, whose rounding must not count.
constexpr double least_units = 1024.0;
// Single precision finds a few too many rather than one too few.
constexpr double single_margin = 1.0 + 1e-5;
// Runs of disks that the kernel searches in one call.
constexpr std::size_t runs_at_once = 16;
constexpr double two_to_31 = 2147483648.0;
// Share of the skin that gravity may bend a path by before earliest_relist_time is asked again.
constexpr double bend_share = 0.1;

// Collects the neighbours of one disk: from runs of disks by the kernel, relisted ones one by one.
class NeighbourCollector {
 public:
  NeighbourCollector(ListKernel kernel, const ListQuery& query, const ListColumns& columns, FoundNeighbours& found)
      : kernel_(kernel), query_(query), columns_(columns), found_(found) {
    found.count = 0;
  }

  void add_run(std::uint32_t first, std::uint32_t last) {
    if (held_ == runs_.size()) search();
    runs_[held_++] = {first, last};
    disks_ += last - first;
  }

  void add(std::uint32_t j) {
    if (found_.buffer.size() < found_.count + list_kernel_padding) found_.grow(found_.count);
    found_.buffer[found_.count] = j;
    found_.count += is_neighbour(query_, columns_.position[j], radius_in(query_, columns_, j)) && j != query_.self;
  }

  // Searches the runs that are held.
  void search() {
    if (found_.buffer.size() < found_.count + disks_ + list_kernel_padding) found_.grow(found_.count + disks_);
    found_.count += kernel_(query_, columns_, runs_.data(), held_, found_.buffer.data() + found_.count);
    held_ = disks_ = 0;
  }

 private:
  ListKernel kernel_;
  const ListQuery& query_;
  const ListColumns& columns_;
  FoundNeighbours& found_;
  std::array<DiskRun, runs_at_once> runs_;
  std::size_t held_ = 0;
  std::size_t disks_ = 0;  // in the runs
};

}  // namespace

void FoundNeighbours::grow(std::size_t disks) {
  buffer.resize(2 * (disks + list_kernel_padding));
}

void NeighbourLists::choose_skin(const Disks& d, double relist_share) {
  const double n = static_cast<double>(d.size());
  double radius = d.common_radius;
  if (!d.radius.empty()) {
    radius = 0.0;
    for (const double r : d.radius) radius += r;
    radius /= n;
  }
  const double spacing = std::sqrt(box_.width * box_.height / n);
  skin_ = std::max({0.5 * (cutoff_in_spacings * spacing - 2.0 * radius), least_skin * 2.0 * radius,
                    least_units * std::max(unit_x_, unit_y_)});
  relist_distance_ = relist_share * skin_;
}

void NeighbourLists::sort(Disks& d, std::size_t disks_per_tile, const Executor& executor) {
  const double largest = largest_radius_;
  std::vector<std::size_t> count(class_of_radius(smallest_radius(d), largest) + 1, 0);
  if (count.size() == 1) count[0] = d.size();
  if (count.size() > 1) {
    for (const double r : d.radius) ++count[class_of_radius(r, largest)];
  }
  if (disks_per_tile > 0) {
    make_tiled_grid(box_, largest, count, disks_per_tile, grid_);
  } else {
    // About two disks a cell: lists extend over several cells, and each costs as much to visit, empty or not.
    for (std::size_t& c : count) c = c / 4 + 1;
    make_grid(box_, largest, count, grid_);
  }
  sort_into_cells(d, grid_, executor, cells_);
  head_.assign(grid_.keys, none);
  next_.assign(d.size(), unchained);
}

void NeighbourLists::build(Disks& d, const Domain& box, const ListLayout& layout, const Executor& executor) {
  mode_ = layout.mode;
  box_ = box;
  unit_x_ = box.width / (box.periodic_x() ? 2.0 * two_to_31 : two_to_31);
  unit_y_ = box.height / (box.periodic_y() ? 2.0 * two_to_31 : two_to_31);
  const std::size_t n = d.size();
  largest_radius_ = largest_radius(d);
  grid_.tiles = 1;
  grid_.tile_keys = 0;
  if (mode_ != EngineMode::all_pairs) {
    choose_skin(d, layout.relist_share);
    // Much memory: that of the rows is given back for what sorting needs.
    if (mode_ == EngineMode::tiled) std::vector<Row>().swap(rows_);
    sort(d, layout.disks_per_tile, executor);
  }
  if (rows_.capacity() < n) resize_in_huge_pages(rows_, n);
  rows_.resize(n);
  if (listed_at_.capacity() < n) resize_in_huge_pages(listed_at_, n);
  listed_at_.resize(n);
  executor.for_ranges(n, disks_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) listed_at_[i] = fixed_point(d.x[i], d.y[i]);
  });
  list_all(d, executor);
}

void NeighbourLists::list_all(const Disks& d, const Executor& executor) {
  if (mode_ == EngineMode::tiled) {
    wide_.resize(grid_.tiles);
    executor.run(wide_.size(), [&](std::size_t t) {
      const auto tile = static_cast<std::uint32_t>(t);
      list_block(d, t, first_disk_of(tile), first_disk_of(tile + 1));
    });
  } else {
    const std::size_t per_block = std::max(disks_per_block, d.size() / most_blocks + 1);
    wide_.resize(executor.blocks(d.size(), per_block));
    executor.for_ranges(d.size(), per_block,
                        [&](std::size_t b, std::size_t begin, std::size_t end) { list_block(d, b, begin, end); });
  }
}

void NeighbourLists::list_block(const Disks& d, std::size_t block, std::size_t begin, std::size_t end) {
  thread_local FoundNeighbours found;
  wide_[block].clear();
  ListRegion everything;
  everything.none_relisted = true;
  for (std::size_t k = begin; k < end; ++k) {
    const auto i = static_cast<std::uint32_t>(k);
    rows_[i].block = static_cast<std::uint16_t>(block);
    rows_[i].sides = static_cast<std::uint8_t>(find_sides(d, i));
    if (mode_ == EngineMode::all_pairs) {
      find_all_others(i, found);
    } else {
      find_neighbours(d, i, listed_at_[i], everything, found);
    }
    set_list(i, found.disks());
  }
}

// Along a period the whole number wraps by itself; between walls a rounding error may lead outside.
FixedPointPosition NeighbourLists::fixed_point(double x, double y) const {
  const auto units = [](double c, double unit, bool periodic) {
    const auto whole = static_cast<std::int64_t>(c / unit);
    return static_cast<std::uint32_t>(periodic ? whole : std::clamp(whole, std::int64_t{0}, std::int64_t{1} << 31));
  };
  return {units(x, unit_x_, box_.periodic_x()), units(y, unit_y_, box_.periodic_y())};
}

// Lengths in units of the skin.
ListQuery NeighbourLists::query_at(const Disks& d, std::uint32_t i, FixedPointPosition position) const {
  const double per_length = 1.0 / skin_;
  const double distance = d.radius_of(i) + 2.0 * skin_;
  const auto single = [&](double length) { return static_cast<float>(length * per_length); };
  return {position,
          single(unit_x_),
          single(unit_y_),
          single(distance * single_margin),
          single(d.common_radius * single_margin),
          per_length * single_margin,
          i};
}

// Relisted disks are not found in the cells that they were sorted into, but in the chains of their present cells.
ListColumns NeighbourLists::columns_in(const Disks& d, const ListRegion& region) const {
  return {listed_at_.data(), d.radius.empty() ? nullptr : d.radius.data(),
          region.none_relisted ? nullptr : next_.data(),
          std::min(static_cast<std::uint32_t>(listed_at_.size()), region.last_disk)};
}

bool NeighbourLists::find_neighbours(const Disks& d, std::uint32_t i, FixedPointPosition position,
                                     const ListRegion& region, FoundNeighbours& found) const {
  const ListQuery query = query_at(d, i, position);
  const ListColumns columns = columns_in(d, region);
  NeighbourCollector collector(kernel_, query, columns, found);
  const bool inside = visit_runs_near(
      position_of(position), d.radius_of(i) + 2.0 * skin_, region,
      [&](std::uint32_t first, std::uint32_t last) { collector.add_run(first, last); },
      [&](std::uint32_t j) { collector.add(j); });
  collector.search();
  return inside;
}

void NeighbourLists::find_all_others(std::uint32_t i, FoundNeighbours& found) const {
  found.buffer.resize(rows_.size());
  std::iota(found.buffer.begin(), found.buffer.end(), 0U);
  found.buffer.erase(found.buffer.begin() + i);
  found.count = found.buffer.size();
}

unsigned NeighbourLists::find_sides(const Disks& d, std::uint32_t i) const {
  unsigned sides = 0;
  const Vec2 position = listed_position(i);
  for (const Side side : all_sides) {
    if (box_.side(side) == SideKind::periodic) continue;
    const double gap = -reach_beyond(side, position.x, position.y, d.radius_of(i), box_);
    if (mode_ == EngineMode::all_pairs || gap <= skin_) sides |= 1U << static_cast<unsigned>(side);
  }
  return sides;
}

void NeighbourLists::sort_along(std::vector<double>& column, const Executor& executor) {
  if (mode_ == EngineMode::all_pairs) return;
  std::vector<double>& sorted = cells_.column;
  executor.for_ranges(column.size(), disks_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) sorted[i] = column[cells_.order[i]];
  });
  column.swap(sorted);
}

void NeighbourLists::release_scratch() {
  if (mode_ == EngineMode::tiled) release_sort_scratch(cells_);
}

double NeighbourLists::earliest_relist_time(std::uint32_t i, const PathSegment& path, double from, double until,
                                            double g) const {
  if (mode_ == EngineMode::all_pairs) return never;
  const PathSegment p = carried_to(path, from, g);
  const Vec2 position = listed_position(i);
  const auto [dx, dy] = nearest_image({p.x - position.x, p.y - position.y}, box_);
  double room = relist_distance_ * (1.0 - 1e-9);
  double ahead = never;
  if (g > 0.0) {
    // The straight path, less what gravity can bend it by in that time.
    ahead = std::max(std::sqrt(2.0 * bend_share * relist_distance_ / g), until - from);
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
bool NeighbourLists::stays_listed(std::uint32_t i, const PathSegment& path, double from, double until, double g) const {
  if (mode_ == EngineMode::all_pairs) return true;
  const double bend = 0.125 * g * (until - from) * (until - from);
  const double room = relist_distance_ * (1.0 - 1e-9) - bend;
  const Vec2 position = listed_position(i);
  const auto inside = [&](double t) {
    const double s = t - path.start;
    const double x = path.x + path.vx * s;
    const double y = path.y + (path.vy - 0.5 * g * s) * s;
    return nearest_distance2({x - position.x, y - position.y}, box_) < room * room;
  };
  // A straight path begins inside anyway; a bent one has to begin further inside.
  return room > 0.0 && inside(until) && (g == 0.0 || inside(from));
}

// Listed disks are within their contact distance and 4 skins of each other, carried back to the window's start by two
// flights more; where that is less than half a period, the nearest image is the right one.
double NeighbourLists::safe_speed2(double length, double g) const {
  double period = HUGE_VAL;
  if (box_.periodic_x()) period = std::min(period, box_.width);
  if (box_.periodic_y()) period = std::min(period, box_.height);
  if (period == HUGE_VAL) return HUGE_VAL;
  if (mode_ == EngineMode::all_pairs) return -1.0;
  const double flight = 0.5 * (0.49 * period - 2.0 * largest_radius_ - 4.0 * skin_) - g * length * length;
  return flight > 0.0 ? (flight / length) * (flight / length) : -1.0;
}

std::uint32_t NeighbourLists::cell_of(const Disks& d, std::uint32_t i, FixedPointPosition fixed) const {
  const std::size_t level =
      d.radius.empty() || grid_.levels.size() == 1 ? 0 : class_of_radius(d.radius[i], grid_.levels[0].largest_radius);
  const Vec2 position = position_of(fixed);
  return key_of(grid_.levels[level], position.x, position.y);
}

bool NeighbourLists::lists(std::uint32_t i, std::uint32_t j) const {
  const Row& row = rows_[i];
  const auto offset = static_cast<std::int32_t>(j - i);
  // All of the row, so that the compiler can take several at a time; those beyond count are 0.
  const auto sought = static_cast<std::int16_t>(offset);
  std::int16_t seen = 0;
  for (std::uint32_t k = 0; k < row_capacity; ++k) {
    seen = static_cast<std::int16_t>(seen | -(row.offset[k] == sought));
  }
  if (seen != 0 && sought == offset) return true;
  for (std::uint32_t w = row.more; w != none; w = wide_[row.block][w].next) {
    const WideRow& wide = wide_[row.block][w];
    if (std::find(wide.offset, wide.offset + wide.count, offset) != wide.offset + wide.count) return true;
  }
  return false;
}

void NeighbourLists::set_list(std::uint32_t i, std::span<const std::uint32_t> found) {
  Row& row = rows_[i];
  row.more = none;
  row.count = 0;
  std::fill(std::begin(row.offset), std::end(row.offset), std::int16_t{0});
  for (const std::uint32_t j : found) insert(i, j);
}

void NeighbourLists::insert(std::uint32_t i, std::uint32_t j) {
  Row& row = rows_[i];
  const auto offset = static_cast<std::int32_t>(j - i);
  if (row.count < row_capacity && offset == static_cast<std::int16_t>(offset)) {
    row.offset[row.count++] = static_cast<std::int16_t>(offset);
  } else {
    insert_wide(row, offset);
  }
}

void NeighbourLists::insert_wide(Row& row, std::int32_t offset) {
  std::vector<WideRow>& wide = wide_[row.block];
  if (row.more == none || wide[row.more].count == wide_row_capacity) {
    wide.push_back({{}, 0, row.more});
    row.more = static_cast<std::uint32_t>(wide.size() - 1);
  }
  WideRow& last = wide[row.more];
  last.offset[last.count++] = offset;
}

// Takes the disk out of the chain of this cell. False, without a change, if the link to it is that of a disk stored
// outside the region, which another thread may read.
bool NeighbourLists::unchain(std::uint32_t i, std::uint32_t key, const ListRegion& region) {
  std::uint32_t* link = &head_[key];
  bool holds_link = true;
  while (*link != i) {
    holds_link = region.holds(*link);
    link = &next_[*link];
  }
  if (holds_link) *link = next_[i];
  return holds_link;
}

// Chains the disk to the cell of this position; false, without a change, if its old cell or the link to it there is
// outside the region.
bool NeighbourLists::move_to_cell_of(const Disks& d, std::uint32_t i, FixedPointPosition position,
                                     const ListRegion& region) {
  if (next_[i] != unchained) {
    const std::uint32_t old_key = cell_of(d, i, listed_at_[i]);
    if (old_key < region.first_key || old_key >= region.last_key) return false;
    if (!unchain(i, old_key, region)) return false;
  }
  const std::uint32_t key = cell_of(d, i, position);
  next_[i] = head_[key];
  head_[key] = i;
  return true;
}

bool NeighbourLists::relist(std::uint32_t i, Vec2 at, const Disks& d, const ListRegion& region,
                            FoundNeighbours& found) {
  const FixedPointPosition position = fixed_point(at.x, at.y);
  if (mode_ == EngineMode::all_pairs) {
    listed_at_[i] = position;
    return true;
  }
  if (!find_neighbours(d, i, position, region, found)) return false;
  const std::span<const std::uint32_t> near = found.disks();
  if (!std::all_of(near.begin(), near.end(), [&](std::uint32_t j) { return region.holds(j); })) return false;
  if (!move_to_cell_of(d, i, position, region)) return false;
  listed_at_[i] = position;
  rows_[i].sides = static_cast<std::uint8_t>(find_sides(d, i));
  set_list(i, near);
  for (const std::uint32_t j : near) {
    if (!lists(j, i)) insert(j, i);
  }
  return true;
}

}  // namespace carom
