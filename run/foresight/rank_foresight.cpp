#include "run/foresight/rank_foresight.hpp"

#include <algorithm>

#include "core/disks/disk_columns.hpp"
#include "core/scene/scene_output.hpp"
#include "parallel/slabs/random_on_slabs.hpp"
#include "parallel/slabs/slab_orders.hpp"
#include "parallel/slabs/slab_start.hpp"
#include "parallel/slabs/start_on_slabs.hpp"

namespace carom {

namespace {

// Bytes, measured with 2 10^5 to 4 10^6 disks on 2 and 4 ranks (docs/scaling.md): of a process without disks, MPI
// included; for each of its disks, with cells and lists; and for each entry of an optional column.
constexpr double process_bytes = 31e6;
constexpr double own_disk_bytes = 75.0;
constexpr double column_bytes = 12.0;
// For each disk in exact, with lists, paths and ghosts.
constexpr double exact_disk_bytes = 275.0;
// Of rank 0 if it writes frames: HDF5 and the pieces received; and the rounds of each disk of all ranks.
constexpr double frame_bytes = 20e6;
constexpr double round_bytes = 8.0;
// If it draws a movie: two pictures and the fonts.
constexpr double picture_bytes = 10e6;

// Bytes that rank 0 keeps of the first sample, for each disk of all ranks: positions, with rounds, velocities, and
// psi6.
double remembered_bytes(const Scene& scene) {
  constexpr double two_numbers = 16.0;
  const AnalysisPlan& plan = scene.analysis;
  return (plan.wants(Quantity::displacement) ? two_numbers + round_bytes : 0.0) +
         (plan.wants(Quantity::velocity_autocorrelation) ? two_numbers : 0.0) +
         (plan.wants(Quantity::bond_autocorrelation) ? two_numbers : 0.0);
}

// Does [analysis] need neighbours at distances beyond the adjacent slabs?
bool looks_beyond_neighbours(const Scene& scene, const SlabCut& cut, Count disks) {
  if (cut.ranks() <= 2) return false;
  const AnalysisPlan& plan = scene.analysis;
  const bool orders = plan.wants(Quantity::bond_order) || plan.wants(Quantity::bond_correlation) ||
                      plan.wants(Quantity::bond_autocorrelation);
  const Count measured = plan.group.empty() ? disks : plan.ids.end - plan.ids.first;
  const double reach = std::max({plan.wants(Quantity::pair_correlation) ? plan.pairs.r_max : 0.0,
                                 plan.wants(Quantity::bond_correlation) ? plan.bonds.r_max : 0.0,
                                 orders && measured > 0 ? first_reach(scene.box, measured) : 0.0});
  return reach >= cut.thinnest();
}

// Time spent on trial steps; seconds.
constexpr double traffic_trial = 0.3;

}  // namespace

RankForesight foresee_ranks(const Scene& scene, const State& start, int ranks) {
  check_ranks_know(scene.run.method);
  const auto all = static_cast<double>(start.disks.size());
  RankForesight f;
  f.ranks = ranks;
  f.disks = all / ranks;
  const DiskColumns columns = columns_of(start.disks);
  const int more = (columns.radius ? 1 : 0) + (columns.mass ? 1 : 0) + (columns.spin ? 1 : 0);
  double disk_bytes = scene.run.method == Method::exact ? exact_disk_bytes : own_disk_bytes;
  if (places_on_slabs(scene)) disk_bytes = std::max(disk_bytes, placing_bytes(scene));
  const SlabStart slabs = slab_start(scene, start.disks, ranks);
  f.alone = slabs.alone;
  f.other_bytes = process_bytes + (f.alone.empty() ? (disk_bytes + more * column_bytes) * f.disks : 0.0);
  if (scene.box.has_thermal_side()) f.other_bytes += sizeof(std::uint32_t) * all;
  f.traffic = try_slabs(scene, start, ranks, traffic_trial);
  f.first_has_all = !f.alone.empty() || f.traffic.lone_steps > 0 || !starts_on_slabs(scene) || scene.output.view ||
                    looks_beyond_neighbours(scene, slabs.cut, start.disks.size());
  f.first_bytes = f.other_bytes + (wants_frames(scene.output) ? frame_bytes + round_bytes * all : 0.0);
  f.first_bytes += remembered_bytes(scene) * all;
  if (scene.output.movie) f.first_bytes += picture_bytes;
  return f;
}

}  // namespace carom
