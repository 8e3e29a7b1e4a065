// The measurements of a run: all that has been gathered so far, and how a sample of one more moment is added.
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

// One entry for each sample. Series that the scene does not ask for are empty.
struct SampleSeries {
  std::vector<double> time;
  std::vector<double> disks;
  std::vector<double> displacement;     // mean square; length^2
  std::vector<double> followed;         // number of disks in that mean
  std::vector<double> temperature;      // mean kinetic energy of a disk; filled with pressure or speeds
  std::vector<double> interval;         // time over which pressure and collision_rate are means; see take_sample
  std::vector<double> pressure;         // NaN where the interval is 0
  std::vector<double> collision_rate;   // of one disk; likewise
  std::vector<double> autocorrelation;  // of velocities; length^2 / time^2
  std::vector<double> local_order, global_order;  // psi6 (bond_order.hpp)
  std::vector<double> bond_autocorrelation;       // g6(t) (bond_memory.hpp)
};

// In units of the length of a row of profiles: a sample so close before its end belongs to the next row, since times
// are rounded.
constexpr double row_edge = 1e-9;

struct AnalysisRecord {
  double counted_until = 0.0;  // time of the state at the last sample; the next members are its counters
  Counters before;
  SampleSeries series;
  PairRecord pairs;
  std::vector<PairRecord>
      partial;  // of the groups (k, l), k <= l, in order of k, then l; pairs (k, l) and (l, k) together
  SpeedHistogram speeds;
  DensityProfile density;
  // One profile for each interval of time that the scene asks for; the end of the run may have one of its own (see
  // density_rows_of_run).
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

// Adds a sample of the disks at a time t. now: the state at the end of the step that contains t, for its counters, as
// in series.csv. Means over time are over the steps that have ended since the sample before, so no collision is lost or
// counted twice; of several samples in one window of an exact run only the first has such means, and the run's first
// sample has none. If the plan names a group, everything but these means is of its disks alone. In a sheared box
// velocities are relative to the flow, and displacements are along y.
void take_sample(AnalysisRecord& record, const Scene& scene, const DisksInPieces& disks, const State& now,
                 const BlockRunner& run);
inline void take_sample(AnalysisRecord& record, const Scene& scene, const Disks& disks, double t, const State& now,
                        const BlockRunner& run) {
  take_sample(record, scene, WholeDisks(disks, t), now, run);
}

}  // namespace carom
