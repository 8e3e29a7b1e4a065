// A disk that flies around a periodic box without touching anything returns to its listed position, past disks that it
// did not list meanwhile. If windows are much shorter than planned, here because of a source, events are predicted as
// far ahead as once around the box; a disk in the way of another was once missed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "core/disks/state_hash.hpp"
#include "core/reference/reference_exact.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

struct Flight {
  bool along_y, falls;
  bool followed;  // by another disk, 5 ahead, that it would touch once around the box
};

// A hundred disks at rest on a lattice, small compared with their spacing of 10. One disk flies along x or y in the
// middle between two rows; only one of the disks is in its way, half a period ahead. Small disks are emitted into a
// strip at the bottom.
Scene lonely_flight(int flying, const Flight& flight) {
  std::string at, velocities;
  const int in_the_way = (flying + (flight.along_y ? 50 : 5)) % 100, ahead = (flying + 1) % 100;
  const double begin = 10.0 * (flight.along_y ? flying / 10 : flying % 10) + 5.0;
  for (int k = 0; k < 100; ++k) {
    double along = 10.0 * (flight.along_y ? k / 10 : k % 10) + 5.0;
    double across = 10.0 * (flight.along_y ? k % 10 : k / 10) + 5.0;
    double speed = 0.0;
    if (k == flying) across = 50.0, speed = 1.0;
    if (k == in_the_way) across = 49.75;
    if (k == ahead && flight.followed) across = 50.3, along = begin + 5.0, speed = 0.95;
    at += fmt::format("[{:.2f}, {:.2f}], ", flight.along_y ? across : along, flight.along_y ? along : across);
    velocities += fmt::format("[{}, {}], ", flight.along_y ? 0.0 : speed, flight.along_y ? speed : 0.0);
  }
  return parse_scene(fmt::format(R"([box]
width = 100
height = 100
left = "periodic"
right = "periodic"
bottom = "periodic"
top = "periodic"
[physics]
gravity = [{2}, 0]
[[disks]]
count = 100
positions = [{0}]
velocities = [{1}]
radius = 0.2
mass = 1
[[sources]]
region = [0, 1, 100, 3]
rate = 0.3
radius = 0.02
mass = 1
[run]
t_end = 120
)",
                                 at, velocities, flight.falls ? 1e-12 : 0.0),
                     "test", ".");
}

TEST(RoundTheBox, IsAsTheReferenceHasIt) {
  int collisions = 0;
  for (int k = 0; k < 8; ++k) {
    const Flight flight{(k & 1) != 0, (k & 2) != 0, (k & 4) != 0};
    for (int flying = 0; flying < 100; flying += 3) {
      const Scene scene = lonely_flight(flying, flight);
      State start = initial_state(scene);
      start.window = 25.0;  // events are predicted four times as far ahead
      const auto reference = make_reference_exact(scene, start);
      const auto parallel = make_parallel_engine(scene, start, {1});
      while (reference->state().time < scene.run.t_end) {
        reference->step();
        parallel->step();
      }
      ASSERT_EQ(state_hash(parallel->state().disks), state_hash(reference->state().disks)) << flying << ' ' << k;
      collisions += static_cast<int>(reference->state().counters.collisions);
    }
  }
  EXPECT_GT(collisions, 250);
}

}  // namespace
}  // namespace carom::exact_tests
