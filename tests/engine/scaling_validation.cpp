// All scenes of scenes/ in other units: the same bits, scaled.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/load/scene_file.hpp"
#include "core/start/growth.hpp"
#include "tests/support/run_in_all_units.hpp"

namespace carom {
namespace {

using test::expect_same_in_all_units;

// The first hundred steps of each scene, as in its file.
TEST(Scaling, ScenesOfTheFolder) {
  int run = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CAROM_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    Scene scene = load_scene(entry.path().string());
    if (scene.groups.empty() || scene.groups[0].count > 1000 || scene.run.dt == 0.0) continue;
    // Disks are grown anew for each method and unit, which is slow with the address sanitizer.
    if (grows(scene)) scene = load_scene(entry.path().string(), {{"disks.0.count", "100"}});
    for (Method method : test::stepping_methods) {
      scene.run.method = method;
      scene.run.t_end = 100.0 * scene.run.dt;
      expect_same_in_all_units(scene);
      ++run;
    }
  }
  EXPECT_GE(run, 10) << "at least five scenes, by two methods";
}

}  // namespace
}  // namespace carom
