#include "core/measure/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/disks/cell_index.hpp"
#include "core/disks/fastest_speed.hpp"

namespace carom {

namespace {

constexpr std::int32_t parts = 16;  // of a period
// A quarter period is four parts, five with the rounding of both ends.
constexpr std::int32_t most_parts = 5;
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
// Disks in a block of noting positions: a few milliseconds of work.
constexpr std::size_t look_block = std::size_t{1} << 16;
// Ids in a block of the sum.
constexpr DiskId mean_block = 4096;

std::int32_t part_of(double coordinate, double period) {
  return cell_index(coordinate / period * static_cast<double>(parts), parts);
}

bool is_followed(const AxisTally& axis, DiskId id) {
  return id < axis.from.size() && !std::isnan(axis.from[id]);
}

// Initial ids have no gaps, so memory for this number of disks is usually enough.
AxisTally empty_axis(Count disks, bool periodic) {
  AxisTally axis;
  axis.from.reserve(disks);
  if (periodic) axis.sixteenth.reserve(disks);
  return axis;
}

void begin_axis(AxisTally& axis, const std::vector<double>& coordinate, const std::vector<DiskId>& id, double period,
                bool periodic) {
  const std::size_t ids = id.empty() ? 0 : std::size_t{*std::max_element(id.begin(), id.end())} + 1;
  axis.from.resize(std::max(ids, axis.from.size()), nowhere);
  if (periodic) axis.sixteenth.resize(axis.from.size(), not_followed);
  for (std::size_t i = 0; i < id.size(); ++i) {
    axis.from[id[i]] = coordinate[i];
    if (periodic) axis.sixteenth[id[i]] = part_of(coordinate[i], period);
  }
}

// Numbers of disks, since the last call.
struct Moves {
  Count doubtful = 0;  // moved too far to be sure of
  Count unknown = 0;   // are not followed
  Moves& operator+=(const Moves& other) {
    doubtful += other.doubtful;
    unknown += other.unknown;
    return *this;
  }
};

// Notes disks [begin, end).
Moves look_along(AxisTally& axis, const std::vector<double>& coordinate, const std::vector<DiskId>& id, double period,
                 std::size_t begin, std::size_t end) {
  // Entries of neighbouring disks lie far apart in memory, so each is prefetched this many disks ahead.
  constexpr std::size_t ahead_in_memory = 64;
  const std::size_t known = axis.sixteenth.size();
  Moves moves;
  if (known == 0) return {0, end - begin};  // also if the axis is not periodic
  for (std::size_t i = begin; i < end; ++i) {
    if (i + ahead_in_memory < end && id[i + ahead_in_memory] < known) {
      __builtin_prefetch(&axis.sixteenth[id[i + ahead_in_memory]], 1);
    }
    if (id[i] >= known || axis.sixteenth[id[i]] == not_followed) {
      ++moves.unknown;
      continue;
    }
    std::int32_t& unwrapped = axis.sixteenth[id[i]];
    // The nearest of all coordinates that wrap to the present one: -8 to 7 parts away.
    const std::int32_t ahead = (part_of(coordinate[i], period) - unwrapped) & (parts - 1);
    const std::int32_t move = ahead < parts / 2 ? ahead : ahead - parts;
    moves.doubtful += std::abs(move) > most_parts ? 1 : 0;
    unwrapped += move;
  }
  return moves;
}

double displacement(const AxisTally& axis, double coordinate, DiskId id, double period) {
  const double moved = coordinate - axis.from[id];
  if (axis.sixteenth.empty()) return moved;
  return moved + period * static_cast<double>(rounds_of(axis, id));
}

void follow_along(AxisTally& axis, const std::vector<double>& coordinate, const std::vector<DiskId>& id,
                  double period) {
  const std::size_t ids = id.empty() ? 0 : std::size_t{*std::max_element(id.begin(), id.end())} + 1;
  if (ids > axis.sixteenth.size()) axis.sixteenth.resize(ids, not_followed);
  for (std::size_t i = 0; i < id.size(); ++i) {
    std::int32_t& unwrapped = axis.sixteenth[id[i]];
    if (unwrapped == not_followed) unwrapped = part_of(coordinate[i], period);
  }
}

void follow_rounds_of(DisplacementTally& tally, const Disks& d, const Domain& box, const BlockRunner& run) {
  struct BlockMoves {
    Moves x, y;
  };
  std::vector<BlockMoves> blocks((d.size() + look_block - 1) / look_block);
  run(blocks.size(), [&](std::size_t b) {
    const std::size_t begin = b * look_block, end = std::min(begin + look_block, d.size());
    blocks[b] = {look_along(tally.x, d.x, d.id, box.width, begin, end),
                 look_along(tally.y, d.y, d.id, box.height, begin, end)};
  });
  BlockMoves all;
  for (const BlockMoves& block : blocks) {
    all.x += block.x;
    all.y += block.y;
  }
  tally.doubtful += all.x.doubtful + all.y.doubtful;
  if (box.periodic_x() && all.x.unknown > 0) follow_along(tally.x, d.x, d.id, box.width);
  if (box.periodic_y() && all.y.unknown > 0) follow_along(tally.y, d.y, d.id, box.height);
}

}  // namespace

double fastest_speed(const DisksInPieces& disks) {
  double fastest = 0.0;
  disks.visit([&](const Disks& some) { fastest = std::max(fastest, fastest_speed(some)); });
  return fastest;
}

void begin_displacement(DisplacementTally& tally, const DisksInPieces& disks, const Domain& box) {
  tally.begun = true;
  tally.looked_at = tally.checked_at = disks.time();
  tally.fastest = 0.0;
  const bool rounds_x = box.periodic_x() && !box.shear.acts(), rounds_y = box.periodic_y();
  tally.x = empty_axis(disks.size(), rounds_x);
  tally.y = empty_axis(disks.size(), rounds_y);
  disks.visit([&](const Disks& d) {
    tally.fastest = std::max(tally.fastest, fastest_speed(d));
    begin_axis(tally.x, d.x, d.id, box.width, rounds_x);
    begin_axis(tally.y, d.y, d.id, box.height, rounds_y);
  });
}

void look_at(DisplacementTally& tally, const Disks& d, const Domain& box, double time) {
  tally.doubtful += look_along(tally.x, d.x, d.id, box.width, 0, d.size()).doubtful;
  tally.doubtful += look_along(tally.y, d.y, d.id, box.height, 0, d.size()).doubtful;
  tally.looked_at = time;
}

void look_at(DisplacementTally& tally, const DisksInPieces& disks, const Domain& box) {
  disks.visit([&](const Disks& some) { look_at(tally, some, box, disks.time()); });
}

void follow_rounds(DisplacementTally& tally, const DisksInPieces& disks, const Domain& box, const BlockRunner& run) {
  if (!tally.begun) {
    tally.begun = true;
    tally.checked_at = disks.time();
    tally.fastest = fastest_speed(disks);
    // Initial ids have no gaps, so this is usually enough.
    if (box.periodic_x()) tally.x.sixteenth.reserve(disks.size());
    if (box.periodic_y()) tally.y.sixteenth.reserve(disks.size());
  }
  disks.visit([&](const Disks& some) { follow_rounds_of(tally, some, box, run); });
  tally.looked_at = disks.time();
}

std::int32_t rounds_of(const AxisTally& axis, DiskId id) {
  return id < axis.sixteenth.size() ? axis.sixteenth[id] >> 4 : 0;  // rounds down
}

// Sums run within blocks of ids; disks that are gone add 0.
MeanSquare mean_square_displacement(const DisplacementTally& tally, const DisksInPieces& disks, const Domain& box) {
  MeanSquare mean;
  double total = 0.0, sum = 0.0;
  DiskId block = 0;  // number of the present block
  disks.visit([&](const Disks& d) {
    for (const std::size_t i : by_id(d)) {
      if (!is_followed(tally.x, d.id[i])) continue;
      const double dx = box.shear.acts() ? 0.0 : displacement(tally.x, d.x[i], d.id[i], box.width);
      const double dy = displacement(tally.y, d.y[i], d.id[i], box.height);
      if (d.id[i] / mean_block != block) {
        total += std::exchange(sum, 0.0);
        block = d.id[i] / mean_block;
      }
      sum += dx * dx + dy * dy;
      ++mean.disks;
    }
  });
  mean.value = mean.disks > 0 ? (total + sum) / static_cast<double>(mean.disks) : nowhere;
  return mean;
}

}  // namespace carom
