// Windows in parts with halos have the bits of one queue if the halos suffice; if they do not, this is noticed.
#include "parallel/exact/halo_windows.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "core/disks/state_hash.hpp"
#include "core/step/step_start.hpp"
#include "core/step/window_plan.hpp"
#include "parallel/exact/window_passes.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"
#include "tests/support/same_counters.hpp"

namespace carom::exact_tests {
namespace {

const std::string mixed =
    "velocities = { uniform = 2.0 }\nradius = { uniform = [0.2, 0.6] }\nmass = { uniform = [1, 40] }";

// Runs windows in parts only. divisor: 1, or the factor by which blocks of work, and thus halos, are smaller.
struct InParts {
  InParts(Scene s, State initial, int threads, std::size_t divisor)
      : scene(std::move(s)), state(std::move(initial)), executor(threads, divisor) {}

  SliceOutcome step() {
    if (scene.physics.collapse_contact_time) state.last_contact.resize(state.next_id, -never);
    count_thermal_hits(scene, state);
    const SpeedSummary speeds = summarise_speeds(state.disks, scene.box, executor);
    const WindowPlan plan = plan_window(scene, state, state.disks.size(), speeds);
    const SliceOutcome outcome = windows.run(plan, speeds, WindowState{});
    if (outcome == SliceOutcome::done) {
      const ImpactTally tally = windows.store_paths(plan);
      finish_window(state, state.disks.size(), plan, tally);
    }
    return outcome;
  }

  Scene scene;
  State state;
  Executor executor;
  PhaseTimes times;
  HaloWindows windows{scene, state, executor, times};
};

struct Tally {
  int done = 0;
  Count void_runs = 0;
  std::size_t parts = 0;
};

// After each window both must have the same state. If a window is void in all tries, the parts continue from the right
// state.
Tally run_beside_one_queue(const Scene& scene, const State& initial, int threads, std::size_t divisor, int windows) {
  const auto one_queue = make_parallel_engine(scene, initial, {1});
  InParts parts(scene, initial, threads, divisor);
  Tally tally;
  for (int k = 0; k < windows; ++k) {
    one_queue->step();
    const State& right = one_queue->state();
    const SliceOutcome outcome = parts.step();
    if (outcome == SliceOutcome::done) {
      ++tally.done;
      EXPECT_EQ(state_hash(parts.state.disks), state_hash(right.disks)) << "window " << k;
      test::expect_same_counters(right.counters, parts.state.counters);
      EXPECT_EQ(right.taken, parts.state.taken) << "window " << k;
      EXPECT_EQ(parts.state.time, right.time) << "window " << k;
      EXPECT_EQ(parts.state.last_contact, right.last_contact) << "window " << k;
      EXPECT_EQ(parts.state.thermal_hits, right.thermal_hits) << "window " << k;
    } else {
      EXPECT_EQ(outcome, SliceOutcome::ghosts_too_few) << "window " << k;
      parts.state = right;
      parts.windows.forget(Known::nothing);
    }
    if (testing::Test::HasFailure()) break;
  }
  tally.void_runs = parts.windows.void_runs();
  tally.parts = parts.windows.parts();
  return tally;
}
Tally run_beside_one_queue(const Scene& scene, int threads, std::size_t divisor, int windows) {
  return run_beside_one_queue(scene, initial_state(scene), threads, divisor, windows);
}

TEST(LongHaloWindows, HardlyAnyIsVoid) {
  const Scene scene = make_scene({100, 100, "periodic", "", random_disks(5000, equal_disks), 1000, ""});
  for (const int threads : {2, 3}) {
    SCOPED_TRACE(threads);
    const Tally tally = run_beside_one_queue(scene, threads, 1, 60);
    EXPECT_EQ(tally.done, 60);
    EXPECT_LE(tally.void_runs, 2U);
  }
}

// Halos as wide as a part, or narrower than the reach of collisions: some windows are void, but none is wrong.
TEST(HaloWindows, AreVoidWhereHalosAreTooNarrow) {
  const Scene scene = make_scene({60, 60, "periodic", "", random_disks(2000, equal_disks), 1000, ""});
  Tally all;
  for (const int threads : {2, 3, 8}) {
    SCOPED_TRACE(threads);
    const Tally tally = run_beside_one_queue(scene, threads, 128, 60);
    all.done += tally.done;
    all.void_runs += tally.void_runs;
  }
  EXPECT_GT(all.done, 60);
  EXPECT_GT(all.void_runs, 3U);
}

// Work is cut so small that one thread makes parts of 125000 / 512 disks when it has more than 10^6 / 512, and several
// threads parts half as large. Halos are then so narrow that most windows are void; those that are done have the right
// bits.
TEST(LongHaloWindows, SeveralOnEachThread) {
  const Scene scene = make_scene({100, 100, "periodic", "", random_disks(5000, equal_disks), 1000, ""});
  for (const auto& [threads, parts] : {std::pair{1, 21U}, std::pair{2, 40U}}) {
    SCOPED_TRACE(threads);
    const Tally tally = run_beside_one_queue(scene, threads, 512, 30);
    EXPECT_EQ(tally.parts, parts);
    EXPECT_GT(tally.done, 3);
  }
}

// Two by three, two by four, and three by three parts: a disk at a corner is a ghost of three parts, or along a period
// of one or two.
TEST(LongHaloWindows, InRowsAndColumns) {
  const Scene scene = make_scene({140, 140, "periodic", "", random_disks(9000, equal_disks), 1000, ""});
  for (const int threads : {6, 8, 9}) {
    SCOPED_TRACE(threads);
    const Tally tally = run_beside_one_queue(scene, threads, 8, 30);
    EXPECT_EQ(tally.parts, static_cast<std::size_t>(threads));
    EXPECT_GE(tally.done, 29);
    EXPECT_LE(tally.void_runs, 4U);
  }
}

TEST(LongHaloWindows, OfOtherScenes) {
  const std::vector<SceneText> scenes{
      {140, 50, "periodic", "", random_disks(3500, equal_disks), 1000, ""},
      {60, 120, "wall", "gravity = [0.1, 0.5]", random_disks(3500, equal_disks), 1000, ""},
      {120, 60, "wall", "restitution = 0.95", random_disks(3500, mixed), 1000, ""},
      {100, 100, "periodic", "gravity = 0.3\nrestitution = 0.9", random_disks(4000, mixed), 1000, ""},
      {120, 60, "left = { temperature = 4.0 }\nright = { temperature = 0.5 }", "", random_disks(3500, equal_disks),
       1000, ""},
      {100, 100, "periodic", "restitution = 0.9\ncollapse = { model = \"tc\", contact_time = 1e-3 }",
       random_disks(4000, mixed), 1000, ""},
      {100, 100, "wall", "roughness = { tangential_restitution = 0.3, friction = 0.4 }", random_disks(4000, mixed),
       1000, ""},
      {300, 300, "periodic", "", random_disks(3000, equal_disks), 1000, ""}};
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    for (const int threads : {2, k % 2 == 0 ? 6 : 9}) {
      SCOPED_TRACE(fmt::format("scene {}, {} threads", k, threads));
      const Tally tally = run_beside_one_queue(make_scene(scenes[k]), threads, 1, 30);
      EXPECT_GE(tally.done, 25);
    }
  }
}

// A few disks move in a lane along a lattice at rest.
std::string lane(double width, double first, double other, double height, double velocity = -100) {
  return fmt::format(
      "[[disks]]\ncount = 2\npositions = [[{}, 0.5], [{}, 0.5]]\nvelocities = [[{}, 0], [0, 0]]\nradius = 0.2\n"
      "mass = 1\n[[disks]]\ncount = 4900\npositions = \"square\"\nregion = [0, 2, {}, {}]\nradius = 0.2\nmass = 1\n",
      first, other, velocity, width, height);
}

struct FlyingDisk {
  double x, y, vx, vy;
  double mass = 1.0;
  double radius = 0.2;
};

std::string at_rest(std::size_t count, double left, double right) {
  return fmt::format(
      "[[disks]]\ncount = {}\npositions = \"square\"\nregion = [{}, 3, {}, 35]\nradius = 0.2\nmass = 1\n", count, left,
      right);
}

// Besides the given disks there is only a lattice at rest at each end, with numbers such that two parts meet just
// behind a single disk in the middle, at x = 70.02. Halos are 4 wide. The first window has the greatest length, so a
// disk flies far in each slice, and wrong ghosts are noticed only at a slice's end.
Tally run_in_two_parts(const std::vector<FlyingDisk>& disks, int windows, const std::string& physics = "",
                       double t_end = 10.0, const std::string& sides = "wall") {
  std::size_t left = 2499, right = 2500;
  std::string text = "[[disks]]\ncount = 1\npositions = [[70, 20]]\nradius = 0.2\nmass = 1\n";
  for (const FlyingDisk& d : disks) {
    --(d.x < 70.0 ? left : right);
    text +=
        fmt::format("[[disks]]\ncount = 1\npositions = [[{}, {}]]\nvelocities = [[{}, {}]]\nradius = {}\nmass = {}\n",
                    d.x, d.y, d.vx, d.vy, d.radius, d.mass);
  }
  const Scene scene =
      make_scene({140, 35, sides, physics, text + at_rest(left, 0, 20) + at_rest(right, 120, 140), t_end, ""});
  State initial = initial_state(scene);
  initial.window = 1e9;
  return run_beside_one_queue(scene, initial, 2, 128, windows);
}

// A disk beyond the halo hits a ghost at rest, which then flies so deep into the part that its owner has no disk there.
// The only sign that it has to meet one is that the ghost leaves its owner.
TEST(HaloWindows, AreVoidWhereAGhostComesInThatRestsHere) {
  const Tally tally = run_in_two_parts({{65, 0.5, 0, 0}, {73.5, 0.5, 0, 0}, {74.5, 0.5, -100, 0}}, 1);
  EXPECT_EQ(tally.done, 0);
  EXPECT_GT(tally.void_runs, 0U);
}

// A ghost would fly to a disk of the part, if another disk beyond the halo did not knock a third into its way. The only
// sign that it has met the part's disk here is the part's own mark.
TEST(HaloWindows, AreVoidWhereAGhostIsMetThatTurnsBackAtItsOwners) {
  const Tally tally = run_in_two_parts({{68, 0.5, 0, 0},
                                        {73.6, 0.5, -100, 0},
                                        {71.6, 1.1, 0, 0, 1e3},
                                        {74.2, 4.1, -200, -200, 1e3},
                                        {71.0, 1.5, 0, 0, 1e9}},
                                       1);
  EXPECT_EQ(tally.done, 0);
  EXPECT_GT(tally.void_runs, 0U);
}

// The ghost is hit so late that this window does not need it. For the next window it gets its true path, and its events
// are predicted on that. (The last disk shortens windows.)
TEST(HaloWindows, PredictAGhostAnewThatRestedHere) {
  const Tally tally =
      run_in_two_parts({{65, 0.5, 0, 0}, {73.9, 0.5, 0, 0}, {122.3, 0.5, -100, 0}, {100, 17, 0, 100}}, 2);
  EXPECT_EQ(tally.done, 1) << "only the first window can be run: the next is void";
}

// A disk beyond the halo changes the spin of a ghost, but so little that no bit of its path changes. Through another
// ghost, which is hit in the same slice, a disk of this part gets as small a spin. (All lengths and times are exact.)
TEST(HaloWindows, PutAGhostRightThatDiffersInItsSpinAlone) {
  constexpr double radius = 0.3125;
  const Tally tally = run_in_two_parts({{68.125, 1, 0, 1, 1, radius},
                                        {72.125, 1, 0, 1, 1, radius},
                                        {73.75, 1, -64, 1, 1, radius},
                                        {74.125, 1.75, -64, -255, 0x1p-70, radius}},
                                       1, "roughness = { tangential_restitution = 0.5, friction = 0.5 }", 0.08);
  EXPECT_EQ(tally.done, 1);
  EXPECT_EQ(tally.void_runs, 0U);
}

// Beyond the halo a disk hits one that hits another, which becomes four times as fast as any disk at the window's start
// and crosses the end of its part. It flies more than a quarter of the period, where its path is cut. The part that it
// enters does not know why it is so fast, and must cut the path as well.
TEST(HaloWindows, CutThePathOfAGhostThatHasBecomeFastElsewhere) {
  const Tally tally = run_in_two_parts({{74.183, 1.0, 0, 100, 1e6}, {73.9, 1.6, 0, 0}, {73.405, 2.095, 0, 0, 1e-3}}, 1,
                                       "", 0.07, "bottom = \"periodic\"\ntop = \"periodic\"");
  EXPECT_EQ(tally.done, 1);
  EXPECT_EQ(tally.void_runs, 0U);
}

// At a wall a part has no neighbour to take disks from; otherwise its own disks would become its ghosts.
TEST(HaloWindows, AreNotVoidWhereAPartEndsAtAWall) {
  const Scene scene = make_scene({120, 60, "wall", "", random_disks(4000, equal_disks), 1000, ""});
  const Tally tally = run_beside_one_queue(scene, 2, 1, 12);
  EXPECT_EQ(tally.parts, 2U);
  EXPECT_EQ(tally.done, 12);
  EXPECT_EQ(tally.void_runs, 0U);
}

// A disk flies from the first of three parts through the second into the third, to a disk that neither of the first two
// has. The same in the opposite direction.
TEST(HaloWindows, AreVoidWhereADiskComesToAThirdPart) {
  for (const std::string& disks : {lane(140, 23.8, 108, 35), lane(140, 116.2, 32, 35, 100)}) {
    const Scene scene = make_scene({140, 35, "wall", "", disks, 1.5, ""});
    const auto in_parts = make_parallel_engine(scene, initial_state(scene), {3});
    run_to_end(*in_parts, scene);
    EXPECT_EQ(in_parts->state().counters.collisions, 1U);
    EXPECT_EQ(state_hash(in_parts->state().disks), state_hash(run_reference(scene, initial_state(scene)).disks));
  }
}

// A disk starts at the end of an outer part, where the second one has it as a ghost, flies through the second, and so
// deep into the third that the second has no disk there.
TEST(HaloWindows, AreVoidWhereADiskFliesThroughAPartIntoAThird) {
  for (const bool upright : {false, true}) {
    const auto at = [upright](double along, double across) {
      return upright ? fmt::format("[{}, {}]", across, along) : fmt::format("[{}, {}]", along, across);
    };
    const std::string region = upright ? "[2, 0, 35, 140]" : "[0, 2, 140, 35]";
    const std::string disks = fmt::format(
        "[[disks]]\ncount = 2\npositions = [{}, {}]\nvelocities = [{}, [0, 0]]\nradius = 0.2\nmass = 1\n"
        "[[disks]]\ncount = 4900\npositions = \"square\"\nregion = {}\nradius = 0.2\nmass = 1\n",
        at(98, 0.5), at(23.8, 0.5), at(-100, 0), region);
    const Scene scene = make_scene({upright ? 35.0 : 140.0, upright ? 140.0 : 35.0, "wall", "", disks, 1.5, ""});
    State initial = initial_state(scene);
    initial.window = 1e9;
    const Tally tally = run_beside_one_queue(scene, initial, 3, 1, 1);
    EXPECT_EQ(tally.done, 0);
    EXPECT_EQ(tally.parts, 3U);
    EXPECT_EQ(tally.void_runs, 3U);
  }
}

// A disk flies from one of three parts into the second, which takes it over, and on into the third, which is no
// neighbour of the first: the third must learn of the disk from the second. A thermostat that kicks no disk keeps
// windows short.
TEST(HaloWindows, TellAThirdPartOfADiskThatWasTakenOver) {
  const std::string kicks = "thermostat = { kind = \"andersen\", temperature = 1, rate = 1e-12, dt = 0.05 }";
  for (const std::string& disks : {lane(140, 108, 23.8, 35), lane(140, 32, 116.2, 35, 100)}) {
    const Scene scene = make_scene({140, 35, "wall", kicks, disks, 1.0, ""});
    const auto in_parts = make_parallel_engine(scene, initial_state(scene), {3});
    run_to_end(*in_parts, scene);
    EXPECT_EQ(in_parts->state().counters.collisions, 1U);
    EXPECT_EQ(state_hash(in_parts->state().disks), state_hash(run_reference(scene, initial_state(scene)).disks));
  }
}

// A disk is inside its part by exactly a halo's width, where rounding across the period decides.
TEST(HaloWindows, KnowADiskAtTheHalosEdgeOnBothSidesOfAPeriod) {
  const std::string sides = "left = \"periodic\"\nright = \"periodic\"";
  Scene scene = make_scene({140.302, 35, sides, "", lane(140.302, 8.0069900102902469, 127.302, 35), 0.35, ""});
  scene.box.width = 140.30200000000002;  // with all its digits
  const State reference = run_reference(scene, initial_state(scene));
  EXPECT_EQ(reference.counters.collisions, 1U);
  for (const int threads : {2, 3}) {
    const auto in_parts = make_parallel_engine(scene, initial_state(scene), {threads});
    run_to_end(*in_parts, scene);
    EXPECT_EQ(state_hash(in_parts->state().disks), state_hash(reference.disks)) << threads << " threads";
  }
}

// Two lattices so dense that all disks together start too many paths in a window, but those of neither part alone do.
TEST(HaloWindows, AreCrowdedAsOneQueueIs) {
  const auto lattice = [](int left, int right) {
    return fmt::format(
        "[[disks]]\ncount = 3000\npositions = \"square\"\nregion = [{}, 0, {}, 75]\nvelocities = {{ maxwell = 1 }}\n"
        "radius = 0.4995\nmass = 1\n",
        left, right);
  };
  const Scene scene = make_scene({140, 75, "wall", "", lattice(0, 40) + lattice(100, 140), 0.02, ""});
  const auto one_queue = make_parallel_engine(scene, initial_state(scene), {1});
  const auto in_parts = make_parallel_engine(scene, initial_state(scene), {2});
  one_queue->step();
  in_parts->step();
  EXPECT_EQ(in_parts->state().time, one_queue->state().time);
  EXPECT_LT(one_queue->state().time, 0.02);
  EXPECT_EQ(state_hash(in_parts->state().disks), state_hash(one_queue->state().disks));
}

// A disk a hundred times as fast as the others flies through several parts in a window.
TEST(LongHaloWindows, WithAProjectile) {
  const std::string projectile =
      "[[disks]]\ncount = 1\npositions = [[50, 50]]\nvelocities = [[7, 99]]\nradius = 0.5\nmass = 1\n";
  const Scene scene = make_scene({100, 100, "periodic", "", projectile + random_disks(4000, equal_disks), 1000, ""});
  for (const auto& [threads, divisor] : {std::pair{3, 1U}, std::pair{3, 128U}, std::pair{9, 1U}}) {
    const Tally tally = run_beside_one_queue(scene, threads, divisor, 30);
    EXPECT_GT(tally.done, 0);
  }
}

// With three by three parts those in the other two corners would have no disks.
TEST(HaloWindows, AreStripsWhereDisksCrowdInTwoCorners) {
  const auto crowd = [](int low, int high) {
    return fmt::format(
        "[[disks]]\ncount = 2000\npositions = \"random\"\nregion = [{}, {}, {}, {}]\nvelocities = {{ maxwell = 1 }}\n"
        "radius = 0.4\nmass = 1\n",
        low, low, high, high);
  };
  const Scene scene = make_scene({200, 200, "wall", "", crowd(0, 60) + crowd(140, 200), 1000, ""});
  const Tally tally = run_beside_one_queue(scene, 9, 1, 8);
  EXPECT_EQ(tally.parts, 3U);
  EXPECT_EQ(tally.done, 8);
}

// A disk ten times as large as the others comes to a part whose lists were built for small disks.
TEST(HaloWindows, TakeAGiantThatComesFromAnotherPart) {
  for (const int height : {9, 12, 14, 15, 16, 18, 20}) {
    SCOPED_TRACE(height);
    const std::string giant = fmt::format(
        "[[disks]]\ncount = 1\npositions = [[90, {}]]\nvelocities = [[100, 0]]\nradius = 3\nmass = 1e6\n", height);
    const std::string small = "velocities = { maxwell = 1 }\nradius = 0.3\nmass = 1";
    const Scene scene = make_scene({300, 30, "wall", "", giant + random_disks(4000, small), 0.8, ""});
    const auto one_queue = make_parallel_engine(scene, initial_state(scene), {1});
    const auto in_parts = make_parallel_engine(scene, initial_state(scene), {2});
    run_to_end(*one_queue, scene);
    run_to_end(*in_parts, scene);
    EXPECT_EQ(state_hash(in_parts->state().disks), state_hash(one_queue->state().disks));
  }
}

std::vector<std::tuple<double, DiskId, DiskId>> in_order(const std::vector<DiskContact>& contacts) {
  std::vector<std::tuple<double, DiskId, DiskId>> all;
  for (const DiskContact& c : contacts) all.emplace_back(c.time, std::min(c.id1, c.id2), std::max(c.id1, c.id2));
  std::sort(all.begin(), all.end());
  return all;
}

// Frames within a window, and its collisions, must be those of one queue.
void expect_paths_of_one_queue(const std::string& physics) {
  const Scene scene = make_scene({100, 100, "periodic", physics, random_disks(5000, mixed), 1000, ""});
  const State initial = initial_state(scene);
  const auto one_queue = make_parallel_engine(scene, initial, {1});
  InParts parts(scene, initial, 2, 1);
  for (int k = 0; k < 3; ++k) {
    const double start = parts.state.time;
    one_queue->step();
    ASSERT_EQ(parts.step(), SliceOutcome::done);
    for (const double share : {0.0, 0.3, 0.99}) {
      const double t = start + share * (parts.state.time - start);
      Disks frame = parts.state.disks;
      parts.windows.move_along_paths(t - start, frame);
      Disks expected;
      one_queue->disks_at(t, expected);
      EXPECT_EQ(state_hash(frame), state_hash(expected)) << "window " << k << ", share " << share;
    }
    const auto met = in_order(parts.windows.contacts(start));
    EXPECT_EQ(met, in_order(one_queue->contacts())) << "window " << k;
    EXPECT_GT(met.size(), 100U);
  }
}

TEST(HaloWindows, KeepPaths) {
  expect_paths_of_one_queue("gravity = 0.1");
}

TEST(HaloWindows, KeepPathsAndSpinsOfRoughDisks) {
  expect_paths_of_one_queue("roughness = { tangential_restitution = 0.3, friction = 0.4 }");
}

}  // namespace
}  // namespace carom::exact_tests
