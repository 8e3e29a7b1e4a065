// Neighbour lists with a skin: for every disk a list of the disks near it, valid as long as both stay near the
// positions at which they were listed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/physics/exact_path.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/counting_sort.hpp"
#include "parallel/cells/nearby_runs.hpp"
#include "parallel/exact/cell_blocks.hpp"
#include "parallel/exact/cell_slots.hpp"
#include "parallel/exact/engine_mode.hpp"
#include "parallel/exact/flow_frame.hpp"
#include "parallel/exact/list_kernel.hpp"
#include "parallel/exact/list_rows.hpp"
#include "parallel/exact/listed_box.hpp"
#include "parallel/exact/listed_cells.hpp"
#include "parallel/exact/relist_distance.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// The buffer of a search for neighbours, and the number found.
struct FoundNeighbours {
  std::vector<std::uint32_t> buffer;
  std::size_t count = 0;
  FixedPointPosition at;  // where find_list is to list the disk
  std::span<const std::uint32_t> disks() const { return {buffer.data(), count}; }
  void grow(std::size_t disks);
};

// Each disk has a listed position, equal to its position when it was listed or a little ahead of it, from which it may
// move as far as the skin. Disks i and j are in each other's lists whenever their listed positions are within r_i + r_j
// + 2 skin (nearest image). So while both are within the skin of their listed positions, disks that do not list each
// other cannot touch. A disk that has moved the relist distance, at most the skin, from its listed position is
// relisted. In all-pairs mode every disk lists every other one, and none is ever relisted. If radii grow, r_i and r_j
// are at least those when the lists were built, and the relist distance is less than the skin by the largest growth
// allowed.
class NeighbourLists {
 public:
  // Sorts the disks into cells, which changes their storage order, and lists all of them where they are; in all-pairs
  // mode they are not sorted. sorted(order, scratch) is called after sorting and before listing: order[i] is the former
  // index of disk i; scratch is a column that it may use.
  using Sorted = std::function<void(const std::vector<std::uint32_t>& order, std::vector<double>& scratch)>;
  void build(Disks& disks, const Domain& box, const ListLayout& layout, const Executor& executor,
             const Sorted& sorted = {});

  // Frees most of the lists' memory before they are built anew, so that it is available for what comes before building.
  void release_rows() { rows_.release(); }

  const FlowFrame& flow() const { return flow_; }
  // For a sheared box. follow_flow must be called before lists are built for a window that starts at `start` and has
  // this length, carry_flow at the start of each window. box: at that time. Without a shear follow_flow does nothing.
  void follow_flow(const Domain& box, double start, double length);
  void carry_flow(const Domain& box, double start);
  // Has the flow carried disks so far by time t that the lists must be built anew?
  bool is_strained(double t) const { return std::abs(flow_.rate) * (t - flow_.built_at) > flow_.strain; }
  // The time of the run at which that will be so; `never` in a box that is not sheared.
  double strained_at() const { return flow_.acts ? flow_.built_at + flow_.strain / std::abs(flow_.rate) : never; }
  // The place at which to list a disk whose path begins at p: a little ahead of it, in the middle of the path expected.
  Vec2 listing_place(const PathSegment& p, const Domain& box, const RelistDistance& relist) const {
    if (flow_.acts) [[unlikely]]
      return into_flow(p.x, p.y, p.start);
    const double v2 = p.vx * p.vx + p.vy * p.vy;
    const double lead = lead_time_ * lead_time_ * v2 > relist.lead2 ? std::sqrt(relist.lead2 / v2) : lead_time_;
    const double x = p.x + lead * p.vx;
    const double y = p.y + lead * p.vy;
    return {box.periodic_x() ? wrap(x, box.width) : x, box.periodic_y() ? wrap(y, box.height) : y};
  }
  // Sets about how long disks keep their velocities: they are listed as far ahead as they fly in that time.
  void set_lead_time(double t) { lead_time_ = t; }

  EngineMode mode() const { return mode_; }
  // Not in all-pairs mode.
  double skin() const { return skin_; }  // length
  // The largest growth of any radius since the lists were built: that of the layout, or 0 if it would leave too little
  // of the skin. Two disks that do not list each other are further apart than their radii when the lists were built and
  // twice this growth, while both stay within the relist distance. Length.
  double growth() const { return growth_; }
  // No disk of the lists may be larger than this, since no search would find it. Length.
  double largest_listed() const { return largest_radius_; }
  const RelistDistance& relist_distance(bool near_border) const { return near_border ? near_border_ : elsewhere_; }
  const RelistDistance& relist_distance_near_border() const { return near_border_; }
  const RelistDistance& relist_distance_elsewhere() const { return elsewhere_; }
  Vec2 listed_unit() const { return listed_box_.unit; }  // of a FixedPointPosition; length
  // The listed position of disk i; inside the box, except for rounding.
  Vec2 listed_position(std::uint32_t i) const { return listed_box_.position_of(rows_.listed_at(i)); }

  // A tile is a run of disks in storage that are close to each other in space. A layer is a run of tiles that reaches
  // from one of the box's longer sides to the other. Without regions there is one tile.
  std::uint32_t tiles() const { return grid_.tiles; }
  std::uint32_t tiles_a_layer() const { return grid_.tiles_a_layer; }
  std::uint32_t first_disk_of(std::uint32_t tile) const { return first_of_tile_[tile]; }
  ListRegion region_of_tiles(std::uint32_t first, std::uint32_t last) const;
  // Makes the part of the box between these heights the region's core; length.
  void set_core_between(double low, double high, ListRegion& region) const;
  // Is the disk listed so deep within the region that it can be relisted there (ListRegion)?
  bool is_in_core(std::uint32_t i, const ListRegion& region) const {
    const FixedPointPosition at = rows_.listed_at(i);
    return (region.core_is_of_x ? at.x : at.y) - region.core < region.core_size;
  }
  // The tile of disk i, if there are regions.
  std::uint32_t tile_of(std::uint32_t i) const { return rows_.block_of(i); }

  // The largest v^2 at which, in a window of this length, no disk meets any image of a neighbour but the nearest one,
  // or flies more than a quarter of the way round the box. Negative if no speed is safe.
  double safe_speed2(double length, double g) const;

  // Calls visit(j) for each neighbour j of disk i.
  template <class Visit>
  void for_each_neighbour(std::uint32_t i, Visit&& visit) const {
    rows_.for_each_neighbour(i, visit);
  }
  const ListRows& rows() const { return rows_; }

  // Calls visit(i, near) for each disk i, on all threads. near: the disks in its list.
  void visit_lists(const Executor& executor,
                   const std::function<void(std::size_t, std::span<const std::uint32_t>)>& visit) const;

  // Can the disk touch an obstacle while it stays listed?
  bool is_obstacle_near(std::uint32_t i) const { return (rows_.row(i).sides & ListRow::obstacle_near) != 0; }
  // Sets anew for all disks whether an obstacle is near; needed if obstacles move, for each new window.
  void see_where_walls_move(const Disks& disks, const Executor& executor);

  // Prefetches the list of disk i.
  [[gnu::always_inline]] void prefetch(std::uint32_t i) const { rows_.prefetch(i); }
  // A time up to which the disk, which is on this path at time `from`, stays within the relist distance of its listed
  // position; `from` itself if it is outside. Extrapolates no further than `until`, or as far as gravity bends the path
  // little.
  double earliest_relist_time(std::uint32_t i, const PathSegment& path, double from, double until,
                              const Gravity& gravity, const RelistDistance& relist) const;

  // The same if neither gravity nor a shear acts, and without a limit.
  [[gnu::noinline, gnu::hot]] double relist_time_straight(std::uint32_t i, const PathSegment& path, double from,
                                                          const RelistDistance& relist) const {
    const double s = from - path.start;
    const Vec2 listed = listed_position(i);
    Vec2 d{path.x + path.vx * s - listed.x, path.y + path.vy * s - listed.y};
    if (!rows_.row(i).is_inside()) [[unlikely]]
      d = listed_box_.nearest_image_of(d);
    return from + time_within(relist.stay2, d, {path.vx, path.vy});
  }

  // Does the disk, which is within the relist distance of its listed position at time `from`, stay so until `until`?
  // Sometimes returns false although it does by earliest_relist_time, but never true if it does not; it is much faster.
  // Precondition: neither gravity nor a shear acts.
  [[gnu::always_inline]] bool stays_listed(std::uint32_t i, const PathSegment& path, double from, double until,
                                           const RelistDistance& relist) const {
    const double s = until - path.start;
    const Vec2 listed = listed_position(i);
    Vec2 d{path.x + path.vx * s - listed.x, path.y + path.vy * s - listed.y};
    if (!rows_.row(i).is_inside()) [[unlikely]]
      d = offset_until(path, listed, from, until);
    return d.x * d.x + d.y * d.y < relist.stay2;
  }
  // The same if gravity or a shear acts.
  bool stays_listed_bent(std::uint32_t i, const PathSegment& path, double from, double until, const Gravity& g,
                         const RelistDistance& relist) const {
    return flow_.acts ? stays_listed_in_flow(i, path, from, until)
                      : stays_listed_falling(i, path, from, until, g, relist);
  }
  // Does disk i, at (x, y) now, stay within the skin of its listed position however it moves over this distance? Not
  // for a sheared box.
  bool stays_in_skin(std::uint32_t i, double x, double y, double distance) const {
    const double room = elsewhere_.length * (1.0 - 1e-9) - distance;
    return room > 0.0 && is_within(i, x, y, room * room);
  }

  // Is this place outside the box along a period?
  bool is_outside(double x, double y) const { return listed_box_.is_outside(x, y); }
  // For a disk whose path has left the box and come to p: the distance from the border along a period at which it is
  // listed; 0 if p is in the box, or the disk so near the border that all disks there look for images anyway
  // (find_inner_part). Length.
  double depth_beyond_border(const PathSegment& p, Vec2 listed) const {
    const Vec2 depth = listed_box_.depth_beyond_border({p.x, p.y}, listed, 2.0 * skin_ * (1.0 - 1e-6));
    return flow_.acts ? depth.y : std::max(depth.x, depth.y);
  }
  // May a disk that is listed here list one at this depth from a border along a period?
  bool may_list_at_depth(Vec2 listed, double depth) const {
    const double reach = depth + 2.0 * flow_.stretch * largest_radius_ + 2.0 * skin_ + search_margin_;
    const auto is_near = [reach](double at, double period) {
      return std::min(at, period - at) <= reach && period > 0.0;
    };
    return (!flow_.acts && is_near(listed.x, listed_box_.period.x)) || is_near(listed.y, listed_box_.period.y);
  }
  // From now on disk i looks for images of its neighbours, until it is relisted.
  void look_for_images(std::uint32_t i) {
    rows_.set_sides(i, rows_.row(i).sides | ListRow::across | (flow_.acts ? ListRow::images_move : 0U));
  }

  // Prefetches the cells that are searched if a disk of this radius, on this path, is relisted at this time.
  [[gnu::hot]] void prefetch_search(const PathSegment& path, double radius, double time,
                                    const RelistDistance& relist) const;
  // Lists disk i at this position, inside the box. Reads and writes nothing outside the region; if the new or the old
  // list reaches beyond it, nothing changes and the result is false. found: scratch.
  bool relist(std::uint32_t i, Vec2 position, const Disks& disks, const ListRegion& region, FoundNeighbours& found) {
    return find_list(i, position, disks, region, found) && take_list(i, disks, region, found);
  }
  // The same in two steps, between which the disks of the new list may be prefetched. find_list writes the new list to
  // `found`; take_list makes the change, provided that nothing else has changed in between. Each may return false.
  [[gnu::hot]] bool find_list(std::uint32_t i, Vec2 position, const Disks& disks, const ListRegion& region,
                              FoundNeighbours& found) const;
  [[gnu::hot]] bool take_list(std::uint32_t i, const Disks& disks, const ListRegion& region,
                              const FoundNeighbours& found);

  // Between windows, with a single queue. append: disk i, the first one behind those that are listed, is new and at
  // this place. remove: disk i is removed, and the last one takes its index. In both calls the columns still hold the
  // disk.
  void append(const Disks& disks, std::uint32_t i, Vec2 at);
  void remove(std::uint32_t i, const Disks& disks);

  // Calls visit(j) for all disks whose centres may be within half_width and half_height of a place, and for some
  // others. Not in all-pairs mode.
  template <class Visit>
  void visit_near(Vec2 centre, double half_width, double half_height, Visit&& visit) const {
    visit_listed_near(centre, std::max(half_width, half_height) + skin_, visit);
  }

  // Calls visit(j) for all disks that, within the skin of their listed positions, may overlap a disk of this radius at
  // (x, y), for a few others, and for some twice.
  template <class Visit>
  void visit_possible_overlaps(double x, double y, double radius, Visit&& visit) const {
    if (mode_ == EngineMode::all_pairs) {
      for (std::uint32_t j = 0; j < rows_.size(); ++j) visit(j);
      return;
    }
    visit_listed_near({x, y}, radius + skin_, visit);
  }

 private:
  // Calls run(first, last) for runs of cells [first, last) that may hold disks whose listed positions are within
  // `distance`, plus their radii, of this position. Returns false, possibly before the last run, if a cell is outside
  // the region.
  template <class Run>
  bool visit_cells_near(Vec2 position, double distance, const ListRegion& region, Run&& run) const {
    bool inside = true;
    for (const GridLevel& level : grid_.levels) {
      // Rounding decides in which cell a listed position at the edge of one is.
      const double cutoff = (distance + flow_.stretch * level.largest_radius) * (1.0 + 1e-9) +
                            std::max(listed_box_.unit.x, listed_box_.unit.y);
      const Span rows =
          span_around(position.y, cutoff, box_.height, level.rows_per_length, level.rows, box_.periodic_y());
      const Span columns =
          span_around(position.x, cutoff, box_.width, level.columns_per_length, level.columns, box_.periodic_x());
      for_each_stored_block(level, rows, columns, [&](const CellBlock& block) {
        inside = inside && block.first >= region.first_key && end_of(block) <= region.last_key;
        if (inside) for_each_row(block, run);
      });
    }
    return inside;
  }
  // Calls visit(j) for the disks of those cells.
  template <class Visit>
  void visit_listed_near(Vec2 position, double distance, Visit&& visit) const {
    const ListRegion everything;
    visit_cells_near(position, distance, everything, [&](std::uint32_t first, std::uint32_t last) {
      slots_.visit_slots(first, last, visit);
      slots_.visit_chained(first, last, everything.last_key, visit);
    });
  }

  // Is this place within a distance of disk i's listed position? distance2: its square.
  bool is_within(std::uint32_t i, double x, double y, double distance2) const {
    const Vec2 listed = listed_position(i);
    const Vec2 d = listed_box_.nearest_image_of({x - listed.x, y - listed.y});
    return d.x * d.x + d.y * d.y < distance2;
  }
  // The difference of a straight path's place at time `until` and the listed position, taken of the image that is the
  // nearest one at time `from`: in between, the path may have gone round the box to another image.
  [[gnu::hot]] Vec2 offset_until(const PathSegment& path, Vec2 listed, double from, double until) const {
    const double s = from - path.start;
    const Vec2 d = listed_box_.nearest_image_of({path.x + path.vx * s - listed.x, path.y + path.vy * s - listed.y});
    return {d.x + path.vx * (until - from), d.y + path.vy * (until - from)};
  }
  bool stays_listed_in_flow(std::uint32_t i, const PathSegment& path, double from, double until) const;
  double earliest_relist_in_flow(std::uint32_t i, const PathSegment& path, double from, double until) const;
  Vec2 into_flow(double x, double y, double s) const;
  bool stays_listed_falling(std::uint32_t i, const PathSegment& path, double from, double until, const Gravity& g,
                            const RelistDistance& relist) const;
  bool begins_and_ends_within(double room, Vec2 centre, Vec2 first, Vec2 last) const;
  void choose_skin(const Disks& disks, const ListLayout& layout, double crowded);
  void sort(Disks& disks, const ListLayout& layout, double crowded, const Executor& executor);
  // In tiles, disks are stored by size classes.
  bool is_sorted_by_place() const { return mode_ == EngineMode::single_queue && grid_.levels.size() > 1; }
  void sort_by_place(Disks& disks, const ListLayout& layout, double crowded, const Executor& executor);
  void sort_grown(Disks& disks, const ListLayout& layout, double crowded, const Executor& executor);
  void find_tiles(std::size_t disks);
  void set_listed_positions(const Disks& disks, const Executor& executor);
  void list_all(const Disks& disks, const Executor& executor);
  void list_block(const Disks& disks, std::size_t block, std::size_t begin, std::size_t end);
  void choose_slot_units();
  void prepare_query(const Disks& disks);
  void list_levels();
  SlotPosition slot_position(FixedPointPosition p) const {
    return {static_cast<std::uint16_t>(p.x >> slot_shift_x_), static_cast<std::uint16_t>(p.y >> slot_shift_y_)};
  }
  // A length in units of listed positions, rounded up; at most the whole side.
  static std::uint32_t listed_units(double length, double units_per_length) {
    constexpr double most = 0x1p31;
    return static_cast<std::uint32_t>(std::min(length * units_per_length * (1.0 + 1e-9) + 2.0, most));
  }
  // The reach of a search for the neighbours of a disk of this radius among the disks of a level.
  ListReach reach_of(double radius, double largest_of_level) const {
    if (!slots_.have_radii()) [[likely]]
      return common_reach_;
    const double length = flow_.stretch * (radius + largest_of_level) + 2.0 * skin_ + search_margin_;
    return {listed_units(length, listed_box_.units_per_length.x), listed_units(length, listed_box_.units_per_length.y)};
  }
  // Calls visit(block) for the blocks of cells that are searched for neighbours of a disk listed here.
  template <class Visit>
  void visit_cells_in_reach(double radius, FixedPointPosition position, Visit&& visit) const {
    for (const ListedLevel& level : listed_levels_) {
      const ListReach reach = reach_of(radius, level.largest_radius);
      const CellBlock block = level.block_around(position, reach);
      if (block.rows > 0) [[likely]] {
        visit(block);
      } else {
        visit_cells_apart(grid_.levels[static_cast<std::size_t>(&level - listed_levels_.data())], position, reach,
                          visit);
      }
    }
  }
  // The same for one level, wherever its cells are in memory.
  template <class Visit>
  [[gnu::noinline, gnu::hot]] void visit_cells_apart(const GridLevel& level, FixedPointPosition position,
                                                     ListReach reach, Visit&& visit) const {
    const Span rows = span_around_listed(position.y, reach.y, level.rows, box_.periodic_y());
    const Span columns = span_around_listed(position.x, reach.x, level.columns, box_.periodic_x());
    for_each_stored_block(level, rows, columns, visit);
  }
  ListQuery query_at(const Disks& disks, std::uint32_t i, FixedPointPosition position) const;
  float radius_in_units(double radius) const;
  [[gnu::hot]] bool find_neighbours(const Disks& disks, std::uint32_t i, FixedPointPosition position,
                                    const ListRegion& region, FoundNeighbours& found) const;
  void search_block(const Disks& disks, const ListQuery& query, const CellBlock& block, std::uint32_t end,
                    FoundNeighbours& found) const;
  void search_chains(const Disks& disks, const ListQuery& query, const CellBlock& block, std::uint32_t end,
                     FoundNeighbours& found) const;
  void find_all_others(std::uint32_t i, FoundNeighbours& found) const;
  // The number of the level for the disk's size.
  std::size_t level_of(const Disks& disks, std::uint32_t i) const;
  std::size_t level_of_radius(double radius) const;
  void keep_levels(const Disks& disks);
  void keep_level(const Disks& disks, std::uint32_t i);
  std::uint32_t cell_in(std::size_t k, FixedPointPosition at) const {
    const ListedLevel& listed = listed_levels_[k];
    const std::int64_t row = listed.rows.place_of(at.y);
    const std::int64_t column = listed.columns.place_of(at.x);
    if (row < listed.rows.stored && column < listed.columns.stored) [[likely]]
      return listed.cell(row, column);
    const GridLevel& level = grid_.levels[k];
    return level.stored_key(cell_of_listed(at.y, level.rows, box_.periodic_y()),
                            cell_of_listed(at.x, level.columns, box_.periodic_x()));
  }
  void fill_slots(const Disks& disks, std::uint32_t first_key, std::uint32_t last_key);
  void fill_slot(const Disks& disks, std::uint32_t i);
  void move_into_cell(const Disks& disks, std::uint32_t i, std::uint32_t key);
  [[gnu::hot]] bool move_to_cell_of(const Disks& disks, std::uint32_t i, FixedPointPosition position,
                                    const ListRegion& region);
  void find_inner_part();
  bool is_inside_in_height(Vec2 listed) const { return inner_low_.y < listed.y && listed.y < inner_high_.y; }
  bool is_inside(Vec2 listed) const {
    return inner_low_.x < listed.x && listed.x < inner_high_.x && is_inside_in_height(listed);
  }
  bool may_touch_obstacle(Vec2 listed, double radius) const;
  // ListRow::sides, without has_more, of disk i at its listed position.
  unsigned find_sides(const Disks& disks, std::uint32_t i) const {
    const unsigned sides = is_inside(listed_position(i)) ? 0U : ListRow::across;
    return images_alone_ ? sides : sides | find_other_sides(disks, i);
  }
  unsigned find_other_sides(const Disks& disks, std::uint32_t i) const;

  EngineMode mode_ = EngineMode::single_queue;
  Domain box_;
  ListedBox listed_box_;
  CellGrid grid_;
  SortedCells cells_;
  std::vector<std::uint32_t> first_of_tile_;  // behind the last tile: the number of disks
  double skin_ = 0.0;
  double growth_ = 0.0;
  RelistDistance near_border_, elsewhere_;
  FlowFrame flow_;
  bool images_alone_ = false;    // no walls, obstacles or shear: only images of neighbours can be near a disk
  bool layers_along_x_ = false;  // are layers next to each other along x?
  double lead_time_ = 0.0;
  // Disks listed between these places list no others across a border along a period. In a sheared box that is true only
  // of heights, since places along x are carried with the flow.
  Vec2 inner_low_, inner_high_;
  double largest_radius_ = 0.0;
  double slot_unit_x_ = 0.0, slot_unit_y_ = 0.0;  // of a SlotPosition; length
  double slots_per_length_ = 0.0;                 // 1 / the coarser of the two
  ListQuery query_;                               // what the queries of all disks have in common
  ListReach common_reach_;                        // if all radii are equal
  std::vector<ListedLevel> listed_levels_;
  std::vector<std::uint8_t> kept_level_;  // of each disk, if radii grow: a disk keeps its level then
  // Two disks may list each other although they are further apart than the reach of lists, by at most this length.
  double search_margin_ = 0.0;
  unsigned slot_shift_x_ = 0, slot_shift_y_ = 0;  // the lowest bit of a listed position that is in a SlotPosition
  ListRows rows_;
  CellSlots slots_;
  ListKernel kernel_ = choose_list_kernel();
};

}  // namespace carom
