#include "parallel/slabs/placement_trials.hpp"

#include <algorithm>
#include <bit>

namespace carom {

namespace {

// The number of trials of a disk that ranks exchange at first, when few disks are without a place; it is doubled each
// time. The second number is that of all disks' trials, unless there are more disks than that.
constexpr std::size_t first_trials = 16, trials_at_once = 4096;
// The number of points whose memory is fetched at a time.
constexpr std::size_t points_at_once = 32;

}  // namespace

// Without a list every rank knows each point; with a list it knows those in its own voxels.
std::optional<Vec2> PlacementTrials::known_point(const DiskToPlace& disk, const PlacementRoom& room,
                                                 std::uint64_t trial) const {
  const VoxelList* const list = places_.list();
  const TrialDraw draw = draw_trial(site_.scene.seed, disk.id, trial, list != nullptr);
  if (list != nullptr && !list->has(draw.voxel)) return {};
  return trial_point(site_.box, room, list, draw);
}

// Sets the trial's bit if its point is free, now or in answer(): while memory for one point is fetched, others are
// drawn.
void PlacementTrials::ask(std::size_t trial, Vec2 point, double radius) {
  grid_.prefetch_cells(point.x, point.y);
  asked_.push_back({trial, point, radius});
  if (asked_.size() == points_at_once) answer();
}

void PlacementTrials::answer() {
  for (const Asked& a : asked_) grid_.prefetch_disks(a.point.x, a.point.y);
  for (const Asked& a : asked_) {
    if (!grid_.overlapping(a.point.x, a.point.y, a.radius, false)) free_.set(a.trial);
  }
  asked_.clear();
}

std::size_t PlacementTrials::next_free(const std::vector<DiskToPlace>& disks, std::vector<std::uint64_t>& next,
                                       bool in_turn) {
  std::size_t end = disks.size();
  std::vector<std::size_t> pending(disks.size());
  for (std::size_t m = 0; m < disks.size(); ++m) pending[m] = m;
  for (std::size_t most = first_trials; !pending.empty(); most = std::min(2 * most, trials_at_once)) {
    const std::size_t at_once = std::clamp<std::size_t>(trials_at_once / pending.size(), 1, most);
    free_.clear(pending.size() * at_once);
    for (std::size_t q = 0; q < pending.size(); ++q) {
      const std::size_t m = pending[q];
      const PlacementRoom room = placement_room(site_.box, disks[m].radius);
      for (std::size_t t = 0; t < at_once; ++t) {
        const std::optional<Vec2> p = known_point(disks[m], room, next[m] + t);
        if (!p || !room.holds(*p) || (places_.list() == nullptr && !site_.is_own(*p))) continue;
        ask(q * at_once + t, *p, disks[m].radius);
      }
    }
    answer();
    free_.share(site_.ranks);
    std::size_t left = 0;
    for (std::size_t q = 0; q < pending.size(); ++q) {
      const std::size_t m = pending[q];
      std::size_t t = 0;
      while (t < at_once && !free_.is_set(q * at_once + t)) ++t;
      next[m] += t;
      if (next[m] >= trials_between_lessons) end = std::min(end, m);
      if (t == at_once) pending[left++] = m;
    }
    pending.resize(left);
    if (in_turn) end = std::min(end, places_.disks_before_lesson(next));
    std::erase_if(pending, [end](std::size_t m) { return m >= end; });
  }
  return end;
}

std::vector<TrialPlace> PlacementTrials::places_of(const std::vector<DiskToPlace>& disks,
                                                   const std::vector<std::uint64_t>& trials) const {
  std::vector<std::int64_t> bits(2 * disks.size(), 0);
  for (std::size_t m = 0; m < disks.size(); ++m) {
    const PlacementRoom room = placement_room(site_.box, disks[m].radius);
    const std::optional<Vec2> p = known_point(disks[m], room, trials[m]);
    if (!p) continue;
    bits[2 * m] = std::bit_cast<std::int64_t>(p->x);
    bits[2 * m + 1] = std::bit_cast<std::int64_t>(p->y);
  }
  if (places_.list() != nullptr) site_.ranks.sum(bits);  // each bit is known to one rank
  std::vector<TrialPlace> places;
  for (std::size_t m = 0; m < disks.size(); ++m) {
    places.push_back({{std::bit_cast<double>(bits[2 * m]), std::bit_cast<double>(bits[2 * m + 1])}, trials[m]});
  }
  return places;
}

}  // namespace carom
