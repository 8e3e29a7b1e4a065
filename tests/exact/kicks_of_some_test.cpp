// In an exact run Andersen's thermostat kicks some disks, and predictions for the others are kept: the bits must be
// those of an engine that predicts all disks anew.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/disks/state_hash.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

struct Gas {
  int disks = 300;
  std::string radius = "0.5";
  std::string physics = "";
  std::string sides = "periodic";
  double share = 0.1;  // of the disks chosen by a kick
};

constexpr double dt = 0.02;

Scene scene_of(const Gas& gas) {
  const double side = std::sqrt(gas.disks * 3.0);
  const std::string thermostat = fmt::format(
      "\nthermostat = {{ kind = \"andersen\", temperature = 2.0, rate = {}, dt = {} }}", gas.share / dt, dt);
  const std::string disk = "velocities = { maxwell = 1.0 }\nmass = 1.0\nradius = " + gas.radius;
  return make_scene({side, side, gas.sides, gas.physics + thermostat, random_disks(gas.disks, disk), 1000.0, ""});
}

void expect_same(const Engine& engine, const Engine& other, int kick) {
  ASSERT_EQ(engine.state().time, other.state().time);
  ASSERT_EQ(state_hash(engine.state().disks), state_hash(other.state().disks)) << "kick " << kick;
}

TEST(KicksOfSome, HaveTheReferencesBits) {
  const Gas gases[] = {{},
                       {.disks = 20},
                       {.radius = "{ uniform = [0.2, 0.6] }"},
                       {.physics = "gravity = 1.0\nrestitution = 0.9", .sides = "wall"},
                       {.physics = "roughness = { tangential_restitution = 0.5, friction = 0.3 }"},
                       {.share = 0.45},
                       {.share = 0.6}};
  for (const Gas& gas : gases) {
    const Scene scene = scene_of(gas);
    const State start = initial_state(scene);
    const auto reference = make_reference_engine(scene, start);
    const auto one = make_parallel_engine(scene, start, {1});
    const auto three = make_parallel_engine(scene, start, {3, 256});
    for (int kick = 0; kick < 150; ++kick) {
      for (Engine* engine : {reference.get(), one.get(), three.get()}) engine->step();
      expect_same(*one, *reference, kick);
      expect_same(*three, *reference, kick);
    }
    EXPECT_GT(reference->state().counters.collisions, 10U);
  }
}

// Many of the disks are in the halo of the other part.
TEST(KicksOfSome, InPartsHaveTheBitsOfOneQueue) {
  const Scene scene = scene_of({.disks = 6000, .share = 0.05});
  const State start = initial_state(scene);
  const auto one_queue = make_parallel_engine(scene, start, {1});
  const auto in_parts = make_parallel_engine(scene, start, {2});
  const auto in_three = make_parallel_engine(scene, start, {3, 8});
  for (int kick = 0; kick < 40; ++kick) {
    for (Engine* engine : {one_queue.get(), in_parts.get(), in_three.get()}) engine->step();
    expect_same(*in_parts, *one_queue, kick);
    expect_same(*in_three, *one_queue, kick);
  }
  EXPECT_GT(one_queue->state().counters.collisions, 1000U);
}

}  // namespace
}  // namespace carom::exact_tests
