// One disk in a window of the exact engine: its present path and its next event.
#pragma once

#include <cstdint>

#include "core/base/types.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/exact_path.hpp"

namespace carom {

// What a disk's next event is with: another disk, a side of the box (a wall, a sink, or a periodic side that it
// crosses), its own neighbour list, which is due to be renewed, or nothing, so that its events are to be predicted
// again. 32 bits.
class Partner {
 public:
  constexpr Partner() = default;  // none
  static constexpr Partner none() { return {}; }
  static constexpr Partner relist() { return Partner(relist_bits); }
  static constexpr Partner wall(Side side) { return Partner(wall_partner(side)); }
  // By storage index, below first_wall_partner.
  static constexpr Partner disk(std::uint32_t index) { return Partner(index); }

  constexpr bool is_disk() const { return bits_ < first_wall_partner; }
  constexpr bool is_wall() const { return bits_ - first_wall_partner < 4; }
  constexpr bool is_relist() const { return bits_ == relist_bits; }
  constexpr bool is_none() const { return bits_ == none_bits; }
  constexpr bool is_contact() const { return bits_ < relist_bits; }  // with a disk or a wall

  // Of a disk.
  constexpr std::uint32_t index() const { return bits_; }
  // Of a wall: its side, and the id that stands for it in events.
  constexpr Side side() const { return wall_side(bits_); }
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
static_assert(Partner::disk(first_wall_partner - 1).is_disk());

// What a prediction reads of a disk, in one cache line.
struct alignas(64) DiskRecord {
  PathSegment path;
  double radius = 0.0;
  DiskId id = 0;
  Partner partner;                    // of the next event
  std::uint32_t version = 0;          // segments begun in the window
  std::uint32_t partner_version = 0;  // of the partner's path that the event was predicted on
};
static_assert(sizeof(DiskRecord) == 64);

}  // namespace carom
