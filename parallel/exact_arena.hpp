// Where a thread keeps the disks whose paths it changes within a slice.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/exact_flight.hpp"

namespace carom {

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

// A segment that begins with an event.
struct Piece {
  PathSegment path;
  std::uint32_t before;  // the same member's piece before this one, or nobody
  DiskId partner;        // of the event, in the piece of the disk with the smaller id; otherwise nobody
  Impact outcome;
};

// A disk that has, or may have, events in the slice.
struct Member {
  std::uint32_t disk = 0;
  std::uint32_t component = 0;
  std::uint32_t next_member = nobody;  // of the same component
  std::uint32_t version = 0;           // events so far
  std::uint32_t last_piece = nobody;
  bool gone = false;     // left through a sink
  bool looked = false;   // next and exit are known
  double exit = never;   // when it leaves its list's range
  double cross = never;  // earliest meeting after the slice that cross checks found
  ExactDisk now;
  Burst burst;
  NextEvent next;
};

enum class ComponentStatus : std::uint8_t {
  solved,
  conflict,   // met a disk of another arena: to be solved with it
  roams,      // a member leaves the range of its list: to be listed anew
  collapsed,  // solved up to an inelastic collapse
};

// Disks that met each other in the slice, directly or in a chain.
struct Component {
  std::uint32_t first, last, count;  // members, chained by next_member
  ComponentStatus status = ComponentStatus::solved;
  DiskId id1 = 0, id2 = 0;  // where it collapsed
  double time = 0.0;
};

// A member whose list holds a disk of another arena: to be looked at when both are solved.
struct CrossPair {
  std::uint32_t member;
  std::uint32_t other;  // handle
};

// Components that meet after all; b may be nobody.
struct Conflict {
  std::uint32_t a, b;  // handles of members
};

// An event in the heap; void once the disk's version is another one.
struct HeapEntry {
  NextEvent event;
  std::uint32_t disk;
  std::uint32_t version;
};

// Cleared for each slice, never freed.
struct ExactArena {
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

}  // namespace carom
