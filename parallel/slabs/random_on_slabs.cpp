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

namespace carom {

namespace {

// Disks of a batch: so few of all that few of it get into each other's way, and some megabytes on each rank.
constexpr Count batches = 64;
constexpr Count smallest_batch = 64, largest_batch = Count{1} << 17;
// Trials that ranks tell each other of at a time where few disks are still without a place.
constexpr std::size_t most_trials_at_once = 16;
// How many more disks than in the mean a slab may get: in standard deviations, and a share.
constexpr double deviations = 8.0, more_disks = 0.02;
constexpr double rounding = 1e-9;
// Packing fraction up to which one machine learns nothing, measured with 4 10^5 disks: 0.38 is below, 0.4 above.
constexpr double most_packed = 0.39;

// All ranks know every trial's point, which follows from seed, id and trial; whether it is free of the disks placed
// before knows the rank in whose slab it lies. What they tell each other is a bit a trial. Then all of them go through
// the batch in order, as one machine does: a disk takes its first free point that no other of the batch covers. Where
// one has none left, the ranks look for its next, and go through the batch again.
class SlabPlacement {
 public:
  SlabPlacement(const Scene& scene, double radius, Count count, const SlabCut& cut, double up, Ranks& ranks)
      : scene_(scene),
        box_(scene.box),
        walls_(place_obstacles(segments_of(scene), box_)),
        radius_(radius),
        count_(count),
        cut_(cut),
        up_(up),
        ranks_(ranks),
        room_(placement_room(box_, radius)),
        slab_(slab_of(cut, box_, ranks.rank())) {
    slab_.low -= up;
    slab_.high -= up;
    make_room_for_disks();
    grid_.emplace(box_, near_);
  }

  std::optional<PlacedOnSlab> place() {
    const auto batch = static_cast<std::size_t>(std::clamp(count_ / batches, smallest_batch, largest_batch));
    cells_.fit(box_, 2.000001 * radius_, batch);  // rounding may shift a cell's edge
    for (first_ = 0; first_ < count_; first_ += points_.size()) {
      points_.assign(static_cast<std::size_t>(std::min<Count>(batch, count_ - first_)), {});
      if (!find_points() || !settle() || ranks_.any(!commit())) return {};
    }
    return own_disks();
  }

 private:
  struct Point {
    Vec2 at;
    std::uint64_t trial = 0;
  };

  // A slab as high as this may get so many disks, and sees those of its neighbours that may touch its own.
  void make_room_for_disks() {
    const double height = std::min(box_.height, slab_.high - slab_.low + 2.0 * reach());
    const double room = std::max(room_.up.high - room_.up.low, height);
    const double expected = static_cast<double>(count_) * std::min(1.0, height / room);
    const double most = expected * (1.0 + more_disks) + deviations * std::sqrt(expected) + 64.0;
    const auto capacity = static_cast<std::size_t>(std::min(most, static_cast<double>(count_)));
    near_.common_radius = radius_;
    near_.x.resize(capacity);
    near_.y.resize(capacity);
    near_.id.resize(capacity);
  }

  double reach() const { return 2.0 * radius_ + rounding * box_.height; }
  bool is_own(Vec2 p) const { return cut_.rank_at(p.y + up_) == ranks_.rank(); }
  bool is_near(Vec2 p) const {
    const Beyond b = beyond(slab_, box_, p.y);
    return std::max(b.lower, b.upper) <= reach();
  }

  Vec2 point_of(std::size_t k, std::uint64_t trial) const {
    const auto id = static_cast<DiskId>(first_ + k);
    return trial_point(box_, room_, nullptr, draw_trial(scene_.seed, id, trial, false));
  }
  bool is_free(Vec2 p) const { return room_.holds(p) && !grid_->overlapping(p.x, p.y, radius_, false); }

  // For each of these disks of the batch, from trial next[m] on, the first that is free of the disks placed before;
  // next[m] becomes it. False where one has none.
  bool next_free(const std::vector<std::size_t>& disks, std::vector<std::uint64_t>& next) {
    std::vector<std::size_t> pending(disks.size());
    for (std::size_t m = 0; m < disks.size(); ++m) pending[m] = m;
    while (!pending.empty()) {
      const std::size_t at_once = std::clamp<std::size_t>(smallest_batch * 64 / pending.size(), 1, most_trials_at_once);
      bits_.assign((pending.size() * at_once + 62) / 63, 0);  // 63 a number: their sum is of one rank's each
      for (std::size_t b = 0; b < pending.size() * at_once; ++b) {
        const std::size_t m = pending[b / at_once];
        const Vec2 p = point_of(disks[m], next[m] + b % at_once);
        if (is_own(p) && is_free(p)) bits_[b / 63] |= std::int64_t{1} << (b % 63);
      }
      ranks_.sum(bits_);
      std::size_t left = 0;
      for (std::size_t q = 0; q < pending.size(); ++q) {
        const std::size_t m = pending[q];
        std::size_t t = 0;
        while (t < at_once && (bits_[(q * at_once + t) / 63] >> ((q * at_once + t) % 63) & 1) == 0) ++t;
        next[m] += t;
        if (next[m] >= trials_between_lessons) return false;
        if (t == at_once) pending[left++] = m;
      }
      pending.resize(left);
    }
    return true;
  }

  bool find_points() {
    later_.clear();
    std::vector<std::size_t> all(points_.size());
    std::vector<std::uint64_t> next(points_.size(), 0);
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    if (!next_free(all, next)) return false;
    for (std::size_t k = 0; k < all.size(); ++k) points_[k] = {point_of(k, next[k]), next[k]};
    first_points_ = points_;
    return true;
  }

  bool apart(std::size_t k, Vec2 p) const {
    const double contact = radius_ + radius_;
    const Vec2 other = points_[k].at;
    return !(nearest_distance2({other.x - p.x, other.y - p.y}, box_) < contact * contact);
  }

  // By a disk before k in the batch?
  bool is_covered(std::size_t k, Vec2 p) const {
    return cells_.any_near(p,
                           [&](std::uint32_t other) { return other < k && absent_[other] == 0 && !apart(other, p); });
  }

  // The disks of the batch whose first point one before them covers: each rank looks at those in its slab.
  void find_conflicts() {
    cells_.clear();
    for (std::size_t k = 0; k < points_.size(); ++k) cells_.insert(static_cast<std::uint32_t>(k), points_[k].at);
    absent_.assign(points_.size(), 0);
    bits_.assign(points_.size() / 63 + 1, 0);
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Vec2 p = points_[k].at;
      if (is_own(p) && is_covered(k, p)) bits_[k / 63] |= std::int64_t{1} << (k % 63);
    }
    ranks_.sum(bits_);
    conflicts_.clear();
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if ((bits_[k / 63] >> (k % 63) & 1) != 0) conflicts_.push_back(k);
    }
  }

  void move(std::size_t k, const Point& to) {
    cells_.move(static_cast<std::uint32_t>(k), points_[k].at, to.at);
    points_[k] = to;
  }

  // The next known point of k that none before it covers; false where there is none.
  bool move_on(std::size_t k) {
    for (const std::uint64_t trial : later_[k]) {
      const Point next{point_of(k, trial), trial};
      if (trial <= points_[k].trial || is_covered(k, next.at)) continue;
      move(k, next);
      return true;
    }
    return false;
  }

  // Goes through the disks in each other's way, in order, from first points on; returns those all of whose known points
  // are covered, which the others then do not see.
  std::vector<std::size_t> go_through() {
    // In any order: whether a point is covered does not depend on the order of the disks in a cell.
    for (const auto& [k, trials] : later_) move(k, first_points_[k]);
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
      const std::vector<std::size_t> without = go_through();
      if (without.empty()) return true;
      std::vector<std::uint64_t> next;
      for (const std::size_t k : without) {
        next.push_back((later_[k].empty() ? first_points_[k].trial : later_[k].back()) + 1);
      }
      if (!next_free(without, next)) return false;
      for (std::size_t m = 0; m < without.size(); ++m) later_[without[m]].push_back(next[m]);
    }
  }

  // False where one machine would begin to learn, or the slab gets more disks than there is memory for.
  bool commit() {
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (trials_are_many(trials_, first_ + k)) return false;
      trials_ += points_[k].trial;
      const Vec2 p = points_[k].at;
      if (!is_near(p)) continue;
      if (stored_ == near_.size()) return false;
      near_.x[stored_] = p.x;
      near_.y[stored_] = p.y;
      near_.id[stored_] = static_cast<DiskId>(first_ + k);
      grid_->insert(stored_++);
    }
    return true;
  }

  PlacedOnSlab own_disks() {
    grid_.reset();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < stored_; ++i) {
      if (!is_own({near_.x[i], near_.y[i]})) continue;
      near_.x[kept] = near_.x[i];
      near_.y[kept] = near_.y[i];
      near_.id[kept++] = near_.id[i];
    }
    near_.x.resize(kept);
    near_.y.resize(kept);
    near_.id.resize(kept);
    return {std::move(near_.x), std::move(near_.y), std::move(near_.id)};
  }

  const Scene& scene_;
  Domain box_;
  std::unique_ptr<const ObstacleCells> walls_;
  double radius_;
  Count count_;
  const SlabCut& cut_;
  double up_;
  Ranks& ranks_;
  PlacementRoom room_;
  Slab slab_;
  Disks near_;  // its own, and those of others that may touch them; stored_ of them are placed
  std::size_t stored_ = 0;
  std::optional<PlacementGrid> grid_;
  Count first_ = 0;           // of the batch
  std::uint64_t trials_ = 0;  // in vain, of all disks so far
  std::vector<Point> first_points_, points_;
  std::unordered_map<std::size_t, std::vector<std::uint64_t>> later_;  // trials behind the first point
  BatchCells cells_;
  std::vector<std::size_t> conflicts_;
  std::vector<unsigned char> absent_;  // of the batch, while it is gone through
  std::vector<std::int64_t> bits_;
};

}  // namespace

bool places_on_slabs(const Scene& scene) {
  double covered = 0.0;
  for (const DiskGroup& g : scene.groups) {
    const bool anywhere = g.positions.kind == PositionLaw::Kind::random && !g.positions.region;
    const SizeLaw& radius = g.radius;
    const bool equal = radius.kind == SizeLaw::Kind::constant && radius.value == scene.groups[0].radius.value;
    if (!anywhere || !equal) return false;
    covered += static_cast<double>(g.count) * std::numbers::pi * radius.value * radius.value;
  }
  return covered <= most_packed * scene.box.width * scene.box.height;
}

std::optional<PlacedOnSlab> place_on_slabs(const Scene& scene, double radius, Count count, const SlabCut& cut,
                                           double up, Ranks& ranks) {
  return SlabPlacement(scene, radius, count, cut, up, ranks).place();
}

}  // namespace carom
