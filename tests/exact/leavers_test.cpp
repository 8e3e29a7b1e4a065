// Disks that leave an exact run through sinks stay in the lists until the next window starts, since frames of the last
// window need them. The bits must be those of the reference, also in such frames, and if a program changes disks
// between two windows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "core/physics/contact_event.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/edit.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

constexpr double side = 60.0;
constexpr std::size_t disks_at_start = 800;

Scene leaking_gas(const std::string& radius, const std::string& physics = "", double t_end = 20.0,
                  const std::string& run = "") {
  return make_scene({side, side, "sink", physics,
                     "[[disks]]\ncount = " + std::to_string(disks_at_start) +
                         "\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nmass = 1.0\nradius = " + radius +
                         "\n",
                     t_end, run});
}

using Met = std::tuple<DiskId, DiskId, double>;

std::vector<Met> sorted_contacts(const Engine& engine) {
  std::vector<Met> met;
  for (const DiskContact& c : engine.contacts()) met.emplace_back(c.id1, c.id2, c.time);
  std::sort(met.begin(), met.end());
  return met;
}

// Compares, after a step, the states, the disks in the middle of the step, and the pairs that met in it.
void expect_same(const Engine& engine, const Engine& reference, double start) {
  ASSERT_EQ(engine.state().time, reference.state().time);
  ASSERT_EQ(state_hash(engine.state().disks), state_hash(reference.state().disks)) << "at t = " << start;
  ASSERT_EQ(engine.state().counters.removed, reference.state().counters.removed);
  Disks ours, theirs;
  const double middle = 0.5 * (start + reference.state().time);
  ASSERT_EQ(engine.disks_at(middle, ours), reference.disks_at(middle, theirs));
  ASSERT_EQ(state_hash(ours), state_hash(theirs)) << "at t = " << middle;
  ASSERT_EQ(sorted_contacts(engine), sorted_contacts(reference));
}

// A search must find every disk near a place, unless the engine has no cells at hand.
void expect_found(Engine& engine, Vec2 place) {
  constexpr double reach = 3.0;
  const Disks& d = engine.state().disks;
  std::vector<unsigned char> seen(d.size(), 0);
  const bool looked = engine.visit_near(place, reach, reach, [&](std::size_t i) { seen.at(i) = 1; });
  for (std::size_t i = 0; looked && i < d.size(); ++i) {
    const bool near = std::abs(d.x[i] - place.x) <= reach && std::abs(d.y[i] - place.y) <= reach;
    EXPECT_TRUE(!near || seen[i] == 1) << "disk " << d.id[i];
  }
}

void expect_bits_of_reference(const Scene& scene, std::size_t most_left) {
  const auto reference = make_reference_engine(scene, initial_state(scene));
  const auto one = make_parallel_engine(scene, initial_state(scene), {1});
  const auto three = make_parallel_engine(scene, initial_state(scene), {3, 64});
  while (reference->state().time < scene.run.t_end) {
    const double start = reference->state().time;
    for (Engine* engine : {reference.get(), one.get(), three.get()}) engine->step();
    for (Engine* engine : {one.get(), three.get()}) {
      ASSERT_NO_FATAL_FAILURE(expect_same(*engine, *reference, start));
      expect_found(*engine, {0.9 * side, 0.5 * side});
    }
  }
  EXPECT_LE(reference->state().disks.size(), most_left);
  EXPECT_EQ(one->state().counters.collisions, reference->state().counters.collisions);
}

TEST(Leavers, HaveTheReferencesBits) {
  expect_bits_of_reference(leaking_gas("0.5"), disks_at_start / 2);
}

TEST(Leavers, HaveTheReferencesBitsWhateverTheirRadii) {
  expect_bits_of_reference(leaking_gas("{ choice = [0.1, 0.4, 1.3], weights = [20, 20, 1] }"), disks_at_start / 2);
}

TEST(Leavers, HaveTheReferencesBitsWhereBrownianIntervalsBegin) {
  expect_bits_of_reference(leaking_gas("0.5", "diffusion = 1.0\n", 4.0, "dt = 0.05\n"), disks_at_start - 100);
}

// When the lists are freed, the record of disks that left goes with them.
TEST(Leavers, HaveTheReferencesBitsWhereMemoryIsGivenBackBetweenWindows) {
  const Scene scene = leaking_gas("0.5", "", 6.0);
  const auto reference = make_reference_engine(scene, initial_state(scene));
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1});
  for (int window = 0; reference->state().time < scene.run.t_end; ++window) {
    const double start = reference->state().time;
    reference->step();
    engine->step();
    ASSERT_NO_FATAL_FAILURE(expect_same(*engine, *reference, start));
    if (window % 2 == 1) engine->release_memory();
  }
  EXPECT_GT(engine->state().counters.removed, 50U);
}

// For the reference each change makes a new engine from the changed state.
TEST(Leavers, MayBeChangedAroundBetweenWindows) {
  const Scene scene = leaking_gas("0.5");
  auto reference = make_reference_engine(scene, initial_state(scene));
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1});
  const auto change = [&](Edit edit, DiskId id) {
    const auto index_in = [id](const Disks& d) {
      return static_cast<std::size_t>(std::find(d.id.begin(), d.id.end(), id) - d.id.begin());
    };
    State changed = reference->state();
    edit.index = index_in(changed.disks);
    apply(edit, changed);
    reference = make_reference_engine(scene, std::move(changed));
    edit.index = index_in(engine->state().disks);
    ASSERT_TRUE(engine->edit(edit));
  };
  for (int window = 0; window < 8; ++window) {
    const double start = reference->state().time;
    reference->step();
    engine->step();
    ASSERT_NO_FATAL_FAILURE(expect_same(*engine, *reference, start));
    const std::vector<DiskId> id = engine->state().disks.id;
    change({Edit::Kind::set_velocity, {0.0, 0.0, 3.0, -1.0}}, id[id.size() / 2]);
    change({Edit::Kind::remove, {}}, id[id.size() / 3]);
    expect_found(*engine, {0.1 * side, 0.5 * side});
  }
  EXPECT_GT(engine->state().counters.removed, 50U);
}

}  // namespace
}  // namespace carom::exact_tests
