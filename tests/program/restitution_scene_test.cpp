// restitution = { viscoelastic = ... } and [[physics.pairs]] in a scene file: reading, writing, refusals, and the
// report of carom check.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/scene/scene_text.hpp"
#include "tests/support/command_support.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using test::scene_from;
using test::sound_scene;
using testing::HasSubstr;
using testing::StartsWith;

// Two named groups, pegs, and disks from a source; line 8 has the restitution, and pairs start in line 9.
constexpr std::string_view groups = R"(title = "groups"

[box]
width = 20.0
height = 10.0

[physics]
restitution = 0.5
# pairs
[[disks]]
name = "light"
count = 2
positions = [[2, 2], [5, 5]]
radius = 1.0
mass = 2.0
[[disks]]
name = "heavy"
count = 1
positions = [[8, 2]]
radius = 1.0
mass = 20.0
[[disks]]
name = "pegs"
fixed = true
count = 1
positions = [[18, 2]]
radius = 1.0
[[disks]]
name = "posts"
fixed = true
count = 1
positions = [[14, 2]]
radius = 1.0
[[sources]]
side = "top"
rate = 1.0
radius = 0.5
mass = 1.0
[run]
method = "pairwise"
dt = 0.01
t_end = 10.0
)";

std::string with(std::string_view pairs) {
  return replaced(groups, "# pairs", pairs);
}

TEST(RestitutionOfPairs, IsReadAndWrittenAgain) {
  const std::string text = with(
      "[[physics.pairs]]\ngroups = [\"sources\", \"light\"]\nrestitution = { viscoelastic = 0.25, least = 0.125 }\n"
      "[[physics.pairs]]\ngroups = [\"heavy\", \"light\"]\nrestitution = 0.75\n"
      "[[physics.pairs]]\ngroups = [\"heavy\", \"heavy\"]\nrestitution = 1\n"
      "[[physics.pairs]]\ngroups = [\"heavy\", \"pegs\"]\nrestitution = 0\n");
  const Scene scene = scene_from(text);
  const RestitutionLaw& law = scene.physics.law;
  EXPECT_EQ(scene.physics.restitution, 0.5);
  EXPECT_EQ(law.viscosity, 0.0);
  EXPECT_THAT(law.ends, testing::ElementsAre(2, 3, 4, 5));
  ASSERT_EQ(law.pairs.size(), 4U);
  EXPECT_EQ(law.of(0.5, 1, 2), (Restitution{0.75, 0.0}));
  EXPECT_EQ(law.of(0.5, 2, 2), (Restitution{1.0, 0.0}));
  EXPECT_EQ(law.of(0.5, 2, 3), (Restitution{0.0, 0.0}));
  EXPECT_EQ(law.of(0.5, 0, 3), (Restitution{0.5, 0.0})) << "this pair is not stated";
  EXPECT_EQ(law.of(0.5, 0, 77), (Restitution{0.125, 0.25}));
  const std::string resolved = resolved_toml(scene);
  EXPECT_EQ(resolved_toml(parse_scene(resolved, "again.toml", "")), resolved);
  EXPECT_EQ(parse_scene(resolved, "again.toml", "").physics.law.pairs.size(), 4U);
}

TEST(ViscoelasticRestitution, IsReadAndWrittenAgain) {
  const Scene scene =
      scene_from(replaced(groups, "restitution = 0.5", "restitution = { viscoelastic = 0.1, least = 0.25 }"));
  EXPECT_EQ(scene.physics.restitution, 0.25);
  EXPECT_EQ(scene.physics.law.viscosity, 0.1);
  const std::string resolved = resolved_toml(scene);
  EXPECT_THAT(resolved, HasSubstr("restitution = { viscoelastic = 0.1, least = 0.25 }"));
  EXPECT_EQ(resolved_toml(parse_scene(resolved, "again.toml", "")), resolved);
  const Scene deep = scene_from(groups, {{"physics.restitution", "{ viscoelastic = 0.1 }"}});
  EXPECT_EQ(deep.physics.restitution, 0.0) << "the default of the least value";
}

std::string pair_of(std::string_view names, std::string_view restitution = "restitution = 0.5") {
  return with("[[physics.pairs]]\ngroups = " + std::string(names) + "\n" + std::string(restitution));
}

TEST(BadPair, OneLineEach) {
  EXPECT_EQ(complaint(pair_of(R"(["light", "haevy"])")),
            "gas.toml:10: physics.pairs.0.groups.1: unknown group \"haevy\"; expected one of light, heavy, pegs, "
            "posts, sources (nearest: heavy)");
  EXPECT_EQ(complaint(pair_of(R"(["light"])")),
            "gas.toml:10: physics.pairs.0.groups: is a list of 1; expected the names of two groups, as in [\"light\", "
            "\"heavy\"]");
  EXPECT_THAT(complaint(pair_of(R"("light")")),
              StartsWith("gas.toml:10: physics.pairs.0.groups: is a string; expected"));
  EXPECT_THAT(complaint(pair_of(R"(["light", 2])")),
              StartsWith("gas.toml:10: physics.pairs.0.groups.1: is an integer"));
  EXPECT_THAT(complaint(pair_of(R"(["pegs", "posts"])")),
              StartsWith("gas.toml:10: physics.pairs.0.groups: are both of fixed disks, which never collide"));
  EXPECT_THAT(complaint(pair_of(R"(["light", "heavy"])", "")),
              StartsWith("gas.toml:9: physics.pairs.0.restitution: missing; expected a number from 0 to 1"));
  EXPECT_THAT(complaint(pair_of(R"(["light", "heavy"])", "restitution = 1.5")),
              StartsWith("gas.toml:11: physics.pairs.0.restitution: is 1.5; expected a number from 0 to 1"));
  EXPECT_THAT(complaint(pair_of(R"(["light", "heavy"])", "restitutions = 0.5")),
              HasSubstr("physics.pairs.0.restitutions: unknown key; expected one of groups, restitution (nearest: "
                        "restitution)"));
  EXPECT_THAT(complaint(with("[[physics.pairs]]\nrestitution = 0.5")),
              StartsWith("gas.toml:9: physics.pairs.0.groups: missing"));
  EXPECT_THAT(complaint(with("pairs = 3")), StartsWith("gas.toml:9: physics.pairs: is an integer; expected"));
  EXPECT_THAT(complaint(with("pairs = [3]")), HasSubstr("physics.pairs.0: is an integer; expected a table"));
  EXPECT_THAT(complaint(replaced(sound_scene, "restitution = 0.5",
                                 "[[physics.pairs]]\ngroups = [\"a\", \"b\"]\nrestitution = 1")),
              HasSubstr("unknown group \"a\"; expected the name of a [[disks]] block, and none has one"));
}

TEST(BadPair, StatedTwice) {
  EXPECT_EQ(complaint(with("[[physics.pairs]]\ngroups = [\"light\", \"heavy\"]\nrestitution = 0.5\n"
                           "[[physics.pairs]]\ngroups = [\"heavy\", \"light\"]\nrestitution = 0.5")),
            "gas.toml:13: physics.pairs.1.groups: are light and heavy, a pair that is already given; expected each "
            "pair once, in either order");
}

std::string with_law(std::string_view law, std::string_view more = "") {
  return complaint(replaced(groups, "restitution = 0.5", "restitution = " + std::string(law) + std::string(more)));
}

TEST(BadLaw, OneLineEach) {
  EXPECT_THAT(with_law("{ least = 0.5 }"),
              StartsWith("gas.toml:8: physics.restitution.viscoelastic: missing; expected the number a in e(v)"));
  EXPECT_THAT(with_law("{ viscoelastic = 0 }"),
              StartsWith("gas.toml:8: physics.restitution.viscoelastic: is 0; expected a number above 0"));
  EXPECT_THAT(with_law("{ viscoelastic = 0.1, least = 1 }"),
              StartsWith("gas.toml:8: physics.restitution.least: is 1, so that no collision loses energy; expected"));
  EXPECT_THAT(with_law("{ viscoelastic = 0.1, least = -1 }"),
              HasSubstr("least: is -1; expected a number from 0 to below 1"));
  EXPECT_THAT(with_law("{ viscoelasitc = 0.1 }"), HasSubstr("unknown key; expected one of viscoelastic, least"));
  EXPECT_THAT(with_law("\"soft\""), StartsWith("gas.toml:8: physics.restitution: is a string; expected a number"));
  EXPECT_EQ(with_law("{ viscoelastic = 0.1 }\ndiffusion = 0.1"),
            "gas.toml:8: physics.restitution: depends on the speed, and Brownian disks have none; expected a number "
            "from 0 to 1");
  EXPECT_EQ(with_law("{ viscoelastic = 0.1 }\ndiffusion = 0.1\naccumulate = true"), "");
}

using CheckOfLaws = test::CommandTest;

TEST_F(CheckOfLaws, SaysEachRestitution) {
  write("groups.toml", with("[[physics.pairs]]\ngroups = [\"heavy\", \"light\"]\nrestitution = 0.75\n"));
  EXPECT_THAT(carom("check groups.toml").out, HasSubstr("restitution 0.5 of disks, 0.75 of light with heavy"));
  EXPECT_THAT(carom("check groups.toml --set physics.restitution='{ viscoelastic = 0.1 }'").out,
              HasSubstr("restitution max(0, 1 - 0.1 v^(1/5)) of disks, 0.75 of light with heavy"));
  EXPECT_EQ(carom("run groups.toml -o out --set physics.pairs.0.groups='[\"heavy\", \"lihgt\"]'").status, 2);
}

}  // namespace
}  // namespace carom
