// Inner walls along a side of the box: a disk that reaches both meets either of them. Belts at the top and at the right
// once moved only half of the disks, without a warning.
#include "core/load/wall_warnings.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/load/scene_warnings.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::replaced;
using test::sound_scene;
using testing::ElementsAre;
using testing::IsEmpty;

// The warnings for the sound scene, a box of 20 x 10, with this wall.
std::vector<std::string> warnings(const std::string& wall, const std::vector<Override>& sets = {}) {
  return wall_warnings(test::scene_from(replaced(sound_scene, "[run]", "[[walls]]\n" + wall + "\n[run]"), sets));
}

constexpr const char* along_top = "points = [[4, 10], [9, 10]]";

TEST(WallWarnings, AWallThatDiffersFromTheSideBehindIt) {
  EXPECT_THAT(
      warnings(std::string(along_top) + "\nrestitution = 0.25"),
      ElementsAre("gas.toml:20: walls.0: lies along the top side, and a disk that reaches both collides with either of "
                  "them, as rounding decides; place the wall inside the box, a thousandth of a radius from the side"));
  for (const auto& [points, side] : {std::pair("[[0, 2], [0, 4]]", "left"), std::pair("[[20, 2], [20, 4]]", "right"),
                                     std::pair("[[1, 1], [2, 0], [4, 0]]", "bottom")}) {
    EXPECT_THAT(warnings(fmt::format("points = {}\nrestitution = 0.25", points)),
                ElementsAre(testing::HasSubstr(fmt::format("walls.0: lies along the {} side, ", side))));
  }
  EXPECT_THAT(warnings(std::string(along_top) + "\nmotion = { velocity = [0.1, 0] }"), testing::SizeIs(1)) << "a belt";
  EXPECT_THAT(warnings(along_top, {{"box.top", "{ temperature = 1.0 }"}}), testing::SizeIs(1));
  EXPECT_THAT(warnings(along_top, {{"box.top", "{ restitution = 0.5 }"}}), testing::SizeIs(1));
  EXPECT_THAT(
      warnings(std::string(along_top) + "\nrestitution = 0.25", {{"run.method", "rollback"}, {"run.dt", "0.1"}}),
      ElementsAre(testing::EndsWith("collides with the side; place the wall inside the box, a thousandth of a radius "
                                    "from the side, and use another method")));
}

// The message once began with "gas.toml:0".
TEST(WallWarnings, AWallOfNoLineOfTheFileHasNone) {
  const std::vector<Override> sets{{"walls", "[{ points = [[4, 10], [9, 10]], restitution = 0.25 }]"}};
  EXPECT_THAT(wall_warnings(test::scene_from(sound_scene, sets)),
              ElementsAre(testing::StartsWith("gas.toml: walls.0: lies along the top side, ")));
}

TEST(WallWarnings, NoneOfOthers) {
  EXPECT_THAT(warnings(along_top), IsEmpty()) << "the wall acts as the side does";
  EXPECT_THAT(warnings(std::string(along_top) + "\nkind = \"sink\""), IsEmpty());
  EXPECT_THAT(warnings(std::string(along_top) + "\nrestitution = 0.25", {{"box.top", "\"sink\""}}), IsEmpty());
  EXPECT_THAT(warnings("points = [[4, 9.999], [9, 9.999]]\nrestitution = 0.25"), IsEmpty());
  EXPECT_THAT(warnings("points = [[4, 10], [9, 9]]\nrestitution = 0.25"), IsEmpty()) << "it only touches the side";
}

// A belt under disks that rest on it: the load of a support has no component along the belt, so they once stayed where
// they were, without a warning.
TEST(WallWarnings, ABeltUnderAPileTakesNothingAlong) {
  const std::vector<Override> pile{{"run.method", "pairwise"},
                                   {"run.dt", "0.001"},
                                   {"physics.gravity", "1.0"},
                                   {"physics.restitution", "0.5"},
                                   {"physics.roughness.tangential_restitution", "0.0"},
                                   {"box.wall_roughness.tangential_restitution", "0.0"}};
  const auto with = [&](const char* wall, const std::vector<Override>& sets) {
    std::vector<Override> all = pile;
    all.insert(all.end(), sets.begin(), sets.end());
    return warnings(wall, all);
  };
  constexpr const char* belt = "points = [[4, 2], [9, 2]]\nmotion = { velocity = [0.1, 0] }";
  EXPECT_THAT(with(belt, {}),
              ElementsAre("gas.toml:20: walls.0: moves along itself, and drags along disks that hit it, but not disks "
                          "that rest on it: method pairwise supports a pile without friction"));
  EXPECT_THAT(with("points = [[4, 2], [9, 3]]\nmotion = { vibrate = [0.1, 0], period = 1 }", {}), testing::SizeIs(1));
  EXPECT_THAT(with("points = [[4, 2], [9, 3]]\nmotion = { vibrate = [0, 0.1], period = 1 }", {}), testing::SizeIs(1));
  EXPECT_THAT(with("points = [[4, 2], [9, 2]]\nmotion = { vibrate = [0, 0.1], period = 1 }", {}), IsEmpty()) << "lifts";
  EXPECT_THAT(with("points = [[4, 2], [4, 7]]\nmotion = { vibrate = [0, 0.1], period = 1 }", {}), IsEmpty())
      << "no disk can rest on it";
  EXPECT_THAT(with("points = [[4, 2], [9, 2]]", {}), IsEmpty());
  EXPECT_THAT(with(belt, {{"run.method", "exact"}}), IsEmpty());
  EXPECT_THAT(with(belt, {{"physics.gravity", "0.0"}}), IsEmpty());
  EXPECT_THAT(with(belt, {{"box.wall_roughness.friction", "0.0"}}), IsEmpty()) << "smooth";
}

TEST(WallWarnings, AreAmongThoseOfTheScene) {
  const std::string text =
      replaced(sound_scene, "[run]", std::string("[[walls]]\n") + along_top + "\nrestitution = 0.25\n[run]");
  EXPECT_THAT(scene_warnings(test::scene_from(text)), testing::Contains(testing::HasSubstr("walls.0: lies along")));
}

}  // namespace
}  // namespace carom
