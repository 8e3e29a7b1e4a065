// The ends of a part of the box, and the parts around it (HaloPart).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/types.hpp"
#include "parallel/exact/disk_record.hpp"
#include "parallel/exact/known_band.hpp"

namespace carom {

// The parts next to a part and at its corners, each once: two parts that fill a period are each on both sides of the
// other.
class PartNeighbours {
 public:
  std::size_t count() const { return count_; }
  std::uint16_t part(std::size_t k) const { return part_[k]; }
  // Each neighbour has a bit. bit_towards: of the part this number of pieces, -1 to 1, further along x and y; 0 if
  // there is none. bit_of: of the part with this number; 0 if it is not a neighbour.
  std::uint8_t bit_towards(int along_x, int along_y) const { return towards_[place_towards(along_x, along_y)]; }
  std::uint8_t bit_of(std::size_t part) const {
    for (std::size_t k = 0; k < count_; ++k) {
      if (part_[k] == part) return static_cast<std::uint8_t>(1U << k);
    }
    return 0;
  }

  void add(int along_x, int along_y, std::size_t part) {
    if (bit_of(part) == 0) part_[count_++] = static_cast<std::uint16_t>(part);
    towards_[place_towards(along_x, along_y)] = bit_of(part);
  }

 private:
  static std::size_t place_towards(int along_x, int along_y) {
    return 3U * static_cast<unsigned>(along_y + 1) + static_cast<unsigned>(along_x + 1);
  }

  std::array<std::uint16_t, 8> part_{};
  std::size_t count_ = 0;
  std::array<std::uint8_t, 9> towards_{};
};

// The other parts that an own disk concerns, as PartNeighbours' bits.
struct OtherParts {
  std::uint8_t known_to = 0;   // the parts that have it as a ghost
  std::uint8_t may_reach = 0;  // the parts that it may have reached since the lists were built
};

// A choice of pieces along an axis: the one below the part's, its own, the one above.
struct PieceSteps {
  bool below, own, above;
};

// A part's ends along one axis; lengths. `between` has bounds if there are other pieces.
struct AxisEnds {
  KnownBand between;
  // Relative to the centre, as in `between`: the far ends of the pieces next to this one, where third pieces begin.
  double next_below = -HUGE_VAL, next_above = HUGE_VAL;

  // The distance of a coordinate beyond the ends; negative between them.
  double beyond(double c) const {
    const double d = between.from_centre(c);
    return std::fmax(d - between.above, between.below - d);
  }
};

// A part lies between two coordinates along each axis. Its own disks are those that are there when the lists are built,
// wherever they go until the lists are built again.
struct PartEnds {
  AxisEnds x, y;
  PartNeighbours neighbours;

  // The bits of the parts that these steps lead to.
  std::uint8_t bits_of(PieceSteps along_x, PieceSteps along_y) const {
    unsigned bits = 0;
    const auto add_row = [&](bool taken, int row) {
      if (!taken) return;
      if (along_x.below) bits |= neighbours.bit_towards(-1, row);
      if (along_x.own) bits |= neighbours.bit_towards(0, row);
      if (along_x.above) bits |= neighbours.bit_towards(1, row);
    };
    add_row(along_y.below, -1);
    add_row(along_y.own, 0);
    add_row(along_y.above, 1);
    return static_cast<std::uint8_t>(bits);
  }

  // Notes the parts that a disk may reach which has been listed at this place and stays within `distance` of it.
  // Returns false if one of them does not have it as a ghost, or if it may come to a third part: then the window would
  // be void.
  bool note_listing(Vec2 at, double distance, const DiskRecord& disk, OtherParts& others) const {
    if (disk.progress.has(DiskProgress::ghost)) return true;
    const double reach = (distance + disk.radius) * (1.0 + 1e-9);
    const double dx = x.between.from_centre(at.x);
    const double dy = y.between.from_centre(at.y);
    if (is_inside(x, dx, reach) && is_inside(y, dy, reach)) [[likely]]
      return true;
    others.may_reach |= bits_of(within(x, dx, reach), within(y, dy, reach));
    if (dx - reach < x.next_below || dx + reach > x.next_above) return false;
    if (dy - reach < y.next_below || dy + reach > y.next_above) return false;
    return (others.may_reach & ~unsigned{others.known_to}) == 0;
  }

 private:
  static bool is_inside(const AxisEnds& axis, double d, double reach) {
    return d - reach >= axis.between.below && d + reach <= axis.between.above;
  }
  static PieceSteps within(const AxisEnds& axis, double d, double reach) {
    const KnownBand& own = axis.between;
    return {d - reach < own.below, d + reach >= own.below && d - reach <= own.above, d + reach > own.above};
  }
};

}  // namespace carom
