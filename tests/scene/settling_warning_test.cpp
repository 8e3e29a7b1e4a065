// The warning of the energy that pairwise loses in excess when nearly elastic disks settle; docs/methods.md has
// measurements.
#include "core/load/settling_warning.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

// Of the energy of 200 such disks 10 % too much was lost with e = 0.99, 119 % with 0.999, and 0.3 % with 0.9.
const std::string falling =
    "[box]\nwidth = 10.0\nheight = 20.0\n[[disks]]\ncount = 200\nradius = 0.3\nmass = 1.0\n"
    "positions = \"random\"\nvelocities = { maxwell = 1.0 }\n"
    "[physics]\ngravity = 0.3\nrestitution = 0.99\n[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 30.0\n";

TEST(SettlingWarning, ComesWhereNearlyElasticDisksFallInLongSteps) {
  EXPECT_THAT(settling_warnings(test::scene_from(falling)),
              testing::ElementsAre(testing::HasSubstr("run.dt: nearly elastic disks may lose up to")));
  EXPECT_EQ(settling_warnings(test::scene_from(falling, {{"physics.restitution", "0.999"}})).size(), 1U);
}

TEST(SettlingWarning, ComesNowhereElse) {
  const auto warnings = [](const std::string& key, const std::string& value) {
    return settling_warnings(test::scene_from(falling, {{key, value}}));
  };
  EXPECT_THAT(warnings("run.dt", "1e-4"), testing::IsEmpty());
  EXPECT_THAT(warnings("run.method", "exact"), testing::IsEmpty());
  EXPECT_THAT(warnings("physics.restitution", "0.9"), testing::IsEmpty());
  EXPECT_THAT(settling_warnings(test::scene_from(falling, {{"physics.restitution", "0.9"}, {"run.dt", "1.0"}})),
              testing::IsEmpty())
      << "for any step";
  EXPECT_THAT(warnings("physics.restitution", "1.0"), testing::IsEmpty());
  EXPECT_THAT(warnings("physics.gravity", "0.0"), testing::IsEmpty());
}

}  // namespace
}  // namespace carom
