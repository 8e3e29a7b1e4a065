// Measurements in a box with moved sides refer to the room that is left.
#include <gtest/gtest.h>

#include <cmath>

#include "core/load/scene_file.hpp"
#include "core/measure/analysis.hpp"
#include "core/measure/invariants.hpp"
#include "core/measure/pair_distances.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

// A box of 20 x 10, from which a piston at the left takes 2 along x, and a floor 1 along y, in each unit of time.
Scene pressed_box() {
  return parse_scene(
      "[box]\nwidth = 20.0\nheight = 10.0\nleft = { motion = { velocity = [2.0, 0.0] } }\n"
      "bottom = { motion = { velocity = [0.0, 1.0] } }\n[[disks]]\ncount = 1\npositions = [[18.0, 8.0]]\n"
      "velocities = [[0.0, 0.0]]\nradius = 0.5\nmass = 1.0\n[run]\nmethod = \"exact\"\nt_end = 4.0\n"
      "[analysis]\nwhat = [\"pressure\"]\nevery = 1.0\n",
      "pressed.toml", "");
}

TEST(MovedSides, PressureOfASampleIsThatOfTheRoomLeft) {
  const Scene scene = pressed_box();
  const Disks disks = test::disks_of({{18.0, 8.0, 3.0, 0.0, 0.5, 2.0}});  // kinetic energy 9
  AnalysisRecord record = empty_record(scene);
  State now;
  take_sample(record, scene, disks, 0.0, now, run_in_order);
  now.time = 4.0;
  now.counters.virial = 24.0;
  take_sample(record, scene, disks, 4.0, now, run_in_order);
  ASSERT_EQ(record.series.pressure.size(), 2U);
  EXPECT_TRUE(std::isnan(record.series.pressure[0]));
  EXPECT_DOUBLE_EQ(record.series.pressure[1], (9.0 + 24.0 / 8.0) / (12.0 * 6.0));
}

// Each of the four sides takes away room.
TEST(MovedSides, PressureIsThatOfTheRoomBetweenAllFour) {
  Domain box{20.0, 10.0};
  box.places = {SidePlace{1.0, 0.0, 0.0}, SidePlace{3.0, 0.0, 0.0}, SidePlace{2.0, 0.0, 0.0}, SidePlace{4.0, 0.0, 0.0}};
  EXPECT_DOUBLE_EQ(pressure({32.0}, 64.0, 2.0, box), (32.0 + 16.0) / (16.0 * 4.0));
}

// Compared with the mean over a thousand times in between; Simpson's rule is less exact at the end of a piece.
TEST(MovedSides, MeanPlaceIsThatOfTheMotion) {
  const SideMotion steady{SideMotion::Kind::steady, 2.0, 0.3};
  const SideMotion parabolas{SideMotion::Kind::parabolas, 2.0, 0.0, -0.7, 0.8};
  const SideMotion sine{SideMotion::Kind::sine, 2.0, 0.0, 0.7, 0.8};
  for (const SideMotion& motion : {steady, parabolas, sine}) {
    for (const double from : {0.0, 0.3, 0.8, 5.5}) {
      for (const double length : {1e-3, 0.1, 0.4, 0.5, 0.8, 3.1}) {
        constexpr int places = 1000;
        double sum = 0.0;
        for (int k = 0; k < places; ++k) sum += motion.at(from + length * (k + 0.5) / places).inset;
        EXPECT_NEAR(motion.mean_inset(from, from + length), sum / places, 2e-5 * length) << from << ", " << length;
      }
      EXPECT_EQ(motion.mean_inset(from, from), motion.at(from).inset);
    }
  }
}

TEST(MovedSides, CentresOfPairsKeepAwayFromWhereTheSidesAre) {
  const Scene scene = pressed_box();
  const DistanceBins bins{2.0, 10, 3.0};
  EXPECT_DOUBLE_EQ(area_of_centres(scene.box, bins), 14.0 * 4.0);
  EXPECT_DOUBLE_EQ(area_of_centres(box_at(scene.box, 3.0), bins), 8.0 * 1.0);
}

}  // namespace
}  // namespace carom
