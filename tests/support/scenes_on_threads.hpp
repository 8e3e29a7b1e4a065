// Compares the engine with the reference on a scene of scenes/.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/thread_counts.hpp"

namespace carom::test {

// A window of exact has about two collisions a disk, so that many disks need fewer.
inline int steps_of(const Scene& scene, const State& start, int steps) {
  constexpr int disk_windows = 100'000;
  const int disks = static_cast<int>(start.disks.size());
  return scene.run.method == Method::exact ? std::clamp(disk_windows / std::max(disks, 1), std::min(40, steps), steps)
                                           : steps;
}

// Their names.
inline std::vector<std::string> scene_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(CAROM_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path().stem().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The scene as it stands, but with at most a few thousand disks and by the method given.
inline Scene short_scene(const std::string& name, const std::string& method) {
  std::vector<Override> changes{{"run.method", method}};
  if (name == "analysis") changes.push_back({"disks.0.count", "400"});
  if (name == "hopper") changes.push_back({"disks.0.count", "150"});
  if (name == "gas_million") changes.push_back({"disks.0.count", "2000"});
  if (name == "tracer_in_bath") changes.push_back({"disks.0.count", "1500"});
  if (name == "dense_mixture") changes.push_back({"disks.0.count", "200"});  // grown anew for each method
  if (name == "lorentz_gas" && method != "exact") {
    changes.push_back({"disks.1.radius", "0.02"});
    changes.push_back({"disks.1.count", "200"});
    changes.push_back({"run.dt", "0.005"});
  }
  if (method == "exact" && name != "couette")
    changes.push_back({"physics.collapse", "{ model = \"tc\", contact_time = 1e-3 }"});
  return load_scene(CAROM_SOURCE_DIR "/scenes/" + name + ".toml", changes);
}

inline std::vector<std::uint64_t> hashes(Engine& engine, int steps) {
  std::vector<std::uint64_t> all;
  for (int k = 0; k < steps; ++k) {
    engine.step();
    all.push_back(state_hash(engine.state().disks));
  }
  return all;
}

// With all methods, on 1, 2, 3, 5 and 8 threads, and the same run twice; at most most_steps steps.
inline void expect_engine_equals_reference(const std::string& name, int most_steps) {
  for (const char* method : {"pairwise", "rollback", "exact"}) {
    const Scene scene = short_scene(name, method);
    const State start = initial_state(scene);
    const int steps = steps_of(scene, start, most_steps);
    const std::vector<std::uint64_t> expected = hashes(*make_reference_engine(scene, start), steps);
    for (const int threads : thread_counts) {
      SCOPED_TRACE(std::string(method) + " on " + std::to_string(threads) + " threads");
      ASSERT_EQ(expected, hashes(*make_parallel_engine(scene, start, {threads, 256}), steps));
    }
    EXPECT_EQ(expected, hashes(*make_parallel_engine(scene, start, {2, 1}), steps))
        << "a repeated run, blocks as usual";
  }
}

}  // namespace carom::test
