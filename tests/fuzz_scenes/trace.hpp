// What a run did, step by step, so that two runs that should be the same can be compared.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/step/engine.hpp"

namespace carom::fuzz {

struct Frame {
  double time = 0.0;       // that the engine gave it for
  std::uint64_t bits = 0;  // state_hash
  bool operator==(const Frame&) const = default;
};

// After a step.
struct Moment {
  double time = 0.0;
  Count collisions = 0;
  std::uint64_t disks = 0;        // state_hash
  std::uint64_t bits = 0;         // a hash of all that the state is: counters, loads, what was warned of, ...
  std::array<Frame, 2> within{};  // the disks at two times within the step
  std::string warnings;
};

struct Trace {
  std::vector<Moment> moments;
  std::string error;      // that ended it; empty if none
  bool finished = false;  // it came to t_end
};

// What is done to an engine between steps. None of it may change a bit.
enum class Handling : std::uint8_t {
  looked_at,   // frames are taken within each step
  left_alone,  // it keeps no paths
  released     // its memory is taken away now and then
};

using Look = std::function<void(const State&, const Moment&)>;

// Steps until the end, an error, very many events, or most_steps moments in the trace. look may be empty.
void follow(Engine& engine, const Scene& scene, std::size_t most_steps, Handling handling, Trace& trace,
            const Look& look = {});

std::uint64_t hash_of(const State& state);

// Where they part, in one line; empty if they do not. Frames are compared where both have them.
std::string difference(const Trace& expected, const Trace& found);

}  // namespace carom::fuzz
