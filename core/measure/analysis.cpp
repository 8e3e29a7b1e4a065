#include "core/measure/analysis.hpp"

#include <limits>

#include "core/measure/bond_order.hpp"
#include "core/measure/invariants.hpp"
#include "core/scene/drawn_velocities.hpp"

namespace carom {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

Disks disks_of(const Disks& all, const IdRange& ids) {
  Disks some;
  some.common_radius = all.common_radius;
  some.common_mass = all.common_mass;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!ids.holds(all.id[i])) continue;
    some.x.push_back(all.x[i]);
    some.y.push_back(all.y[i]);
    some.vx.push_back(all.vx[i]);
    some.vy.push_back(all.vy[i]);
    some.id.push_back(all.id[i]);
    if (!all.radius.empty()) some.radius.push_back(all.radius[i]);
    if (!all.mass.empty()) some.mass.push_back(all.mass[i]);
  }
  return some;
}

void add_pairs(PairRecord& pairs, const PairCounts& found, double area) {
  const auto n = static_cast<double>(found.centres);
  for (std::size_t k = 0; k < pairs.counts.size(); ++k) pairs.counts[k] += found.counts[k];
  pairs.centres += found.centres;
  if (found.centres > 0) pairs.expected += n * (n - 1.0) / area;
}

void add_displacement(AnalysisRecord& record, const Scene& scene, const Disks& disks, double t) {
  DisplacementTally& tally = record.displacement;
  if (tally.begun) {
    look_at(tally, disks, scene.box, t);
  } else {
    begin_displacement(tally, disks, scene.box, t);
  }
  const MeanSquare mean = mean_square_displacement(tally, disks, scene.box);
  record.series.displacement.push_back(mean.value);
  record.series.followed.push_back(static_cast<double>(mean.disks));
}

// Means over the time since the sample before, of all disks.
void add_means(AnalysisRecord& record, const Scene& scene, const Disks& disks, const State& now) {
  const bool first = record.series.time.size() == 1;
  const double elapsed = first ? 0.0 : now.time - record.counted_until;
  const double disk_time = elapsed * static_cast<double>(disks.size());
  record.series.interval.push_back(elapsed);
  if (scene.analysis.wants(Quantity::pressure)) {
    const double virial = now.counters.virial - record.before.virial;
    const bool known = elapsed > 0.0 && !velocities_are_drawn(scene);
    record.series.pressure.push_back(
        known ? pressure(energy_of(disks, 0.0), virial, elapsed, box_at(scene.box, now.time)) : nothing);
  }
  if (scene.analysis.wants(Quantity::collision_rate)) {
    const auto collisions = static_cast<double>(now.counters.collisions - record.before.collisions);
    record.series.collision_rate.push_back(disk_time > 0.0 ? 2.0 * collisions / disk_time : nothing);
  }
  record.counted_until = now.time;
  record.before = now.counters;
}

}  // namespace

DistanceBins distance_bins(const AnalysisPlan& plan) {
  return {plan.r_max, static_cast<std::size_t>(plan.r_bins), plan.wall_margin};
}

AnalysisRecord empty_record(const Scene& scene) {
  const AnalysisPlan& plan = scene.analysis;
  AnalysisRecord record;
  if (plan.wants(Quantity::pair_correlation)) record.pairs.counts.assign(plan.r_bins, 0);
  if (plan.wants(Quantity::speeds)) record.speeds.counts.assign(plan.speed_bins, 0);
  if (plan.wants(Quantity::density)) {
    record.density.centres.assign(plan.density_bins, 0);
    record.density.covered.assign(plan.density_bins, 0.0);
  }
  if (plan.wants(Quantity::profile)) record.motion = empty_profile(plan.profile_bins);
  if (plan.wants(Quantity::structure_factor)) {
    if (scene.box.periodic_x()) record.structure.along_x.assign(plan.wave_numbers, 0.0);
    if (scene.box.periodic_y()) record.structure.along_y.assign(plan.wave_numbers, 0.0);
  }
  return record;
}

bool same_shape(const MotionProfile& a, const MotionProfile& b) {
  return a.disks.size() == b.disks.size() && a.mass.size() == b.mass.size() && a.px.size() == b.px.size() &&
         a.py.size() == b.py.size() && a.twice_k.size() == b.twice_k.size();
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
  return record.pairs.counts.size() == fresh.pairs.counts.size() &&
         record.speeds.counts.size() == fresh.speeds.counts.size() &&
         record.density.centres.size() == fresh.density.centres.size() &&
         record.density.covered.size() == fresh.density.covered.size() &&
         fits(s.displacement, plan.wants(Quantity::displacement)) &&
         fits(s.followed, plan.wants(Quantity::displacement)) && fits(s.pressure, plan.wants(Quantity::pressure)) &&
         fits(s.collision_rate, plan.wants(Quantity::collision_rate)) && fits(s.disks, true) &&
         fits(s.interval, true) &&
         fits(s.temperature, plan.wants(Quantity::pressure) || plan.wants(Quantity::speeds)) &&
         fits(s.autocorrelation, plan.wants(Quantity::velocity_autocorrelation)) &&
         fits(s.local_order, plan.wants(Quantity::bond_order)) &&
         fits(s.global_order, plan.wants(Quantity::bond_order)) && same_shape(record.motion, fresh.motion) &&
         record.structure.along_x.size() == fresh.structure.along_x.size() &&
         record.structure.along_y.size() == fresh.structure.along_y.size() &&
         record.velocities.vx.size() == record.velocities.vy.size() && tally.x.from.size() == tally.y.from.size() &&
         (tally.x.sixteenth.empty() || tally.x.sixteenth.size() == tally.x.from.size()) &&
         (tally.y.sixteenth.empty() || tally.y.sixteenth.size() == tally.y.from.size());
}

void take_sample(AnalysisRecord& record, const Scene& scene, const Disks& all, double t, const State& now,
                 const PairCounter& count) {
  const AnalysisPlan& plan = scene.analysis;
  const bool part = !plan.group.empty();
  const Disks selected = part ? disks_of(all, plan.ids) : Disks{};
  const Disks& disks = part ? selected : all;
  record.series.time.push_back(t);
  record.series.disks.push_back(static_cast<double>(disks.size()));
  if (plan.wants(Quantity::speeds) || plan.wants(Quantity::pressure)) {
    const double kinetic = energy_of(disks, 0.0).kinetic;
    record.series.temperature.push_back(disks.empty() ? nothing : kinetic / static_cast<double>(disks.size()));
  }
  if (plan.wants(Quantity::pair_correlation)) {
    const DistanceBins bins = distance_bins(plan);
    add_pairs(record.pairs, count(disks, scene.box, bins), area_of_centres(scene.box, bins));
  }
  if (plan.wants(Quantity::displacement)) add_displacement(record, scene, disks, t);
  if (plan.wants(Quantity::speeds)) add_speeds(record.speeds, disks, record.series.temperature.back(), plan.speed_max);
  if (plan.wants(Quantity::density)) add_density(record.density, disks, scene.box, plan.density_along_x);
  if (plan.wants(Quantity::profile)) add_motion(record.motion, disks, scene.box, plan.profile_along_x);
  if (plan.wants(Quantity::structure_factor)) add_structure(record.structure, disks, scene.box);
  if (plan.wants(Quantity::velocity_autocorrelation)) {
    if (!record.velocities.begun) begin_memory(record.velocities, disks);
    record.series.autocorrelation.push_back(velocity_autocorrelation(record.velocities, disks));
  }
  if (plan.wants(Quantity::bond_order)) {
    const BondOrder order = bond_order(disks, scene.box);
    record.series.local_order.push_back(order.local);
    record.series.global_order.push_back(order.global);
  }
  add_means(record, scene, all, now);
}

}  // namespace carom
