// The search of a new list: which cells are within reach, and which disks in them.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "parallel/exact/neighbour_lists.hpp"

namespace carom {

namespace {

// Makes single precision find a few disks too many rather than one too few.
constexpr double single_margin = 1.0 + 1e-5;
// Runs of disks that the kernel searches in one call.
constexpr std::size_t runs_at_once = 16;

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
  common_reach_x_ = listed_units(length, units_per_x_);
  common_reach_y_ = listed_units(length, units_per_y_);
}

ListQuery NeighbourLists::query_at(const Disks& d, std::uint32_t i, FixedPointPosition position) const {
  ListQuery query = query_;
  query.position = slot_position(position);
  if (!d.radius.empty()) query.radius = radius_in_units(d.radius[i]);
  query.self = i;
  return query;
}

bool NeighbourLists::find_neighbours(const Disks& d, std::uint32_t i, FixedPointPosition position,
                                     const ListRegion& region, FoundNeighbours& found) const {
  const ListQuery query = query_at(d, i, position);
  std::array<SlotRun, runs_at_once> runs;
  std::size_t held = 0;
  std::size_t cells = 0;
  CellSlots::Chains chains = slots_.chains_before(region.last_key);
  const bool everywhere = region.is_everything();
  bool inside = true;
  found.count = 0;
  const auto search = [&] {
    const std::span<const SlotRun> held_runs(runs.data(), held);
    if (chains.any()) search_chains(d, query, held_runs, region, found);
    const std::size_t room = found.count + slots_a_cell * cells + list_kernel_padding;
    if (found.buffer.size() < room) found.grow(room);
    found.count += kernel_(query, slots_.columns(), runs.data(), held, found.buffer.data() + found.count);
    held = cells = 0;
    chains = slots_.chains_before(region.last_key);
  };
  const auto add = [&](std::uint32_t first, std::uint32_t last) {
    if (!everywhere && (first < region.first_key || last > region.last_key)) {
      inside = false;
      return;
    }
    if (held == runs.size()) [[unlikely]]
      search();
    runs[held++] = {first * slots_a_cell, last * slots_a_cell};
    cells += last - first;
    chains.add(first, last);
  };
  visit_cells_in_reach(d.radius_of(i), position, add);
  if (inside) search();
  return inside;
}

// Takes no account of gravity: it is only a prefetch.
void NeighbourLists::prefetch_search(const PathSegment& path, double radius, double time,
                                     const RelistDistance& relist) const {
  if (mode_ == EngineMode::all_pairs || flow_.acts) return;
  const double s = time - path.start;
  const Vec2 at = listing_place({time, path.x + s * path.vx, path.y + s * path.vy, path.vx, path.vy}, box_, relist);
  visit_cells_in_reach(radius, fixed_point(at.x, at.y),
                       [&](std::uint32_t first, std::uint32_t last) { slots_.prefetch(first, last); });
  // g++ 12 leaves out calls of functions that do nothing but prefetch.
  std::atomic_signal_fence(std::memory_order_seq_cst);
}

// The disks chained to the cells of these runs, one by one.
void NeighbourLists::search_chains(const Disks& d, const ListQuery& query, std::span<const SlotRun> runs,
                                   const ListRegion& region, FoundNeighbours& found) const {
  for (const SlotRun& run : runs) {
    const std::uint32_t first = run.first / slots_a_cell;
    const std::uint32_t last = run.last / slots_a_cell;
    CellSlots::Chains chains = slots_.chains_before(region.last_key);
    chains.add(first, last);
    if (!chains.any()) continue;
    slots_.visit_chained(first, last, region.last_key, [&](std::uint32_t j) {
      if (found.buffer.size() < found.count + list_kernel_padding) found.grow(found.count);
      found.buffer[found.count] = j;
      const bool near =
          is_neighbour(query, slot_position(rows_.listed_at(j)), radius_in_units(d.radius_of(j))) && j != query.self;
      found.count += near ? 1U : 0U;
    });
  }
}

}  // namespace carom
