// The parallel engine has the bits of the reference after windows and within them, in cases that few scenes have:
// events at the same moment, disks on a side at the end of a window, falls while lists are rebuilt, spinning rough
// disks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

// The time of a frame, its number of disks, and their hash.
std::string frame_at(const Engine& engine, double t) {
  Disks then;
  const double time = engine.disks_at(t, then);
  return fmt::format("{}: {}, {}", time, then.size(), hash_text(state_hash(then)));
}

// Compares the states after each window and frames within it; returns the last state.
State expect_bits_of_reference(const Scene& scene, const State& start) {
  const auto reference = make_reference_exact(scene, start);
  const auto engine = make_parallel_engine(scene, start, {1});
  const auto on_threads = make_parallel_engine(scene, start, {3, 128});
  double before = 0.0;
  while (reference->state().time < scene.run.t_end && !testing::Test::HasFailure()) {
    reference->step();
    const State& right = reference->state();
    for (Engine* e : {engine.get(), on_threads.get()}) {
      e->step();
      EXPECT_EQ(fingerprint(e->state()), fingerprint(right));
      for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const double t = before + share * (right.time - before);
        EXPECT_EQ(frame_at(*e, t), frame_at(*reference, t)) << "frame at " << t;
      }
    }
    before = right.time;
  }
  return reference->state();
}

// A disk at rest is hit from the left and from the right at the same moment, again and again. The result depends on the
// order, and the pair with the smallest ids comes first, wherever disks are stored. The lowest row falls onto the floor
// at that moment, too.
TEST(ExactBits, OfContactsAtTheSameMoment) {
  constexpr int rows = 12, columns = 4, all = 3 * rows * columns;
  const Scene scene = plain_scene(test::box_of(64.0, 48.0), 8.0, 0.0, 0.5);
  std::vector<Disk> list;
  for (int k = 0; k < all; ++k) {
    const int mixed = 29 * k % all, triple = mixed / 3, place = mixed % 3;
    const int row = triple / columns;
    const double x = 8.0 + 16.0 * (triple % columns) + 3.0 * (place - 1), y = 2.5 + 3.5 * row;
    list.push_back({x, y, 1.0 - place, row == 0 ? -1.0 : 0.0, 0.5, 1.0});
  }
  const State end = expect_bits_of_reference(scene, state_of(scene, list));
  EXPECT_GT(end.counters.collisions, 2U * rows * columns);
  EXPECT_GE(end.counters.wall_collisions, 3U * columns);
}

// A disk that has just collided reaches two disks at rest at the same moment: both contacts are found from its path
// only.
TEST(ExactBits, OfOneThatHitsTwoAtTheSameMoment) {
  constexpr int rows = 12, columns = 4, all = 4 * rows * columns;
  const Scene scene = plain_scene(test::box_of(64.0, 48.0), 12.0, 0.0, 0.5);
  const Vec2 from[] = {{2.0, 0.0}, {4.0, 0.0}, {8.0, 0.75}, {8.0, -0.75}};
  std::vector<Disk> list;
  for (int k = 0; k < all; ++k) {
    const int mixed = 29 * k % all, group = mixed / 4, place = mixed % 4;
    const double x = 16.0 * (group % columns) + from[place].x, y = 2.0 + 4.0 * (group / columns) + from[place].y;
    list.push_back({x, y, place == 0 ? 1.0 : 0.0, 0.0, 0.5, 1.0});
  }
  const State end = expect_bits_of_reference(scene, state_of(scene, list));
  EXPECT_GE(end.counters.collisions, 3U * rows * columns);
}

// A disk between a wall and a fixed disk, both without rebound, touches both at the same moment again and again. The
// fixed disk comes first, although the search for it ends at the time of the wall.
TEST(ExactBits, OfAFixedDiskAndAWallAtTheSameMoment) {
  const Scene scene = parse_scene(R"([box]
width = 12
height = 6
bottom = "periodic"
top = "periodic"
wall_restitution = 0
[physics]
gravity = 1
[[disks]]
fixed = true
count = 1
positions = [[11, 0.5]]
radius = 0.125
[[disks]]
count = 2
positions = [[11.75, 1.9697732266236629], [11.327221210146591, 1.3385502021886884]]
velocities = [[0, -1.0348935313515297], [1.8447193148856498, 0.18949405500704941]]
radius = [0.25, 0.5]
mass = 1
[run]
method = "exact"
t_end = 0.5
)",
                                  "test", ".");
  const State start = initial_state(scene);
  const auto reference = make_reference_exact(scene, start);
  reference->step();
  EXPECT_LT(reference->state().time, 0.2) << "the window was not cut short by too many events";
  for (const int threads : {1, 3}) {
    const auto engine = make_parallel_engine(scene, start, {threads, 128});
    engine->step();
    EXPECT_EQ(fingerprint(engine->state()), fingerprint(reference->state()));
  }
}

// The wall vibrates as a sine. At its turning point, at the window's end, a row of touching disks reaches it: the first
// disk meets it twice, the second time within rounding of the end.
TEST(ExactBits, OfContactsWithASineAtTheEndOfAWindow) {
  const Scene scene = parse_scene(R"([box]
width = 16
height = 6
right = { motion = { vibrate = [0.5, 0], period = 2, shape = "sine" } }
[[disks]]
count = 3
positions = [[14.75, 4], [13.75, 4], [12.75, 4]]
velocities = [[1, 0], [1, 0], [1, 0]]
radius = 0.5
mass = 1
[run]
method = "exact"
t_end = 1
)",
                                  "test", ".");
  State start = initial_state(scene);
  start.time = 0.75;
  start.window = 10.0;
  const State end = expect_bits_of_reference(scene, start);
  EXPECT_EQ(end.counters.collisions, 3U);
}

// Disks of a dilute gas fly further than their lists reach, and lists are rebuilt while next events are known: in some
// windows a disk leaves the surroundings of its listed position before its event.
TEST(ExactBits, OfAFallThroughListsThatAreBuiltAnew) {
  Scene scene = make_scene({31.22, 6.24, "left = \"periodic\"\nright = \"periodic\"", "gravity = 0.05",
                            "[[disks]]\ncount = 80\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\n"
                            "radius = 0.1525\nmass = 1.0\n",
                            46.81, ""});
  scene.seed = 41962;
  const State end = expect_bits_of_reference(scene, initial_state(scene));
  EXPECT_GT(end.counters.collisions, 200U);
}

// Spins between two collisions of a window, and before the first one.
TEST(ExactBits, OfTheSpinOfRoughDisks) {
  const std::string rough = "roughness = { tangential_restitution = 0.4, friction = 0.5 }";
  for (const int count : {20, 80}) {
    const Scene scene =
        make_scene({20, 16, "wall", rough,
                    "[[disks]]\ncount = " + std::to_string(count) +
                        "\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.4\nmass = 1.0\n",
                    12, ""});
    const State end = expect_bits_of_reference(scene, initial_state(scene));
    EXPECT_GT(end.counters.collisions, 20U);
  }
}

// Frames with disks that have crossed the top of a sheared box, and with disks still on their way.
TEST(ExactBits, OfFramesOfAShear) {
  const Scene scene = make_scene(
      {20, 16, "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\nshear_rate = 0.3",
       "", "[[disks]]\ncount = 80\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.4\nmass = 1.0\n",
       6, ""});
  const State end = expect_bits_of_reference(scene, initial_state(scene));
  EXPECT_GT(end.counters.collisions, 20U);
}

// If disks move nearly with the flow, lists are strained and rebuilt long before a disk leaves its listed position, and
// meanwhile the images above go around a narrow box many times.
TEST(ExactBits, OfAShearWhoseListsAreStrainedAgainAndAgain) {
  for (const double width : {12.0, 60.0}) {
    const Scene scene = make_scene({width, 18,
                                    "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = "
                                    "\"periodic\"\nshear_rate = -6.0",
                                    "restitution = 0.5",
                                    "[[disks]]\ncount = 80\npositions = \"random\"\nvelocities = { maxwell = 1.0 "
                                    "}\nradius = { uniform = [0.2, 0.4] }\nmass = 1.0\n",
                                    3, ""});
    const State end = expect_bits_of_reference(scene, initial_state(scene));
    EXPECT_GT(end.counters.collisions, 50U);
  }
}

// In the last window a disk comes exactly to a periodic side: its coordinate must be 0, not the box's width.
TEST(ExactBits, OfADiskOnAPeriodicSideAtTheEnd) {
  const Domain box = test::box_of(16.0, 8.0, test::Periodic::both);
  std::vector<Disk> list{{12.0, 4.0, 2.0, 0.0, 0.25, 1.0}, {4.0, 6.0, 0.0, 1.0, 0.25, 1.0}};
  for (const std::size_t more : {0U, 48U}) {  // with more disks there are lists
    for (std::size_t k = 0; k < more; ++k)
      list.push_back({0.5 + 0.3125 * static_cast<double>(k), 1.0, 0.0, 0.0, 0.1, 1.0});
    const Scene scene = plain_scene(box, 2.0);
    const State start = state_of(scene, list);
    expect_bits_of_reference(scene, start);
    const auto engine = make_parallel_engine(scene, start, {1});
    run_to_end(*engine, scene);
    const Disks& d = engine->state().disks;
    EXPECT_EQ(d.x[index_of(d, 0)], 0.0);
    EXPECT_EQ(d.y[index_of(d, 1)], 0.0);
  }
}

const std::string hot = "left = { temperature = 25.0 }\nright = { temperature = 0.3 }\nwall_restitution = 0.9";

// Disks leave through a sink.
TEST(ExactBits, OfFramesWhileDisksLeave) {
  const std::string open_sides = "left = \"wall\"\nright = \"sink\"\nbottom = \"periodic\"\ntop = \"periodic\"";
  const Scene scene = make_scene({20, 20, open_sides, "gravity = 0.4", random_disks(150, mixed_disks), 2.0, ""});
  EXPECT_GT(expect_bits_of_reference(scene, initial_state(scene)).counters.removed, 0U);
}

// All combinations of what an engine keeps of disks besides their paths: numbers of reflections by thermal sides, times
// of contacts.
TEST(ExactBits, WithMemoryOfContacts) {
  const std::string tc = "restitution = 0.8\ncollapse = { model = \"tc\", contact_time = 0.001 }";
  for (const std::string& sides : {std::string("wall"), hot}) {
    for (const std::string& physics : {std::string(), tc}) {
      SCOPED_TRACE(sides + "; " + physics);
      const Scene scene = make_scene({20, 20, sides, physics, random_disks(100, equal_disks), 2.0, ""});
      expect_bits_of_reference(scene, initial_state(scene));
    }
  }
}

// Before the first event a frame is the state at the window's start.
TEST(ExactBits, OfAFrameAtTheStart) {
  const Scene scene = make_scene({20, 20, hot, "", random_disks(100, equal_disks), 2.0, ""});
  const State initial = initial_state(scene);
  const auto reference = make_reference_exact(scene, initial);
  const auto parallel = make_parallel_engine(scene, initial, {3, 128});
  for (Engine* engine : {reference.get(), parallel.get()}) {
    engine->step();
    Disks frame;
    EXPECT_EQ(engine->disks_at(0.0, frame), 0.0);
    EXPECT_EQ(state_hash(frame), state_hash(initial.disks));
  }
}

}  // namespace
}  // namespace carom::exact_tests
