#include "parallel/start/random_placement.hpp"

#include <array>
#include <queue>
#include <span>

#include "core/start/initial_state.hpp"
#include "core/start/placement_search.hpp"
#include "parallel/cells/batch_cells.hpp"
#include "parallel/start/growth_flights.hpp"

namespace carom {

namespace {

// A batch is this share of the disks, so that few disks of it conflict, and it fits into a core's own cache.
constexpr std::size_t batches = 64;
constexpr std::size_t smallest_batch = 64, largest_batch = 32768;

constexpr std::size_t range_of_members = 512;  // a task of the parallel search

// Disks for which one thread searches at the same time: while memory is read for one, points of the others are drawn.
constexpr std::size_t lanes = 32;

constexpr std::size_t range_of_voxels = 16384;
constexpr std::size_t voxels_at_once = 16 * range_of_voxels;
constexpr std::size_t voxels_per_member = 256;

// Trials after which a disk is left to the serial search, which may update the free places for it, and decides when to
// give up.
constexpr std::uint64_t patience = trials_between_lessons;

// The first point of a member that no disk placed before the batch covers.
struct Candidate {
  Vec2 point;
  std::uint64_t trial = 0;
  bool found = false;
};

// A search in batches. By definition, a disk takes the first point of its sequence that no disk before it covers. For a
// batch, all threads find the first points that are free of the disks placed so far; points before those would be
// rejected in any case. Then, in order, the few disks whose point is covered by another disk of the batch go on to the
// first point that is free of all disks before them. The result is that of the definition, so neither batches nor
// threads can change a bit. If the serial search would do something between two disks (update the free places, give
// up), the batch ends there.
class BatchSearch {
 public:
  BatchSearch(const Executor& executor, PlacementSearch& search) : executor_(executor), search_(search) {}

  void place_class(const std::function<void()>& watch) {
    const double widest = search_.disks.radius_of(search_.members[search_.begin]);
    cells_.fit(search_.scene.box, 2.000001 * widest, largest_batch);  // rounding may shift a cell's edge
    const std::size_t most = std::clamp((search_.end - search_.begin) / batches, smallest_batch, largest_batch);
    for (first_ = search_.begin; first_ < search_.end;) {
      if (watch) watch();
      while (search_.lesson_due(first_)) learn();
      if (search_.list && search_.list->empty()) search_.place_one(first_);  // throws: there is no room
      listed_ = search_.list ? &*search_.list : nullptr;
      const std::size_t count = std::min({most, search_.end - first_, batch_of_list()});
      find_candidates(count);
      first_ += commit(settle_conflicts(count));
    }
  }

 private:
  struct Lane {
    std::size_t member = 0;  // in the batch
    std::uint64_t trial = 0;
    TrialDraw draw;
    Vec2 point;
    bool alive = false;
  };

  void learn() {
    if (!search_.refine_due()) return search_.learn();
    VoxelList& list = *search_.list;
    if (list.halved()) {
      std::vector<Voxel> survivors;
      for (const auto& part : survivors_of(0, list.size())) survivors.insert(survivors.end(), part.begin(), part.end());
      return search_.refine(std::move(survivors));
    }
    // In place: two lists at a time would need more memory than anything else in a run.
    std::size_t kept = 0;
    for (std::size_t first = 0; first < list.size(); first += voxels_at_once) {
      const std::size_t count = std::min(voxels_at_once, list.size() - first);
      for (const auto& part : survivors_of(first, count)) kept = list.put(kept, part);
    }
    search_.refine_to(kept);
  }

  std::vector<std::vector<Voxel>> survivors_of(std::size_t first, std::size_t count) {
    std::vector<std::vector<Voxel>> parts(executor_.blocks(count, range_of_voxels));
    executor_.for_ranges(count, range_of_voxels, [&](std::size_t part, std::size_t begin, std::size_t end) {
      parts[part] = search_.list->survivors(search_.grid, first + begin, first + end);
    });
    return parts;
  }

  // If few places are left, most disks of a large batch would conflict.
  std::size_t batch_of_list() const {
    return search_.list ? std::max(smallest_batch, search_.list->size() / voxels_per_member) : largest_batch;
  }

  std::uint32_t disk_of(std::size_t k) const { return search_.members[first_ + k]; }
  double radius_of(std::size_t k) const { return search_.disks.radius_of(disk_of(k)); }

  void find_candidates(std::size_t count) {
    candidates_.assign(count, {});
    executor_.for_ranges(count, range_of_members,
                         [&](std::size_t, std::size_t begin, std::size_t end) { find_candidates(begin, end); });
  }

  void find_candidates(std::size_t begin, std::size_t end) {
    std::array<Lane, lanes> lane;
    std::size_t running = 0;
    while (running < lanes && begin < end) lane[running++].member = begin++;
    while (running > 0) {
      try_once({lane.data(), running});
      for (std::size_t l = 0; l < running;) {
        Lane& here = lane[l];
        if (here.alive) candidates_[here.member] = {here.point, here.trial, true};
        if (!here.alive && ++here.trial < patience) {
          ++l;
        } else if (begin < end) {
          here = {begin++, 0, {}, {}, false};
          ++l;
        } else {
          here = lane[--running];
        }
      }
    }
  }

  // One trial of each lane, in stages, each of which prefetches the memory of the next.
  void try_once(std::span<Lane> all) const {
    const Domain& box = search_.scene.box;
    const bool listed = listed_ != nullptr;
    for (Lane& l : all) {
      l.draw = draw_trial(search_.scene.seed, disk_of(l.member), l.trial, listed);
      if (listed) listed_->prefetch(l.draw.voxel);
    }
    for (Lane& l : all) {
      const PlacementRoom room = placement_room(box, radius_of(l.member), search_.region);
      l.point = trial_point(box, room, listed_, l.draw);
      l.alive = room.holds(l.point);
      if (search_.cells) search_.cells->prefetch_cell(l.point.x, l.point.y);
    }
    for (Lane& l : all) {
      l.alive = l.alive && (!search_.cells || search_.cells->is_open(l.point.x, l.point.y));
      if (l.alive) search_.grid.prefetch_cells(l.point.x, l.point.y);
    }
    for (Lane& l : all) {
      if (l.alive) search_.grid.prefetch_disks(l.point.x, l.point.y);
    }
    for (Lane& l : all) l.alive = l.alive && is_free(l.point, radius_of(l.member));
  }

  bool is_free(Vec2 point, double radius) const { return !search_.grid.overlapping(point.x, point.y, radius, false); }

  bool apart(std::size_t k, Vec2 point, double radius) const {
    const Vec2 other = candidates_[k].point;
    const double contact = radius + radius_of(k);
    return !(nearest_distance2({other.x - point.x, other.y - point.y}, search_.scene.box) < contact * contact);
  }

  // Is the point of disk k covered by a disk before it in the batch?
  bool covered(std::size_t k, Vec2 point) const {
    const double radius = radius_of(k);
    return cells_.any_near(point, [&](std::uint32_t other) { return other < k && !apart(other, point, radius); });
  }

  // Gives each disk of the batch its final point; returns how many have one, up to the first that found none within
  // `patience`.
  std::size_t settle_conflicts(std::size_t count) {
    std::size_t whole = 0;
    cells_.clear();
    while (whole < count && candidates_[whole].found) {
      cells_.insert(static_cast<std::uint32_t>(whole), candidates_[whole].point);
      ++whole;
    }
    conflict_.assign(whole, 0);
    executor_.for_ranges(whole, range_of_members, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) conflict_[k] = covered(k, candidates_[k].point) ? 1 : 0;
    });
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> again;
    for (std::size_t k = 0; k < whole; ++k) {
      if (conflict_[k] != 0) again.push(k);
    }
    while (!again.empty()) {
      const std::size_t k = again.top();
      while (!again.empty() && again.top() == k) again.pop();
      if (!covered(k, candidates_[k].point)) continue;
      const Vec2 old = candidates_[k].point;
      if (!move_on(k)) return k;
      cells_.move(static_cast<std::uint32_t>(k), old, candidates_[k].point);
      const Vec2 now = candidates_[k].point;
      cells_.for_near(now, [&](std::uint32_t other) {
        if (other > k && !apart(other, now, radius_of(k))) again.push(other);
      });
    }
    return whole;
  }

  // Moves disk k on to its next point that is free of all disks before it; false if `patience` trials are exceeded.
  bool move_on(std::size_t k) {
    Candidate& c = candidates_[k];
    std::array<Lane, 1> lane;
    lane[0].member = k;
    for (lane[0].trial = c.trial + 1; lane[0].trial < patience; ++lane[0].trial) {
      try_once(lane);
      if (!lane[0].alive || covered(k, lane[0].point)) continue;
      c = {lane[0].point, lane[0].trial, true};
      return true;
    }
    return false;
  }

  // Places the first `settled` disks of the batch, but at least one; returns their number.
  std::size_t commit(std::size_t settled) {
    for (std::size_t k = 0; k < settled; ++k) {
      const Candidate& c = candidates_[k];
      if (k > 0 && search_.lesson_due(first_ + k)) return k;
      if (search_.trials + c.trial >= search_.most) {
        search_.place_one(first_ + k);  // may throw: there is no room
        return k + 1;
      }
      search_.count(c.trial);
      search_.settle(disk_of(k), c.point.x, c.point.y);
    }
    if (settled > 0) return settled;
    search_.place_one(first_);
    return 1;
  }

  const Executor& executor_;
  PlacementSearch& search_;
  BatchCells cells_;
  std::size_t first_ = 0;  // of the batch, in members
  const VoxelList* listed_ = nullptr;
  std::vector<Candidate> candidates_;
  std::vector<unsigned char> conflict_;
};

}  // namespace

void parallel_place_at_random(const Executor& executor, const Scene& scene, Disks& disks, PlacementGrid& grid,
                              std::vector<std::uint32_t> members, const std::function<void()>& watch) {
  PlacementSearch search = make_placement_search(scene, disks, grid, members);
  BatchSearch batches_of(executor, search);
  while (search.next_class()) batches_of.place_class(watch);
}

State parallel_initial_state(const Scene& scene, int threads, const std::function<void(const GrowthProgress&)>& watch) {
  const Executor executor(threads);
  GrowthTools growth = parallel_growth(executor, {threads});
  growth.watch = watch;
  const auto place = [&](const Scene& s, Disks& disks, PlacementGrid& grid, std::vector<std::uint32_t> m) {
    parallel_place_at_random(executor, s, disks, grid, std::move(m), [&] {
      if (watch) watch({});
    });
  };
  return initial_state(scene, place, growth);
}

}  // namespace carom
