// Whether the lists of parts with halos have all that own disks may grow against.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/step/step_start.hpp"
#include "core/step/window_plan.hpp"
#include "parallel/exact/halo_windows.hpp"
#include "parallel/exact/window_passes.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

std::string at_rest(std::size_t count, double left, double right) {
  return fmt::format(
      "[[disks]]\ncount = {}\npositions = \"square\"\nregion = [{}, 3, {}, 35]\nradius = 0.2\nmass = 1\n", count, left,
      right);
}

// Three parts, the second from 62.29 to 76.39, with halos of 9.33, after one window in which a disk of the second one
// has flown from 70 to this place. So far inside, both others have it as a ghost: it stays a disk of its part wherever
// it goes.
bool lists_are_complete(double place) {
  const std::string disk =
      fmt::format("[[disks]]\ncount = 1\npositions = [[70, 0.5]]\nvelocities = [[{}, 0]]\nradius = 0.2\nmass = 1\n",
                  place < 70.0 ? -1 : 1);
  const Scene scene = make_scene(
      {140, 35, "wall", "", disk + at_rest(300, 43, 63) + at_rest(299, 63.5, 77) + at_rest(300, 79, 99), 100, ""});
  State state = initial_state(scene);
  state.window = std::abs(place - 70.0);
  const Executor executor(3, 128);
  PhaseTimes times;
  HaloWindows windows{scene, state, executor, times};
  const SpeedSummary speeds = summarise_speeds(state.disks, scene.box, executor);
  const WindowPlan plan = plan_window(scene, state, state.disks.size(), speeds);
  EXPECT_EQ(windows.run(plan, speeds, WindowState{}), SliceOutcome::done);
  EXPECT_EQ(windows.parts(), 3U);
  finish_window(state, state.disks.size(), plan, windows.store_paths(plan));
  EXPECT_EQ(state.counters.collisions, 0U);
  return windows.complete_lists();
}

// Another part's disk may be beyond its end as well, and come as near to the disk as they may grow: if both are less
// than 4.47 outside, half of what halos are wider than two disks, it is a ghost here.
TEST(HaloLists, AreCompleteWhereNoDiskIsFarBeyondItsPart) {
  for (const double place : {57.9, 80.8}) EXPECT_TRUE(lists_are_complete(place)) << place;
  for (const double place : {57.75, 80.95}) EXPECT_FALSE(lists_are_complete(place)) << place;
}

}  // namespace
}  // namespace carom::exact_tests
