// Shared by the functions of carom.h: the world behind a handle, and the conversion of exceptions to a status and a
// text.
#pragma once

#include <carom/carom.h>
#include <fmt/format.h>

#include <cstddef>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "run/simulation/simulation.hpp"

// The text of an error is mutable: functions with a const world may set it, too.
struct carom_world {
  std::optional<carom::Simulation> simulation;  // absent if it could not be made
  mutable std::string error;
  std::vector<std::string> warnings;  // not taken yet, in reverse order
  std::string warning;
};

namespace carom {

inline constexpr const char* no_world = "the world is a null pointer";
inline constexpr const char* never_made = "the world could not be made";
inline constexpr const char* no_memory = "out of memory";

inline carom_status fail(const carom_world* world, carom_status status, const char* what) {
  try {
    world->error = one_line(what);  // the text of a program's own exception may have several lines
  } catch (const std::bad_alloc&) {
    world->error.clear();
  }
  return status;
}

inline carom_status fail(const carom_world* world, const char* what) {
  return fail(world, CAROM_INPUT, what);
}

// Returns the status of work(), or that of an exception thrown by it.
template <class Work>
carom_status guarded(const carom_world* world, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    return fail(world, CAROM_INPUT, error.what());
  } catch (const PhysicsError& error) {
    return fail(world, CAROM_PHYSICS, error.what());
  } catch (const std::bad_alloc&) {
    return fail(world, CAROM_FAILED, no_memory);
  } catch (const std::length_error&) {
    return fail(world, CAROM_FAILED, no_memory);
  } catch (const std::exception& error) {
    return fail(world, CAROM_FAILED, error.what());
  } catch (...) {
    return fail(world, CAROM_FAILED, "failed");
  }
}

// Calls work(simulation) for a world that exists, even if its state is lost.
template <class World, class Work>
carom_status with_any(World* world, Work&& work) {
  if (world == nullptr) return CAROM_INPUT;
  if (!world->simulation) return fail(world, never_made);
  return guarded(world, [&] { return work(*world->simulation); });
}

// The same, but an error if the world's state is lost.
template <class World, class Work>
carom_status with(World* world, Work&& work) {
  return with_any(world, [&](auto& simulation) {
    simulation.check_not_lost();
    return work(simulation);
  });
}

// value(simulation) if the world exists and has a state, else 0. Precondition: value() does not throw.
template <class Value>
auto value_of(const carom_world* world, Value&& value) noexcept {
  using Result = decltype(value(*world->simulation));
  return world != nullptr && world->simulation && !world->simulation->lost() ? value(*world->simulation) : Result{};
}

inline void check_pointer(const void* pointer, const char* name) {
  if (pointer == nullptr) throw InputError(fmt::format("{} is a null pointer", name));
}

inline void check_room(std::size_t room, std::size_t count, const char* what = "disk") {
  if (room < count)
    throw InputError(fmt::format("the array has room for {}, and there are {}", counted(room, what), count));
}

}  // namespace carom
