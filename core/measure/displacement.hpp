// How far disks have come, across periodic sides too: the mean square displacement, and how often a disk has gone
// round.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/base/types.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// In a sheared box only the displacement along y counts: along x disks go with the flow, and an image that follows one
// across the top has come from elsewhere.
//
// Along an axis: where each disk was at the start, by id (NaN: no such disk; empty where only rounds are counted), and,
// where the axis is periodic, its unwrapped coordinate in sixteenths of the period, rounded down (not_followed: no such
// disk). A coordinate known to a sixteenth tells, with the next frame, how often it went round, as long as no disk
// moves further than a quarter period between two frames. The sixteenths only count periods: the displacement itself is
// the difference of two coordinates and does not depend on when frames were taken. 2^27 periods fit.
inline constexpr std::int32_t not_followed = std::numeric_limits<std::int32_t>::min();
struct AxisTally {
  std::vector<double> from;             // length
  std::vector<std::int32_t> sixteenth;  // empty where the axis is not periodic
};

struct DisplacementTally {
  bool begun = false;
  AxisTally x, y;
  double looked_at = 0.0;   // time of the last look
  double fastest = 0.0;     // largest speed when it was last asked for
  double checked_at = 0.0;  // and when that was
  Count doubtful = 0;       // moves between two looks that were, or may have been, too long to be sure of
};

// As fastest_speed(const Disks&): length / time, 0 without disks.
double fastest_speed(const DisksInPieces& disks);

// From here on displacements count, of the disks that are there.
void begin_displacement(DisplacementTally& tally, const DisksInPieces& disks, const Domain& box);
inline void begin_displacement(DisplacementTally& tally, const Disks& disks, const Domain& box, double time) {
  begin_displacement(tally, WholeDisks(disks, time), box);
}

// Takes note of where the disks are; a disk that came later is not followed.
void look_at(DisplacementTally& tally, const Disks& disks, const Domain& box, double time);
void look_at(DisplacementTally& tally, const DisksInPieces& disks, const Domain& box);

// Takes note of where the disks are, and follows those that it does not know yet from here on, for their rounds alone:
// a disk that it meets for the first time has gone round 0 times.
void follow_rounds(DisplacementTally& tally, const DisksInPieces& disks, const Domain& box,
                   const BlockRunner& run = run_in_order);

inline void follow_rounds(DisplacementTally& tally, const Disks& disks, const Domain& box, double time) {
  follow_rounds(tally, WholeDisks(disks, time), box);
}

// How often a disk has gone round, upwards along the axis less downwards: its unwrapped coordinate is x + period *
// rounds. 0 where the axis is not periodic.
std::int32_t rounds_of(const AxisTally& axis, DiskId id);

// Mean of (x - x_0)^2 + (y - y_0)^2 over the disks of the start that are still there, of (y - y_0)^2 in a sheared box;
// length^2, NaN without any.
// Precondition: look_at was the last to see these disks. Sums in order of ids: the same bits in any storage order.
struct MeanSquare {
  double value = 0.0;
  Count disks = 0;
};
MeanSquare mean_square_displacement(const DisplacementTally& tally, const DisksInPieces& disks, const Domain& box);
inline MeanSquare mean_square_displacement(const DisplacementTally& tally, const Disks& disks, const Domain& box) {
  return mean_square_displacement(tally, WholeDisks(disks, 0.0), box);
}

}  // namespace carom
