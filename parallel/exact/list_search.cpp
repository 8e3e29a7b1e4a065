// The search for a new list: the cells within reach, and the disks in them.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "parallel/exact/neighbour_lists.hpp"

namespace carom {

namespace {

// Single precision then finds a few disks too many rather than one too few.
constexpr double single_margin = 1.0 + 1e-5;

}  // namespace

// In the kernel's unit of length, rounded up a little.
float NeighbourLists::radius_in_units(double radius) const {
  return static_cast<float>(flow_.stretch * radius * (slots_per_length_ * single_margin));
}

void NeighbourLists::prepare_query(const Disks& d) {
  const auto share = [&](double unit) {
    return static_cast<std::int16_t>(std::min(std::floor(0x1p15 * (unit * slots_per_length_)), 0x1p15 - 1.0));
  };
  // Each position is rounded down by less than a unit of slots.
  const double reach = (2.0 * skin_ + slot_unit_x_ + slot_unit_y_) * slots_per_length_ + list_kernel_rounding;
  query_ = {};
  query_.unit_x = share(slot_unit_x_);
  query_.unit_y = share(slot_unit_y_);
  query_.cutoff = static_cast<float>(reach * single_margin);
  query_.radius = radius_in_units(d.common_radius);
  const double length = 2.0 * flow_.stretch * d.common_radius + 2.0 * skin_ + search_margin_;
  common_reach_ = {listed_units(length, listed_box_.units_per_length.x),
                   listed_units(length, listed_box_.units_per_length.y)};
}

void NeighbourLists::list_levels() {
  const bool tiled = grid_.tile_keys != 0;
  const auto axis = [tiled](std::uint32_t reach, std::uint32_t cells, bool periodic, StoredCells stored) {
    return ListedAxis{cells, periodic ? 32U : 31U, takes_whole_side(reach, cells, periodic), stored.first,
                      tiled ? 0U : std::min(stored.count, cells)};
  };
  listed_levels_.clear();
  for (const GridLevel& level : grid_.levels) {
    const ListReach most = reach_of(largest_radius_, level.largest_radius);
    listed_levels_.push_back({axis(most.x, level.columns, box_.periodic_x(), level.stored_columns),
                              axis(most.y, level.rows, box_.periodic_y(), level.stored_rows), level.first_key,
                              level.stride, level.largest_radius});
  }
}

ListQuery NeighbourLists::query_at(const Disks& d, std::uint32_t i, FixedPointPosition position) const {
  ListQuery query = query_;
  query.position = slot_position(position);
  if (!d.radius.empty()) query.radius = radius_in_units(d.radius[i]);
  query.self = i;
  return query;
}

// Adds the neighbours that the cells of a block hold. Nothing is read of cells from `end` on.
inline void NeighbourLists::search_block(const Disks& d, const ListQuery& query, const CellBlock& block,
                                         std::uint32_t end, FoundNeighbours& found) const {
  if (slots_.may_be_chained(block, end)) [[unlikely]]
    search_chains(d, query, block, end, found);
  const std::size_t room = found.count + std::size_t{slots_a_cell} * block.width * block.rows + list_kernel_padding;
  if (found.buffer.size() < room) [[unlikely]]
    found.grow(room);
  found.count += kernel_(query, slots_.columns(), block, found.buffer.data() + found.count);
}

bool NeighbourLists::find_neighbours(const Disks& d, std::uint32_t i, FixedPointPosition position,
                                     const ListRegion& region, FoundNeighbours& found) const {
  const ListQuery query = query_at(d, i, position);
  const bool everywhere = region.is_everything();
  bool inside = true;
  found.count = 0;
  visit_cells_in_reach(d.radius_of(i), position, [&](const CellBlock& block) {
    inside = inside && (everywhere || (block.first >= region.first_key && end_of(block) <= region.last_key));
    if (inside) search_block(d, query, block, region.last_key, found);
  });
  return inside;
}

bool NeighbourLists::find_list(std::uint32_t i, Vec2 at, const Disks& d, const ListRegion& region,
                               FoundNeighbours& found) const {
  found.count = 0;
  found.at = listed_box_.fixed_point(at.x, at.y);
  if (mode_ == EngineMode::all_pairs) return true;
  // Neighbours of the old list must be in the region, too: one elsewhere would keep disk i in its list, and if it comes
  // near again and is relisted, it would assume that disk i lists it as well.
  if (!rows_.are_within(i, region) || !find_neighbours(d, i, found.at, region, found)) return false;
  const std::span<const std::uint32_t> near = found.disks();
  const auto held = [&](std::uint32_t j) { return region.holds(j); };
  return region.is_everything() || std::all_of(near.begin(), near.end(), held);
}

// Neglects gravity, since it only prefetches.
void NeighbourLists::prefetch_search(const PathSegment& path, double radius, double time,
                                     const RelistDistance& relist) const {
  if (mode_ == EngineMode::all_pairs || flow_.acts) return;
  const double s = time - path.start;
  const Vec2 at = listing_place({time, path.x + s * path.vx, path.y + s * path.vy, path.vx, path.vy}, box_, relist);
  visit_cells_in_reach(radius, listed_box_.fixed_point(at.x, at.y), [&](const CellBlock& block) {
    for_each_row(block, [&](auto first, auto last) { slots_.prefetch(first, last); });
  });
  // g++ 12 drops calls of functions that only prefetch.
  std::atomic_signal_fence(std::memory_order_seq_cst);
}

// Adds the neighbours among the disks chained to the cells of this block, one by one.
void NeighbourLists::search_chains(const Disks& d, const ListQuery& query, const CellBlock& block, std::uint32_t end,
                                   FoundNeighbours& found) const {
  const auto add = [&](std::uint32_t j) {
    if (found.buffer.size() < found.count + list_kernel_padding) found.grow(found.count);
    found.buffer[found.count] = j;
    const bool near =
        is_neighbour(query, slot_position(rows_.listed_at(j)), radius_in_units(d.radius_of(j))) && j != query.self;
    found.count += near ? 1U : 0U;
  };
  for_each_row(block, [&](std::uint32_t first, std::uint32_t last) { slots_.visit_chained(first, last, end, add); });
}

}  // namespace carom
