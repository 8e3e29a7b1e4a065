// Makes scenes and states for the tests of the exact method, and runs its engines.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <string>

#include "core/base/check.hpp"
#include "core/disks/state.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/reference/reference_exact.hpp"
#include "core/scene/scene.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom::exact_tests {

struct SceneText {
  double width = 10.0, height = 10.0;
  std::string sides = "wall";  // of all four; or whole lines for [box]
  std::string physics;         // lines of [physics]
  std::string disks;           // [[disks]] and [[sources]] tables
  double t_end = 1.0;
  std::string run;  // further lines of [run]
};

// A [[disks]] table of so many at random places; rest: its further lines, as those below.
inline std::string random_disks(int count, const std::string& rest) {
  return "[[disks]]\ncount = " + std::to_string(count) + "\npositions = \"random\"\n" + rest + "\n";
}
inline const std::string equal_disks = "velocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1.0";
inline const std::string mixed_disks =
    "velocities = { uniform = 2.0 }\nradius = { uniform = [0.1, 0.9] }\nmass = { uniform = [1, 40] }";

inline Scene make_scene(const SceneText& s) {
  std::string text = "[box]\nwidth = " + std::to_string(s.width) + "\nheight = " + std::to_string(s.height) + "\n";
  if (s.sides.find('=') != std::string::npos) {
    text += s.sides + "\n";
  } else {
    for (const char* side : {"left", "right", "bottom", "top"}) text += std::string(side) + " = \"" + s.sides + "\"\n";
  }
  text += "[physics]\n" + s.physics + "\n" + s.disks +
          "\n[run]\nmethod = \"exact\"\nt_end = " + std::to_string(s.t_end) + "\n" + s.run + "\n";
  return parse_scene(text, "test", ".");
}

// A box and disks given one by one; nothing else.
inline Scene plain_scene(const Domain& box, double t_end, double gravity = 0.0, double restitution = 1.0) {
  Scene scene;
  scene.box = box;
  scene.physics.gravity = gravity;
  scene.physics.restitution = restitution;
  scene.run.method = Method::exact;
  scene.run.t_end = t_end;
  return scene;
}

using test::state_of;

inline void run_to_end(Engine& engine, const Scene& scene) {
  while (engine.state().time < scene.run.t_end) engine.step();
}

inline State run_reference(const Scene& scene, State initial, double window_scale = 1.0) {
  const auto engine = make_reference_exact(scene, std::move(initial), window_scale);
  run_to_end(*engine, scene);
  return engine->state();
}

// All bits of a state, as text.
inline std::string fingerprint(const State& s) {
  const Counters& c = s.counters;
  return fmt::format(
      "{} t {} n {} steps {} collisions {} walls {} removed {} emitted {} waiting {} virial {} sides {} {} {} {} heat "
      "{} shear {} {}",
      hash_text(state_hash(s.disks)), s.time, s.disks.size(), c.steps, c.collisions, c.wall_collisions, c.removed,
      c.emitted, c.waiting, c.virial, c.wall_impulse[0], c.wall_impulse[1], c.wall_impulse[2], c.wall_impulse[3],
      fmt::join(c.side_energy, " "), c.shear_virial, c.shear_work);
}

// Entry of the disk with this id.
inline std::size_t index_of(const Disks& d, DiskId id) {
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (d.id[i] == id) return i;
  }
  ADD_FAILURE() << "no disk " << id;
  return 0;
}

}  // namespace carom::exact_tests
