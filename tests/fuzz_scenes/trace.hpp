// A record of a run, step by step, for comparing two runs that should be equal.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/step/engine.hpp"

namespace carom::fuzz {

struct Frame {
  double time = 0.0;       // returned by the engine for the frame
  std::uint64_t bits = 0;  // state_hash
  bool operator==(const Frame&) const = default;
};

// The state after a step.
struct Moment {
  double time = 0.0;
  Count collisions = 0;
  std::uint64_t disks = 0;        // state_hash
  std::uint64_t bits = 0;         // a hash of the whole state: counters, loads, warnings, ...
  std::array<Frame, 2> within{};  // the disks at two times within the step
  std::string warnings;
};

struct Trace {
  std::vector<Moment> moments;
  std::string error;      // the error that ended the run; empty if there was none
  bool finished = false;  // the run came to t_end
};

// What is done with an engine between steps; none of it may change a bit.
enum class Handling : std::uint8_t {
  looked_at,   // frames are taken within each step
  left_alone,  // the engine keeps no paths
  released     // its memory is freed from time to time
};

using Look = std::function<void(const State&, const Moment&)>;

// Steps until the end, an error, very many events, or most_steps moments in the trace. look may be empty.
void follow(Engine& engine, const Scene& scene, std::size_t most_steps, Handling handling, Trace& trace,
            const Look& look = {});

std::uint64_t hash_of(const State& state);

// The first difference of two traces, in one line; empty if there is none. Frames are compared if both traces have
// them.
std::string difference(const Trace& expected, const Trace& found);

}  // namespace carom::fuzz
