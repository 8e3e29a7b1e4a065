// One disk in a window of the exact engine: its present path and its next event.
#pragma once

#include <cstdint>

#include "core/base/types.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/exact_path.hpp"

namespace carom {

// The partner of a disk's next event, in 32 bits: another disk; a side of the box (a wall, a sink, or a periodic side);
// an obstacle; `relist`, if the disk has to be relisted; or `none`, if its events have to be predicted again.
class Partner {
 public:
  constexpr Partner() = default;  // none
  static constexpr Partner none() { return {}; }
  static constexpr Partner relist() { return Partner(relist_bits); }
  static constexpr Partner wall(Side side) { return Partner(wall_partner(side)); }
  // By its place in State::obstacles.
  static constexpr Partner obstacle(std::uint32_t place) { return Partner(obstacle_partner(place)); }
  // By storage index, below first_obstacle_partner.
  static constexpr Partner disk(std::uint32_t index) { return Partner(index); }

  constexpr bool is_disk() const { return bits_ < first_obstacle_partner; }
  constexpr bool is_wall() const { return bits_ - first_wall_partner < 4; }
  constexpr bool is_obstacle() const { return carom::is_obstacle(bits_); }
  constexpr bool is_relist() const { return bits_ == relist_bits; }
  constexpr bool is_none() const { return bits_ == none_bits; }
  constexpr bool is_contact() const { return bits_ < relist_bits; }  // with a disk, a wall or an obstacle

  // Is it the disk of this index?
  constexpr bool is(std::uint32_t index) const { return bits_ == index; }
  // Of a disk.
  constexpr std::uint32_t index() const { return bits_; }
  // The side of a wall; the place of an obstacle; for both, their partner id in events.
  constexpr Side side() const { return wall_side(bits_); }
  constexpr std::uint32_t place() const { return obstacle_of(bits_); }
  constexpr DiskId wall_id() const { return bits_; }

 private:
  static constexpr std::uint32_t relist_bits = 0xfffffffeU;
  static constexpr std::uint32_t none_bits = 0xffffffffU;
  explicit constexpr Partner(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = none_bits;
};
static_assert(Partner().is_none() && !Partner::none().is_contact() && !Partner::none().is_wall());
static_assert(Partner::relist().is_relist() && !Partner::relist().is_contact() && !Partner::relist().is_wall());
static_assert(Partner::wall(Side::top).is_wall() && !Partner::wall(Side::top).is_disk());
static_assert(Partner::disk(first_obstacle_partner - 1).is_disk());
static_assert(Partner::obstacle(0).is_obstacle() && !Partner::obstacle(0).is_disk() && !Partner::obstacle(0).is_wall());
static_assert(Partner::obstacle(0).is_contact() && !Partner::wall(Side::left).is_obstacle());

// With regions: the time up to which a disk's motion is known in the present slice, in 32 bits. For an active disk it
// is that of the events processed; for a disk at a border, the slice's start; for a blocked disk its safe time within
// the slice, which is in its BlockedDisk (worker.hpp). A disk also has marks.
class DiskProgress {
 public:
  enum Mark : std::uint32_t {
    at_border = 1,                 // lists a disk of another region
    lists_border = 2,              // lists a disk that is at a border
    has_unresolved_neighbour = 4,  // possibly has a neighbour that is at a border, or blocked in this slice
    relists_late = 8,              // must be relisted at the end of the slice
    ghost = 16                     // belongs to another rank, which counts its events
  };
  // The same bits if each thread has a part of the box with a halo (HaloPart): there, `ghost` marks the disks of the
  // halo.
  enum HaloMark : std::uint32_t {
    met_own = 1  // a ghost that a disk of the part has met in the window
  };

  constexpr DiskProgress() = default;  // active
  constexpr bool is_active() const { return state() == active_state; }
  constexpr bool is_border() const { return state() == border_state; }
  constexpr bool is_blocked() const { return state() < border_state; }
  // Of a blocked disk: the number of its BlockedDisk.
  constexpr std::uint32_t blocked() const { return state(); }
  constexpr void set_active() { set_state(active_state); }
  constexpr void set_border() { set_state(border_state); }
  constexpr void set_blocked(std::uint32_t number) { set_state(number); }

  constexpr bool has(Mark mark) const { return (bits_ & mark) != 0; }
  constexpr void set(Mark mark) { bits_ |= mark; }
  // Is the disk at a border, or a neighbour of one that is?
  constexpr bool is_near_border() const { return (bits_ & (at_border | lists_border)) != 0; }
  constexpr void clear(Mark mark) { bits_ &= ~static_cast<std::uint32_t>(mark); }
  constexpr bool has(HaloMark mark) const { return (bits_ & mark) != 0; }
  constexpr void set(HaloMark mark) { bits_ |= mark; }
  constexpr void clear(HaloMark mark) { bits_ &= ~static_cast<std::uint32_t>(mark); }

 private:
  static constexpr std::uint32_t mark_bits = 5;
  static constexpr std::uint32_t marks = (1U << mark_bits) - 1U;
  static constexpr std::uint32_t active_state = 0xffffffffU >> mark_bits;
  static constexpr std::uint32_t border_state = active_state - 1;
  constexpr std::uint32_t state() const { return bits_ >> mark_bits; }
  constexpr void set_state(std::uint32_t state) { bits_ = state << mark_bits | (bits_ & marks); }
  std::uint32_t bits_ = active_state << mark_bits;
};
static_assert(sizeof(DiskProgress) == 4 && DiskProgress().is_active() && !DiskProgress().is_blocked());

// The data of a disk that a prediction reads, in one cache line.
struct alignas(64) DiskRecord {
  PathSegment path;
  double radius = 0.0;
  DiskId id = 0;
  Partner partner;                    // of the next event
  std::uint16_t version = 0;          // segments begun in the window
  std::uint16_t partner_version = 0;  // of the partner when the event was predicted
  DiskProgress progress;
};
static_assert(sizeof(DiskRecord) == 64);

}  // namespace carom
