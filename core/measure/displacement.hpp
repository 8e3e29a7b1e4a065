// Displacements across periodic sides: the mean square displacement, and the net number of times that each disk has
// crossed a periodic side (its rounds).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/base/types.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// In a sheared box only the displacement along y counts: along x disks move with the flow, and a disk that leaves at
// the top comes back elsewhere.
//
// Along one axis. from: the coordinate of each disk at the start, by id (NaN: no such disk; the list is empty if only
// rounds are counted). sixteenth: for a periodic axis, the unwrapped coordinate in sixteenths of the period, rounded
// down (not_followed: no such disk). As long as no disk moves by more than a quarter period between two times at which
// positions are noted, this counts its rounds. The displacement itself is the difference of two coordinates plus
// periods, so it does not depend on when positions were noted. 2^27 periods fit.
inline constexpr std::int32_t not_followed = std::numeric_limits<std::int32_t>::min();
struct AxisTally {
  std::vector<double> from;             // length
  std::vector<std::int32_t> sixteenth;  // empty if the axis is not periodic
};

struct DisplacementTally {
  bool begun = false;
  AxisTally x, y;
  double looked_at = 0.0;   // time at which positions were last noted
  double fastest = 0.0;     // largest speed when it was last computed
  double checked_at = 0.0;  // time of that
  Count doubtful = 0;       // moves between two notes that were, or may have been, longer than a quarter period
};

// As fastest_speed(const Disks&): length / time, 0 without disks.
double fastest_speed(const DisksInPieces& disks);

// Displacements count from the present positions, for the present disks.
void begin_displacement(DisplacementTally& tally, const DisksInPieces& disks, const Domain& box);
inline void begin_displacement(DisplacementTally& tally, const Disks& disks, const Domain& box, double time) {
  begin_displacement(tally, WholeDisks(disks, time), box);
}

// Notes the positions of the disks; a disk that came after the beginning is not followed.
void look_at(DisplacementTally& tally, const Disks& disks, const Domain& box, double time);
void look_at(DisplacementTally& tally, const DisksInPieces& disks, const Domain& box);

// Notes the positions, and follows new disks from now on, for their rounds alone: a new disk has 0 rounds.
void follow_rounds(DisplacementTally& tally, const DisksInPieces& disks, const Domain& box,
                   const BlockRunner& run = run_in_order);

inline void follow_rounds(DisplacementTally& tally, const Disks& disks, const Domain& box, double time) {
  follow_rounds(tally, WholeDisks(disks, time), box);
}

// The rounds of a disk, upwards along the axis less downwards: its unwrapped coordinate is x + period * rounds. 0 if
// the axis is not periodic.
std::int32_t rounds_of(const AxisTally& axis, DiskId id);

// Mean of (x - x_0)^2 + (y - y_0)^2, in a sheared box of (y - y_0)^2, over the initial disks that are still there;
// length^2, NaN without any. Precondition: the present positions have been noted. Sums run in order of ids: the same
// bits for any storage order.
struct MeanSquare {
  double value = 0.0;
  Count disks = 0;
};
MeanSquare mean_square_displacement(const DisplacementTally& tally, const DisksInPieces& disks, const Domain& box);
inline MeanSquare mean_square_displacement(const DisplacementTally& tally, const Disks& disks, const Domain& box) {
  return mean_square_displacement(tally, WholeDisks(disks, 0.0), box);
}

}  // namespace carom
