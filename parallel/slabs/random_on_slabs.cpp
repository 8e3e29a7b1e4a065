#include "parallel/slabs/random_on_slabs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <queue>
#include <unordered_map>
#include <utility>

#include "core/disks/obstacle_cells.hpp"
#include "core/start/placement_grid.hpp"
#include "core/start/placement_search.hpp"
#include "core/start/wall_segments.hpp"
#include "parallel/cells/batch_cells.hpp"
#include "parallel/slabs/border_search.hpp"
#include "parallel/slabs/open_places.hpp"
#include "parallel/slabs/placement_trials.hpp"
#include "parallel/slabs/shared_bits.hpp"

namespace carom {

namespace {

// Disks of a batch: so few of all that few of it get into each other's way, and some megabytes on each rank.
constexpr Count batches = 64;
constexpr Count smallest_batch = 64, largest_batch = Count{1} << 17;
// How many more disks than in the mean a slab may get: in standard deviations, and a share.
constexpr double deviations = 8.0, more_disks = 0.02;
constexpr double rounding = 1e-9;
// Where few places are left, a large batch would only get into its own way: a disk for so many voxels.
constexpr std::size_t voxels_per_disk = 256;
// Packing fraction at which random addition jams (Feder 1980).
constexpr double most_packed = 0.547;

// For a batch of disks the ranks find the first trials that are free of the disks placed before (PlacementTrials). Then
// all of them go through the batch in order, as one machine does: a disk takes its first free point that no other of
// the batch covers. Where one has none left, the ranks look for its next, and go through the batch again.
class SlabPlacement {
 public:
  SlabPlacement(const Scene& scene, double radius, Count count, const SlabCut& cut, double up, Ranks& ranks)
      : site_{scene, scene.box, placement_room(scene.box, radius), radius, cut, up, ranks},
        walls_(place_obstacles(segments_of(scene), site_.box)),
        count_(count),
        slab_(slab_of(cut, scene.box, ranks.rank())) {
    slab_.low -= up;
    slab_.high -= up;
    make_room_for_disks();
    grid_.emplace(site_.box, near_);
    places_.emplace(site_.box, site_.radius, static_cast<std::size_t>(count_), heights(), near_, *grid_, site_.ranks);
    trials_.emplace(site_, *places_, *grid_);
  }

  std::optional<PlacedOnSlab> place() {
    const auto batch = static_cast<std::size_t>(std::clamp(count_ / batches, smallest_batch, largest_batch));
    cells_.fit(site_.box, 2.000001 * site_.radius, batch);  // rounding may shift a cell's edge
    while (first_ < count_) {
      while (places_->lesson_due(static_cast<std::size_t>(first_))) {
        if (!places_->learn()) return {};
      }
      if (places_->list() != nullptr && places_->list()->all() == 0) return {};
      points_.assign(static_cast<std::size_t>(std::min<Count>(std::min(batch, batch_of_list()), count_ - first_)), {});
      if (!find_points() || !settle() || site_.ranks.any(!commit())) return {};
    }
    return own_disks();
  }

 private:
  // A slab as high as this may get so many disks, and sees those of its neighbours that may touch its own.
  void make_room_for_disks() {
    const double height = std::min(site_.box.height, slab_.high - slab_.low + 2.0 * reach());
    const double room = std::max(site_.room.up.high - site_.room.up.low, height);
    const double expected = static_cast<double>(count_) * std::min(1.0, height / room);
    const double most = expected * (1.0 + more_disks) + deviations * std::sqrt(expected) + 64.0;
    const auto capacity = static_cast<std::size_t>(std::min(most, static_cast<double>(count_)));
    near_.common_radius = site_.radius;
    near_.x.resize(capacity);
    near_.y.resize(capacity);
    near_.id.resize(capacity);
  }

  double reach() const { return OpenPlaces::reach(site_.radius) + rounding * site_.box.height; }
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

  std::vector<DiskId> ids_of(const std::vector<std::size_t>& disks) const {
    std::vector<DiskId> ids;
    for (const std::size_t k : disks) ids.push_back(static_cast<DiskId>(first_ + k));
    return ids;
  }

  bool find_points() {
    later_.clear();
    std::vector<std::size_t> all(points_.size());
    std::vector<std::uint64_t> next(points_.size(), 0);
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    std::vector<DiskId> ids = ids_of(all);
    ids.resize(trials_->next_free(ids, next, true));
    points_ = trials_->places_of(ids, next);
    first_points_ = points_;
    return !points_.empty();
  }

  // Leaves the disks from k on to the next batch: it does not matter to which one a disk belongs.
  void end_batch_at(std::size_t k) {
    points_.resize(k);
    std::erase_if(conflicts_, [k](std::size_t disk) { return disk >= k; });
    std::erase_if(later_, [k](const auto& entry) { return entry.first >= k; });
    fill_cells();
  }

  // Those that come after a lesson, if disks stay where they are now.
  void end_batch_at_lesson() {
    std::vector<std::uint64_t> trials;
    for (const TrialPlace& place : points_) trials.push_back(place.trial);
    const std::size_t k = places_->disks_before_lesson(trials);
    if (k < points_.size()) end_batch_at(k);
  }

  bool apart(std::size_t k, Vec2 p) const {
    const double contact = site_.radius + site_.radius;
    const Vec2 other = points_[k].at;
    return !(nearest_distance2({other.x - p.x, other.y - p.y}, site_.box) < contact * contact);
  }

  // By a disk before k in the batch?
  bool is_covered(std::size_t k, Vec2 p) const {
    return cells_.any_near(p,
                           [&](std::uint32_t other) { return other < k && absent_[other] == 0 && !apart(other, p); });
  }

  void fill_cells() {
    cells_.clear();
    for (std::size_t k = 0; k < points_.size(); ++k) cells_.insert(static_cast<std::uint32_t>(k), points_[k].at);
  }

  // The disks of the batch whose first point one before them covers: each rank looks at those in its slab.
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

  // The next known point of k that none before it covers; false where there is none.
  bool move_on(std::size_t k) {
    for (const TrialPlace& next : later_[k]) {
      if (next.trial <= points_[k].trial || is_covered(k, next.at)) continue;
      move(k, next);
      return true;
    }
    return false;
  }

  // Goes through the disks in each other's way, in order, from first points on; returns those all of whose known points
  // are covered, which the others then do not see.
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
        if (other > k && !apart(other, points_[k].at)) again.push(other);
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
      for (const std::size_t k : without) {
        next.push_back((later_[k].empty() ? first_points_[k].trial : later_[k].back().trial) + 1);
      }
      std::vector<DiskId> ids = ids_of(without);
      ids.resize(trials_->next_free(ids, next, false));
      if (ids.size() < without.size()) end_batch_at(without[ids.size()]);
      if (points_.empty()) return false;
      const std::vector<TrialPlace> places = trials_->places_of(ids, next);
      for (std::size_t m = 0; m < ids.size(); ++m) later_[without[m]].push_back(places[m]);
    }
  }

  // Places disks of the batch up to a lesson. False where the trials run out, or the slab gets more disks than there is
  // memory for.
  bool commit() {
    const std::size_t settled = places_->take_in(static_cast<std::size_t>(first_), points_);
    for (std::size_t k = 0; k < settled; ++k) {
      const Vec2 p = points_[k].at;
      if (!is_near(p)) continue;
      if (stored_ == near_.size()) return false;
      near_.x[stored_] = p.x;
      near_.y[stored_] = p.y;
      near_.id[stored_] = static_cast<DiskId>(first_ + k);
      grid_->insert(stored_++);
    }
    first_ += settled;
    return settled > 0;
  }

  PlacedOnSlab own_disks() {
    trials_.reset();
    places_.reset();
    grid_.reset();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < stored_; ++i) {
      if (!site_.is_own({near_.x[i], near_.y[i]})) continue;
      near_.x[kept] = near_.x[i];
      near_.y[kept] = near_.y[i];
      near_.id[kept++] = near_.id[i];
    }
    near_.x.resize(kept);
    near_.y.resize(kept);
    near_.id.resize(kept);
    return {std::move(near_.x), std::move(near_.y), std::move(near_.id)};
  }

  PlacementSite site_;
  std::unique_ptr<const ObstacleCells> walls_;  // of its box
  Count count_;
  Slab slab_;
  Disks near_;  // its own, and those of others that may touch them; stored_ of them are placed
  std::size_t stored_ = 0;
  std::optional<PlacementGrid> grid_;
  std::optional<OpenPlaces> places_;
  std::optional<PlacementTrials> trials_;
  Count first_ = 0;  // of the batch
  std::vector<TrialPlace> first_points_, points_;
  std::unordered_map<std::size_t, std::vector<TrialPlace>> later_;  // behind the first point
  BatchCells cells_;
  std::vector<std::size_t> conflicts_;
  std::vector<unsigned char> absent_;  // of the batch, while it is gone through
  SharedBits covered_;
};

// Of disks that are equally large.
double packing_fraction(const Scene& scene) {
  double covered = 0.0;
  for (const DiskGroup& g : scene.groups) {
    covered += static_cast<double>(g.count) * std::numbers::pi * g.radius.value * g.radius.value;
  }
  return covered / (scene.box.width * scene.box.height);
}

}  // namespace

double placing_bytes(const Scene& scene) {
  // Measured with 4 10^6 disks on 4 ranks, at 0.3 and 0.5: where cells and a list of voxels are learnt.
  constexpr double learns_from = 0.39;
  constexpr double bytes = 107.0;
  return packing_fraction(scene) > learns_from ? bytes : 0.0;
}

bool places_on_slabs(const Scene& scene) {
  for (const DiskGroup& g : scene.groups) {
    const bool anywhere = g.positions.kind == PositionLaw::Kind::random && !g.positions.region;
    const SizeLaw& radius = g.radius;
    const bool equal = radius.kind == SizeLaw::Kind::constant && radius.value == scene.groups[0].radius.value;
    if (!anywhere || !equal) return false;
  }
  return packing_fraction(scene) <= most_packed;
}

std::optional<PlacedOnSlab> place_on_slabs(const Scene& scene, double radius, Count count, const SlabCut& cut,
                                           double up, Ranks& ranks) {
  return SlabPlacement(scene, radius, count, cut, up, ranks).place();
}

}  // namespace carom
