#include "parallel/slabs/start_on_slabs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/check.hpp"
#include "core/disks/cell_index.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/disks/place_slack.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/start/between_sides.hpp"
#include "core/start/placement.hpp"
#include "core/start/placement_grid.hpp"
#include "core/start/placement_search.hpp"
#include "core/start/wall_segments.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/slabs/random_on_slabs.hpp"
#include "parallel/slabs/rank_sums.hpp"
#include "parallel/slabs/start_disks.hpp"

namespace carom {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Rows in which disks are counted for the cut: with a thousand ranks a slab has about sixty of them.
constexpr std::size_t rows_counted = std::size_t{1} << 16;

// The largest distance from a border at which a disk may touch another beyond it, in largest diameters, with rounding.
constexpr double reach_of_contacts = 1.0 + 1e-9;

// The scene without moving sides and shear, in the coordinates of the room in which it starts.
Scene scene_at_rest(const Scene& scene) {
  Scene at_rest = scene.box.has_moving_side() ? inside_moving_sides(scene) : scene;
  at_rest.box.shear = {};
  return at_rest;
}

class Maker {
 public:
  Maker(const Scene& scene, Ranks& ranks)
      : scene_(scene), at_rest_(scene_at_rest(scene)), ranks_(ranks), disks_(at_rest_, ranks) {
    if (!scene.box.has_moving_side()) return;
    right_ = scene.box.place(Side::left).inset;
    up_ = scene.box.place(Side::bottom).inset;
  }

  std::optional<StartOnSlab> make() {
    if (fails([&] {
          start_ = slab_start(scene_, columns(), disks_.sizes().smallest.radius, disks_.sizes().largest.radius,
                              disks_.disks(), ranks_.count());
          if (!at_random()) disks_.place();
        })) {
      return {};
    }
    if (!start_.alone.empty()) return {};
    if (at_random() ? !place_at_random() : !place_lattices()) return {};
    disks_.sum_motions();
    StartOnSlab made{part(), start_};
    const Disks& d = made.part.disks;
    const auto finite = [](double v) { return std::isfinite(v); };
    const bool all_finite =
        std::all_of(d.vx.begin(), d.vx.end(), finite) && std::all_of(d.vy.begin(), d.vy.end(), finite);
    if (ranks_.any(!all_finite)) return {};
    return made;
  }

 private:
  template <class Work>
  bool fails(Work&& work) {
    bool failed = false;
    try {
      work();
    } catch (const InputError&) {
      failed = true;
    }
    return ranks_.any(failed);
  }

  bool at_random() const { return scene_.groups[0].positions.kind == PositionLaw::Kind::random; }

  bool place_lattices() {
    cut();
    return !ranks_.any(overlap());
  }

  // Slabs are cut as if disks were spread evenly over the height.
  bool place_at_random() {
    const PlacementRoom::Axis along = placement_room(at_rest_.box, disks_.sizes().largest.radius).up;
    for (int r = 0; r < ranks_.count(); ++r) {
      const double share = static_cast<double>(r) / ranks_.count();
      start_.cut.bounds.push_back(r == 0 ? 0.0 : along.low + share * (along.high - along.low) + up_);
    }
    start_.cut.bounds.push_back(scene_.box.height);
    keep_thick(start_.cut, thinnest_slab(scene_, start_));
    count_classes();
    placed_ = place_on_slabs(at_rest_, disks_, start_.cut, up_, ranks_);
    return placed_.has_value();
  }

  void count_classes() {
    const double largest = disks_.sizes().largest.radius;
    start_.counts.assign(class_of_radius(largest, start_.largest_radius) + 1, 0);
    if (!start_.columns.radius) {
      start_.counts.back() = static_cast<std::size_t>(disks_.disks());
      return;
    }
    start_.counts.resize(class_of_radius(disks_.sizes().smallest.radius, start_.largest_radius) + 1, 0);
    disks_.for_share([&](std::size_t g, Count k) {
      ++start_.counts[class_of_radius(disks_.size_of(g, k).radius, start_.largest_radius)];
    });
    sum_counts_over_ranks(ranks_, start_.counts);
  }

  DiskColumns columns() const {
    const SizeFacts& sizes = disks_.sizes();
    const bool radii_differ = sizes.smallest.radius < sizes.largest.radius;
    const bool masses_differ = sizes.smallest.mass < sizes.largest.mass;
    const bool rough = scene_.physics.surfaces.inertia > 0.0;
    return {radii_differ, masses_differ, rough};
  }

  // In the box's own coordinates.
  double height(std::size_t g, Count k) const { return disks_.height(g, k) + up_; }

  void cut() {
    std::vector<std::size_t> rows(rows_counted, 0);
    const double rows_per_length = static_cast<double>(rows_counted) / scene_.box.height;
    disks_.for_share([&](std::size_t g, Count k) { ++rows[cell_index(height(g, k) * rows_per_length, rows_counted)]; });
    sum_counts_over_ranks(ranks_, rows);
    count_classes();
    start_.cut = cut_by_rows(scene_.box, {rows.begin(), rows.end()}, ranks_.count());
    keep_thick(start_.cut, thinnest_slab(scene_, start_));
    const int rank = ranks_.rank();
    low_ = rank == 0 ? -infinity : start_.cut.low(rank) - up_;
    high_ = rank + 1 == ranks_.count() ? infinity : start_.cut.high(rank) - up_;
  }

  // The group's disks from `low` to just below `high`, and those with an image there, each once.
  std::vector<GroupRange> seen_between(std::size_t g, double low, double high) const {
    const Domain& box = at_rest_.box;
    std::vector<GroupRange> ranges{disks_.between(g, low, high)};
    if (box.periodic_y()) {
      ranges.push_back(disks_.between(g, low + box.height, infinity));
      ranges.push_back(disks_.between(g, -infinity, high - box.height));
    }
    std::sort(ranges.begin(), ranges.end(), [](const GroupRange& a, const GroupRange& b) { return a.first < b.first; });
    Count end = 0;
    for (GroupRange& range : ranges) {
      range.first = std::max(range.first, end);
      end = range.last = std::max(range.first, range.last);
    }
    return ranges;
  }

  // Does a disk of the slab overlap another, or a wall?
  bool overlap() const {
    Domain box = at_rest_.box;
    const std::unique_ptr<const ObstacleCells> walls = place_obstacles(segments_of(at_rest_), box);
    const double reach = reach_of_contacts * 2.0 * disks_.sizes().largest.radius;
    Disks near;
    near.common_radius = start_.columns.radius ? 0.0 : disks_.sizes().largest.radius;
    const double low = std::max(low_, 0.0) - reach;
    const double high = std::min(high_, box.height) + reach;
    for (std::size_t g = 0; g < disks_.groups(); ++g) {
      if (at_rest_.groups[g].count == 0) continue;
      for (const GroupRange& range : seen_between(g, low, high)) {
        reserve_more(near, range.last - range.first);
        for (Count k = range.first; k < range.last; ++k) {
          const Vec2 place = disks_.place_of(g, k);
          near.x.push_back(place.x);
          near.y.push_back(place.y);
          if (start_.columns.radius) near.radius.push_back(disks_.size_of(g, k).radius);
        }
      }
    }
    PlacementGrid grid(box, near);
    for (std::size_t i = 0; i < near.size(); ++i) {
      if (overlaps_wall(box, near, i) || grid.overlapping(near.x[i], near.y[i], near.radius_of(i), true)) return true;
      grid.insert(i);
    }
    return false;
  }

  void reserve_more(Disks& d, Count more) const {
    const std::size_t n = d.size() + static_cast<std::size_t>(more);
    d.x.reserve(n);
    d.y.reserve(n);
    if (start_.columns.radius) d.radius.reserve(n);
  }

  static bool overlaps_wall(const Domain& box, const Disks& d, std::size_t i) {
    if (box.obstacles == nullptr) return false;
    bool deep = false;
    const double r = d.radius_of(i);
    for_each_solid_touched(box, d.x[i], d.y[i], r, [&](std::uint32_t, const ObstacleGap& gap) {
      deep = deep || gap.beyond > place_slack(box, r);
    });
    return deep;
  }

  // Calls use(group, k, place) for the disks of the slab, in order of id.
  template <class Use>
  void for_own(Use&& use) const {
    std::size_t next = 0;
    for (std::size_t g = 0; g < disks_.groups(); ++g) {
      const Count count = at_rest_.groups[g].count;
      if (placed_) {
        const Count end = disks_.first_id(g) + count;
        for (; next < placed_->id.size() && placed_->id[next] < end; ++next) {
          use(g, placed_->id[next] - disks_.first_id(g), Vec2{placed_->x[next], placed_->y[next]});
        }
      } else if (count > 0) {
        const GroupRange range = disks_.between(g, low_, high_);
        for (Count k = range.first; k < range.last; ++k) use(g, k, disks_.place_of(g, k));
      }
    }
  }

  // Shifts a disk from the room between moving sides to the box; in a sheared box, adds the velocity of the flow.
  Disk in_box(Disk disk) const {
    const Domain& room = inner_box_;
    if (room.shear.acts()) disk.vx += room.shear.flow(disk.y, room.height);
    if (scene_.box.has_moving_side()) {
      disk.x += right_;
      disk.y += up_;
    }
    return disk;
  }

  State part() const {
    State state;
    Disks& d = state.disks;
    const SizeFacts& sizes = disks_.sizes();
    d.inertia = scene_.physics.surfaces.inertia;
    if (!start_.columns.radius) d.common_radius = sizes.largest.radius;
    if (!start_.columns.mass) d.common_mass = sizes.largest.mass;
    const auto expected = static_cast<std::size_t>(disks_.disks()) / static_cast<std::size_t>(ranks_.count());
    reserve(d, expected + expected / 32, start_.columns);
    for_own(
        [&](std::size_t g, Count k, Vec2 place) { push_back(d, in_box(disks_.disk_at(g, k, place)), start_.columns); });
    state.obstacles = segments_of(scene_);
    state.next_id = static_cast<DiskId>(disks_.disks());
    state.sources.resize(scene_.sources.size());
    state.taken.resize(sink_numbers(scene_));
    return state;
  }

  const Scene& scene_;
  Scene at_rest_;
  Domain inner_box_ = scene_.box.has_moving_side() ? at_rest_.box : scene_.box;
  Ranks& ranks_;
  StartDisks disks_;
  double right_ = 0.0, up_ = 0.0;  // of the room within the box; length
  double low_ = 0.0, high_ = 0.0;  // of the slab, in coordinates of the room; length
  SlabStart start_;
  std::optional<PlacedOnSlab> placed_;  // of disks at random
};

}  // namespace

bool starts_on_slabs(const Scene& scene) {
  using Kind = PositionLaw::Kind;
  if (scene.box.has_moving_side() && scene.box.shear.acts()) return false;
  Count disks = 0;
  bool lattices = true;
  for (const DiskGroup& g : scene.groups) {
    const auto listed = [&](const SizeLaw& law) {
      return law.kind != SizeLaw::Kind::list || law.values.size() >= g.count;
    };
    if (g.fixed || !listed(g.radius) || !listed(g.mass)) return false;
    const bool in_circle = g.positions.region && g.positions.region->circle;
    const bool lattice = g.positions.kind == Kind::square || g.positions.kind == Kind::hexagonal;
    lattices = lattices && lattice && !in_circle;
    disks += g.count;
  }
  return disks > 0 && (lattices || places_on_slabs(scene));
}

std::optional<StartOnSlab> start_on_slab(const Scene& scene, Ranks& ranks) {
  try {
    return Maker(scene, ranks).make();
  } catch (const InputError&) {
    return {};  // regions beyond moving sides: every rank throws it
  }
}

}  // namespace carom
