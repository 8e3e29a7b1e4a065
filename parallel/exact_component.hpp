// A component: disks that meet each other, directly or in a chain, within a slice of a window. It starts from one disk
// that has an event and takes in whom its members meet; everybody else is seen on the path that he has at the start of
// the slice. Many components are solved at the same time by different threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/exact_event.hpp"
#include "core/types.hpp"
#include "parallel/exact_lists.hpp"

namespace carom {

// A path carried back to the window's start, with the velocity it would have there: between two rays time and distance
// need no common start, and gravity cancels. Good for bounds only; PathSegment decides.
struct Ray {
  double x, y;    // length
  double vx, vy;  // length / time
};

inline Ray ray_of(const PathSegment& p, double g) {
  const double vy = p.vy + g * p.start;
  return {p.x - p.vx * p.start, p.y - vy * p.start + 0.5 * g * p.start * p.start, p.vx, vy};
}

// What is known of all disks during a slice, by storage index. Only `owner` changes while components are solved.
struct ExactField {
  ExactRules rules;
  const Disks* disks = nullptr;  // ids, radii, masses
  std::vector<PathSegment> path;
  std::vector<Ray> ray;
  // No event that this disk answers for happens before; each pair is answered for by the one whose path changed last
  // (or both), each disk for its own sides and for leaving its list's range.
  std::vector<double> due;
  std::vector<std::uint32_t> owner;  // handle of the member that this disk is, or nobody
  std::vector<double> last_contact;  // with the TC model
  std::vector<Burst> burst;          // where collapse is possible
  double length = 0.0;               // of the window; time
  double horizon = 0.0;              // events are looked for up to here, beyond the window
  // Up to this v^2 nobody flies so far in a window that images beyond the nearest one, or crossing events, come into
  // play; fastest2 is the largest v^2 so far.
  double safe_speed2 = 0.0;
  double fastest2 = 0.0;
  double slice_start = 0.0;
  double slice_end = 0.0;  // events before this time; in the last slice up to and including `length`

  bool in_slice(double t) const { return t < slice_end && t <= length; }
};

inline constexpr std::uint32_t nobody = 0xffffffffU;

// A handle names a member in the arena of a block of disks.
inline constexpr unsigned member_bits = 22;
inline constexpr std::uint32_t most_arenas = 1U << (32 - member_bits);
inline constexpr std::uint32_t handle_of(std::uint32_t arena, std::uint32_t member) {
  return arena << member_bits | member;
}
inline constexpr std::uint32_t arena_of(std::uint32_t handle) {
  return handle >> member_bits;
}
inline constexpr std::uint32_t member_of(std::uint32_t handle) {
  return handle & ((1U << member_bits) - 1U);
}

// How a disk looks to another one; path is null for one that is left out.
struct Seen {
  const PathSegment* path = nullptr;
  const Ray* ray = nullptr;
  std::uint32_t version = 0;
};

// Neighbours relative to a disk, at the window's start, in columns that the compiler turns into vectors.
struct NeighbourBatch {
  static constexpr std::uint32_t size = 16;
  double dx[size], dy[size];    // length
  double dvx[size], dvy[size];  // length / time
  double reach[size];           // r1 + r2
  double bound[size];           // time
  const PathSegment* path[size];
  std::uint32_t disk[size];
  std::uint32_t version[size];
};

// The earliest event that a disk answers for. `other`: the disk met (storage index), or the disk itself for a side.
struct NextEvent {
  double time = never;
  DiskId id1 = 0, id2 = 0;
  std::uint32_t other = nobody;  // nobody: not looked for yet, but not before `time`
  std::uint32_t other_version = 0;
  double bound = never;  // no event of this disk can come before, rounding of the paths allowed for

  // The canonical order.
  bool before(const NextEvent& e) const {
    if (time != e.time) return time < e.time;
    if (id1 != e.id1) return id1 < e.id1;
    return id2 < e.id2;
  }
};

// A segment that begins with an event.
struct Piece {
  PathSegment path;
  std::uint32_t before;  // the same member's piece before this one, or nobody
  DiskId partner;        // of the event, in the piece of the disk with the smaller id; otherwise nobody
  Impact outcome;
};

struct Member {
  std::uint32_t disk = 0;
  std::uint32_t component = 0;
  std::uint32_t version = 0;  // events so far
  std::uint32_t last_piece = nobody;
  bool gone = false;   // left through a sink
  double due = never;  // bound found by cross checks
  ExactDisk now;
  Burst burst;
  NextEvent next;
};

enum class ComponentStatus : std::uint8_t {
  solved,
  conflict,   // met a disk of another component: to be solved with it
  roams,      // a member leaves the range of its list: to be listed anew
  collapsed,  // solved up to an inelastic collapse
};

struct Component {
  std::uint32_t first, count;  // members
  ComponentStatus status = ComponentStatus::solved;
  DiskId id1 = 0, id2 = 0;  // where it collapsed
  double time = 0.0;
};

// A member whose list holds a disk of another component: to be looked at when both are solved.
struct CrossPair {
  std::uint32_t member;
  std::uint32_t other;  // handle
};

// Components that meet after all.
struct Conflict {
  std::uint32_t a, b;  // handles of members
};

// Where the components that start in one block of disks are kept, during a slice. Cleared, never freed.
struct ComponentArena {
  std::uint32_t number = 0;
  std::vector<Member> members;
  std::vector<Piece> pieces;
  std::vector<Component> components;
  std::vector<CrossPair> cross_pairs;
  std::vector<Conflict> conflicts;
  std::vector<std::uint32_t> roaming;  // disks to be listed anew before they can be looked at

  void clear() {
    members.clear();
    pieces.clear();
    components.clear();
    cross_pairs.clear();
    conflicts.clear();
    roaming.clear();
  }
};

// Solves components into one arena.
class ComponentSolver {
 public:
  ComponentSolver(ExactField& field, const ExactLists& lists, ComponentArena& arena)
      : field_(field), lists_(lists), arena_(arena) {}  // NOLINT(cppcoreguidelines-pro-type-member-init): batch_

  // Disk i is due: if it has an event in the slice, solves the component that grows from it; otherwise puts off its due
  // time. Does nothing for a disk that another component holds.
  void look_at(std::uint32_t i);

  // Solves the component that grows from all these disks, none of which anybody holds; returns its number.
  std::uint32_t solve(const std::vector<std::uint32_t>& disks);

 private:
  template <class Visit>
  NextEvent earliest(std::uint32_t i, const PathSegment& path, Visit&& visit);
  NextEvent earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far) const;
  void meet_exactly(std::uint32_t i, const PathSegment& path, std::uint32_t k, NextEvent& best) const;
  bool add_member(std::uint32_t i);
  Member fresh_member(std::uint32_t i) const;
  void start_over();
  void look_around(std::uint32_t member);
  void run();
  std::uint32_t first_due() const;
  bool take_in(std::uint32_t member, const NextEvent& e);
  void happen(std::uint32_t member, const NextEvent& e);
  void begin_piece(std::uint32_t member, const NextEvent& e, bool counts, const Impact& outcome);
  std::uint32_t handle(std::uint32_t member) const { return handle_of(arena_.number, member); }
  std::uint32_t owner_of(std::uint32_t i) const {
    return std::atomic_ref<std::uint32_t>(field_.owner[i]).load(std::memory_order_seq_cst);
  }
  // A disk's due time is a bound on its next event, which its own block may raise while another component takes the
  // disk in. Whichever of the two bounds that component sees, it finds the same events.
  double due_of(std::uint32_t i) const {
    return std::atomic_ref<double>(field_.due[i]).load(std::memory_order_relaxed);
  }
  bool is_ours(std::uint32_t owner) const {
    return arena_of(owner) == arena_.number && arena_.members[member_of(owner)].component == component_;
  }

  ExactField& field_;
  const ExactLists& lists_;
  ComponentArena& arena_;
  std::uint32_t component_ = 0;
  NeighbourBatch batch_;   // scratch
  Ray member_ray_{};       // scratch
  double clock_ = -never;  // of the last event that happened
};

}  // namespace carom
