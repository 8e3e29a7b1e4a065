#include "core/measure/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/measure/blocked_tally.hpp"
#include "core/measure/bond_order.hpp"
#include "core/measure/invariants.hpp"
#include "core/measure/measured_disks.hpp"
#include "core/scene/drawn_velocities.hpp"

namespace carom {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// Sum of m v^2 / 2 over all disks.
double kinetic_energy_of(const DisksInPieces& disks) {
  BlockedTally sum;
  disks.visit(
      [&](const Disks& d) { sum.add(by_id(d), run_in_order, [&](std::size_t i) { return kinetic_energy_of(d, i); }); });
  return sum.value();
}

// The row of the profile to which a sample at time t belongs; at the boundary of two rows, the later one. So the sample
// at the end of the run may begin a row, which is continued if the run is resumed with a later end.
template <class Profile>
Profile& row_at(std::vector<Profile>& rows, const Scene& scene, double every, double t, const Profile& empty) {
  const double row = std::floor((t - scene.analysis.start) / every + row_edge);
  const auto k = static_cast<std::size_t>(std::max(0.0, row));
  if (rows.size() <= k) rows.resize(k + 1, empty);
  return rows[k];
}

void add_displacement(AnalysisRecord& record, const Scene& scene, const DisksInPieces& disks) {
  DisplacementTally& tally = record.displacement;
  if (tally.begun) {
    look_at(tally, disks, scene.box);
  } else {
    begin_displacement(tally, disks, scene.box);
  }
  const MeanSquare mean = mean_square_displacement(tally, disks, scene.box);
  record.series.displacement.push_back(mean.value);
  record.series.followed.push_back(static_cast<double>(mean.disks));
}

// Adds means over all disks and over the time since the sample before.
void add_means(AnalysisRecord& record, const Scene& scene, const DisksInPieces& disks, const State& now) {
  const bool first = record.series.time.size() == 1;
  const double elapsed = first ? 0.0 : now.time - record.counted_until;
  const double disk_time = first ? 0.0 : now.counters.disk_time - record.before.disk_time;
  record.series.interval.push_back(elapsed);
  if (scene.analysis.wants(Quantity::pressure)) {
    const double virial = now.counters.virial - record.before.virial;
    const bool known = elapsed > 0.0 && !velocities_are_drawn(scene);
    const auto mean = [&] {
      const Energy energy{kinetic_energy_of(DisksInFlow(disks, scene.box))};
      return pressure(energy, virial, elapsed, box_at(scene.box, now.time));
    };
    record.series.pressure.push_back(known ? mean() : nothing);
  }
  if (scene.analysis.wants(Quantity::collision_rate)) {
    const auto collisions = static_cast<double>(now.counters.collisions - record.before.collisions);
    record.series.collision_rate.push_back(disk_time > 0.0 ? 2.0 * collisions / disk_time : nothing);
  }
  record.counted_until = now.time;
  record.before = now.counters;
}

}  // namespace

AnalysisRecord empty_record(const Scene& scene) {
  const AnalysisPlan& plan = scene.analysis;
  AnalysisRecord record;
  if (plan.wants(Quantity::pair_correlation)) {
    const std::size_t groups = plan.pair_groups.size();
    record.pairs.counts.assign(plan.pairs.bins, 0);
    record.partial.assign(groups * (groups + 1) / 2, record.pairs);
  }
  if (plan.wants(Quantity::speeds)) record.speeds.counts.assign(plan.speed_bins, 0);
  if (plan.wants(Quantity::density)) record.density = empty_density(plan.density_bins);
  if (plan.wants(Quantity::profile)) record.motion = empty_profile(plan.profile_bins);
  if (plan.wants(Quantity::structure_factor)) {
    if (scene.box.periodic_x()) record.structure.along_x.assign(plan.wave_numbers, 0.0);
    if (scene.box.periodic_y()) record.structure.along_y.assign(plan.wave_numbers, 0.0);
  }
  if (plan.wants(Quantity::bond_correlation)) {
    record.bonds = {std::vector<double>(plan.bonds.bins, 0.0), std::vector<Count>(plan.bonds.bins, 0), 0};
  }
  return record;
}

bool same_shape(const MotionProfile& a, const MotionProfile& b) {
  return a.disks.size() == b.disks.size() && a.mass.size() == b.mass.size() && a.px.size() == b.px.size() &&
         a.py.size() == b.py.size() && a.twice_thermal.size() == b.twice_thermal.size();
}

bool same_shape(const DensityProfile& a, const DensityProfile& b) {
  return a.centres.size() == b.centres.size() && a.covered.size() == b.covered.size();
}

bool same_shape(const PairRecord& a, const PairRecord& b) {
  return a.counts.size() == b.counts.size();
}

// Do all parts have as many bins as this one?
template <class Part>
bool all_like(const std::vector<Part>& parts, const Part& one) {
  return std::all_of(parts.begin(), parts.end(), [&](const Part& part) { return same_shape(part, one); });
}

bool goes_with(const AnalysisRecord& record, const Scene& scene) {
  const AnalysisPlan& plan = scene.analysis;
  const AnalysisRecord fresh = empty_record(scene);
  const std::size_t samples = record.series.time.size();
  const auto fits = [samples](const std::vector<double>& series, bool wanted) {
    return series.size() == (wanted ? samples : 0);
  };
  const SampleSeries& s = record.series;
  const DisplacementTally& tally = record.displacement;
  return same_shape(record.pairs, fresh.pairs) && record.partial.size() == fresh.partial.size() &&
         all_like(record.partial, fresh.pairs) && all_like(record.density_rows, fresh.density) &&
         all_like(record.motion_rows, fresh.motion) && record.bonds.product.size() == fresh.bonds.product.size() &&
         record.bonds.pairs.size() == fresh.bonds.pairs.size() &&
         record.speeds.counts.size() == fresh.speeds.counts.size() && same_shape(record.density, fresh.density) &&
         fits(s.displacement, plan.wants(Quantity::displacement)) &&
         fits(s.followed, plan.wants(Quantity::displacement)) && fits(s.pressure, plan.wants(Quantity::pressure)) &&
         fits(s.collision_rate, plan.wants(Quantity::collision_rate)) && fits(s.disks, true) &&
         fits(s.interval, true) &&
         fits(s.temperature, plan.wants(Quantity::pressure) || plan.wants(Quantity::speeds)) &&
         fits(s.autocorrelation, plan.wants(Quantity::velocity_autocorrelation)) &&
         fits(s.local_order, plan.wants(Quantity::bond_order)) &&
         fits(s.global_order, plan.wants(Quantity::bond_order)) &&
         fits(s.bond_autocorrelation, plan.wants(Quantity::bond_autocorrelation)) &&
         same_shape(record.motion, fresh.motion) && record.structure.along_x.size() == fresh.structure.along_x.size() &&
         record.structure.along_y.size() == fresh.structure.along_y.size() &&
         record.velocities.vx.size() == record.velocities.vy.size() &&
         record.orders.real.size() == record.orders.imaginary.size() && tally.x.from.size() == tally.y.from.size() &&
         (tally.x.sixteenth.empty() || tally.x.sixteenth.size() == tally.x.from.size()) &&
         (tally.y.sixteenth.empty() || tally.y.sixteenth.size() == tally.y.from.size());
}

namespace {

void add_profiles(AnalysisRecord& record, const Scene& scene, const DisksInPieces& disks) {
  const double t = disks.time();
  const AnalysisPlan& plan = scene.analysis;
  if (plan.wants(Quantity::density)) {
    add_density(record.density, disks, scene.box, plan.density_along_x);
    if (plan.density_every > 0.0) {
      DensityProfile& row = row_at(record.density_rows, scene, plan.density_every, t, empty_density(plan.density_bins));
      add_density(row, disks, scene.box, plan.density_along_x);
    }
  }
  if (plan.wants(Quantity::profile)) {
    add_motion(record.motion, disks, scene.box, plan.profile_along_x);
    if (plan.profile_every > 0.0) {
      MotionProfile& row = row_at(record.motion_rows, scene, plan.profile_every, t, empty_profile(plan.profile_bins));
      add_motion(row, disks, scene.box, plan.profile_along_x);
    }
  }
}

// box: at the time of the sample.
void add_order(AnalysisRecord& record, const AnalysisPlan& plan, const DisksInPieces& all, const DisksInPieces& disks,
               const Domain& box, const BlockRunner& run) {
  const DisksWithOrders orders(all, disks, box, run);
  if (plan.wants(Quantity::structure_factor)) add_structure(record.structure, disks, box);
  if (plan.wants(Quantity::bond_order)) {
    const BondOrder order = bond_order(orders);
    record.series.local_order.push_back(order.local);
    record.series.global_order.push_back(order.global);
  }
  if (plan.wants(Quantity::bond_correlation) && disks.size() >= least_of_bonds) {
    const std::optional<BondPairs> known = all.bond_pairs();
    add_bond_pairs(record.bonds, known ? *known : bond_pairs(orders.whole(), box, distance_bins(plan.bonds), run));
  }
  if (plan.wants(Quantity::bond_autocorrelation)) {
    if (!record.orders.begun) begin_memory(record.orders, orders);
    record.series.bond_autocorrelation.push_back(bond_autocorrelation(record.orders, orders));
  }
}

}  // namespace

void take_sample(AnalysisRecord& record, const Scene& scene, const DisksInPieces& all, const State& now,
                 const BlockRunner& run) {
  const AnalysisPlan& plan = scene.analysis;
  const DisksOfGroup disks(all, plan.group.empty() ? std::nullopt : std::optional(plan.ids));
  const DisksInFlow in_flow(disks, scene.box);
  const Domain box = box_at(scene.box, all.time());
  record.series.time.push_back(all.time());
  record.series.disks.push_back(static_cast<double>(disks.size()));
  if (plan.wants(Quantity::speeds) || plan.wants(Quantity::pressure)) {
    const double kinetic = kinetic_energy_of(in_flow);
    record.series.temperature.push_back(disks.size() == 0 ? nothing : kinetic / static_cast<double>(disks.size()));
  }
  if (plan.wants(Quantity::pair_correlation)) {
    const std::optional<std::vector<PairCounts>> known = all.pair_counts();
    add_pairs(record.pairs, record.partial, plan, box, known ? *known : pairs_of_plan(plan, all.whole(), box, run));
  }
  if (plan.wants(Quantity::displacement)) add_displacement(record, scene, disks);
  if (plan.wants(Quantity::speeds)) {
    add_speeds(record.speeds, in_flow, record.series.temperature.back(), plan.speed_max);
  }
  if (plan.wants(Quantity::velocity_autocorrelation)) {
    if (!record.velocities.begun) begin_memory(record.velocities, in_flow);
    record.series.autocorrelation.push_back(velocity_autocorrelation(record.velocities, in_flow));
  }
  add_profiles(record, scene, disks);
  add_order(record, plan, all, disks, box, run);
  add_means(record, scene, all, now);
}

}  // namespace carom
