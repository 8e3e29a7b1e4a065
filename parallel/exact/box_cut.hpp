// The box cut into parts across its longer side, with about as much work each.
#pragma once

#include <cstddef>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

struct BoxCut {
  bool along_x = false;  // parts follow each other along x
  bool periodic = false;
  double side = 0.0;         // length
  double halo = 0.0;         // how wide halos are; length
  std::vector<double> line;  // parts + 1, from 0 to the side

  std::size_t parts() const { return line.size() - 1; }
  double low(std::size_t part) const { return line[part]; }
  double high(std::size_t part) const { return line[part + 1]; }
  const std::vector<double>& coordinates(const Disks& d) const { return along_x ? d.x : d.y; }

  // Is there another part below or above this one?
  bool has_below(std::size_t part) const { return periodic || part > 0; }
  bool has_above(std::size_t part) const { return periodic || part + 1 < parts(); }
  // Rounding may have led a disk out of a box between walls.
  bool owns(std::size_t part, double c) const {
    return (c >= low(part) || part == 0) && (c < high(part) || part + 1 == parts());
  }
  // How far a place is below the part's lower end (above its upper end), round the box along a period; negative where
  // it is not.
  double below(std::size_t part, double c) const { return round_the_box(low(part) - c); }
  double above(std::size_t part, double c) const { return round_the_box(c - high(part)); }
  bool in_halo(std::size_t part, double c) const {
    const double b = below(part, c);
    const double a = above(part, c);
    return (has_below(part) && b >= 0.0 && b <= halo) || (has_above(part) && a >= 0.0 && a <= halo);
  }

  // The parts next to this one; itself where there is none.
  std::size_t part_below(std::size_t part) const {
    return !has_below(part) ? part : part == 0 ? parts() - 1 : part - 1;
  }
  std::size_t part_above(std::size_t part) const {
    return !has_above(part) ? part : part + 1 == parts() ? 0 : part + 1;
  }
  // Is it the place of an own disk that is in the halo of the part below (above)? Computed as that part does, so that
  // both say the same whatever rounding does.
  bool is_known_below(std::size_t part, double c) const {
    return owns(part, c) && has_below(part) && above(part_below(part), c) <= halo;
  }
  bool is_known_above(std::size_t part, double c) const {
    return owns(part, c) && has_above(part) && below(part_above(part), c) <= halo;
  }

 private:
  double round_the_box(double d) const { return periodic && d < 0.0 ? d + side : d; }
};

// How much work the disks of a former cut were: work[k] for each disk of part k, in any unit. Without parts, 1 for each
// disk.
struct PartWork {
  BoxCut cut;
  std::vector<double> work;

  double at(double c) const;
};

// Cuts the box into at most so many parts. halo: length. Parts are at least as wide as a halo; where they would not be,
// there are fewer.
BoxCut cut_box(const Disks& disks, const Domain& box, std::size_t parts, double halo, const PartWork& before = {});

}  // namespace carom
