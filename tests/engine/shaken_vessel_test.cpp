// A shaken vessel with walls inside: floor, lid, shelf and partition vibrate in step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/engine_run.hpp"

namespace carom {
namespace {

// Floor and lid are 19 apart; a partition at x = 8 goes from one to the other, and a shelf from it to the right side.
std::string vessel(const char* shape) {
  const std::string motion = fmt::format("vibrate = [0, 0.5], period = 2, shape = \"{}\"", shape);
  return fmt::format(
      "[box]\nwidth = 20.0\nheight = 20.0\nbottom = {{ place = 0.5, motion = {{ {0} }} }}\n"
      "top = {{ place = 19.5, motion = {{ {0} }} }}\n"
      "[[walls]]\npoints = [[8, 0.5], [8, 19.5]]\nmotion = {{ {0} }}\n"
      "[[walls]]\npoints = [[8, 10], [20, 10]]\nmotion = {{ {0} }}\n",
      motion);
}

Scene scene_in(const std::string& vessel, const std::string& rest, const char* method, double t_end) {
  return parse_scene(fmt::format("{}{}[run]\nmethod = \"{}\"\ndt = 0.002\nt_end = {}\n", vessel, rest, method, t_end),
                     "vessel.toml", "");
}

constexpr const char* gas =
    "[[disks]]\ncount = 60\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.3\nmass = 1.0\n";

// The numbers of disks left of the partition, and right of it below and above the shelf.
std::array<std::size_t, 3> in_compartments(const State& state) {
  const double shelf = 10.0 + (state.time > 0.0 ? 0.5 : 0.0);  // no disk is closer to it than its radius
  std::array<std::size_t, 3> counts{};
  for (std::size_t i = 0; i < state.disks.size(); ++i) {
    counts[state.disks.x[i] < 8.0 ? 0 : state.disks.y[i] < shelf ? 1 : 2] += 1;
  }
  return counts;
}

// After two and a quarter periods everything is up by half a unit of length.
TEST(ShakenVessel, KeepsTheDisksInTheirCompartments) {
  for (const char* shape : {"parabola", "sine"}) {
    for (const char* method : {"exact", "pairwise"}) {
      SCOPED_TRACE(fmt::format("{} {}", shape, method));
      const Scene scene = scene_in(vessel(shape), gas, method, 4.5);
      const State start = initial_state(scene);
      const std::array<std::size_t, 3> counts = in_compartments(start);
      EXPECT_GT(*std::min_element(counts.begin(), counts.end()), 0U);
      const State end = test::run_by_engine(scene, start);
      EXPECT_DOUBLE_EQ(end.time, 4.5);
      EXPECT_EQ(in_compartments(end), counts);
      EXPECT_GT(end.counters.wall_collisions, 40U);
    }
  }
}

// The energy gained is the work of floor, lid and walls together.
TEST(ShakenVessel, DoesTheWorkThatIsGainedWithTheBitsOfTheReference) {
  for (const char* shape : {"parabola", "sine"}) {
    SCOPED_TRACE(shape);
    const Scene scene = scene_in(vessel(shape), gas, "exact", 6.0);
    const State start = initial_state(scene);
    const auto reference = make_reference_engine(scene, start);
    while (reference->state().time < scene.run.t_end) reference->step();
    const State end = test::run_by_engine(scene, start);
    EXPECT_EQ(state_hash(end.disks), state_hash(reference->state().disks));
    const double gained = energy_of(end.disks, {}).kinetic - energy_of(start.disks, {}).kinetic;
    EXPECT_NEAR(gained, end.counters.wall_work + test::energy_from_sides(end), 1e-10);
    EXPECT_NE(gained, 0.0);
  }
}

}  // namespace
}  // namespace carom
