// The box, cut along both axes into parts of about equal work.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "parallel/exact/part_ends.hpp"

namespace carom {

// The number of pieces along each axis.
struct PieceCounts {
  std::size_t x = 1, y = 1;

  std::size_t parts() const { return x * y; }
};

// The pieces along one axis. Lengths.
struct AxisCut {
  bool periodic = false;
  double side = 0.0;
  std::vector<double> line;  // pieces + 1, from 0 to the side

  std::size_t pieces() const { return line.size() - 1; }
  double low(std::size_t piece) const { return line[piece]; }
  double high(std::size_t piece) const { return line[piece + 1]; }
  double width(std::size_t piece) const { return high(piece) - low(piece); }

  // Is there another piece below or above this one?
  bool has_below(std::size_t piece) const { return piece > 0 || is_ring(); }
  bool has_above(std::size_t piece) const { return piece + 1 < pieces() || is_ring(); }
  // The pieces next to this one; the piece itself if there is none.
  std::size_t below(std::size_t piece) const {
    return !has_below(piece) ? piece : piece == 0 ? pieces() - 1 : piece - 1;
  }
  std::size_t above(std::size_t piece) const {
    return !has_above(piece) ? piece : piece + 1 == pieces() ? 0 : piece + 1;
  }
  // The piece that owns a coordinate. (By rounding a disk may be slightly outside a box between walls.)
  std::size_t piece_at(double c) const {
    return static_cast<std::size_t>(std::upper_bound(line.begin() + 1, line.end() - 1, c) - line.begin()) - 1;
  }
  // Is a coordinate beyond an end of the piece, by at most `halo`?
  bool in_halo(std::size_t piece, double c, double halo) const {
    const double b = round_the_box(low(piece) - c);
    const double a = round_the_box(c - high(piece));
    return (has_below(piece) && b >= 0.0 && b <= halo) || (has_above(piece) && a >= 0.0 && a <= halo);
  }

 private:
  bool is_ring() const { return periodic && pieces() > 1; }
  // A difference d, wrapped across the period: the distance beyond an end of a piece, negative if not beyond it.
  double round_the_box(double d) const { return periodic && d < 0.0 ? d + side : d; }
};

// Part k is the intersection of piece k % (pieces along x) along x and piece k / (pieces along x) along y.
struct BoxCut {
  AxisCut x, y;
  double halo = 0.0;  // width of halos; length

  std::size_t parts() const { return x.pieces() * y.pieces(); }
  std::size_t column(std::size_t part) const { return part % x.pieces(); }
  std::size_t row(std::size_t part) const { return part / x.pieces(); }
  std::size_t part_of(std::size_t column, std::size_t row) const { return row * x.pieces() + column; }
  // The part that owns a place.
  std::size_t part_at(Vec2 at) const { return part_of(x.piece_at(at.x), y.piece_at(at.y)); }

  // Calls visit(part) first for the part that owns a place, then for each part whose halo contains it.
  template <class Visit>
  void visit_parts_at(Vec2 at, Visit&& visit) const {
    const Pieces columns = pieces_at(x, at.x);
    const Pieces rows = pieces_at(y, at.y);
    for (std::size_t r = 0; r < rows.count; ++r) {
      for (std::size_t c = 0; c < columns.count; ++c) visit(part_of(columns.piece[c], rows.piece[r]));
    }
  }

  // The ends of a part, and the parts around it.
  PartEnds ends_of(std::size_t part) const;

 private:
  // The piece that owns a coordinate, and those whose halos contain it.
  struct Pieces {
    std::array<std::size_t, 3> piece;
    std::size_t count = 1;
  };
  // Pieces are at least as wide as a halo, so only those next to the owner may contain it in theirs.
  Pieces pieces_at(const AxisCut& axis, double c) const {
    const std::size_t own = axis.piece_at(c);
    Pieces found{{own}, 1};
    const double well_inside = halo * (1.0 + 1e-6);
    if (c - axis.low(own) > well_inside && axis.high(own) - c > well_inside) [[likely]]
      return found;
    const std::size_t below = axis.below(own);
    const std::size_t above = axis.above(own);
    if (below != own && axis.in_halo(below, c, halo)) found.piece[found.count++] = below;
    if (above != own && above != below && axis.in_halo(above, c, halo)) found.piece[found.count++] = above;
    return found;
  }
};

// The work for each disk, measured with a former cut: work[k] for each disk of part k, in any unit. Without parts, 1
// for each disk.
struct PartWork {
  BoxCut cut;
  std::vector<double> work;

  double at(Vec2 place) const { return work.empty() ? 1.0 : work[cut.part_at(place)]; }
};

// The division into this number of parts that has the fewest ghosts for evenly spread disks, among those whose pieces
// are at least `least` halos wide; a single part if there is none. halo: length.
PieceCounts best_pieces(std::size_t parts, const Domain& box, double halo, double least);
// The number of disks of all parts, ghosts included, over that of the box.
double share_with_ghosts(PieceCounts pieces, const Domain& box, double halo);

// Cuts the box into at most these numbers of pieces. halo: length. Pieces are at least as wide as a halo; if necessary
// there are fewer.
BoxCut cut_box(const Disks& disks, const Domain& box, PieceCounts pieces, double halo, const PartWork& before = {});

}  // namespace carom
