// One run in many units: lengths, masses or times scaled by 2^20 or 2^-20.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "core/start/initial_state.hpp"
#include "tests/support/other_units.hpp"
#include "tests/support/reference_run.hpp"

namespace carom::test {

inline const std::vector<Units> other_units{{0x1p20, 1, 1},  {0x1p-20, 1, 1}, {1, 0x1p20, 1},
                                            {1, 0x1p-20, 1}, {1, 1, 0x1p20},  {1, 1, 0x1p-20}};

inline void expect_equal(const State& a, const State& b) {
  EXPECT_EQ(a.disks.id, b.disks.id);
  EXPECT_EQ(a.disks.x, b.disks.x);
  EXPECT_EQ(a.disks.y, b.disks.y);
  EXPECT_EQ(a.disks.vx, b.disks.vx);
  EXPECT_EQ(a.disks.vy, b.disks.vy);
  EXPECT_EQ(a.disks.radius, b.disks.radius);
  EXPECT_EQ(a.disks.mass, b.disks.mass);
  EXPECT_EQ(a.disks.spin, b.disks.spin);
  EXPECT_EQ(a.disks.common_radius, b.disks.common_radius);
  EXPECT_EQ(a.disks.common_mass, b.disks.common_mass);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.counters.steps, b.counters.steps);
  EXPECT_EQ(a.counters.collisions, b.counters.collisions);
  EXPECT_EQ(a.counters.wall_collisions, b.counters.wall_collisions);
  EXPECT_EQ(a.counters.removed, b.counters.removed);
  EXPECT_EQ(a.counters.emitted, b.counters.emitted);
  EXPECT_EQ(a.counters.disk_time, b.counters.disk_time);
  EXPECT_EQ(a.counters.virial, b.counters.virial);
  EXPECT_EQ(a.counters.emitted_energy, b.counters.emitted_energy);
  for (int side = 0; side < 4; ++side) {
    EXPECT_EQ(a.counters.wall_impulse[side], b.counters.wall_impulse[side]);
    EXPECT_EQ(a.counters.side_energy[side], b.counters.side_energy[side]);
  }
  EXPECT_EQ(a.thermal_hits, b.thermal_hits);
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  for (std::size_t k = 0; k < a.obstacles.size(); ++k) {
    EXPECT_EQ(a.obstacles[k].x, b.obstacles[k].x);
    EXPECT_EQ(a.obstacles[k].y, b.obstacles[k].y);
    EXPECT_EQ(a.obstacles[k].dx, b.obstacles[k].dx);
    EXPECT_EQ(a.obstacles[k].dy, b.obstacles[k].dy);
    EXPECT_EQ(a.obstacles[k].radius, b.obstacles[k].radius);
  }
  ASSERT_EQ(a.loads.size(), b.loads.size());
  for (std::size_t k = 0; k < a.loads.size(); ++k) EXPECT_EQ(a.loads[k].force, b.loads[k].force);
}

// Initial state and run, in all units. Returns the end in the scene's own.
inline State expect_same_in_all_units(const Scene& scene) {
  const State start = initial_state(scene);
  const State end = run(scene, start);
  for (const Units& u : other_units) {
    SCOPED_TRACE(testing::Message() << scene.title << ", " << name_of(scene.run.method) << ", length " << u.length
                                    << ", mass " << u.mass << ", time " << u.time);
    const Scene other = scaled(scene, u);
    const State other_start = initial_state(other);
    expect_equal(other_start, scaled(start, u));
    expect_equal(run(other, other_start), scaled(end, u));
    if (testing::Test::HasFailure()) break;
  }
  return end;
}

}  // namespace carom::test
