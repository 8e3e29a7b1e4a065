// A state in pieces: for one rank of several, which must not hold all disks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "core/disks/state.hpp"

namespace carom {

// The lists of a state that grow with the number of disks.
enum class StateList : std::uint8_t { x, y, vx, vy, id, radius, mass, spin, loads, last_contact, thermal_hits };
inline constexpr std::array all_state_lists{
    StateList::x,           StateList::y,    StateList::vx,   StateList::vy,    StateList::id,
    StateList::radius,      StateList::mass, StateList::spin, StateList::loads, StateList::last_contact,
    StateList::thermal_hits};

// Calls use() with the vector of that name.
template <class Use>
decltype(auto) with_list(const State& state, StateList list, Use&& use) {
  const Disks& d = state.disks;
  switch (list) {
    case StateList::x:
      return use(d.x);
    case StateList::y:
      return use(d.y);
    case StateList::vx:
      return use(d.vx);
    case StateList::vy:
      return use(d.vy);
    case StateList::id:
      return use(d.id);
    case StateList::radius:
      return use(d.radius);
    case StateList::mass:
      return use(d.mass);
    case StateList::spin:
      return use(d.spin);
    case StateList::loads:
      return use(state.loads);
    case StateList::last_contact:
      return use(state.last_contact);
    case StateList::thermal_hits:
      break;
  }
  return use(state.thermal_hits);
}

// Bytes of an entry in memory.
inline std::size_t entry_bytes(StateList list) {
  return with_list(State{}, list, [](const auto& values) { return sizeof(values[0]); });
}

class StatePieces {
 public:
  using Use = std::function<void(std::span<const std::byte>)>;

  StatePieces() = default;
  StatePieces(const StatePieces&) = delete;
  StatePieces& operator=(const StatePieces&) = delete;
  virtual ~StatePieces() = default;

  // The state, whose lists may be those of a part of the disks only.
  virtual const State& part() const = 0;

  // How many entries a list has.
  virtual Count entries(StateList list) const = 0;

  // Calls use() with the bytes of a list's entries in order, many at a time. All lists have the disks in the same
  // order. An exception thrown by use() ends the visit and does no harm.
  virtual void visit(StateList list, const Use& use) const = 0;
};

// A state that is all in this program. It must outlive this object.
class WholeState final : public StatePieces {
 public:
  explicit WholeState(const State& state) : state_(state) {}

  const State& part() const override { return state_; }
  Count entries(StateList list) const override {
    return with_list(state_, list, [](const auto& values) { return Count{values.size()}; });
  }
  void visit(StateList list, const Use& use) const override {
    with_list(state_, list, [&use](const auto& values) { use(std::as_bytes(std::span(values))); });
  }

 private:
  const State& state_;
};

}  // namespace carom
