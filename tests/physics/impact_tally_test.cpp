// Tallies of impacts, kept for parts of a step.
#include "core/physics/impact_tally.hpp"

#include <gtest/gtest.h>

namespace carom {
namespace {

// The tallies of parts add up to that of the whole step: collisions and crossings, the impulse and energy from sides
// and inner walls, the work of the shear, and what sinks took.
TEST(Tally, OfPartsIsThatOfTheWhole) {
  const auto part = [](double x) {
    ImpactTally tally;
    tally.add(1, PairImpact{.virial = 2.0 * x, .happened = true, .inaccurate = true});
    tally.add(1, PairImpact{.virial = x, .happened = true, .sheared = true, .shear_virial = 3.0 * x, .shear_work = x});
    tally.add(1, PairImpact{.shear_work = 4.0 * x});
    tally.add(wall_partner(Side::top),
              WallImpact{.impulse = 3.0 * x, .energy = x, .happened = true, .inaccurate = true});
    tally.add(wall_partner(Side::top), WallImpact{.energy = 16.0 * x});
    tally.add(obstacle_partner(0), WallImpact{.impulse = x,
                                              .energy = 5.0 * x,
                                              .happened = true,
                                              .inaccurate = true,
                                              .pushed = true,
                                              .momentum = {6.0 * x, 7.0 * x}});
    tally.add_taken(1, x);
    return tally;
  };
  ImpactTally all = part(0.25);
  all.add(part(0.75));
  EXPECT_EQ(all.inaccurate, 2U);
  EXPECT_EQ(all.inaccurate_at_walls, 4U);
  EXPECT_EQ(all.all_inaccurate(), 6U);
  ASSERT_EQ(all.absence.size(), 1U);
  EXPECT_EQ(all.absence[0].value(), 1.0);
  Counters counters;
  all.count_into(counters);
  EXPECT_EQ(counters.collisions, 4U);
  EXPECT_EQ(counters.wall_collisions, 4U);
  EXPECT_EQ(counters.virial, 3.0);
  EXPECT_EQ(counters.wall_impulse[3], 3.0);
  EXPECT_EQ(counters.side_energy[3], 1.0);
  EXPECT_EQ(counters.wall_work, 5.0);
  EXPECT_EQ(counters.wall_push[0], 6.0);
  EXPECT_EQ(counters.wall_push[1], 7.0);
  EXPECT_EQ(counters.shear_virial, 3.0);
  EXPECT_EQ(counters.shear_work, 1.0 + 4.0 + 16.0);
}

}  // namespace
}  // namespace carom
