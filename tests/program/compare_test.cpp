// carom compare with a tolerance, for chosen fields and times: the differences found, and the exit status.
#include <fmt/format.h>

#include <array>

#include "tests/support/command_support.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;
using test::Outcome;
using test::text_of;
using ::testing::HasSubstr;
using ::testing::Not;

// One disk in a box that is periodic along x, with these positions and velocities, one for each frame.
std::string trajectory(const std::vector<std::string>& disks, double every = 0.1) {
  std::string text;
  for (std::size_t k = 0; k < disks.size(); ++k) {
    text += fmt::format(
        "1\nLattice=\"10 0 0 0 8 0 0 0 1\" Origin=\"0 0 0\" pbc=\"T F F\" "
        "Properties=species:S:1:pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1 Time={}\nA {} 0.5 1 0\n",
        every * static_cast<double>(k), disks[k]);
  }
  return text;
}

class Compare : public test::CommandTest {
 protected:
  Compare() {
    write("a.xyz", trajectory({"1 2 3 4", "9.9995 2 3 4", "5 2 3 4"}));
    write("b.xyz", trajectory({"1 2 3 4", "0.0005 2 3.25 4", "5.5 2 3 4"}));
  }
  Outcome compare(const std::string& options) const { return carom("compare a.xyz b.xyz " + options); }
};

// Status 1 would mean a difference.
TEST_F(Compare, WhatCannotBePrintedIsNoDifference) {
  EXPECT_EQ(carom("run small.toml --quiet -o run").status, 0);
  expect_error("$C compare run run >/dev/full", 2, "cannot write to standard output: No space left on device");
  shell(
      "rm -f gone; { trap '' PIPE; until [ -e gone ]; do sleep 0.01; done; $C compare run run 2>said; echo $? >status; "
      "} "
      "| { exec <&-; : >gone; }; true");
  EXPECT_EQ(text_of(at("status")) + text_of(at("said")),
            "2\ncarom: error: cannot write to standard output: Broken pipe\n");
}

// This must hold for the superuser, too, whose right to read everything is taken away here.
TEST_F(Compare, WhatCannotBeLookedIntoIsNoDifference) {
  EXPECT_EQ(carom("run small.toml --quiet -o run").status, 0);
  for (const std::string command : {"compare shut run", "compare run shut", "resume shut"}) {
    const Outcome o = shell(
        "cp -r run shut; chmod 0 shut; as=; [ $(id -u) != 0 ] || as='setpriv "
        "--bounding-set=-dac_override,-dac_read_search'; $as $C " +
        command + "; status=$?; chmod 755 shut; rm -r shut; exit $status");
    EXPECT_EQ(o.status, 2) << command;
    EXPECT_THAT(o.err, testing::MatchesRegex("carom: error: shut: holds .*; expected .*\n")) << command;
  }
}

TEST_F(Compare, PeriodicPlacesDifferByTheNearestImage) {
  const Outcome o = compare("");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.out, HasSubstr("different: first in frame 2 (t = 0.1), disk 0, x: 9.9995 against 0.0005\n"));
  const Json j = Json::parse(compare("--times :0.1 --json").out);
  EXPECT_NEAR(j["largest"]["x"]["by"].get<double>(), 0.001, 1e-12);
}

TEST_F(Compare, AToleranceForgivesUpToItself) {
  EXPECT_EQ(compare("--tolerance 0.5").status, 0);
  EXPECT_EQ(compare("--tolerance 0").status, 1);
  EXPECT_EQ(compare("--tolerance 0.5").out,
            "the same to 0.5 in 3 frames\n"
            "  x       differs by at most 0.5, in frame 3 (t = 0.2), disk 0\n"
            "  vx      differs by at most 0.25, in frame 2 (t = 0.1), disk 0\n");
  Outcome o = compare("--tolerance 0.3");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.out, HasSubstr("different: first in frame 3 (t = 0.2), disk 0, x: 5 against 5.5"));
  EXPECT_THAT(o.out, HasSubstr("  vx      differs by at most 0.25"));
  o = compare("--tolerance 0.2");
  EXPECT_THAT(o.out, HasSubstr("different: first in frame 2 (t = 0.1), disk 0, vx: 3 against 3.25"));
  EXPECT_EQ(Json::parse(compare("--tolerance 0.2 --json").out)["tolerance"], 0.2);
}

TEST_F(Compare, FramesOfOtherTimesAreToldFromOtherPaths) {
  write("late.xyz", trajectory({"1 2 3 4", "9.9995 2 3 4"}, 0.2));
  EXPECT_THAT(carom("compare a.xyz late.xyz").out,
              HasSubstr("\n  Frames are compared in their order, and from this one on"));
  EXPECT_THAT(compare("").out, Not(HasSubstr("Frames are compared in their order")));
  write("late.xyz", trajectory({"1 2 3 4", "9.9995 2 3 4"}, 0.1 * (1.0 + 1e-15)));
  EXPECT_THAT(carom("compare a.xyz late.xyz").out, Not(HasSubstr("Frames are compared in their order")))
      << "rounding must not matter";
}

TEST_F(Compare, FieldsAndTimesAreChosen) {
  EXPECT_EQ(compare("--fields y,vy,mass").out, "same bits in 3 frames, of y, vy, mass\n");
  EXPECT_EQ(compare("--fields vx --at 0.2").status, 0);
  EXPECT_THAT(compare("--fields vx --at 0.1").out, HasSubstr("frame 2 (t = 0.1), disk 0, vx"));
  EXPECT_EQ(compare("--times :0.05").out, "same bits in 1 frame\n");
  EXPECT_EQ(compare("--times 0.2:").status, 1);
  EXPECT_EQ(compare("--times 0.2: --tolerance 0.5").status, 0);
  expect_error("$C compare a.xyz b.xyz --at 0.3", 2,
               "a.xyz: has no frame at t = 0.3; expected --at within t = 0 to 0.2");
  expect_error("$C compare a.xyz b.xyz --times 1:2", 2, "a.xyz: has no frame from t = 1 to 2; expected --times within");
}

// Times are sums of steps: 0.1 + 0.2 is 0.30000000000000004, which counts as 0.3.
TEST_F(Compare, TimesAreChosenButForRounding) {
  write("a.xyz", trajectory({"1 2 3 4", "2 2 3 4", "3 2 3 4", "4 2 3 4"}));
  write("b.xyz", trajectory({"1 2 3 4", "2 2 3 4", "3 2 3 4", "4.5 2 3 4"}));
  EXPECT_EQ(compare("--times 0.3:").status, 1);
  EXPECT_EQ(compare("--times 0.30000000000000004:").status, 1);
  EXPECT_EQ(compare("--times :0.3").status, 1) << "the last frame, at 0.30000000000000004, counts as 0.3";
  EXPECT_EQ(compare("--times 0.1:0.2").status, 0);
  EXPECT_EQ(compare("--times 0.1:0.1").out, "same bits in 1 frame\n");
  EXPECT_EQ(compare("--at 0.3").status, 1);
  expect_error("$C compare a.xyz b.xyz --at -0.1", 2, "a.xyz: has no frame at t = -0.1; expected --at within");
}

TEST_F(Compare, OfTwoFramesThatAreAsNearTheEarlierIsMeant) {
  write("a.xyz", trajectory({"1 2 3 4", "2 2 3 4", "3 2 3 4"}, 0.5));
  write("b.xyz", trajectory({"1 2 3 4", "2.5 2 3 4", "3 2 3 4"}, 0.5));
  EXPECT_EQ(compare("--at 0.25").status, 0);
  EXPECT_EQ(compare("--at 0.26").status, 1);
  EXPECT_EQ(compare("--at 0.75").status, 1);
}

// The left and right sides are periodic here, the bottom and top are not.
TEST_F(Compare, OnlyPeriodicSidesAreCrossed) {
  write("a.xyz", trajectory({"1 0.5 3 4", "1 0.5 3 4"}));
  write("b.xyz", trajectory({"1 7.5 3 4", "1 7.5 3 4"}));
  EXPECT_EQ(compare("--tolerance 1").status, 1);
  EXPECT_EQ(compare("--tolerance 7").out,
            "the same to 7 in 2 frames\n  y       differs by at most 7, in frame 1 (t = 0), disk 0\n")
      << "the first of several equal differences";
  for (const char* const file : {"a.xyz", "b.xyz"}) {
    write(file, test::replaced(test::replaced(text_of(at(file)), "T F F", "F T F"), "T F F", "F T F"));
  }
  EXPECT_EQ(compare("--tolerance 1").status, 0);
}

// Times of 1e-12 occur, for example, in a scene in nanometres and seconds.
TEST_F(Compare, TimesAreChosenInAnyUnit) {
  write("short_a.xyz", trajectory({"1 2 3 4", "2 2 3 4", "3 2 3 4"}, 1e-12));
  write("short_b.xyz", trajectory({"1 2 3 4", "2 2 3 4", "3.5 2 3 4"}, 1e-12));
  EXPECT_EQ(carom("compare short_a.xyz short_b.xyz --times :1e-12").out, "same bits in 2 frames\n");
  EXPECT_EQ(carom("compare short_a.xyz short_b.xyz --times 2e-12:").out.substr(0, 9), "different");
  expect_error("$C compare short_a.xyz short_b.xyz --at 3e-12", 2,
               "short_a.xyz: has no frame at t = 3e-12; expected --at within t = 0 to 2e-12");
  expect_error("$C compare short_a.xyz short_b.xyz --times 3e-12:4e-12", 2, "has no frame from t = 3e-12 to 4e-12");
}

TEST_F(Compare, SpinsThatNeitherHasCannotBeCompared) {
  for (const std::string fields : {"spin", "y,spin"}) {
    expect_error("$C compare a.xyz b.xyz --fields " + fields, 2,
                 "a.xyz and b.xyz: neither has spins, so that they cannot be compared; expected other --fields");
  }
  EXPECT_EQ(compare("--tolerance 0.5 --fields x,y,vx,vy,radius,mass,spin,group,image_x,image_y").status, 0)
      << "all frames that there are";
  ASSERT_EQ(carom("run small.toml --quiet -o smooth").status, 0);
  ASSERT_EQ(carom("run small.toml --quiet -o rough --set physics.roughness.tangential_restitution=0.5 --set "
                  "disks.0.spin_temperature=1")
                .status,
            0);
  EXPECT_EQ(carom("compare rough rough --fields spin").out, "same bits in 11 frames, of spin\n");
  EXPECT_EQ(carom("compare smooth rough --fields y,spin --at 1").status, 1) << "fields that both have can be compared";
}

TEST_F(Compare, WithARuleOnlyTrajectoriesCount) {
  ASSERT_EQ(carom("run small.toml --quiet -o one").status, 0);
  ASSERT_EQ(carom("run small.toml --quiet -o two --method exact").status, 0);
  EXPECT_EQ(carom("compare one two").status, 1);
  const Outcome o = carom("compare one two --tolerance 0.1");
  EXPECT_EQ(o.status, 0) << o.out << "five disks that hardly collide, and summaries of two methods";
  std::string bare = test::small_scene;
  const std::size_t line = bare.find("trajectory = ");
  ASSERT_NE(line, std::string::npos);
  bare.erase(line, bare.find('\n', line) + 1 - line);
  write("bare.toml", bare);
  ASSERT_EQ(carom("run bare.toml --quiet -o bare").status, 0);
  expect_error("$C compare one bare --tolerance 1", 2, "bare: holds no trajectory; expected a trajectory: --tolerance");
}

TEST_F(Compare, WhatOnlyOneHasIsADifferenceAtAnyTolerance) {
  write("b.xyz", trajectory({"1 2 3 4", "9.9995 2 3 4"}));
  const Outcome o = compare("--tolerance 1e9");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.out, HasSubstr("different: first in frame 3 (t = 0.2): only one has it; 3 frames against 2"));
  EXPECT_THAT(o.out, HasSubstr("\n  frames  3 against 2\n"));
  const Json j = Json::parse(compare("--tolerance 1e9 --json").out);
  EXPECT_EQ(j["frames"], Json({3, 2}));
  EXPECT_EQ(j["same"], false);
}

// The same disks in another box are a different state.
TEST_F(Compare, TheBoxIsCompared) {
  const std::string one = trajectory({"1 2 3 4", "2 2 3 4"});
  write("a.xyz", one);
  const auto with_box = [&](const std::string& from, const std::string& to) {
    std::string other = one;
    const std::size_t at = other.rfind(from);  // in the second frame
    write("b.xyz", other.replace(at, from.size(), to));
  };
  with_box("10 0 0", "10.5 0 0");
  const Outcome o = compare("");
  EXPECT_EQ(o.status, 1);
  EXPECT_EQ(o.out, "different: first in frame 2 (t = 0.1): the width of its box is 10 against 10.5\n");
  EXPECT_EQ(compare("--tolerance 0.4").status, 1);
  EXPECT_EQ(compare("--tolerance 0.6").status, 0);
  EXPECT_EQ(compare("--fields x,y,vx,vy").status, 0) << "if fields are named, only these count";
  const Json first = Json::parse(compare("--json").out)["first"];
  EXPECT_EQ(first["quantity"], "width");
  EXPECT_EQ(first["by"], 0.5);
  with_box("0 8 0", "0 9 0");
  EXPECT_THAT(compare("").out, HasSubstr("frame 2 (t = 0.1): the height of its box is 8 against 9\n"));
  with_box("T F F", "F F F");
  EXPECT_THAT(compare("--tolerance 1e9").out,
              HasSubstr("the left and right sides of its box are periodic, and are not in the other\n"));
  with_box("T F F", "T T F");
  EXPECT_THAT(compare("").out,
              HasSubstr("the bottom and top sides of its box are not periodic, and are in the other\n"));
}

// One or more frames of two disks with these last columns.
std::string with_columns(const std::string& columns, const std::vector<std::array<std::string, 2>>& frames) {
  std::string text;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    text += fmt::format(
        "2\nLattice=\"10 0 0 0 8 0 0 0 1\" Origin=\"0 0 0\" pbc=\"T F F\" "
        "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1{} Time={}\n",
        columns, k);
    for (std::size_t i = 0; i < 2; ++i) text += fmt::format("X {} 4 0 1 0 0 0.5 1 {} {}\n", 2 + 3 * i, i, frames[k][i]);
  }
  return text;
}

TEST_F(Compare, EveryColumnOfADiskIsCompared) {
  const std::vector<std::pair<std::string, std::string>> changes{
      {"X 5 4", "X 5.5 4"},       {"5 4 0 1", "5 4.5 0 1"},  {"4 0 1 0", "4 0 2 0"},     {"1 0 0 0.5", "1 1 0 0.5"},
      {"0.5 1 1", "0.25 1 1"},    {"0.5 1 1", "0.5 2 1"},    {"1 0 0 0 7", "1 0 0 0 8"}, {"1 1 0 0 0", "1 0 0 0 0"},
      {"1 1 0 0 0", "1 1 1 0 0"}, {"1 1 0 0 0", "1 1 0 1 0"}};
  const char* const names[] = {"x", "y", "vx", "vy", "radius", "mass", "spin", "group", "image_x", "image_y"};
  const std::string one = with_columns(":group:I:1:map_shift:I:3:spin:R:1", {{"0 0 0 0 7", "1 0 0 0 7"}});
  write("a.xyz", one);
  for (std::size_t k = 0; k < changes.size(); ++k) {
    std::string other = one;
    const std::size_t line = other.find("\nX 5") + 1;
    const std::size_t at = other.find(changes[k].first, line);
    ASSERT_NE(at, std::string::npos) << names[k];
    write("b.xyz", other.replace(at, changes[k].first.size(), changes[k].second));
    const Outcome o = compare("");
    EXPECT_EQ(o.status, 1) << names[k];
    EXPECT_THAT(o.out, HasSubstr(fmt::format("different: first in frame 1 (t = 0), disk 1, {}: ", names[k])));
    EXPECT_EQ(compare(fmt::format("--fields {}", names[k])).status, 1) << names[k];
    EXPECT_EQ(compare(fmt::format("--fields {}", names[(k + 1) % changes.size()])).status, 0) << names[k];
  }
}

TEST_F(Compare, AFileWithoutGroupsIsOfOne) {
  write("a.xyz", with_columns("", {{"", ""}}));
  write("b.xyz", with_columns(":group:I:1", {{"0", "0"}}));
  EXPECT_EQ(compare("").status, 0);
  write("b.xyz", with_columns(":group:I:1", {{"0", "1"}}));
  EXPECT_THAT(compare("--tolerance 1e9").out, HasSubstr("disk 1, group: 0 against 1")) << "a group is not a length";
  EXPECT_EQ(compare("--fields x,y").status, 0);
}

// Of two disks at a periodic side, on either side of it, one may have one round more.
TEST_F(Compare, RoundsAreComparedOnThePathsOfBoth) {
  const std::string rounds = ":map_shift:I:3";
  const std::string near_left = with_columns(rounds, {{"0 0 0", "0 0 0"}});
  write("a.xyz", test::replaced(near_left, "X 2 4 0 1 0 0 0.5 1 0 0", "X 9.9 4 0 1 0 0 0.5 1 0 -1"));
  write("b.xyz", test::replaced(near_left, "X 2 4", "X 0.1 4"));
  EXPECT_EQ(compare("--tolerance 0.3").status, 0) << compare("--tolerance 0.3").out;
  EXPECT_EQ(compare("--fields image_x").status, 0);
  write("b.xyz", test::replaced(near_left, "X 2 4 0 1 0 0 0.5 1 0 0", "X 0.1 4 0 1 0 0 0.5 1 0 1"));
  EXPECT_THAT(compare("--tolerance 0.3").out, HasSubstr("disk 0, image_x: -1 against 1\n"));
  EXPECT_THAT(compare("--tolerance 0.3").out, HasSubstr("  image_x differs by at most 1, in frame 1"));
  EXPECT_EQ(compare("--tolerance 11").status, 0) << "the tolerance is in the scene's units: one round is 10";
}

// Rounds are counted from the first frame of a file, which may differ if only some frames are compared.
TEST_F(Compare, RoundsOfSomeFramesAreComparedWhereTheyAreAskedFor) {
  const std::string rounds = ":map_shift:I:3";
  write("a.xyz", with_columns(rounds, {{"0 0 0", "0 0 0"}, {"1 0 0", "2 0 0"}}));
  write("b.xyz", with_columns(rounds, {{"0 0 0", "0 0 0"}, {"1 0 0", "1 0 0"}}));
  EXPECT_THAT(compare("").out, HasSubstr("first in frame 2 (t = 1), disk 1, image_x: 2 against 1"));
  EXPECT_EQ(compare("--at 1").out, "same bits in 1 frame\n");
  EXPECT_EQ(compare("--times 1:").out, "same bits in 1 frame\n");
  EXPECT_EQ(compare("--at 1 --fields x,image_x").status, 1);
  write("b.xyz", with_columns("", {{"", ""}, {"", ""}}));
  EXPECT_EQ(compare("").status, 0) << "as from an earlier version, which did not count them";
  expect_error("$C compare a.xyz b.xyz --fields image_y", 2, "a.xyz and b.xyz: not both have images");
}

// A run has the same columns in both formats.
TEST_F(Compare, BothFormatsHaveTheSame) {
  write("two.toml", test::replaced(test::small_scene, "[run]", R"([[disks]]
count = 2
positions = [[1.0, 9.0], [9.0, 9.0]]
velocities = [[9.0, 0.0], [-7.0, 0.0]]
radius = 0.25
mass = 2.0
spin = 3.0
[run]
)"));
  const std::string run =
      "run two.toml --quiet --set box.left=periodic --set box.right=periodic --set "
      "physics.roughness.tangential_restitution=0.5 ";
  ASSERT_EQ(carom(run + "-o text").status, 0);
  ASSERT_EQ(carom(run + "-o binary --set output.trajectory=h5md").status, 0);
  ASSERT_EQ(carom(run + "-o deep --set output.trajectory=h5md --set output.dimensions=3").status, 0);
  EXPECT_THAT(text_of(at("text/trajectory.xyz")), HasSubstr(":id:I:1:group:I:1:map_shift:I:3:spin:R:1"));
  EXPECT_THAT(text_of(at("text/trajectory.xyz")), HasSubstr(" 6 1 1 0 0 ")) << "disk 6, of group 1, has gone round";
  for (const char* const other : {"binary", "deep"}) {
    const std::string both = fmt::format("compare text/trajectory.xyz {}/trajectory.h5", other);
    EXPECT_EQ(carom(both).out, "same bits in all 11 frames\n") << other;
    EXPECT_EQ(carom(both + " --fields group,image_x,image_y,spin").status, 0) << other;
    std::string changed = text_of(at("text/trajectory.xyz"));
    const std::size_t at_round = changed.find(" 6 1 1 0 0 ");
    write("changed.xyz", changed.replace(at_round, 11, " 6 1 0 0 0 "));
    EXPECT_THAT(carom(fmt::format("compare changed.xyz {}/trajectory.h5", other)).out,
                HasSubstr("disk 6, image_x: 0 against 1"));
    changed = text_of(at("text/trajectory.xyz"));
    write("changed.xyz", changed.replace(at_round, 11, " 6 0 1 0 0 "));
    EXPECT_THAT(carom(fmt::format("compare changed.xyz {}/trajectory.h5", other)).out,
                HasSubstr("disk 6, group: 0 against 1"));
  }
}

TEST_F(Compare, JsonHasTheNumbersOfTheText) {
  const Outcome o = compare("--json");
  EXPECT_EQ(o.status, 1);
  const Json j = Json::parse(o.out);
  EXPECT_FALSE(j.contains("tolerance"));
  EXPECT_EQ(j["first"], (Json{{"frame", 2},
                              {"time", 0.1},
                              {"disk", 0},
                              {"quantity", "x"},
                              {"a", 9.9995},
                              {"b", 0.0005},
                              {"by", j["first"]["by"]}}));
  EXPECT_EQ(
      j["largest"]["vx"],
      (Json{{"frame", 2}, {"time", 0.1}, {"disk", 0}, {"quantity", "vx"}, {"a", 3.0}, {"b", 3.25}, {"by", 0.25}}));
  EXPECT_EQ(j["largest"]["x"]["frame"], 3);
  EXPECT_FALSE(j["largest"].contains("y"));
  EXPECT_TRUE(Json::parse(compare("--json --fields x").out)["tolerance"].is_null());
}

}  // namespace
}  // namespace carom
