// For tests of carom::Simulation: a gas, the methods, and engines.
#pragma once

#include <string>

#include "core/load/scene_file.hpp"
#include "run/engine/make_engine.hpp"

namespace carom::test {

// Gas of two sizes in a box that is periodic along x, with walls above and below.
inline Scene gas(const std::string& method, Count disks = 200) {
  const std::string text = R"(
    [box]
    packing_fraction = 0.3
    left = "periodic"
    right = "periodic"
    [[disks]]
    count = )" + std::to_string(disks) +
                           R"(
    velocities = { maxwell = 1.0 }
    positions = "random"
    radius = { uniform = [0.3, 0.6] }
    mass = { from_radius = 1.0 }
    [run]
    dt = 0.01
    t_end = 3.0
    method = ")" + method + "\"\n";
  return parse_scene(text, "gas.toml", "");
}

inline constexpr const char* methods[] = {"exact", "pairwise", "rollback"};

inline EngineChoice choice(const char* engine = "parallel", int threads = 1) {
  return choose_engine(engine, threads);
}

}  // namespace carom::test
