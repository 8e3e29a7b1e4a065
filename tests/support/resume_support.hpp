// Runs that are interrupted and resumed, for tests that compare them with undisturbed ones.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/scene/scene_text.hpp"
#include "core/step/engine.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/feature_scenes.hpp"
#include "tests/support/state_bits.hpp"

namespace carom::test {
// Steps (frames, windows) of a run, unless it ends before.
inline constexpr Count resumed_steps = 12;

inline bool goes_on(const State& state, const Scene& scene, Count steps) {
  return state.time < scene.run.t_end && state.counters.steps < steps;
}

// The engines used in turn: number of threads, 0 for the reference.
inline std::unique_ptr<Engine> make(int threads, const Scene& scene, State state) {
  if (threads == 0) return make_reference_engine(scene, std::move(state));
  return make_parallel_engine(scene, std::move(state), {threads, 512});
}

// The state after a run that was stopped after every second or third step and resumed from a checkpoint: the scene from
// its text, the state from its bytes.
inline State interrupted(const Scene& scene, const State& start, Count steps, int first) {
  constexpr int turns[] = {3, 0, 1, 2, 5};
  RunRecord record;
  record.scene_text = resolved_toml(scene);
  Checkpoint checkpoint{record, start};
  for (int turn = 0; goes_on(checkpoint.state, scene, steps); ++turn) {
    const Scene again = parse_scene(checkpoint.record.scene_text, scene.file, "");
    const auto engine = make(turns[(first + turn) % 5], again, checkpoint.state);
    for (int k = 0; k < 2 + turn % 2 && goes_on(engine->state(), again, steps); ++k) engine->step();
    checkpoint = decode_checkpoint(encode_checkpoint(record, engine->state()), "checkpoint");
  }
  return checkpoint.state;
}

inline void expect_same_bits(const Scene& scene, const State& start, Count steps, int first) {
  const auto engine = make_reference_engine(scene, start);
  while (goes_on(engine->state(), scene, steps)) engine->step();
  EXPECT_EQ(all_bits(interrupted(scene, start, steps, first)), all_bits(engine->state()));
}

// One in `stride` of all combinations of features, for a method and a kind of sides, from the offset-th on.
inline void expect_same_bits(const std::string& method, const std::string& sides, std::size_t offset,
                             std::size_t stride) {
  const std::vector<Features> all = all_features(method, sides);
  for (std::size_t k = offset; k < all.size(); k += stride) {
    SCOPED_TRACE(all[k].name());
    Scene scene = feature_scene(all[k], static_cast<int>(resumed_steps));
    if (method == "exact") scene.physics.collapse_contact_time = 1e-3;
    expect_same_bits(scene, initial_state(scene), resumed_steps, static_cast<int>(k));
    if (::testing::Test::HasFailure()) return;
  }
}

// Runs `steps` steps of the reference, and expects the same bits from the engine on any number of threads. Returns the
// state.
inline State expect_bits_of_reference(const Scene& scene, const State& start, Count steps) {
  const auto reference = make_reference_engine(scene, start);
  while (goes_on(reference->state(), scene, steps)) reference->step();
  const std::string expected = all_bits(reference->state());
  for (const int threads : {1, 2, 3, 5, 8}) {
    const auto engine = make_parallel_engine(scene, start, {threads, 512});
    while (goes_on(engine->state(), scene, steps)) engine->step();
    EXPECT_EQ(all_bits(engine->state()), expected) << threads << " threads";
  }
  return reference->state();
}

}  // namespace carom::test
