// Compares all counters of a run bit by bit.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "core/disks/state.hpp"

namespace carom::test {

// Names every member, and fails to compile if one is missing.
inline void expect_same_counters(const Counters& expected, const Counters& found) {
  const auto& [steps, collisions, wall_collisions, removed, emitted, waiting, disk_time, disk_time_excess, virial,
               emitted_energy, wall_impulse, side_energy, thermostat_heat, shear_virial, shear_work, wall_work,
               wall_push] = expected;
  EXPECT_EQ(steps, found.steps);
  EXPECT_EQ(collisions, found.collisions);
  EXPECT_EQ(wall_collisions, found.wall_collisions);
  EXPECT_EQ(removed, found.removed);
  EXPECT_EQ(emitted, found.emitted);
  EXPECT_EQ(waiting, found.waiting);
  EXPECT_EQ(disk_time, found.disk_time);
  EXPECT_EQ(disk_time_excess, found.disk_time_excess);
  EXPECT_EQ(virial, found.virial);
  EXPECT_EQ(emitted_energy, found.emitted_energy);
  EXPECT_THAT(found.wall_impulse, ::testing::ElementsAreArray(wall_impulse));
  EXPECT_THAT(found.side_energy, ::testing::ElementsAreArray(side_energy));
  EXPECT_EQ(thermostat_heat, found.thermostat_heat);
  EXPECT_EQ(shear_virial, found.shear_virial);
  EXPECT_EQ(shear_work, found.shear_work);
  EXPECT_EQ(wall_work, found.wall_work);
  EXPECT_THAT(found.wall_push, ::testing::ElementsAreArray(wall_push));
}

// By all sinks together.
inline Count all_taken(const SinkCounts& taken) {
  return std::accumulate(taken.begin(), taken.end(), Count{0});
}

}  // namespace carom::test
