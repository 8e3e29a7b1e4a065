// Late collisions that are too few for a warning during the run: at its end they are reported if they exceed their
// share.
#include "core/step/late_collisions.hpp"

#include <gmock/gmock.h>

#include <string>
#include <tuple>
#include <vector>

#include "core/step/engine.hpp"
#include "core/step/validity.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> warnings_on_the_way(Engine& engine, const Scene& scene) {
  while (engine.state().time < scene.run.t_end) engine.step();
  return engine.take_warnings();
}

Scene disks_on_a_line(const std::vector<Override>& changes) {
  return load_scene(CAROM_SOURCE_DIR "/scenes/stability/f16_collapse_three.toml", changes);
}

// Six disks in a row collide with each other in long steps: most of 15 collisions are late, and the energy is three
// times what it should be. They are too few for a warning during the run, but not at the end.
TEST(LateCollisions, FewLateCollisionsAreToldOfAtTheEnd) {
  const auto row = [](const char* method, const char* dt) {
    return disks_on_a_line({{"physics.restitution", "0.3"},
                            {"disks.0.count", "6"},
                            {"disks.0.positions", "[[15, 5], [18, 5.1], [21, 5], [24, 5.1], [27, 5], [30, 5.1]]"},
                            {"disks.0.velocities", "[[1, 0], [0.5, 0], [0.2, 0], [-0.2, 0], [-0.5, 0], [-1, 0]]"},
                            {"run.method", method},
                            {"run.dt", dt},
                            {"run.t_end", "3.6"}});
  };
  const auto told_at_end = [](const Scene& scene) {
    const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 512});
    EXPECT_THAT(warnings_on_the_way(*engine, scene), IsEmpty());
    EXPECT_THAT(validity_warnings_so_far(scene, engine->state()), IsEmpty());
    return few_inaccurate_warnings(scene, engine->state());
  };
  EXPECT_THAT(
      told_at_end(row("pairwise", "0.2")),
      ElementsAre(AllOf(HasSubstr("by time 3.6 "), HasSubstr(" collisions were seen a step late: dt = 0.2 is"))));
}

// Two disks that touch at the start, up to rounding, and hardly move, count as one late collision: this does not show
// that dt is too long.
TEST(LateCollisions, ASingleLateCollisionIsNotToldOf) {
  const Scene scene = disks_on_a_line({{"disks.0.count", "2"},
                                       {"disks.0.positions", "[[3, 5], [4.9999999999999991, 5]]"},
                                       {"disks.0.velocities", "[[1e-9, 0], [-1e-9, 0]]"},
                                       {"run.method", "pairwise"},
                                       {"run.t_end", "1"}});
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 512});
  EXPECT_THAT(warnings_on_the_way(*engine, scene), IsEmpty());
  EXPECT_EQ(engine->state().validity.inaccurate, 1U);
  EXPECT_THAT(few_inaccurate_warnings(scene, engine->state()), IsEmpty());
}

// A disk that crosses a slot in less than a step misses two bounces for each late one: here 16 of 27 are counted.
TEST(LateCollisions, FewLateBouncesAreToldOfAtTheEnd) {
  const auto slot = [](const char* dt) {
    return test::scene_from(R"(
[box]
width = 1.03
height = 20.0
[[disks]]
count = 1
positions = [[0.51, 10.0]]
velocities = [[1.0, 0.01]]
radius = 0.5
mass = 1.0
[run]
method = "pairwise"
t_end = 0.8
)",
                            {{"run.dt", dt}});
  };
  for (const auto& [dt, bounces, said] : {std::tuple{"0.05", Count{16}, true}, std::tuple{"0.01", Count{27}, false}}) {
    const Scene scene = slot(dt);
    const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 512});
    EXPECT_THAT(warnings_on_the_way(*engine, scene), IsEmpty());
    EXPECT_EQ(engine->state().counters.wall_collisions, bounces);
    const std::vector<std::string> told = few_inaccurate_warnings(scene, engine->state());
    if (said) {
      EXPECT_THAT(told, ElementsAre(AllOf(HasSubstr("bounces off walls and obstacles were seen a step late: dt = 0.05"),
                                          HasSubstr("use a smaller dt or run.method = \"exact\""))));
    } else {
      EXPECT_THAT(told, IsEmpty());
    }
  }
}

// Two late collisions are enough if they exceed their share.
TEST(LateCollisions, TwoAreToldOf) {
  const Scene scene = disks_on_a_line({{"run.method", "pairwise"}});
  State state = initial_state(scene);
  state.counters.collisions = 8;
  state.counters.wall_collisions = 1000;  // late bounces are reported separately
  state.validity.inaccurate = 2;
  EXPECT_THAT(few_inaccurate_warnings(scene, state), ElementsAre(HasSubstr("2 of 8 collisions were seen")));
  state.validity.inaccurate = 1;
  EXPECT_THAT(few_inaccurate_warnings(scene, state), IsEmpty());
  state.validity.inaccurate = 2;
  state.validity.inaccurate_told = true;
  EXPECT_THAT(few_inaccurate_warnings(scene, state), IsEmpty());
}

}  // namespace
}  // namespace carom
