// Moving sides that leave the disks less room than they need: exact once slowed down towards that time without any
// warning beforehand.
#include "core/load/press_warning.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/load/scene_warnings.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A box of 20 x 10 and 40 disks; with radius 1 they need an area of 80 sqrt(3), 138.56.
Scene scene_with(std::string_view sides, std::string_view radius = "1.0", std::string_view more = "",
                 std::string_view t_end = "10.0") {
  return test::scene_from(
      fmt::format("[box]\nwidth = 20.0\nheight = 10.0\n{}[[disks]]\ncount = 40\npositions = "
                  "\"square\"\nradius = {}\nmass = 1.0\n{}[run]\nt_end = {}\n",
                  sides, radius, more, t_end));
}

constexpr const char* slow = "right = { motion = { velocity = [-0.6, 0.0] } }\n";  // leaves 140 at t = 10
constexpr const char* far = "right = { motion = { velocity = [-1.0, 0.0] } }\n";   // leaves 138.56 at t = 6.144
constexpr const char* both =
    "left = { motion = { velocity = [0.4, 0.0] } }\nright = { motion = { velocity = [-0.4, "
    "0.0] } }\n";  // leaves 120 at t = 10

TEST(PressWarnings, TellWhenTheRoomIsTooSmall) {
  EXPECT_THAT(press_warnings(scene_with(slow)), IsEmpty());
  EXPECT_THAT(press_warnings(scene_with(far)),
              ElementsAre("gas.toml: box: the disks need an area of at least 138.6, and the moving sides leave less "
                          "than that from t = 6.15 on: no method gets there, and exact becomes slower and slower "
                          "before; move the sides less far, or end the run sooner"));
  EXPECT_THAT(press_warnings(scene_with(far, "1.0", "", "6.1")), IsEmpty());
  EXPECT_THAT(press_warnings(scene_with(both)), testing::SizeIs(1));
  EXPECT_THAT(press_warnings(scene_with(far, "0.5")), IsEmpty());
  EXPECT_THAT(press_warnings(scene_with("top = { motion = { velocity = [0.0, -0.4] } }\n")), testing::SizeIs(1))
      << "120";
  const char* const fixed = "[[disks]]\ncount = 1\npositions = [[2, 2]]\nradius = 1.0\nfixed = true\n";
  EXPECT_THAT(press_warnings(scene_with(slow, "1.0", fixed)), IsEmpty()) << "obstacles do not count";
  EXPECT_THAT(scene_warnings(scene_with(far)), testing::Contains(HasSubstr("less than that from t = 6.15")));
}

// For disks of several sizes only their own area is a sure limit: it is between 0.98^2 and 1 times 40 pi, 125.7, which
// is left at t = 7.43 or later.
TEST(PressWarnings, DisksOfSeveralSizesMayFillMore) {
  const auto found = press_warnings(scene_with(far, "{ uniform = [0.98, 1.0] }"));
  EXPECT_THAT(found, ElementsAre(HasSubstr("less than that from t = 7.")));
}

// The largest inset of a vibration counts, 7, which leaves 130.
TEST(PressWarnings, AVibrationComesAsFarAsItComes) {
  const std::string floor = "right = {{ place = 16.5, motion = {{ vibrate = [{}, 0.0], period = 2.0 }} }}\n";
  EXPECT_THAT(press_warnings(scene_with(fmt::format(fmt::runtime(floor), 3.5))), testing::SizeIs(1));
  EXPECT_THAT(press_warnings(scene_with(fmt::format(fmt::runtime(floor), 2.5))), IsEmpty());
  EXPECT_THAT(
      press_warnings(scene_with("right = { place = 16.5, motion = { vibrate = [3.5, 0.0], period = 0.01 } }\n")),
      testing::SizeIs(1))
      << "also between the times tested";
}

TEST(PressWarnings, NoneWhereSinksMakeRoom) {
  EXPECT_THAT(press_warnings(scene_with(std::string(far) + "left = \"sink\"\n")), IsEmpty());
  EXPECT_THAT(
      press_warnings(scene_with(far, "1.0", "[[walls]]\nfrom = [0.5, 0.1]\nto = [0.6, 0.1]\nkind = \"sink\"\n")),
      IsEmpty());
}

}  // namespace
}  // namespace carom
