#include "core/measure/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/column.hpp"
#include "core/disks/cell_index.hpp"

namespace carom {

namespace {

constexpr std::int32_t parts = 16;  // of a period
// A quarter period is four parts, five with the rounding of both ends.
constexpr std::int32_t most_parts = 5;
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
// Disks a block of a look: a few milliseconds of work.
constexpr std::size_t look_block = std::size_t{1} << 16;
// Ids a block of the sum.
constexpr Eigen::Index mean_block = 4096;

std::int32_t part_of(double coordinate, double period) {
  return cell_index(coordinate / period * static_cast<double>(parts), parts);
}

bool is_followed(const AxisTally& axis, DiskId id) {
  return id < axis.from.size() && !std::isnan(axis.from[id]);
}

void begin_axis(AxisTally& axis, const std::vector<double>& coordinate, const std::vector<DiskId>& id, double period,
                bool periodic) {
  const std::size_t ids = id.empty() ? 0 : std::size_t{*std::max_element(id.begin(), id.end())} + 1;
  axis.from.assign(ids, nowhere);
  axis.sixteenth.assign(periodic ? ids : 0, not_followed);
  for (std::size_t i = 0; i < id.size(); ++i) {
    axis.from[id[i]] = coordinate[i];
    if (periodic) axis.sixteenth[id[i]] = part_of(coordinate[i], period);
  }
}

// Disks begin to end - 1. Returns how many moves were too long.
Count look_along(AxisTally& axis, const std::vector<double>& coordinate, const std::vector<DiskId>& id, double period,
                 std::size_t begin, std::size_t end) {
  Count doubtful = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (id[i] >= axis.sixteenth.size() || axis.sixteenth[id[i]] == not_followed) continue;
    std::int32_t& unwrapped = axis.sixteenth[id[i]];
    // Of all coordinates that wrap to the present one, the nearest: -8 to 7 parts away.
    const std::int32_t ahead = (part_of(coordinate[i], period) - unwrapped) & (parts - 1);
    const std::int32_t move = ahead < parts / 2 ? ahead : ahead - parts;
    doubtful += std::abs(move) > most_parts ? 1 : 0;
    unwrapped += move;
  }
  return doubtful;
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
  std::vector<Count> doubtful((d.size() + look_block - 1) / look_block, 0);
  run(doubtful.size(), [&](std::size_t b) {
    const std::size_t begin = b * look_block, end = std::min(begin + look_block, d.size());
    doubtful[b] =
        look_along(tally.x, d.x, d.id, box.width, begin, end) + look_along(tally.y, d.y, d.id, box.height, begin, end);
  });
  tally.doubtful = std::accumulate(doubtful.begin(), doubtful.end(), tally.doubtful);
  if (box.periodic_x()) follow_along(tally.x, d.x, d.id, box.width);
  if (box.periodic_y()) follow_along(tally.y, d.y, d.id, box.height);
}

}  // namespace

double largest_speed(const Disks& d) {
  double largest2 = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) largest2 = std::max(largest2, d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
  return std::sqrt(largest2);
}

double largest_speed(const DisksInPieces& disks) {
  double largest = 0.0;
  disks.visit([&](const Disks& some) { largest = std::max(largest, largest_speed(some)); });
  return largest;
}

void begin_displacement(DisplacementTally& tally, const Disks& d, const Domain& box, double time) {
  tally.begun = true;
  tally.looked_at = tally.checked_at = time;
  tally.fastest = largest_speed(d);
  begin_axis(tally.x, d.x, d.id, box.width, box.periodic_x() && !box.shear.acts());
  begin_axis(tally.y, d.y, d.id, box.height, box.periodic_y());
}

void look_at(DisplacementTally& tally, const Disks& d, const Domain& box, double time) {
  tally.doubtful += look_along(tally.x, d.x, d.id, box.width, 0, d.size());
  tally.doubtful += look_along(tally.y, d.y, d.id, box.height, 0, d.size());
  tally.looked_at = time;
}

void look_at(DisplacementTally& tally, const DisksInPieces& disks, const Domain& box) {
  disks.visit([&](const Disks& some) { look_at(tally, some, box, disks.time()); });
}

void follow_rounds(DisplacementTally& tally, const DisksInPieces& disks, const Domain& box, const BlockRunner& run) {
  if (!tally.begun) {
    tally.begun = true;
    tally.checked_at = disks.time();
    tally.fastest = largest_speed(disks);
    // Ids begin without gaps: room that need not grow piece by piece.
    if (box.periodic_x()) tally.x.sixteenth.reserve(disks.size());
    if (box.periodic_y()) tally.y.sixteenth.reserve(disks.size());
  }
  disks.visit([&](const Disks& some) { follow_rounds_of(tally, some, box, run); });
  tally.looked_at = disks.time();
}

std::int32_t rounds_of(const AxisTally& axis, DiskId id) {
  return id < axis.sixteenth.size() ? axis.sixteenth[id] >> 4 : 0;  // rounds down
}

MeanSquare mean_square_displacement(const DisplacementTally& tally, const Disks& d, const Domain& box) {
  MeanSquare mean;
  Column square = Column::Zero(static_cast<Eigen::Index>(tally.x.from.size()));  // by id; 0 of disks that are gone
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (!is_followed(tally.x, d.id[i])) continue;
    const double dx = box.shear.acts() ? 0.0 : displacement(tally.x, d.x[i], d.id[i], box.width);
    const double dy = displacement(tally.y, d.y[i], d.id[i], box.height);
    square[d.id[i]] = dx * dx + dy * dy;
    ++mean.disks;
  }
  double total = 0.0;
  for (Eigen::Index begin = 0; begin < square.size(); begin += mean_block) {
    total += square.segment(begin, std::min(mean_block, square.size() - begin)).sum();
  }
  mean.value = mean.disks > 0 ? total / static_cast<double>(mean.disks) : nowhere;
  return mean;
}

}  // namespace carom
