#include "tests/fuzz_scenes/trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "tests/support/state_bits.hpp"

namespace carom::fuzz {

namespace {

// Times of frames within a step, as shares of it.
constexpr std::array<double, 2> looks{0.3125, 0.75};
constexpr std::size_t release_interval = 3;
// A run is ended after more events than this.
constexpr Count most_events = 100'000;

Moment moment_of(Engine& engine, double before, Handling handling) {
  const State& state = engine.state();
  Moment moment;
  moment.time = state.time;
  moment.collisions = state.counters.collisions;
  moment.disks = state_hash(state.disks);
  moment.bits = hash_of(state);
  if (handling == Handling::looked_at) {
    Disks disks;
    for (std::size_t k = 0; k < looks.size(); ++k) {
      moment.within[k].time = engine.disks_at(before + looks[k] * (state.time - before), disks);
      moment.within[k].bits = state_hash(disks);
    }
  }
  for (const std::string& warning : engine.take_warnings()) moment.warnings += warning + "; ";
  return moment;
}

std::string difference(const Moment& a, const Moment& b) {
  if (a.time != b.time) return fmt::format("time {} instead of {}", b.time, a.time);
  if (a.disks != b.disks) {
    return fmt::format("other disks at t = {}, {} collisions instead of {}", a.time, b.collisions, a.collisions);
  }
  if (a.bits != b.bits) return fmt::format("same disks, but other counts or memory at t = {}", a.time);
  const bool both = a.within[0] != Frame{} && b.within[0] != Frame{};
  if (both && a.within != b.within) {
    return fmt::format("other frames before t = {} (of {} and {} instead of {} and {})", a.time, b.within[0].time,
                       b.within[1].time, a.within[0].time, a.within[1].time);
  }
  if (a.warnings != b.warnings) return fmt::format("warnings [{}] instead of [{}]", b.warnings, a.warnings);
  return "";
}

}  // namespace

std::uint64_t hash_of(const State& state) {
  return std::hash<std::string_view>{}(test::all_bits(state));
}

void follow(Engine& engine, const Scene& scene, std::size_t most_steps, Handling handling, Trace& trace,
            const Look& look) {
  if (handling == Handling::left_alone) engine.forget_paths();
  const Counters& counts = engine.state().counters;
  const auto few = [&] { return counts.collisions + counts.wall_collisions < most_events; };
  while (trace.moments.size() < most_steps && trace.error.empty() && few()) {
    const double before = engine.state().time;
    if (!(before < scene.run.t_end)) break;
    try {
      engine.step();
    } catch (const PhysicsError& error) {
      trace.error = error.what();
    }
    const bool frames = handling == Handling::looked_at && trace.error.empty();
    trace.moments.push_back(moment_of(engine, before, frames ? Handling::looked_at : Handling::left_alone));
    if (look) look(engine.state(), trace.moments.back());
    if (handling == Handling::released && trace.moments.size() % release_interval == 0) engine.release_memory();
  }
  trace.finished = !(engine.state().time < scene.run.t_end);
}

std::string difference(const Trace& expected, const Trace& found) {
  const std::size_t both = std::min(expected.moments.size(), found.moments.size());
  for (std::size_t k = 0; k < both; ++k) {
    const std::string what = difference(expected.moments[k], found.moments[k]);
    if (!what.empty()) return fmt::format("step {}: {}", k + 1, what);
  }
  if (expected.error != found.error) return fmt::format("ended by [{}] instead of [{}]", found.error, expected.error);
  if (expected.moments.size() != found.moments.size()) {
    return fmt::format("{} steps instead of {}", found.moments.size(), expected.moments.size());
  }
  return expected.finished == found.finished ? "" : "did not end where it should";
}

}  // namespace carom::fuzz
