#include "parallel/slabs/random_on_slabs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <queue>
#include <unordered_map>

#include "core/disks/obstacle_cells.hpp"
#include "core/start/placement_grid.hpp"
#include "core/start/placement_search.hpp"
#include "core/start/wall_segments.hpp"
#include "parallel/cells/batch_cells.hpp"
#include "parallel/slabs/border_search.hpp"
#include "parallel/slabs/open_places.hpp"
#include "parallel/slabs/placement_order.hpp"
#include "parallel/slabs/placement_trials.hpp"
#include "parallel/slabs/rank_sums.hpp"
#include "parallel/slabs/shared_bits.hpp"

namespace carom {

namespace {

// Disks in a batch: a share of all so small that few of them overlap each other, taking some megabytes on each rank.
constexpr Count batches = 64;
constexpr Count smallest_batch = 64, largest_batch = Count{1} << 17;
// How many more disks than the mean a slab may get: in standard deviations, and as a share.
constexpr double deviations = 8.0, more_disks = 0.02;
constexpr double rounding = 1e-9;
// If few places are left, many disks of a large batch would overlap each other: one disk for this number of voxels.
constexpr std::size_t voxels_per_disk = 256;
// Packing fraction at which random addition jams (Feder 1980).
constexpr double most_packed = 0.547;

// For a batch of disks the ranks find the first trials that are free of the disks placed before (PlacementTrials). Then
// each rank processes the batch in order, as one machine does: a disk takes its first free point that no other disk of
// the batch covers. If a disk has none left, the ranks find its next ones, and process the batch again.
class SlabPlacement {
 public:
  SlabPlacement(const Scene& scene, const StartDisks& disks, const SlabCut& cut, double up, Ranks& ranks)
      : site_{scene, scene.box, cut, up, ranks},
        walls_(place_obstacles(segments_of(scene), site_.box)),
        count_(disks.disks()),
        sizes_(disks.sizes()),
        order_(disks, ranks),
        slab_(slab_of(cut, scene.box, ranks.rank())) {
    slab_.low -= up;
    slab_.high -= up;
    make_room_for_disks();
    if (sizes_.smallest.radius < sizes_.largest.radius) {
      grid_.emplace(site_.box, near_, sizes_.largest.radius, most_near_by_class(disks));
    } else {
      grid_.emplace(site_.box, near_);
    }
  }

  std::optional<PlacedOnSlab> place() {
    std::uint64_t trials_left = most_trials(static_cast<std::size_t>(count_));
    for (SizeClass next = order_.next_class(); next.disks > 0; next = order_.next_class()) {
      places_.emplace(site_.box, next, sizes_.largest.radius, trials_left, heights(), near_, *grid_, site_.ranks);
      trials_.emplace(site_, *places_, *grid_);
      if (!place_class(next)) return {};
      trials_left -= places_->trials();
    }
    return own_disks();
  }

 private:
  bool place_class(const SizeClass& of) {
    const auto batch = static_cast<std::size_t>(std::clamp(Count{of.disks} / batches, smallest_batch, largest_batch));
    cells_.fit(site_.box, 2.000001 * of.largest, batch);  // rounding may shift a cell's edge
    for (placed_ = 0; placed_ < of.disks;) {
      while (places_->lesson_due(placed_)) {
        if (!places_->learn()) return false;
      }
      if (places_->list() != nullptr && places_->list()->all() == 0) return false;
      begin_batch(of, std::min(batch, batch_of_list()));
      if (!find_points() || !settle() || site_.ranks.any(!commit())) return false;
    }
    return true;
  }

  // The most of these disks that a slab of this height may get, together with those of its neighbours that may touch
  // its own.
  std::size_t most_near(std::size_t disks) const {
    const double height = std::min(site_.box.height, slab_.high - slab_.low + 2.0 * reach());
    const PlacementRoom::Axis up = placement_room(site_.box, sizes_.largest.radius).up;
    const auto all = static_cast<double>(disks);
    const double expected = all * std::min(1.0, height / std::max(up.high - up.low, height));
    const double most = expected * (1.0 + more_disks) + deviations * std::sqrt(expected) + 64.0;
    return static_cast<std::size_t>(std::min(most, all));
  }

  std::vector<std::size_t> most_near_by_class(const StartDisks& disks) const {
    std::vector<std::size_t> counts(PlacementGrid::class_of(sizes_.smallest.radius, sizes_.largest.radius) + 1, 0);
    disks.for_share([&](std::size_t g, Count k) {
      ++counts[PlacementGrid::class_of(disks.size_of(g, k).radius, sizes_.largest.radius)];
    });
    sum_counts_over_ranks(site_.ranks, counts);
    for (std::size_t& count : counts) count = most_near(count);
    return counts;
  }

  void make_room_for_disks() {
    const std::size_t capacity = most_near(static_cast<std::size_t>(count_));
    near_.x.resize(capacity);
    near_.y.resize(capacity);
    near_.id.resize(capacity);
    if (sizes_.smallest.radius < sizes_.largest.radius) {
      near_.radius.resize(capacity);
    } else {
      near_.common_radius = sizes_.largest.radius;
    }
  }

  double reach() const { return OpenPlaces::reach(sizes_.largest.radius) + rounding * site_.box.height; }
  KnownHeights heights() const {
    KnownHeights known;
    if (site_.ranks.rank() > 0) known.low = slab_.low;
    if (site_.ranks.rank() + 1 < site_.ranks.count()) known.high = slab_.high;
    return known;
  }
  bool is_near(Vec2 p) const {
    const Beyond b = beyond(slab_, site_.box, p.y);
    return std::max(b.lower, b.upper) <= reach();
  }

  std::size_t batch_of_list() const {
    const VoxelList* const list = places_->list();
    return list != nullptr ? std::max<std::size_t>(smallest_batch, list->all() / voxels_per_disk) : largest_batch;
  }

  // Takes the next disks of the class: at most this number, and at least one.
  void begin_batch(const SizeClass& of, std::size_t most) {
    disks_.erase(disks_.begin(), disks_.begin() + static_cast<std::ptrdiff_t>(points_.size()));
    if (disks_.size() < most) {
      const std::vector<DiskToPlace> more = order_.next(of, most - disks_.size());
      disks_.insert(disks_.end(), more.begin(), more.end());
    }
    points_.assign(std::min(most, disks_.size()), {});
  }

  bool find_points() {
    later_.clear();
    std::vector<DiskToPlace> all(disks_.begin(), disks_.begin() + static_cast<std::ptrdiff_t>(points_.size()));
    std::vector<std::uint64_t> next(points_.size(), 0);
    all.resize(trials_->next_free(all, next, true));
    points_ = trials_->places_of(all, next);
    first_points_ = points_;
    return !points_.empty();
  }

  // Leaves the disks from k on to the next batch: it does not matter in which batch a disk is.
  void end_batch_at(std::size_t k) {
    points_.resize(k);
    std::erase_if(conflicts_, [k](std::size_t disk) { return disk >= k; });
    std::erase_if(later_, [k](const auto& entry) { return entry.first >= k; });
    fill_cells();
  }

  // Leaves the disks after the next lesson to the next batch, if disks keep their present points.
  void end_batch_at_lesson() {
    std::vector<std::uint64_t> trials;
    for (const TrialPlace& place : points_) trials.push_back(place.trial);
    const std::size_t k = places_->disks_before_lesson(trials);
    if (k < points_.size()) end_batch_at(k);
  }

  // Are disk k at p and another one of the batch apart?
  bool apart(std::size_t k, Vec2 p, std::size_t other) const {
    const double contact = disks_[k].radius + disks_[other].radius;
    const Vec2 at = points_[other].at;
    return !(nearest_distance2({at.x - p.x, at.y - p.y}, site_.box) < contact * contact);
  }

  // Is p covered by a disk before k in the batch?
  bool is_covered(std::size_t k, Vec2 p) const {
    return cells_.any_near(
        p, [&](std::uint32_t other) { return other < k && absent_[other] == 0 && !apart(k, p, other); });
  }

  void fill_cells() {
    cells_.clear();
    for (std::size_t k = 0; k < points_.size(); ++k) cells_.insert(static_cast<std::uint32_t>(k), points_[k].at);
  }

  // Finds the disks of the batch whose first point a disk before them covers: each rank checks those in its slab.
  void find_conflicts() {
    fill_cells();
    absent_.assign(points_.size(), 0);
    covered_.clear(points_.size());
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Vec2 p = points_[k].at;
      if (site_.is_own(p) && is_covered(k, p)) covered_.set(k);
    }
    covered_.share(site_.ranks);
    conflicts_.clear();
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (covered_.is_set(k)) conflicts_.push_back(k);
    }
  }

  void move(std::size_t k, const TrialPlace& to) {
    cells_.move(static_cast<std::uint32_t>(k), points_[k].at, to.at);
    points_[k] = to;
  }

  // Moves k to its next known point that no disk before it covers; returns false if there is none.
  bool move_on(std::size_t k) {
    for (const TrialPlace& next : later_[k]) {
      if (next.trial <= points_[k].trial || is_covered(k, next.at)) continue;
      move(k, next);
      return true;
    }
    return false;
  }

  // Processes the disks that cover each other's points, in order, beginning at their first points. Returns those all of
  // whose known points are covered; the others then ignore these.
  std::vector<std::size_t> go_through() {
    // In any order: whether a point is covered does not depend on the order of the disks in a cell.
    for (const auto& [k, places] : later_) move(k, first_points_[k]);
    std::fill(absent_.begin(), absent_.end(), 0);
    std::vector<std::size_t> without;
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> again(conflicts_.begin(),
                                                                                     conflicts_.end());
    while (!again.empty()) {
      const std::size_t k = again.top();
      while (!again.empty() && again.top() == k) again.pop();
      if (!is_covered(k, points_[k].at)) continue;
      if (!move_on(k)) {
        without.push_back(k);
        absent_[k] = 1;
        continue;
      }
      cells_.for_near(points_[k].at, [&](std::uint32_t other) {
        if (other > k && !apart(k, points_[k].at, other)) again.push(other);
      });
    }
    return without;
  }

  bool settle() {
    find_conflicts();
    for (;;) {
      std::vector<std::size_t> without = go_through();
      end_batch_at_lesson();
      std::erase_if(without, [this](std::size_t k) { return k >= points_.size(); });
      if (without.empty()) return true;
      std::vector<std::uint64_t> next;
      std::vector<DiskToPlace> again;
      for (const std::size_t k : without) {
        again.push_back(disks_[k]);
        next.push_back((later_[k].empty() ? first_points_[k].trial : later_[k].back().trial) + 1);
      }
      again.resize(trials_->next_free(again, next, false));
      if (again.size() < without.size()) end_batch_at(without[again.size()]);
      if (points_.empty()) return false;
      const std::vector<TrialPlace> places = trials_->places_of(again, next);
      for (std::size_t m = 0; m < again.size(); ++m) later_[without[m]].push_back(places[m]);
    }
  }

  // Places the disks of the batch up to a lesson. Returns false if the trials run out, or if the slab gets more disks
  // than there is memory for.
  bool commit() {
    points_.resize(places_->take_in(placed_, disks_, points_));
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Vec2 p = points_[k].at;
      if (!is_near(p)) continue;
      if (stored_ == near_.size()) return false;
      near_.x[stored_] = p.x;
      near_.y[stored_] = p.y;
      near_.id[stored_] = disks_[k].id;
      if (!near_.radius.empty()) near_.radius[stored_] = disks_[k].radius;
      grid_->insert(stored_++);
    }
    placed_ += points_.size();
    return !points_.empty();
  }

  PlacedOnSlab own_disks() {
    trials_.reset();
    places_.reset();
    grid_.reset();
    std::vector<std::uint32_t> own;
    for (std::size_t i = 0; i < stored_; ++i) {
      if (site_.is_own({near_.x[i], near_.y[i]})) own.push_back(static_cast<std::uint32_t>(i));
    }
    std::sort(own.begin(), own.end(), [&](std::uint32_t a, std::uint32_t b) { return near_.id[a] < near_.id[b]; });
    return {taken(near_.x, own), taken(near_.y, own), taken(near_.id, own)};
  }

  // The values of these disks, which replace those of all.
  template <class T>
  static std::vector<T> taken(std::vector<T>& column, const std::vector<std::uint32_t>& own) {
    std::vector<T> values;
    values.reserve(own.size());
    for (const std::uint32_t i : own) values.push_back(column[i]);
    std::vector<T>().swap(column);
    return values;
  }

  PlacementSite site_;
  std::unique_ptr<const ObstacleCells> walls_;  // of its box
  Count count_;
  const SizeFacts& sizes_;
  PlacementOrder order_;
  Slab slab_;
  Disks near_;  // the slab's own disks, and others that may touch them; stored_ of them are placed
  std::size_t stored_ = 0;
  std::optional<PlacementGrid> grid_;
  std::optional<OpenPlaces> places_;
  std::optional<PlacementTrials> trials_;
  std::size_t placed_ = 0;          // disks of the class
  std::vector<DiskToPlace> disks_;  // the next disks; the first of them, one for each point, are the batch
  std::vector<TrialPlace> first_points_, points_;
  // Free points behind the first one, by disk. The map's order, which libraries choose, affects no bit (go_through).
  std::unordered_map<std::size_t, std::vector<TrialPlace>> later_;
  BatchCells cells_;
  std::vector<std::size_t> conflicts_;
  std::vector<unsigned char> absent_;  // of the batch: is the disk without a point at present?
  SharedBits covered_;
};

bool equally_large(const Scene& scene) {
  return std::all_of(scene.groups.begin(), scene.groups.end(), [&](const DiskGroup& g) {
    return g.radius.kind == SizeLaw::Kind::constant && g.radius.value == scene.groups[0].radius.value;
  });
}

// The packing fraction of equally large disks.
double packing_fraction(const Scene& scene) {
  double covered = 0.0;
  for (const DiskGroup& g : scene.groups) {
    covered += static_cast<double>(g.count) * std::numbers::pi * g.radius.value * g.radius.value;
  }
  return covered / (scene.box.width * scene.box.height);
}

}  // namespace

double placing_bytes(const Scene& scene) {
  // Measured with 4 10^6 disks on 4 ranks, at 0.3 and 0.5; above this packing fraction cells and a list of voxels are
  // made.
  constexpr double learns_from = 0.39;
  constexpr double bytes = 107.0;
  return !equally_large(scene) || packing_fraction(scene) > learns_from ? bytes : 0.0;
}

bool places_on_slabs(const Scene& scene) {
  for (const DiskGroup& g : scene.groups) {
    if (g.positions.kind != PositionLaw::Kind::random || g.positions.region) return false;
  }
  return !equally_large(scene) || packing_fraction(scene) <= most_packed;
}

std::optional<PlacedOnSlab> place_on_slabs(const Scene& scene, const StartDisks& disks, const SlabCut& cut, double up,
                                           Ranks& ranks) {
  return SlabPlacement(scene, disks, cut, up, ranks).place();
}

}  // namespace carom
