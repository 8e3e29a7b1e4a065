// carom check gives the speed of moving walls, and compares their acceleration with gravity: if a floor's acceleration
// is below that of gravity, disks at rest on it never leave it.
#include <fmt/format.h>

#include "tests/support/command_support.hpp"

namespace carom {
namespace {

using ::testing::HasSubstr;

class CheckOfMotion : public test::CommandTest {
 protected:
  std::string report(const std::string& box, const std::string& more) const {
    write("moves.toml", "[box]\nwidth = 10.0\nheight = 10.0\n" + box +
                            "[[disks]]\ncount = 1\npositions = [[5, 5]]\nradius = 0.5\nmass = 1\n" + more +
                            "[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 1.0\n");
    const test::Outcome o = carom("check moves.toml");
    EXPECT_EQ(o.status, 0) << o.err;
    return o.out;
  }
};

// Pieces of parabolas of height A over half a period h: speed 4 A / h at their ends, and acceleration 8 A / h^2 at any
// time.
TEST_F(CheckOfMotion, AFloorThatVibratesIsHeldAgainstGravity) {
  const std::string floor = "bottom = { motion = { vibrate = [0.0, 0.5], period = 2.0 } }\n";
  EXPECT_THAT(
      report(floor + "[physics]\ngravity = 5.0\n", ""),
      HasSubstr("elastic collisions, at walls too; the bottom wall moves at speeds up to 2, accelerations up to 4, "
                "0.8 times gravity's\n"));
  EXPECT_THAT(report(floor, ""), HasSubstr("the bottom wall moves at speeds up to 2, accelerations up to 4\n"));
}

// A sine: A w and A w^2, with w = 2 pi / period.
TEST_F(CheckOfMotion, OfInnerWallsTheLargestCounts) {
  const std::string walls =
      "[[walls]]\nfrom = [1, 2]\nto = [9, 2]\nmotion = { vibrate = [0.3, 0.4], period = 2.0, shape = \"sine\" }\n"
      "[[walls]]\nfrom = [1, 8]\nto = [2, 8]\nmotion = { velocity = [0.5, 0.0] }\n";
  EXPECT_THAT(report("", walls), HasSubstr("; inner walls move at speeds up to 1.57, accelerations up to 4.93\n"));
}

TEST_F(CheckOfMotion, ASteadySideHasASpeedAlone) {
  EXPECT_THAT(report("left = { motion = { velocity = [0.25, 0.0] } }\n", ""),
              HasSubstr("elastic collisions, at walls too; the left wall moves at speeds up to 0.25\n"));
}

}  // namespace
}  // namespace carom
