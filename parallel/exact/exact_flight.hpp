// What the exact engine knows of every disk during a window.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/types.hpp"
#include "core/physics/exact_event.hpp"

namespace carom {

inline constexpr std::uint32_t nobody = 0xffffffffU;
// In Flight::partner: the disk leaves the range of its list; it is to be listed anew.
inline constexpr std::uint32_t leaving = 0xfffffffeU;

// A disk on its path: all that a look at it needs, in one cache line.
struct alignas(64) Flight {
  PathSegment path;
  double radius = 0.0;
  DiskId id = 0;
  // Whom it meets when it is due: a storage index or a wall_partner; leaving; nobody: not known, it has to look.
  std::uint32_t partner = nobody;
  std::uint32_t version = 0;          // paths begun in the window
  std::uint32_t partner_version = 0;  // of the path that the partner was found on
};
static_assert(sizeof(Flight) == 64);

// In ExactField::standing. The disk's motion is known up to the slice's end; as far as events have happened; up to the
// slice's start only; any other number: that of a Doubt.
inline constexpr std::uint32_t settled = 0xffffffffU;
inline constexpr std::uint32_t at_hand = 0xfffffffeU;
inline constexpr std::uint32_t waiting = 0xfffffffdU;

// Bits of ExactField::mark.
inline constexpr std::uint8_t at_edge = 1;    // lists a disk of another region
inline constexpr std::uint8_t at_border = 2;  // lists a disk of a later tile, or one at the edge
inline constexpr std::uint8_t wary = 4;       // may list a disk that is in doubt, or waits, in this slice

// All by storage index.
struct ExactField {
  ExactRules rules;
  const Disks* disks = nullptr;  // masses
  std::vector<Flight> flight;
  // No event that this disk answers for happens before; each pair is answered for by the one whose path changed last
  // (or both), each disk for its own sides and for leaving its list's range.
  std::vector<double> due;
  std::vector<double> last_contact;  // with the TC model
  std::vector<Burst> burst;          // where anything dissipates
  // Where there are tiles.
  std::vector<std::uint32_t> standing;
  std::vector<std::uint8_t> mark;
  std::vector<std::uint16_t> region_of_tile;
  double length = 0.0;      // of the window; time
  double horizon = 0.0;     // events are looked for up to here, beyond the window
  double next_start = 0.0;  // just beyond the window
  double slack = 0.0;       // rounding of a place, generously; length
  // Two disks (a disk and a side) that are so close and so slow, one as seen from the other, may touch or not, and
  // approach or not, by the rounding of each window's start.
  double close = 0.0;  // length
  double slow = 0.0;   // length / time
  double largest_radius = 0.0;
  // Up to this v^2 nobody flies so far in a window that images beyond the nearest one, or crossing events, come into
  // play; fastest2 is the largest v^2 so far.
  double safe_speed2 = 0.0;
  double fastest2 = 0.0;
  // Where there are tiles: paths that begin with more than allowed2 (v^2) void the window; then nobody's speed exceeds
  // bound, not even under gravity.
  double allowed2 = 0.0;
  double bound = 0.0;
  double slice_start = 0.0;
  double slice_end = 0.0;  // events before this time; in the last slice up to and including `length`
  bool keeps_paths = true;
  Count most_paths = 0;         // of all disks, beyond which the window is crowded (core/step/window_length.hpp)
  std::function<bool()> go_on;  // as in Engine::set_watch

  bool in_slice(double t) const { return t < slice_end && t <= length; }
  bool is_known(std::uint32_t i) const { return standing[i] >= at_hand; }
  bool is_settled(std::uint32_t i) const { return !standing.empty() && standing[i] == settled; }
};

// An event of a disk that looks.
struct NextEvent {
  double time = never;
  DiskId id1 = 0, id2 = 0;       // of the event; id2 may be a wall_partner
  std::uint32_t other = nobody;  // storage index of the disk met, or of the disk itself for a side

  // The canonical order.
  bool before(const NextEvent& e) const {
    if (time != e.time) return time < e.time;
    if (id1 != e.id1) return id1 < e.id1;
    return id2 < e.id2;
  }
};

}  // namespace carom
