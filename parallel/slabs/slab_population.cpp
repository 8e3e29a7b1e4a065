// The disks of a rank: disks come from sources, leave through sinks, and move to another slab.
#include <algorithm>
#include <utility>

#include "core/step/source.hpp"
#include "core/step/step_start.hpp"
#include "parallel/cells/compact.hpp"
#include "parallel/cells/meets_nearby.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/slabs/disk_pieces.hpp"
#include "parallel/slabs/load_memory.hpp"
#include "parallel/slabs/newcomers_alone.hpp"
#include "parallel/slabs/rank_sums.hpp"
#include "parallel/slabs/redistribute.hpp"
#include "parallel/slabs/slab_stepping.hpp"
#include "parallel/stepping/mark_gone.hpp"

namespace carom {

namespace {

// Slabs are cut anew if one has more than this factor times its share of the disks, and more by this number: rows of
// cells are not divided.
constexpr double uneven_share = 1.1;
constexpr double uneven_disks = 64.0;

// A disk that moves to another rank.
struct Migrant {
  Disk disk;
  std::uint32_t thermal_hits;
};

// The disks that leave by one border, with their loads.
struct Migrants {
  std::vector<Migrant> list;
  std::vector<DiskId> ids;

  bool is_full() const { return list.size() == disks_a_message; }
  void add(const Migrant& migrant) {
    list.push_back(migrant);
    ids.push_back(migrant.disk.id);
  }
  Bytes message(const std::vector<ContactLoad>& loads) {
    std::sort(ids.begin(), ids.end());
    Bytes bytes;
    put_all(bytes, list);
    put_all(bytes, loads_of(loads, ids));
    return bytes;
  }
};

}  // namespace

void SlabStepping::emit_from_sources(double t, Count step) {
  bool due = false;
  for (std::size_t s = 0; s < scene_.sources.size(); ++s) {
    due = due || due_by(scene_.sources[s], t) > state_.sources[s].emitted;
  }
  if (due) sort_now();
  const Disks newcomers = emit_alone(state_, [&](const Disks& own) {
    emit_due(scene_, state_, t, step, [&](const Disk& disk) {
      const bool met = meets(state_.disks, scene_.box, disk, 0, state_.disks.size()) ||
                       (!own.empty() && meets_nearby(own, scene_.box, cells_.grid, cells_.sorted, disk));
      return !ranks_.any(met);
    });
  });
  if (!newcomers.empty()) take_newcomers(newcomers);
}

void SlabStepping::take_newcomers(const Disks& newcomers) {
  carom::take_newcomers(cut_, ranks_.rank(), newcomers, disks_ == 0, columns_, state_.disks);
  disks_ += newcomers.size();
  sort_due_ = true;
  speed2_known_ = false;
}

void SlabStepping::remove_at_sinks() {
  if (!has_sinks(scene_.box)) return;
  const PhaseTimer timer(times_, "sinks");
  mark_at_sinks(state_.disks, scene_.box, executor_, gone_, taken_, block_values_);
  remove_gone();
}

// Removes the marked disks on all ranks.
void SlabStepping::remove_gone() {
  auto marked = static_cast<std::int64_t>(std::count(gone_.begin(), gone_.end(), 1));
  const bool here = marked > 0;
  ranks_.sum({&marked, 1});
  if (marked == 0) return;
  keep_contacts_of_those_that_stay();
  if (here) remove_in_parallel(state_.disks, gone_, executor_, cells_.sorted.column, cells_.sorted.pass);
  disks_ -= static_cast<Count>(marked);
  state_.counters.removed += static_cast<Count>(marked);
  count_taken_on_ranks(ranks_, std::exchange(taken_, {}), state_.taken);
  sort_due_ = true;
}

// The pairs found refer to disks in the order of storage before disks left, and ghosts may have left on their own
// ranks.
void SlabStepping::keep_contacts_of_those_that_stay() {
  std::vector<DiskId> leaving;
  for (std::size_t i = 0; i < gone_.size(); ++i) {
    if (gone_[i] != 0) leaving.push_back(state_.disks.id[i]);
  }
  Bytes here;
  put_all(here, leaving);
  leaving.clear();
  for (const Bytes& there : ranks_.gather(here)) {
    const auto more = MessageReader(there).get_all<DiskId>();
    leaving.insert(leaving.end(), more.begin(), more.end());
  }
  std::sort(leaving.begin(), leaving.end());
  const auto leaves = [&](DiskId id) { return std::binary_search(leaving.begin(), leaving.end(), id); };
  std::vector<DiskContact> kept = contacts();
  std::erase_if(kept, [&](const DiskContact& c) { return leaves(c.id1) || leaves(c.id2); });
  contacts_kept_ = std::move(kept);
  closed_up_ = true;
}

// If one slab has more than its share, since disks fall or come from sources, cuts slabs with as equal numbers of disks
// as possible.
void SlabStepping::cut_anew_if_uneven() {
  if (ranks_.count() == 1) return;
  auto most = static_cast<double>(state_.disks.size());
  ranks_.maximum({&most, 1});
  const double share = static_cast<double>(disks_) / ranks_.count();
  if (most <= uneven_share * share + uneven_disks) return;
  cut_ = cut_by_rows_of_all(ranks_, scene_.box, state_.disks);
  keep_thick(cut_, least_thickness * largest_radius_);
  slab_ = slab_of(cut_, scene_.box, ranks_.rank());
  std::vector<std::size_t> counts = count_classes(state_.disks, largest_radius_);
  sum_counts_over_ranks(ranks_, counts);
  make_cells(counts);
}

// Sends each disk to the rank whose slab it is in. That is a neighbour, unless another disk has thrown it far or slabs
// are cut anew: then it moves on through the neighbours. If many disks leave, they are sent some at a time.
void SlabStepping::migrate() {
  while (ranks_.any(migrate_to_neighbours())) continue;
}

// Returns whether one of the rank's disks is not yet where it belongs. Disks that are stored last take the places of
// those that leave, since all are sorted next.
bool SlabStepping::migrate_to_neighbours() {
  Disks& d = state_.disks;
  Migrants down;
  Migrants up;
  DiskHoles holes;
  bool all_at_home = true;
  for (std::uint32_t i = 0; i < d.size(); ++i) {
    if (cut_.is_between_bounds(ranks_.rank(), d.y[i])) continue;
    const int to = cut_.rank_at(d.y[i]);
    if (to == ranks_.rank()) continue;
    const bool goes_up = to == ranks_.above() || (to != ranks_.below() && to > ranks_.rank());
    Migrants& list = goes_up ? up : down;
    if (list.is_full()) {
      all_at_home = false;
      continue;
    }
    list.add({disk_at(d, i), thermal_hits_of(state_, d.id[i])});
    holes.add({&i, 1});
  }
  holes.close(d);
  const auto [below, above] = ranks_.exchange(down.message(state_.loads), up.message(state_.loads));
  if (!take_in(below)) all_at_home = false;
  if (!take_in(above)) all_at_home = false;
  return !all_at_home;
}

// Returns whether all of them belong here.
bool SlabStepping::take_in(const Bytes& migrants) {
  MessageReader reader(migrants);
  std::vector<DiskId> ids;
  bool all_at_home = true;
  for (const auto& [disk, thermal_hits] : reader.get_all<Migrant>()) {
    push_back(state_.disks, disk, columns_);
    take_thermal_hits(state_, disk.id, thermal_hits);
    ids.push_back(disk.id);
    all_at_home = all_at_home && cut_.rank_at(disk.y) == ranks_.rank();
  }
  std::sort(ids.begin(), ids.end());
  merge_loads(loads_of(reader.get_all<ContactLoad>(), ids), state_.loads);
  return all_at_home;
}

}  // namespace carom
