// What a run measures on its way: everything that has been gathered so far, and how one more moment is added.
#pragma once

#include <vector>

#include "core/base/block_runner.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/state.hpp"
#include "core/measure/bond_correlation.hpp"
#include "core/measure/bond_memory.hpp"
#include "core/measure/density_profile.hpp"
#include "core/measure/displacement.hpp"
#include "core/measure/motion_profile.hpp"
#include "core/measure/pair_records.hpp"
#include "core/measure/speed_histogram.hpp"
#include "core/measure/structure_factor.hpp"
#include "core/measure/velocity_memory.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// One entry a sample. What a scene does not ask for is empty.
struct SampleSeries {
  std::vector<double> time;
  std::vector<double> disks;
  std::vector<double> displacement;               // mean square; length^2
  std::vector<double> followed;                   // disks that it is a mean over
  std::vector<double> temperature;                // mean kinetic energy a disk; with pressure or speeds
  std::vector<double> interval;                   // time over which the next two are means; see take_sample
  std::vector<double> pressure;                   // NaN where the interval is 0
  std::vector<double> collision_rate;             // of one disk; likewise
  std::vector<double> autocorrelation;            // of velocities; length^2 / time^2
  std::vector<double> local_order, global_order;  // psi6 (bond_order.hpp)
  std::vector<double> bond_autocorrelation;       // g6(t) (bond_memory.hpp)
};

// Of a row of profiles: as near to its end, by its length, a sample belongs to the next one, as times are rounded.
constexpr double row_edge = 1e-9;

struct AnalysisRecord {
  double counted_until = 0.0;  // time of the state at the last sample, and what it had counted
  Counters before;
  SampleSeries series;
  PairRecord pairs;
  std::vector<PairRecord> partial;  // of the groups (k, l), k <= l, in order of k, then l: k k, and k l with l k
  SpeedHistogram speeds;
  DensityProfile density;
  // Of the times that a scene divides the run into; the last moment may have one of its own (see density_rows_of_run).
  std::vector<DensityProfile> density_rows;
  DisplacementTally displacement;
  MotionProfile motion;
  std::vector<MotionProfile> motion_rows;  // likewise
  StructureFactor structure;
  VelocityMemory velocities;
  BondCorrelation bonds;
  BondMemory orders;
};

// An empty record with the bins that the scene asks for.
AnalysisRecord empty_record(const Scene& scene);

// Was the record made for this scene?
bool goes_with(const AnalysisRecord& record, const Scene& scene);

// Adds the disks of a time t; now: what has been counted, at the end of the step that t lies in, as in series.csv.
// Means are over the steps that have ended since the sample before: no collision is lost or counted twice, but of
// several samples in one window of an exact run only the first has a mean, and the run's first sample has none. Where
// the plan names a group, all but those means is of its disks alone. In a sheared box velocities are those relative to
// the flow, and displacements those along y.
void take_sample(AnalysisRecord& record, const Scene& scene, const DisksInPieces& disks, const State& now,
                 const BlockRunner& run);
inline void take_sample(AnalysisRecord& record, const Scene& scene, const Disks& disks, double t, const State& now,
                        const BlockRunner& run) {
  take_sample(record, scene, WholeDisks(disks, t), now, run);
}

}  // namespace carom
