// Scenes whose values are valid one by one but not together, unreadable files, and faulty --set.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/machine_memory.hpp"
#include "core/load/memory_need.hpp"
#include "core/load/scene_warnings.hpp"
#include "tests/support/scene_support.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using test::sound_scene;
using test::TestFolder;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

constexpr std::string_view positions = "positions = [[2, 2], [5, 5], [8, 2]]";

// The error for the sound scene with these positions.
std::string with_positions(std::string_view value) {
  return complaint(replaced(sound_scene, positions, value));
}

TEST(SoundScene, HasNoComplaint) {
  EXPECT_EQ(complaint(sound_scene), "");
}

TEST(BadList, LengthMustMatchCount) {
  EXPECT_THAT(
      with_positions("positions = [[2, 2], [5, 5]]"),
      StartsWith("gas.toml:15: disks.0.positions: has 2 entries for count = 3; expected one entry for each disk"));
  EXPECT_THAT(complaint(replaced(sound_scene, "{ maxwell = 1.0 }", "[[1, 0]]")),
              StartsWith("gas.toml:16: disks.0.velocities: has 1 entry"));
  EXPECT_THAT(complaint(replaced(sound_scene, "radius = 1.0", "radius = [1, 1, 1, 1]")),
              StartsWith("gas.toml:17: disks.0.radius: has 4 entries"));
  EXPECT_THAT(complaint(replaced(sound_scene, "mass = 2.0", "mass = []")),
              StartsWith("gas.toml:18: disks.0.mass: has 0 entries"));
}

TEST(UnusedKey, IntervalsShorterThanAStepAreAWarning) {
  const auto warned = [](const std::vector<Override>& sets) {
    std::vector<Override> all = {{"output.series", "true"}, {"analysis.what", "[\"speeds\"]"}};
    all.insert(all.end(), sets.begin(), sets.end());
    return scene_warnings(test::scene_from(sound_scene, all));
  };
  const auto of = [](const std::string& key, const std::string& every) {
    return fmt::format(
        "gas.toml: {}: is {}, shorter than dt = 0.1: time stepping has states only at the ends of its steps", key,
        every);
  };
  const std::vector<Override> long_steps = {{"run.dt", "0.1"}, {"run.t_end", "1.0"}};
  const auto beside = [&](std::vector<Override> sets) {
    sets.insert(sets.begin(), long_steps.begin(), long_steps.end());
    return warned(sets);
  };
  EXPECT_THAT(beside({}), testing::IsEmpty()) << "the default, a hundredth of the run";
  EXPECT_THAT(beside({{"output.every", "0.1"}}), testing::IsEmpty());
  EXPECT_THAT(beside({{"output.every", "0.0"}}), testing::IsEmpty());
  EXPECT_THAT(beside({{"output.every", "0.04"}}), testing::ElementsAre(of("output.every", "0.04")));
  EXPECT_THAT(beside({{"output.every", "0.04"}, {"analysis.every", "0.02"}}),
              testing::ElementsAre(of("output.every", "0.04"), of("analysis.every", "0.02")));
  EXPECT_THAT(beside({{"output.every", "0.04"}, {"run.method", "exact"}}), testing::IsEmpty());
}

// The error must come before any radius is drawn: 3.9e9 of them would take minutes.
TEST(BadCount, MoreDisksThanTheMachineHolds) {
  const std::string text = replaced(replaced(sound_scene, "count = 3", "count = 3_900_000_000"), "radius = 1.0",
                                    "radius = { uniform = [0.5, 1.0] }");
  if (machine_memory() > least_memory(Method::pairwise, 3'900'000'000)) GTEST_SKIP() << "this one holds them";
  EXPECT_THAT(complaint(text), AllOf(StartsWith("gas.toml:14: disks.0.count: 3900000000 disks need at least 242 GB of "
                                                "memory with method pairwise, and this machine has "),
                                     HasSubstr("; expected fewer disks")));
}

TEST(UnusedKey, CollapseWithoutTheExactMethodIsAWarning) {
  const std::string text = replaced(sound_scene, "restitution = 0.5",
                                    "restitution = 0.5\ncollapse = { model = \"tc\", contact_time = 1e-3 }");
  EXPECT_THAT(
      scene_warnings(test::scene_from(text)),
      testing::ElementsAre("gas.toml: physics.collapse: only the exact method uses it, method pairwise does not"));
  EXPECT_THAT(scene_warnings(test::scene_from(text, {{"run.method", "exact"}})), testing::IsEmpty());
  EXPECT_THAT(scene_warnings(test::scene_from(sound_scene)), testing::IsEmpty());
}

TEST(BadSizes, RadiusAndMassDerivedFromEachOther) {
  const std::string text =
      replaced(sound_scene, "radius = 1.0\nmass = 2.0", "radius = { from_mass = 1 }\nmass = { from_radius = 1 }");
  EXPECT_THAT(complaint(text), StartsWith("gas.toml:17: disks.0.radius: radius and mass are both derived"));
}

TEST(BadStart, OverlapNamesBothDisksAndTheOverlap) {
  EXPECT_THAT(with_positions("positions = [[2, 2], [5, 5], [5, 6.5]]"),
              StartsWith("gas.toml:15: disks.0.positions: disks 1 and 2 overlap by 0.5 (25 % of r1 + r2); expected"));
  const std::string periodic = replaced(replaced(sound_scene, "left = \"wall\"", "left = \"periodic\""),
                                        "right = \"wall\"", "right = \"periodic\"");
  EXPECT_THAT(complaint(replaced(periodic, positions, "positions = [[0, 2], [5, 5], [19, 2]]")),
              HasSubstr("disks 0 and 2 overlap by 1 (50 % of r1 + r2)"))
      << "it goes through the side";
}

TEST(BadStart, DiskOutsideTheBox) {
  EXPECT_THAT(with_positions("positions = [[2, 2], [5, 5], [19.5, 2]]"),
              AllOf(StartsWith("gas.toml:15: disks.0.positions: disk 2 of radius 1 at (19.5, 2) is not inside"),
                    HasSubstr("expected its centre a radius or more from each wall")));
  EXPECT_THAT(with_positions("positions = [[2, 2], [5, 0.5], [8, 2]]"), HasSubstr("disk 1 of radius 1"));
  EXPECT_THAT(with_positions("positions = [[2, 2], [5, -3], [8, 2]]"), HasSubstr("disk 1 of radius 1"));
  const std::string sink = replaced(sound_scene, "left = \"wall\"", "left = \"sink\"");
  EXPECT_THAT(complaint(replaced(sink, positions, "positions = [[0.5, 2], [5, 5], [8, 2]]")), HasSubstr("disk 0"));
  const std::string periodic = replaced(replaced(sound_scene, "left = \"wall\"", "left = \"periodic\""),
                                        "right = \"wall\"", "right = \"periodic\"");
  EXPECT_EQ(complaint(replaced(periodic, positions, "positions = [[0, 2], [5, 5], [18, 2]]")), "");
  EXPECT_THAT(complaint(replaced(periodic, positions, "positions = [[-1, 2], [5, 5], [8, 2]]")), HasSubstr("disk 0"));
  EXPECT_THAT(complaint(replaced(periodic, positions, "positions = [[21, 2], [5, 5], [8, 2]]")), HasSubstr("disk 0"));
}

TEST(BadStart, TooManyForALattice) {
  const std::string square =
      replaced(replaced(sound_scene, positions, "positions = \"square\""), "count = 3", "count = 51");
  EXPECT_THAT(complaint(square), AllOf(StartsWith("gas.toml:15: disks.0.positions: 51 disks of radius up to 1"),
                                       HasSubstr("expected at most 50")));
  EXPECT_EQ(complaint(replaced(square, "51", "50")), "") << "10 x 5 diameters";
}

TEST(BadStart, RandomFindsNoRoom) {
  const std::string text =
      replaced(replaced(sound_scene, positions, "positions = \"random\""), "count = 3", "count = 48");
  EXPECT_THAT(complaint(text), AllOf(StartsWith("gas.toml:15: disks.0.positions: \"random\" finds no room for disk "),
                                     HasSubstr("of 48 placed, packing fraction 0."), HasSubstr("\"hexagonal\""),
                                     HasSubstr("positions = \"growth\" (denser)")));
}

TEST(BadStart, MaxwellWithOneDisk) {
  const std::string one = replaced(replaced(sound_scene, positions, "positions = [[2, 2]]"), "count = 3", "count = 1");
  EXPECT_THAT(complaint(one), StartsWith("gas.toml:16: disks.0.velocities: maxwell cannot be used with a single disk"));
  EXPECT_EQ(complaint(replaced(one, "maxwell = 1.0", "maxwell = 0")), "");
  EXPECT_EQ(complaint(replaced(one, "maxwell", "uniform")), "");
}

TEST(BadStart, VelocityOverflows) {
  EXPECT_THAT(complaint(replaced(sound_scene, "maxwell = 1.0", "maxwell = 1e308")), HasSubstr("disks.0.velocities"));
}

TEST(BadBox, PeriodicOnOneSideOnly) {
  EXPECT_THAT(complaint(replaced(sound_scene, "right = \"wall\"", "right = \"periodic\"")),
              StartsWith("gas.toml:8: box.right: right is periodic but left is not; expected"));
  EXPECT_THAT(complaint(replaced(sound_scene, "right = \"wall\"", "bottom = \"periodic\"")),
              StartsWith("gas.toml:8: box.bottom: bottom is periodic but top is not; expected"));
}

TEST(BadBox, SmallerThanADisk) {
  EXPECT_THAT(complaint(replaced(sound_scene, "height = 10.0", "height = 1.9")),
              StartsWith("gas.toml:6: box.height: 1.9 is too small for a disk of radius 1; expected at least 2"));
  const std::string periodic = replaced(replaced(sound_scene, "left = \"wall\"", "bottom = \"periodic\""),
                                        "right = \"wall\"", "top = \"periodic\"");
  EXPECT_THAT(complaint(replaced(periodic, "height = 10.0", "height = 3.9")),
              AllOf(StartsWith("gas.toml:6: box.height: 3.9 is too small"), HasSubstr("two diameters")));
}

// The box is computed from packing_fraction, so no key width or height can be blamed.
TEST(BadBox, MadeToFitTheAreaAndSmallerThanADisk) {
  const std::string flat = replaced(sound_scene, "width = 20.0\nheight = 10.0", "packing_fraction = 0.5\naspect = 20");
  EXPECT_THAT(complaint(flat), StartsWith("gas.toml:5: box.packing_fraction: height of the box: 0.97"));
  EXPECT_THAT(complaint(flat), HasSubstr(" is too small for a disk of radius 1; expected at least 2, the diameter"));
  EXPECT_THAT(complaint(flat, {{"box.packing_fraction", "0.4"}, {"box.aspect", "0.05"}}),
              StartsWith("--set box.packing_fraction: width of the box: 1.08"));
  EXPECT_THAT(complaint(flat, {{"box.packing_fraction", "1e-26"}}),
              StartsWith("--set box.packing_fraction: width of the box: 13729368492956"));
}

TEST(BadBox, SizeSaidTwiceOrOddly) {
  EXPECT_THAT(complaint(replaced(sound_scene, "height = 10.0", "packing_fraction = 0.1")),
              StartsWith("gas.toml:6: box.packing_fraction: cannot be used with width; expected either"));
  EXPECT_THAT(complaint(replaced(sound_scene, "height = 10.0", "height = 10.0\naspect = 2")),
              StartsWith("gas.toml:7: box.aspect: cannot be used without packing_fraction"));
  EXPECT_THAT(complaint(replaced(sound_scene, "width = 20.0\nheight = 10.0", "packing_fraction = 0.91")),
              StartsWith("gas.toml:5: box.packing_fraction: is 0.91; expected a number below pi / sqrt(12)"));
  EXPECT_THAT(complaint(replaced(sound_scene, "width = 20.0\nheight = 10.0", "packing_fraction = 0.1"),
                        {{"disks.0.count", "0"}, {"disks.0.positions", "[]"}}),
              StartsWith("gas.toml:5: box.packing_fraction: gives a box of 0 x 0"));
}

TEST(BadPhysics, BrownianMotionNeedsAStep) {
  const std::string exact = replaced(replaced(sound_scene, "pairwise", "exact"), "dt = 0.01\n", "");
  EXPECT_EQ(complaint(exact), "");
  EXPECT_THAT(complaint(replaced(exact, "restitution = 0.5", "diffusion = 1")),
              StartsWith("gas.toml:20: run.dt: missing; expected the time step of Brownian motion"));
  EXPECT_THAT(complaint(replaced(sound_scene, "restitution = 0.5", "accumulate = true")),
              StartsWith("gas.toml:11: physics.accumulate: needs Brownian motion"));
}

// The sound scene with a source; by default its sizes are those of the disks.
std::string with_source(std::string_view lines, std::string_view sizes = "radius = 1\nmass = 1") {
  return complaint(replaced(sound_scene, "[run]", fmt::format("[[sources]]\n{}\n{}\n[run]", lines, sizes)));
}

TEST(BadSource, SideRegionAndRate) {
  EXPECT_EQ(with_source("side = \"left\"\nrate = 0"), "");
  EXPECT_EQ(with_source("region = [0, 0, 20, 10]\nrate = 2\nlimit = 5"), "");
  EXPECT_THAT(with_source("side = \"left\"\nrate = -1"), StartsWith("gas.toml:22: sources.0.rate: is -1; expected"));
  EXPECT_THAT(with_source("side = \"lft\"\nrate = 1"),
              AllOf(StartsWith("gas.toml:21: sources.0.side: "), HasSubstr("(nearest: left)")));
  EXPECT_THAT(with_source("side = \"left\"\nregion = [0, 0, 1, 1]\nrate = 1"),
              StartsWith("gas.toml:22: sources.0.region: cannot be used with side"));
  EXPECT_THAT(with_source("region = [0, 0, 1]\nrate = 1"), HasSubstr("sources.0.region: has 3 numbers"));
  EXPECT_THAT(with_source("region = [0, 0, 20.5, 10]\nrate = 1"),
              StartsWith("gas.toml:21: sources.0.region: reaches out of the box of 20 x 10"));
  EXPECT_THAT(with_source("region = [-1, 0, 2, 2]\nrate = 1"), HasSubstr("reaches out of the box"));
  EXPECT_THAT(with_source("region = [3, 0, 2, 2]\nrate = 1"), HasSubstr("its corners are not in order"));
  EXPECT_THAT(with_source("side = \"left\"\nrate = 1\nlimit = -1"), HasSubstr("sources.0.limit: is -1"));
  EXPECT_THAT(with_source("side = \"left\"\nrate = 1\ncount = 1"), HasSubstr("sources.0.count: unknown key"));
}

TEST(BadSource, OnAPeriodicSide) {
  const std::string periodic = replaced(replaced(sound_scene, "left = \"wall\"", "left = \"periodic\""),
                                        "right = \"wall\"", "right = \"periodic\"");
  const std::string text =
      replaced(periodic, "[run]", "[[sources]]\nside = \"left\"\nrate = 1\nradius = 1\nmass = 1\n[run]");
  EXPECT_THAT(complaint(text), StartsWith("gas.toml:21: sources.0.side: left is periodic; expected a wall or sink"));
}

TEST(BadSource, LawsThatDoNotServeAnyNumber) {
  const std::string_view side = "side = \"left\"\nrate = 1";
  EXPECT_THAT(with_source(side, "radius = [1]\nmass = 1"), StartsWith("gas.toml:23: sources.0.radius: is a list"));
  EXPECT_THAT(with_source(side, "radius = 1\nmass = [1]"), HasSubstr("sources.0.mass: is a list"));
  EXPECT_THAT(with_source(side, "radius = 1\nmass = 1\nvelocities = [[1, 0]]"), HasSubstr("velocities: is a list"));
  EXPECT_THAT(with_source(side, "radius = { uniform = [1, 6] }\nmass = 1"),
              HasSubstr("box.height: 10 is too small for a disk of radius 6"));
}

// The message must offer only what a source accepts.
TEST(BadSource, IsNotOfferedAList) {
  const std::string_view side = "side = \"left\"\nrate = 1";
  EXPECT_THAT(
      with_source(side, "radius = \"big\"\nmass = 1"),
      EndsWith("sources.0.radius: is a string; expected a number, { uniform = [low, high] }, { normal = [mean, "
               "deviation] }, { lognormal = [median, sigma] }, { choice = [a, b] }, or { from_mass = density }"));
  EXPECT_THAT(with_source(side, "radius = 1"), AllOf(HasSubstr("sources.0.mass: missing; expected a number, { uniform"),
                                                     EndsWith("or { from_radius = density }")));
  EXPECT_THAT(with_source(side, "radius = 1\nmass = 1\nvelocities = 3"),
              EndsWith("sources.0.velocities: is an integer; expected { maxwell = T } or { uniform = v }"));
  const TestFolder folder("bad_source_test");
  const std::string file = folder.write("v.csv", "1,0\n");
  EXPECT_THAT(
      with_source(side, fmt::format("radius = 1\nmass = 1\nvelocities = {{ file = \"{}\" }}", file)),
      EndsWith(fmt::format("sources.0.velocities: is the list in {}; expected a law for any number of disks", file)));
}

TEST(BadFile, EmptyMissingOrNoFile) {
  const TestFolder folder("bad_file_test");
  const auto message = [](const std::string& path) -> std::string {
    try {
      load_scene(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint(""), "gas.toml:1: the file is empty; expected a scene with [box], [[disks]] and [run]");
  EXPECT_THAT(complaint(" \n\n"), HasSubstr("the file is empty"));
  EXPECT_THAT(complaint("# only a comment\n"), StartsWith("gas.toml:1: box: missing"));
  EXPECT_THAT(message(folder.write("empty.toml", "")), HasSubstr("empty.toml:1: the file is empty"));
  EXPECT_THAT(message((folder.path() / "none.toml").string()), HasSubstr("none.toml: cannot be opened: No such file"));
  EXPECT_THAT(message(folder.path().string()), HasSubstr(": is a directory; expected a file"));
}

TEST(BadFile, SyntaxIsReportedWithItsLine) {
  EXPECT_THAT(complaint(replaced(sound_scene, "width = 20.0", "width = ")), StartsWith("gas.toml:5: TOML syntax: "));
  EXPECT_THAT(
      complaint(replaced(sound_scene, "height = 10.0", "width = 10.0")),
      AllOf(StartsWith("gas.toml:6: TOML syntax: "), HasSubstr("cannot redefine existing"), HasSubstr("width")));
  EXPECT_THAT(complaint(replaced(sound_scene, "[run]", "[box]\n[run]")),
              AllOf(StartsWith("gas.toml:20: TOML syntax: "), HasSubstr("cannot redefine")));
  EXPECT_THAT(complaint("\xff\xfe\x01"), StartsWith("gas.toml:1: TOML syntax: "));
  EXPECT_THAT(complaint(replaced(sound_scene, "[box]", "[\x01]")), StartsWith("gas.toml:4: TOML syntax: "));
}

// Notations that people use for numbers elsewhere.
TEST(BadFile, DecimalCommasAndUnits) {
  const auto width = [](const char* value) {
    return complaint(replaced(sound_scene, "width = 20.0", std::string("width = ") + value));
  };
  EXPECT_THAT(width("20,0"), EndsWith("; expected valid TOML 1.0, where decimals have a point: 0.5"));
  EXPECT_THAT(width("20 cm"), EndsWith("; expected valid TOML 1.0, where numbers have no unit"));
  EXPECT_THAT(width("20.0cm # wide"), EndsWith(", where numbers have no unit"));
  EXPECT_THAT(width("90 %"), EndsWith(", where numbers have no unit"));
  EXPECT_THAT(width("{ a = 1 b = 2 }"), EndsWith("; expected valid TOML 1.0")) << "a comma is missing there";
  EXPECT_THAT(width("20 = 30"), EndsWith("; expected valid TOML 1.0"));
}

TEST(BadFile, OnlyStringsAndCommentsLeaveAscii) {
  EXPECT_THAT(complaint(replaced(sound_scene, "dt = 0.01", "dt = \u22120.01")),
              StartsWith("gas.toml:22: TOML syntax: \"\u2212\" outside strings and comments; expected ASCII"));
  EXPECT_THAT(complaint(replaced(sound_scene, "[box]", "[ \u00e9 ]")), StartsWith("gas.toml:4: TOML syntax: "));
  EXPECT_EQ(complaint(replaced(sound_scene, "\"gas\"", "\"\u00e9 \\\" \u00e9\" # \u00e9")), "");
  EXPECT_EQ(complaint(replaced(sound_scene, "\"gas\"", "\"\"\"\u00e9 \"\n \u00e9\"\"\"")), "");
  EXPECT_EQ(complaint(replaced(sound_scene, "\"gas\"", "'\u00e9 \\'")), "");
  EXPECT_EQ(complaint("\xef\xbb\xbf" + std::string(sound_scene)), "") << "byte order mark";
}

// The parser looks for the end of a number at U+FDBF, while our own search takes that for part of a string.
TEST(BadFile, CharactersOutsideAsciiAfterANumber) {
  EXPECT_THAT(complaint(replaced(sound_scene, "dt = 0.01", "dt = +\"0.01\ufdbf")),
              StartsWith("gas.toml:22: TOML syntax: "));
}

TEST(BadFile, CsvThatCannotBeRead) {
  const TestFolder folder("bad_csv_test");
  folder.write("good.csv", "x,y\n2,2\n5,5\n8,2\n");
  folder.write("bad.csv", "x,y\n2,2\n5;5\n8,2\n");
  const auto with_file = [&](const std::string& name) {
    return complaint(replaced(sound_scene, positions, fmt::format("positions = {{ file = \"{}\" }}", name)), {},
                     folder.path().string());
  };
  EXPECT_EQ(with_file("good.csv"), "");
  EXPECT_EQ(with_file("bad.csv"),
            "bad.csv:3: disks.0.positions.file: cannot read \"5;5\"; expected two finite numbers \"x,y\"");
  EXPECT_THAT(with_file("none.csv"), StartsWith("gas.toml:15: disks.0.positions.file \"none.csv\": cannot be opened"));
  EXPECT_THAT(with_file("."), HasSubstr("is a directory"));
  EXPECT_THAT(with_file(""), HasSubstr("is not a file name"));
  folder.write("v.csv", "vx,vy\n2,2\n5,5\n8,2\n");
  EXPECT_EQ(with_file("v.csv"),
            "v.csv:1: disks.0.positions.file: has columns \"vx,vy\"; expected places, as in \"x,y\"");
  folder.write("outside.csv", "2,2\n5,5\n80,2\n");
  EXPECT_THAT(with_file("outside.csv"), HasSubstr("disk 2 (row 3 of outside.csv)"));
}

TEST(BadOverride, IsNamedByItsKey) {
  EXPECT_THAT(complaint(sound_scene, {{"physics.restitution", "2"}}),
              StartsWith("--set physics.restitution: is 2; expected a number from 0 to 1"));
  EXPECT_THAT(complaint(sound_scene, {{"physics.restituton", "1"}}),
              AllOf(StartsWith("--set physics.restituton: unknown key"), HasSubstr("(nearest: restitution)")));
  EXPECT_THAT(complaint(sound_scene, {{"disks.0.radius", "{ uniform = [2, 1] }"}}),
              StartsWith("--set disks.0.radius: disks.0.radius.uniform: is [2, 1]"));
  EXPECT_THAT(complaint(sound_scene, {{"disks.0.positions", "[[2, 2], [5, 5], [5, 6]]"}}),
              StartsWith("--set disks.0.positions: disks 1 and 2 overlap by 1 "));
  EXPECT_THAT(complaint(sound_scene, {{"disks.1.count", "2"}}), StartsWith("--set disks.1.count: no entry \"1\""));
  EXPECT_EQ(complaint(sound_scene, {{"walls.0.restitution", "0.5"}}),
            "--set walls.0.restitution: no entry \"0\", as the scene has no \"walls\"; expected a list of the scene");
  EXPECT_THAT(complaint(sound_scene, {{"title.x", "2"}}),
              StartsWith("--set title.x: \"x\" cannot be a key of a string"));
  EXPECT_THAT(complaint(sound_scene, {{"run.t_end", "[1"}}), StartsWith("--set run.t_end: cannot read \"[1\""));
  EXPECT_EQ(complaint(sound_scene, {{"run.t_end", "1e999"}}),
            "--set run.t_end: is 1e999, too large for a double: the largest is 1.8e+308; expected a number");
  EXPECT_THAT(complaint(sound_scene, {{"physics.gravity", "-1e999"}}),
              StartsWith("--set physics.gravity: is -1e999, too large for a double"));
  for (const std::string& small :
       {std::string("1e-400"), std::string("-2.5E-0400"), "0." + std::string(400, '0') + "1"}) {
    EXPECT_EQ(complaint(sound_scene, {{"run.t_end", '"' + small + '"'}}),
              fmt::format("--set run.t_end: is {}, too small for a double: the smallest is 4.9e-324; expected a number",
                          small));
  }
  EXPECT_THAT(complaint(sound_scene, {{"run.t_end", "1" + std::string(400, '0') + ".0"}}),
              HasSubstr("0.0, too large for a double"));
  EXPECT_THAT(complaint(sound_scene, {{"disks.0.count", "99999999999999999999"}}),
              StartsWith("--set disks.0.count: is 99999999999999999999, too large for the 64 bits of a whole number; "
                         "write it as 1e+20; expected a whole number"));
  EXPECT_THAT(complaint(sound_scene, {{"title", "two words"}}),
              EndsWith("; expected a value as in TOML; text needs quotes of its own: 'title=\"two words\"'"));
  EXPECT_THAT(complaint(sound_scene, {{"output.checkpoint", "10 min"}}),
              EndsWith("text needs quotes of its own: 'output.checkpoint=\"10 min\"'"));
  EXPECT_THAT(complaint(sound_scene, {{"run.t_end", "1,5"}}), EndsWith("; expected a value as in TOML"));
  EXPECT_THAT(complaint(sound_scene, {{"run.t_end", ""}}), StartsWith("--set run.t_end: cannot read"));
  EXPECT_THAT(complaint(sound_scene, {{"run.t_end", "1\n[run]"}}), StartsWith("--set run.t_end: cannot read"));
  EXPECT_THAT(complaint(sound_scene, {{"run.t_end", "\u22121"}}), HasSubstr("outside a string"));
  EXPECT_THAT(complaint(sound_scene, {{"", "1"}}), HasSubstr("is not a key"));
  EXPECT_THAT(complaint(sound_scene, {{"run..t_end", "1"}}), HasSubstr("is not a key"));
  EXPECT_THAT(complaint(sound_scene, {{"run.method", "exakt"}}), HasSubstr("(nearest: exact)"));
}

// The table does not occur in the file, so the message has no line number.
TEST(BadOverride, IsNamedWhereATableThatItMadeIsWrong) {
  EXPECT_THAT(complaint(sound_scene, {{"growth.steps", "5"}, {"run.t_end", "1"}}),
              StartsWith("--set growth.steps: growth: no group grows; expected"));
  EXPECT_THAT(complaint(sound_scene, {{"analysis.every", "1"}}),
              StartsWith("--set analysis.every: analysis.what: missing"));
  EXPECT_THAT(complaint(sound_scene, {{"growht.steps", "5"}}), StartsWith("--set growht.steps: growht: unknown key"));
  EXPECT_THAT(complaint(sound_scene, {{"physics.collapse.model", "tc"}}),
              StartsWith("--set physics.collapse.model: physics.collapse.contact_time: missing"));
  EXPECT_THAT(complaint(replaced(sound_scene, "dt = 0.01\n", ""), {{"run.t_end", "1"}}),
              MatchesRegex("gas.toml:[0-9]+: run.dt: missing.*"))
      << "for a table of the file the line is named";
}

}  // namespace
}  // namespace carom
