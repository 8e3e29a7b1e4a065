// What the exact engine knows of every disk during a slice of a window.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/exact_event.hpp"
#include "core/types.hpp"

namespace carom {

inline constexpr std::uint32_t nobody = 0xffffffffU;
// In Flight::partner: the disk leaves the range of its list; it is to be listed anew.
inline constexpr std::uint32_t leaving = 0xfffffffeU;

// A disk on its path: all that a look at it needs, in one cache line.
struct alignas(64) Flight {
  PathSegment path;
  double radius = 0.0;
  DiskId id = 0;
  std::uint32_t owner = nobody;  // handle of the member that the disk is in this slice
  // Whom it meets when it is due: a storage index or a wall_partner; leaving; nobody: not known, it has to look.
  std::uint32_t partner = nobody;
  // Slices of the window (from 1 on): the one in which the path began, 0 at the window's start, and the one in which
  // the partner was found. A partner on a path begun in an earlier slice than that is still met as found.
  std::uint16_t changed = 0;
  std::uint16_t looked = 0;
};
static_assert(sizeof(Flight) == 64);

// Only `owner`, and `due` and `partner` of disks that nobody owns, change while a slice is solved.
struct ExactField {
  ExactRules rules;
  const Disks* disks = nullptr;  // masses
  std::vector<Flight> flight;    // by storage index
  // No event that this disk answers for happens before; each pair is answered for by the one whose path changed last
  // (or both), each disk for its own sides and for leaving its list's range.
  std::vector<double> due;
  std::vector<double> last_contact;  // with the TC model
  std::vector<Burst> burst;          // where collapse is possible
  double length = 0.0;               // of the window; time
  double horizon = 0.0;              // events are looked for up to here, beyond the window
  double slack = 0.0;                // rounding of a place, generously; length
  // Up to this v^2 nobody flies so far in a window that images beyond the nearest one, or crossing events, come into
  // play; fastest2 is the largest v^2 so far.
  double safe_speed2 = 0.0;
  double fastest2 = 0.0;
  double slice_start = 0.0;
  double slice_end = 0.0;   // events before this time; in the last slice up to and including `length`
  std::uint16_t slice = 0;  // number, from 1 on; stays at its largest value

  bool in_slice(double t) const { return t < slice_end && t <= length; }

  // While components are solved, others may claim a disk or put its due time off at any moment.
  std::uint32_t owner_of(std::uint32_t i) {
    return std::atomic_ref<std::uint32_t>(flight[i].owner).load(std::memory_order_seq_cst);
  }
  double due_of(std::uint32_t i) { return std::atomic_ref<double>(due[i]).load(std::memory_order_relaxed); }
  std::uint32_t partner_of(std::uint32_t i) {
    return std::atomic_ref<std::uint32_t>(flight[i].partner).load(std::memory_order_relaxed);
  }
  void put_off(std::uint32_t i, double time, std::uint32_t partner) {
    std::atomic_ref<double>(due[i]).store(time, std::memory_order_relaxed);
    std::atomic_ref<std::uint32_t>(flight[i].partner).store(partner, std::memory_order_relaxed);
    std::atomic_ref<std::uint16_t>(flight[i].looked).store(slice, std::memory_order_relaxed);
  }
};

// The earliest event that a disk answers for, or that it has to look for one.
struct NextEvent {
  double time = never;
  DiskId id1 = 0, id2 = 0;       // of the event; id2 may be a wall_partner
  std::uint32_t other = nobody;  // storage index of the disk met, or of the disk itself for a side; nobody: to look
  std::uint32_t other_version = 0;

  // The canonical order. To look comes first: ids 0, 0.
  bool before(const NextEvent& e) const {
    if (time != e.time) return time < e.time;
    if (id1 != e.id1) return id1 < e.id1;
    return id2 < e.id2;
  }
};

}  // namespace carom
