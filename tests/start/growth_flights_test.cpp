// The parallel tools of growth: after a flight the lists contain, for each disk, all disks that its next step has to
// look at.
#include "parallel/start/growth_flights.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

constexpr double radius = 0.016, side = 30.0, lack = 0.33, apart_at_end = 0.72;

// Disks at rest on a square lattice of constant 1, with a hole in the middle. There the last two disks approach each
// other until time 1. Disk 1 touches disk 0.
State two_meet(const Scene& scene, double apart) {
  std::vector<Disk> disks{{0.5, 0.5, 0.0, 0.0, radius, 1.0}, {0.5 + 2.0 * radius, 0.5, 0.0, 0.0, radius, 1.0}};
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 30; ++column) {
      if (std::abs(row - 15.0) > 1.5 || std::abs(column - 15.0) > 3.5) {
        disks.push_back({static_cast<double>(column), static_cast<double>(row), 0.0, 0.0, radius, 1.0});
      }
    }
  }
  const double way = 0.5 * (apart - apart_at_end);
  disks.push_back({15.0 - 0.5 * apart, 15.0, way, 0.0, radius, 1.0});
  disks.push_back({15.0 + 0.5 * apart, 15.0, -way, 0.0, radius, 1.0});
  State state = test::state_of(scene, disks);
  state.disks.radius.assign(disks.size(), radius);
  return state;
}

// A step looks further than disks may grow: a gap limits two disks if three quarters of it are less than the sum of
// what both lack, and the lists must contain such pairs. Pairs that come from just beyond the reach of the lists test
// how far that is.
TEST(GrowthFlights, StepsLookAsFarAsThePlainOneDoes) {
  const Executor executor(1);
  Scene scene = test::scene_of(Method::exact, side, side, 0.0, 1.0);
  test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  for (double apart = 1.2; apart < 2.6; apart += 0.02) {
    State state = two_meet(scene, apart);
    const GrowthTools tools = parallel_growth(executor, {1});
    // Disk 0 is to grow, but disk 1 prevents it, so it lacks as much after the step as before.
    std::vector<double> target = state.disks.radius;
    target[0] += lack;
    ASSERT_EQ(tools.step(state.disks, scene.box, target).most_lack, lack);
    state = tools.fly(scene, std::move(state), [] {});
    target.assign(target.size(), radius + lack);
    Disks plain = state.disks;
    grow_step(plain, scene.box, target);
    tools.step(state.disks, scene.box, target);
    ASSERT_EQ(state.disks.id, plain.id) << "the step must use the lists, which do not sort disks";
    EXPECT_EQ(state.disks.radius, plain.radius) << apart;
    const std::size_t last = by_id(plain).back();
    EXPECT_NEAR(plain.radius[last], radius + 0.375 * (apart_at_end - 2.0 * radius), 1e-9) << "half of the usable gap";
  }
}

}  // namespace
}  // namespace carom
