#include "parallel/exact/box_cut.hpp"

#include <cmath>

namespace carom {

namespace {

// Steps along a side in which disks are counted.
constexpr std::size_t steps = 8192;
// A sample of this number of disks is enough to choose the cuts.
constexpr std::size_t most_counted = 0x100000;

// The work of the disks in each step along each axis.
struct WorkAlong {
  std::vector<double> x, y;
};

std::size_t step_at(double c, double steps_a_length) {
  return static_cast<std::size_t>(std::clamp(c * steps_a_length, 0.0, static_cast<double>(steps - 1)));
}

WorkAlong count_work(const Disks& disks, const Domain& box, const PartWork& before) {
  WorkAlong work{std::vector<double>(steps), std::vector<double>(steps)};
  const double per_width = static_cast<double>(steps) / box.width;
  const double per_height = static_cast<double>(steps) / box.height;
  const std::size_t apart = disks.size() / most_counted + 1;
  for (std::size_t k = 0; k < disks.size(); k += apart) {
    const Vec2 at{disks.x[k], disks.y[k]};
    const double of_disk = before.at(at);
    work.x[step_at(at.x, per_width)] += of_disk;
    work.y[step_at(at.y, per_height)] += of_disk;
  }
  return work;
}

AxisCut cut_axis(const std::vector<double>& work, double side, bool periodic, std::size_t pieces, double halo) {
  AxisCut cut{periodic, side, {0.0}};
  double all = 0.0;
  for (const double w : work) all += w;
  double done = 0.0;
  for (std::size_t k = 0; k < steps; ++k) {
    const double end = static_cast<double>(k + 1) * side / static_cast<double>(steps);
    done += work[k];
    const bool is_full = done * static_cast<double>(pieces) >= all * static_cast<double>(cut.line.size());
    const bool is_wide = end - cut.line.back() >= halo && side - end >= halo;
    if (is_full && is_wide && cut.line.size() < pieces) cut.line.push_back(end);
  }
  cut.line.push_back(side);
  return cut;
}

AxisEnds ends_along(const AxisCut& axis, std::size_t piece) {
  AxisEnds ends;
  ends.between.centre = 0.5 * (axis.low(piece) + axis.high(piece));
  ends.between.period = axis.periodic ? axis.side : HUGE_VAL;
  const double half = 0.5 * axis.width(piece);
  const std::size_t below = axis.below(piece);
  const std::size_t above = axis.above(piece);
  if (below != piece) ends.between.below = -half;
  if (above != piece) ends.between.above = half;
  if (below != piece && axis.has_below(below) && axis.below(below) != piece) {
    ends.next_below = -half - axis.width(below);
  }
  if (above != piece && axis.has_above(above) && axis.above(above) != piece) {
    ends.next_above = half + axis.width(above);
  }
  return ends;
}

}  // namespace

PartEnds BoxCut::ends_of(std::size_t part) const {
  PartEnds ends{ends_along(x, column(part)), ends_along(y, row(part)), {}};
  const auto step = [](const AxisCut& axis, std::size_t piece, int to) {
    return to < 0 ? axis.below(piece) : to > 0 ? axis.above(piece) : piece;
  };
  for (int along_y = -1; along_y <= 1; ++along_y) {
    for (int along_x = -1; along_x <= 1; ++along_x) {
      const std::size_t column_there = step(x, column(part), along_x);
      const std::size_t row_there = step(y, row(part), along_y);
      const bool is_there = (along_x == 0 || column_there != column(part)) && (along_y == 0 || row_there != row(part));
      const std::size_t there = part_of(column_there, row_there);
      if (is_there && there != part) ends.neighbours.add(along_x, along_y, there);
    }
  }
  return ends;
}

double share_with_ghosts(PieceCounts pieces, const Domain& box, double halo) {
  const auto along = [halo](std::size_t count, double side) {
    return count == 1 ? 1.0 : 1.0 + 2.0 * halo * static_cast<double>(count) / side;
  };
  return along(pieces.x, box.width) * along(pieces.y, box.height);
}

PieceCounts best_pieces(std::size_t parts, const Domain& box, double halo, double least) {
  PieceCounts best;
  double fewest = HUGE_VAL;
  const auto is_wide = [&](std::size_t count, double side) {
    return count == 1 || static_cast<double>(count) * least * halo <= side;
  };
  for (std::size_t x = 1; x <= parts; ++x) {
    const PieceCounts pieces{x, parts / x};
    if (pieces.parts() != parts || !is_wide(pieces.x, box.width) || !is_wide(pieces.y, box.height)) continue;
    const double share = share_with_ghosts(pieces, box, halo);
    if (share < fewest) best = pieces, fewest = share;
  }
  return best;
}

BoxCut cut_box(const Disks& disks, const Domain& box, PieceCounts pieces, double halo, const PartWork& before) {
  const WorkAlong work = count_work(disks, box, before);
  return {cut_axis(work.x, box.width, box.periodic_x(), pieces.x, halo),
          cut_axis(work.y, box.height, box.periodic_y(), pieces.y, halo), halo};
}

}  // namespace carom
