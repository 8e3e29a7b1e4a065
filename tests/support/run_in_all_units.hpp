// One run in many units: lengths, masses or times scaled by 2^20 or 2^-20.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "core/disks/disk_columns.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/other_units.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/same_counters.hpp"

namespace carom::test {

inline const std::vector<Units> other_units{{0x1p20, 1, 1},  {0x1p-20, 1, 1}, {1, 0x1p20, 1},
                                            {1, 0x1p-20, 1}, {1, 1, 0x1p20},  {1, 1, 0x1p-20}};

inline void expect_equal(const State& a, const State& b) {
  for_each_column(a.disks, b.disks, [](const auto& one, const auto& other) { EXPECT_EQ(one, other); });
  EXPECT_EQ(a.disks.common_radius, b.disks.common_radius);
  EXPECT_EQ(a.disks.common_mass, b.disks.common_mass);
  EXPECT_EQ(a.disks.inertia, b.disks.inertia);
  EXPECT_EQ(a.time, b.time);
  expect_same_counters(a.counters, b.counters);
  EXPECT_EQ(a.taken, b.taken);
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

// Makes the initial state and runs, in all units. Returns the final state in the scene's own units.
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
