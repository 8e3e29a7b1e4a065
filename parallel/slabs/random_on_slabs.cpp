#include "parallel/slabs/random_on_slabs.hpp"

#include <algorithm>
#include <bit>
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

namespace carom {

namespace {

// Disks of a batch: so few of all that few of it get into each other's way, and some megabytes on each rank.
constexpr Count batches = 64;
constexpr Count smallest_batch = 64, largest_batch = Count{1} << 17;
// Trials of a disk that ranks tell each other of at first, where few disks are without a place; twice as many each
// time. And those of all disks, unless there are more disks than that.
constexpr std::size_t first_trials = 16, trials_at_once = 4096;
// How many more disks than in the mean a slab may get: in standard deviations, and a share.
constexpr double deviations = 8.0, more_disks = 0.02;
constexpr double rounding = 1e-9;
// Where few places are left, a large batch would only get into its own way: a disk for so many voxels.
constexpr std::size_t voxels_per_disk = 256;
// Points whose memory is asked for at a time.
constexpr std::size_t points_at_once = 32;
// Of a number that ranks add up: each bit is set by one of them.
constexpr std::size_t bits_a_number = 63;
// Packing fraction at which random addition jams (Feder 1980).
constexpr double most_packed = 0.547;

// A trial's point follows from seed, id and trial, and where few places are left from a list of voxels of which each
// rank has a part; whether it is free of the disks placed before knows the rank in whose slab, or voxels, it lies. What
// they tell each other is a bit a trial, and points that not all of them know. Then all of them go through the batch in
// order, as one machine does: a disk takes its first free point that no other of the batch covers. Where one has none
// left, the ranks look for its next, and go through the batch again.
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
    places_.emplace(box_, radius_, static_cast<std::size_t>(count_), heights(), near_, *grid_, ranks_);
  }

  std::optional<PlacedOnSlab> place() {
    const auto batch = static_cast<std::size_t>(std::clamp(count_ / batches, smallest_batch, largest_batch));
    cells_.fit(box_, 2.000001 * radius_, batch);  // rounding may shift a cell's edge
    while (first_ < count_) {
      while (places_->lesson_due(static_cast<std::size_t>(first_))) {
        if (!places_->learn()) return {};
      }
      if (places_->list() != nullptr && places_->list()->all() == 0) return {};
      points_.assign(static_cast<std::size_t>(std::min<Count>(std::min(batch, batch_of_list()), count_ - first_)), {});
      if (!find_points() || !settle() || ranks_.any(!commit())) return {};
    }
    return own_disks();
  }

 private:
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

  double reach() const { return OpenPlaces::reach(radius_) + rounding * box_.height; }
  KnownHeights heights() const {
    KnownHeights known;
    if (ranks_.rank() > 0) known.low = slab_.low;
    if (ranks_.rank() + 1 < ranks_.count()) known.high = slab_.high;
    return known;
  }
  bool is_own(Vec2 p) const { return cut_.rank_at(p.y + up_) == ranks_.rank(); }
  bool is_near(Vec2 p) const {
    const Beyond b = beyond(slab_, box_, p.y);
    return std::max(b.lower, b.upper) <= reach();
  }

  std::size_t batch_of_list() const {
    const VoxelList* const list = places_->list();
    return list != nullptr ? std::max<std::size_t>(smallest_batch, list->all() / voxels_per_disk) : largest_batch;
  }

  // The point of a trial, if it is known here: without a list every one is, otherwise those in a voxel of this rank.
  std::optional<Vec2> known_point(std::size_t k, std::uint64_t trial) const {
    const VoxelList* const list = places_->list();
    const auto id = static_cast<DiskId>(first_ + k);
    const TrialDraw draw = draw_trial(scene_.seed, id, trial, list != nullptr);
    if (list != nullptr && !list->has(draw.voxel)) return {};
    return trial_point(box_, room_, list, draw);
  }
  // Is it this rank's to say whether a point that it knows is free?
  bool is_judged_here(Vec2 p) const { return places_->list() != nullptr || is_own(p); }
  void set(std::size_t bit) { bits_[bit / bits_a_number] |= std::int64_t{1} << (bit % bits_a_number); }
  bool is_set(std::size_t bit) const { return (bits_[bit / bits_a_number] >> (bit % bits_a_number) & 1) != 0; }

  // Sets the trial's bit if its point is free, now or in judge(): while memory answers for one point, others are drawn.
  void judge_soon(std::size_t trial, Vec2 p) {
    if (!room_.holds(p)) return;
    grid_->prefetch_cells(p.x, p.y);
    judged_.push_back({trial, p});
    if (judged_.size() == points_at_once) judge();
  }
  void judge() {
    for (const Judged& j : judged_) grid_->prefetch_disks(j.point.x, j.point.y);
    for (const Judged& j : judged_) {
      if (grid_->overlapping(j.point.x, j.point.y, radius_, false)) continue;
      set(j.trial);
    }
    judged_.clear();
  }

  // The points of trials of these disks, on all ranks.
  std::vector<Vec2> points_of(const std::vector<std::size_t>& disks, const std::vector<std::uint64_t>& trials) {
    std::vector<std::int64_t> bits(2 * disks.size(), 0);
    for (std::size_t m = 0; m < disks.size(); ++m) {
      const std::optional<Vec2> p = known_point(disks[m], trials[m]);
      if (!p) continue;
      bits[2 * m] = std::bit_cast<std::int64_t>(p->x);
      bits[2 * m + 1] = std::bit_cast<std::int64_t>(p->y);
    }
    if (places_->list() != nullptr) ranks_.sum(bits);  // each is known to one
    std::vector<Vec2> points(disks.size());
    for (std::size_t m = 0; m < disks.size(); ++m) {
      points[m] = {std::bit_cast<double>(bits[2 * m]), std::bit_cast<double>(bits[2 * m + 1])};
    }
    return points;
  }

  // For each of these disks of the batch, from trial next[m] on, the first that is free of the disks placed before;
  // next[m] becomes it. Returns how many of them, from the first on, have one; where all disks of the batch are asked
  // about, those that come after a lesson need none.
  std::size_t next_free(const std::vector<std::size_t>& disks, std::vector<std::uint64_t>& next) {
    std::size_t end = disks.size();
    std::vector<std::size_t> pending(disks.size());
    for (std::size_t m = 0; m < disks.size(); ++m) pending[m] = m;
    for (std::size_t most = first_trials; !pending.empty(); most = std::min(2 * most, trials_at_once)) {
      const std::size_t at_once = std::clamp<std::size_t>(trials_at_once / pending.size(), 1, most);
      bits_.assign(pending.size() * at_once / bits_a_number + 1, 0);
      for (std::size_t b = 0; b < pending.size() * at_once; ++b) {
        const std::size_t m = pending[b / at_once];
        const std::optional<Vec2> p = known_point(disks[m], next[m] + b % at_once);
        if (p && is_judged_here(*p)) judge_soon(b, *p);
      }
      judge();
      ranks_.sum(bits_);
      std::size_t left = 0;
      for (std::size_t q = 0; q < pending.size(); ++q) {
        const std::size_t m = pending[q];
        std::size_t t = 0;
        while (t < at_once && !is_set(q * at_once + t)) ++t;
        next[m] += t;
        if (next[m] >= trials_between_lessons) end = std::min(end, m);
        if (t == at_once) pending[left++] = m;
      }
      pending.resize(left);
      if (disks.size() == points_.size()) end = std::min(end, disks_before_lesson(next));
      std::erase_if(pending, [end](std::size_t m) { return m >= end; });
    }
    return end;
  }

  // How many of the batch there are up to a lesson, one at least, if they take so many trials each.
  std::size_t disks_before_lesson(const std::vector<std::uint64_t>& trials) const {
    const std::uint64_t most = places_->trials_to_lesson();
    std::uint64_t sum = 0;
    std::size_t k = 0;
    while (k < trials.size() && sum <= most) sum += trials[k++];
    return k;
  }

  bool find_points() {
    later_.clear();
    std::vector<std::size_t> all(points_.size());
    std::vector<std::uint64_t> next(points_.size(), 0);
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    const std::size_t found = next_free(all, next);
    all.resize(found);
    points_.resize(found);
    const std::vector<Vec2> points = points_of(all, next);
    for (std::size_t k = 0; k < found; ++k) points_[k] = {points[k], next[k]};
    first_points_ = points_;
    return found > 0;
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
    const std::size_t k = disks_before_lesson(trials);
    if (k < points_.size()) end_batch_at(k);
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

  void fill_cells() {
    cells_.clear();
    for (std::size_t k = 0; k < points_.size(); ++k) cells_.insert(static_cast<std::uint32_t>(k), points_[k].at);
  }

  // The disks of the batch whose first point one before them covers: each rank looks at those in its slab.
  void find_conflicts() {
    fill_cells();
    absent_.assign(points_.size(), 0);
    bits_.assign(points_.size() / bits_a_number + 1, 0);
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Vec2 p = points_[k].at;
      if (is_own(p) && is_covered(k, p)) set(k);
    }
    ranks_.sum(bits_);
    conflicts_.clear();
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (is_set(k)) conflicts_.push_back(k);
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
      const std::size_t found = next_free(without, next);
      if (found < without.size()) {
        end_batch_at(without[found]);
        if (points_.empty()) return false;
        without.resize(found);
      }
      const std::vector<Vec2> points = points_of(without, next);
      for (std::size_t m = 0; m < without.size(); ++m) later_[without[m]].push_back({points[m], next[m]});
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
    places_.reset();
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
  std::optional<OpenPlaces> places_;
  Count first_ = 0;  // of the batch
  std::vector<TrialPlace> first_points_, points_;
  std::unordered_map<std::size_t, std::vector<TrialPlace>> later_;  // behind the first point
  BatchCells cells_;
  std::vector<std::size_t> conflicts_;
  std::vector<unsigned char> absent_;  // of the batch, while it is gone through
  std::vector<std::int64_t> bits_;
  struct Judged {
    std::size_t trial;
    Vec2 point;
  };
  std::vector<Judged> judged_;
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
