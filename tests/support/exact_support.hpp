// Building scenes and states for the tests of the exact method, and driving its engines.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/reference/reference_exact.hpp"
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

// Entry of the disk with this id.
inline std::size_t index_of(const Disks& d, DiskId id) {
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (d.id[i] == id) return i;
  }
  ADD_FAILURE() << "no disk " << id;
  return 0;
}

}  // namespace carom::exact_tests
