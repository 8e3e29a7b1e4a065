// Parts with halos report whether their lists contain all disks against which own disks may grow.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>
#include <utility>

#include "core/step/step_start.hpp"
#include "core/step/window_plan.hpp"
#include "parallel/exact/halo_windows.hpp"
#include "parallel/exact/window_passes.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

std::string at_rest(std::size_t count, double left, double right, double radius = 0.2) {
  return fmt::format("[[disks]]\ncount = {}\npositions = \"square\"\nregion = [{}, 5, {}, 35]\nradius = {}\nmass = 1\n",
                     count, left, right, radius);
}

// A disk in the lane below the others.
std::string flying(double x, double velocity, double radius = 0.2) {
  return fmt::format("[[disks]]\ncount = 1\npositions = [[{}, 2]]\nvelocities = [[{}, 0]]\nradius = {}\nmass = 1\n", x,
                     velocity, radius);
}

// Three parts, the second from 62.29 to 76.39, with halos of 9.33 if no disk is larger than 1.17, after one window of
// the given length without a collision.
struct AfterOneWindow {
  AfterOneWindow(const std::string& disks, double length, double growth = 0.0, bool upright = false)
      : AfterOneWindow(make_scene({140, 35, "wall", "", disks, 100, ""}), 3, length, growth, upright) {}
  // The same with another number of parts. upright: x and y are exchanged.
  AfterOneWindow(Scene in_box, int threads, double length, double growth = 0.0, bool upright = false)
      : scene(std::move(in_box)), state(initial_state(scene)), executor(threads, 128) {
    if (upright) {
      std::swap(scene.box.width, scene.box.height);
      std::swap(state.disks.x, state.disks.y);
      std::swap(state.disks.vx, state.disks.vy);
    }
    state.window = length;
    windows.set_growth(growth);
    const SpeedSummary speeds = summarise_speeds(state.disks, scene.box, executor);
    const WindowPlan plan = plan_window(scene, state, state.disks.size(), speeds);
    EXPECT_EQ(windows.run(plan, speeds, WindowState{}), SliceOutcome::done);
    EXPECT_EQ(windows.parts(), static_cast<std::size_t>(threads));
    finish_window(state, state.disks.size(), plan, windows.store_paths(plan));
    EXPECT_EQ(state.counters.collisions, 0U);
  }

  // The number of times that the disk `by` lists the disk `other`.
  int times_listed(DiskId by, DiskId other) const {
    std::atomic<int> found{0};
    windows.visit_lists([&](std::size_t i, std::span<const std::uint32_t> near) {
      if (state.disks.id[i] != by) return;
      for (const std::uint32_t j : near) found += state.disks.id[j] == other ? 1 : 0;
    });
    return found;
  }

  Scene scene;
  State state;
  Executor executor;
  PhaseTimes times;
  HaloWindows windows{scene, state, executor, times};
};

const std::string lattices = at_rest(300, 43, 63) + at_rest(299, 63.5, 77) + at_rest(300, 79, 99);

// A disk of the second part has flown from 70 to `place`. At its start both other parts have it as a ghost, so it stays
// a disk of its part wherever it goes.
bool lists_are_complete(double place, bool upright) {
  AfterOneWindow after(flying(70, place < 70.0 ? -1 : 1) + lattices, std::abs(place - 70.0), 0.0, upright);
  return after.windows.complete_lists();
}

// A disk of another part may be beyond its part's end, too, and may come so near that both may grow against each other.
// If each is less than 4.47 outside its part, half of the halo's width beyond two disks, the other disk is a ghost
// here.
TEST(HaloLists, AreCompleteWhereNoDiskIsFarBeyondItsPart) {
  for (const bool upright : {false, true}) {
    for (const double place : {57.9, 80.8}) EXPECT_TRUE(lists_are_complete(place, upright)) << place;
    for (const double place : {57.75, 80.95}) EXPECT_FALSE(lists_are_complete(place, upright)) << place;
  }
}

// Both disks may grow to the size of the largest disk, which is in another part; that leaves 4.37.
TEST(HaloLists, AreCompleteForAllThatTheLargestDiskMayGrow) {
  const std::string small = at_rest(299, 43, 63, 0.1) + at_rest(299, 63.5, 77, 0.1) + at_rest(300, 79, 99, 0.1);
  for (const auto& [place, complete] : {std::pair{58.0, true}, std::pair{57.87, false}}) {
    AfterOneWindow after(flying(70, -1, 0.1) + flying(20, 0) + small, 70 - place, 0.1);
    EXPECT_EQ(after.windows.complete_lists(), complete) << place;
  }
}

// A disk has flown from beyond the halo to a disk at the end of another part in the last window: it is a ghost there,
// once.
TEST(HaloLists, TellOfADiskThatHasJustCome) {
  AfterOneWindow after(
      flying(75, 0) + flying(97, -1) + at_rest(300, 43, 63) + at_rest(299, 63.5, 77) + at_rest(299, 79, 99), 20);
  EXPECT_EQ(after.times_listed(0, 1), 0);
  for (int k = 0; k < 2; ++k) {
    EXPECT_TRUE(after.windows.complete_lists());
    EXPECT_EQ(after.times_listed(0, 1), 1);
  }
}

// Two by two parts that meet at (30, 30), with halos of 12; the outer corner of each has a lattice. A disk flies from
// beyond the halo towards a disk at rest just across that point, and must then be a ghost there, once.
TEST(HaloLists, TellOfADiskThatHasJustComeAcrossACorner) {
  const auto lattice = [](int x, int y) {
    return fmt::format(
        "[[disks]]\ncount = 100\npositions = \"square\"\nregion = [{}, {}, {}, {}]\nradius = 0.2\nmass = 1\n", x, y,
        x + 16, y + 16);
  };
  const std::string others = lattice(0, 0) + lattice(44, 0) + lattice(0, 44) + lattice(44, 44) +
                             "[[disks]]\ncount = 4\npositions = [[30, 5], [30, 55], [5, 30], [55, 30]]\nradius = 0.2\n"
                             "mass = 1\n";
  for (const int x : {-1, 1}) {
    for (const int y : {-1, 1}) {
      const auto at = [&](double d) { return fmt::format("[{}, {}]", 30.0 + x * d, 30.0 + y * d); };
      const std::string two = fmt::format(
          "[[disks]]\ncount = 2\npositions = [{}, {}]\nvelocities = [[0, 0], [{}, {}]]\nradius = 0.2\n"
          "mass = 1\n",
          at(-0.1), at(13.2), -x, -y);
      AfterOneWindow after(make_scene({60, 60, "wall", "", two + others, 100, ""}), 4, 11.2);
      EXPECT_EQ(after.times_listed(0, 1), 0);
      EXPECT_TRUE(after.windows.complete_lists());
      EXPECT_EQ(after.times_listed(0, 1), 1) << x << " " << y;
    }
  }
}

// The lists of the second part are made for small disks and do not reach far enough for the large disk that has come.
TEST(HaloLists, AreNotCompleteWhereALargerDiskHasCome) {
  AfterOneWindow after(flying(97, -1, 1.1) + lattices, 15);
  EXPECT_FALSE(after.windows.complete_lists());
}

}  // namespace
}  // namespace carom::exact_tests
