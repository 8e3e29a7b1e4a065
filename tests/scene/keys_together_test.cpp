// Keys that are valid one by one but not together, at the limits of what is accepted, and a scene of many keys written
// out.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/scene/scene_text.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using test::scene_from;
using test::sound_scene;
using testing::HasSubstr;
using testing::IsEmpty;

// A box of 20 x 10, three disks of radius 1 and mass 2 at rest.
std::string scene_with(const std::string& box, const std::string& physics, const std::string& disks,
                       const std::string& more, const std::string& run = "t_end = 10.0\n") {
  return "[box]\nwidth = 20.0\nheight = 10.0\n" + box + "[physics]\n" + physics +
         "[[disks]]\ncount = 3\npositions = [[2, 2], [5, 5], [8, 2]]\nradius = 1.0\nmass = 2.0\n" + disks + more +
         "[run]\n" + run;
}

const std::string torus = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";

TEST(KeysTogether, SelectionSaysEveryWithAnOrdinal) {
  const auto select = [](const std::string& text) {
    return complaint(scene_with("", "", "", "[output]\ntrajectory = \"xyz\"\nselect = \"" + text + "\"\n"));
  };
  for (const char* fine : {"every 1st", "every 2nd", "every 3rd", "every 100th", "every 7"}) {
    EXPECT_THAT(select(fine), IsEmpty()) << fine;
  }
  for (const char* bad : {"every 100x", "every 2nd disk", "every 1.5th", "every 0th", "every"}) {
    EXPECT_THAT(select(bad), HasSubstr("output.select: is ")) << bad;
  }
}

// The shell passes numbers without quotes: numbers of 64 bits for a seed, too.
TEST(KeysTogether, ASeedOf64BitsIsSetWithoutQuotes) {
  EXPECT_EQ(scene_from(sound_scene, {{"seed", "18446744073709551615"}}).seed, 18446744073709551615U);
  EXPECT_THAT(complaint(sound_scene, {{"seed", "18446744073709551616"}}), HasSubstr("--set seed: is"));
}

// A speed is that of both components, sqrt(2) v for [v, v]: it may exceed the limit of 1e60 although no component does.
TEST(KeysTogether, ASpeedIsThatOfBothComponents) {
  const auto velocity = [](const std::string& v) {
    return complaint(scene_with("", "", "velocities = [[0, 0], [" + v + "], [0, 0]]\n", "", "t_end = 0.0\n"));
  };
  EXPECT_THAT(velocity("0.7e60, 0.7e60"), Not(HasSubstr("has a speed of")));
  for (const char* const one : {"1.5e60, 0", "0, 1.5e60"})
    EXPECT_THAT(velocity(one), HasSubstr("has a speed of 1.5e+60"));
  EXPECT_THAT(velocity("0.8e60, 0.8e60"), HasSubstr("disks.0.velocities.1: is [8e+59, 8e+59]: it has a speed of 1.13"));
}

// Along periodic sides a fall never ends, so its length is g t^2 / 2: 2^53 boxes of length 20 are 1.8e17. Between floor
// and ceiling a fall is at most the box's height, with the speed sqrt(2 g height).
TEST(KeysTogether, AFallThroughPeriodicSidesGoesOn) {
  const auto fall = [](const std::string& sides, const char* g) {
    return complaint(scene_with(sides, fmt::format("gravity = {}\n", g), "", "", "t_end = 1e9\n"));
  };
  EXPECT_THAT(fall(torus, "0.3"), IsEmpty());
  EXPECT_THAT(fall(torus, "0.5"), HasSubstr("physics.gravity: is 0.5: a disk that falls crosses the box 1.25e+16"));
  EXPECT_THAT(fall("", "0.5"), IsEmpty());
  EXPECT_THAT(fall("", "1.5e15"), IsEmpty());
  EXPECT_THAT(fall("", "1.7e15"), HasSubstr("a disk that falls crosses the box 9.21954e+15 times"));
}

TEST(KeysTogether, BrownianDisksGoAsFarAsAllTheirSteps) {
  const auto diffusion = [](const char* d) {
    return complaint(scene_with("", fmt::format("diffusion = {}\n", d), "", "", "t_end = 1e9\ndt = 1.0\n"));
  };
  EXPECT_THAT(diffusion("1.0"), IsEmpty());
  EXPECT_THAT(diffusion("1e20"),
              HasSubstr("physics.diffusion: is 1e+20: a disk in Brownian motion crosses the box 7.07"));
}

TEST(KeysTogether, KicksAreCounted) {
  EXPECT_THAT(complaint(scene_with(
                  "", "thermostat = { kind = \"langevin\", temperature = 1.0, rate = 1.0, dt = 1e-20 }\n", "", "")),
              HasSubstr("physics.thermostat.dt: is 1e-20, which makes 1e+21 kicks until run.t_end = 10"));
}

// Only methods with steps need kicks that are no more frequent than steps.
TEST(KeysTogether, KicksMayComeMoreOftenThanAStepThatExactDoesNotTake) {
  const auto said = [](const char* method) {
    return complaint(scene_with("", "thermostat = { kind = \"langevin\", temperature = 1.0, rate = 1.0, dt = 0.01 }\n",
                                "", "", fmt::format("t_end = 10.0\ndt = 0.1\nmethod = \"{}\"\n", method)));
  };
  EXPECT_THAT(said("exact"), IsEmpty());
  EXPECT_THAT(said("pairwise"), HasSubstr("physics.thermostat.dt: is 0.01, below run.dt = 0.1"));
}

TEST(KeysTogether, SmoothDisksHaveNoSpin) {
  const std::string source = "[[sources]]\nside = \"left\"\nrate = 1.0\nradius = 1.0\nmass = 2.0\n";
  EXPECT_THAT(complaint(scene_with("", "", "", source + "spin = 2.0\n")),
              HasSubstr("sources.0.spin: cannot be used without physics.roughness"));
  EXPECT_THAT(complaint(scene_with("", "", "", source + "spin_temperature = 2.0\n")),
              HasSubstr("sources.0.spin_temperature: cannot be used without physics.roughness"));
}

// 9 sqrt(T / (q m)) is the largest speed of a surface: q = 1e-6 makes it a thousand times that for q = 1.
TEST(KeysTogether, SurfacesHaveASpeedWithinItsRange) {
  const auto said = [](const char* inertia, const std::string& source) {
    return complaint(scene_with("",
                                fmt::format("roughness = {{ tangential_restitution = 0.5, inertia = {} }}\n", inertia),
                                source.empty() ? "spin_temperature = 1e115\n" : "", source, "t_end = 1e-30\n"));
  };
  EXPECT_THAT(said("1.0", ""), Not(HasSubstr("spin_temperature")));
  EXPECT_THAT(said("1e-6", ""), HasSubstr("disks.0.spin_temperature: is 1e+115"));
  const std::string hot =
      "[[sources]]\nside = \"left\"\nrate = 1.0\nradius = 1.0\nmass = 2.0\nspin_temperature = 1e119\n";
  EXPECT_THAT(said("1.0", hot),
              HasSubstr("sources.0.spin_temperature: is 1e+119, which gives a surface a speed of 2.01"));
  EXPECT_THAT(said("0.01", replaced(hot, "1e119", "1e117")), HasSubstr("sources.0.spin_temperature: is 1e+117"));
}

// A sheared box must be four diameters of the largest disk long along both axes, and excludes the TC model.
TEST(KeysTogether, AShearedBoxHasRoomAndNoCollapse) {
  const std::string text = scene_with(torus + "shear_rate = 0.1\n", "", "", "");
  EXPECT_THAT(complaint(text), IsEmpty());
  EXPECT_THAT(complaint(replaced(text, "height = 10.0", "height = 7.9")),
              HasSubstr("box.shear_rate: cannot be used in a box of 20 x 7.9 with a disk of radius 1"));
  const std::string narrow = replaced(replaced(text, "width = 20.0", "width = 7.9"), "[8, 2]]", "[5, 8]]");
  EXPECT_THAT(complaint(narrow),
              HasSubstr("box.shear_rate: cannot be used in a box of 7.9 x 10 with a disk of radius 1"));
  EXPECT_THAT(
      complaint(replaced(replaced(text, "shear_rate = 0.1", "shear_rate = 1e8"), "t_end = 10.0", "t_end = 1e9")),
      HasSubstr("box.shear_rate: is 100000000: the images above move at a speed of 1000000000, by 5e+16 widths"));
  EXPECT_THAT(complaint(replaced(text, "[physics]\n",
                                 "[physics]\nrestitution = 0.9\ncollapse = { model = \"tc\", contact_time = 1e-6 }\n")),
              HasSubstr("box.shear_rate: cannot be used with physics.collapse"));
}

// Sides with different periods do not stay in phase: they come as close to each other as both come into the box.
TEST(KeysTogether, SidesOfTwoPeriodsMeetInTheEnd) {
  const auto said = [](const char* period) {
    return complaint(scene_with(
        fmt::format(
            "left = {{ motion = {{ vibrate = [1.0, 0.0], period = 1.0 }}, place = 8.0 }}\nright = {{ motion = {{ "
            "vibrate = [1.0, 0.0], period = {} }}, place = 11.0 }}\n",
            period),
        "", "", ""));
  };
  EXPECT_THAT(said("1.5"), HasSubstr("brings the left and right sides within 1 of each other"));
  EXPECT_THAT(said("1.0"), Not(HasSubstr("brings the left and right sides")));
}

TEST(KeysTogether, SidesAreApartFromTheStartAndWithinTheBox) {
  const auto said = [](const char* left, const char* right) {
    return complaint(scene_with(fmt::format("left = {{ {} }}\nright = {{ {} }}\n", left, right), "", "", ""));
  };
  EXPECT_THAT(
      said("place = 10.0, motion = { velocity = [-0.5, 0.0] }", "place = 11.0, motion = { velocity = [0.5, 0.0] }"),
      HasSubstr("brings the left and right sides within 1 of each other"));
  EXPECT_THAT(said("motion = { velocity = [3.0, 0.0] }", "kind = \"wall\""),
              HasSubstr("box.left.motion: brings the left side out of the box before run.t_end = 10"));
  EXPECT_THAT(said("motion = { vibrate = [-1.0, 0.0], period = 1.0 }", "kind = \"wall\""), IsEmpty())
      << "it vibrates around a place an amplitude from the edge, whatever the sign";
}

TEST(KeysTogether, WallsHaveALengthAndSinksNoRestitution) {
  const std::string wall = "[[walls]]\nfrom = [12, 2]\nto = [14, 8]\n";
  EXPECT_THAT(complaint(scene_with("", "", "", wall + "kind = \"sink\"\nrestitution = 0.5\n")),
              HasSubstr("walls.0.restitution: cannot be used with kind = \"sink\""));
  EXPECT_THAT(complaint(scene_with("", "", "", replaced(wall, "[14, 8]", "[12, 2]"))),
              HasSubstr("walls.0.to: has the point [12, 2] twice in a row"));
  EXPECT_THAT(complaint(scene_with("", "", "", "[[walls]]\npoints = [[12, 2], [14, 8], [14, 8]]\n")),
              HasSubstr("walls.0.points: has the point [14, 8] twice in a row"));
  EXPECT_THAT(complaint(scene_with("", "", "", "[[walls]]\npoints = [[12, 2]]\n")),
              HasSubstr("walls.0.points: is a list of 1; expected two points or more"));
  EXPECT_THAT(complaint(scene_with("", "", "", wall + "motion = { velocity = [1e61, 0.0] }\n")),
              HasSubstr("walls.0.motion.velocity: is [1e+61, 0]; expected a speed"));
  // The square of such a length is 0; a disk that met such a wall once left with half its energy.
  EXPECT_THAT(complaint(scene_with("", "", "", "[[walls]]\npoints = [[0, 2], [3e-162, 2]]\n")),
              HasSubstr("walls.0.points: has a segment of length 3e-162 to [3e-162, 2]; expected "));
}

// For sizes that are drawn the largest and the lightest disk count.
TEST(KeysTogether, TheLargestOfAGroupHasToFit) {
  const std::string text = replaced(scene_with("", "", "", ""), "radius = 1.0\nmass = 2.0",
                                    "radius = [0.5, 6.0, 0.5]\nmass = { from_radius = 1.0 }");
  EXPECT_THAT(complaint(text), HasSubstr("box.height: 10 is too small for a disk of radius 6"));
}

// Fixed disks may reach out of the box and be wider than it; across periodic sides they must have a single nearest
// image.
TEST(KeysTogether, AFixedDiskMayBeWiderThanTheBox) {
  const auto with_sides = [](const std::string& sides) {
    return complaint("[box]\nwidth = 10\nheight = 8\n" + sides +
                     "[[disks]]\nfixed = true\ncount = 1\npositions = [[5, 0]]\nradius = 6\n"
                     "[[disks]]\ncount = 1\npositions = [[5, 7]]\nradius = 0.5\nmass = 1\n[run]\nt_end = 1\n");
  };
  EXPECT_EQ(with_sides(""), "");
  EXPECT_THAT(with_sides("left = \"periodic\"\nright = \"periodic\"\n"),
              HasSubstr("box.width: 10 is too small for a disk of radius 6; expected at least 24, two diameters"));
}

// A random start ends even with very wide fixed disks, and a lattice of them has its sites inside the box.
TEST(KeysTogether, AFixedDiskThatIsWiderThanTheBoxHasItsCentreInIt) {
  const auto start_of = [](const std::string& radius, const std::string& wide, const std::string& small) {
    const Scene scene =
        scene_from("[box]\nwidth = 10\nheight = 8\n[[disks]]\nfixed = true\ncount = 1\npositions = " + wide +
                   "\nradius = " + radius + "\n[[disks]]\ncount = 1\npositions = " + small +
                   "\nradius = 0.5\nmass = 1\n[run]\nt_end = 1\n");
    try {
      initial_state(scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const char* radius : {"30", "1e9", "1e13"}) {
    EXPECT_THAT(start_of(radius, "[[5, 0]]", "\"random\""), HasSubstr("finds no room")) << radius;
  }
  EXPECT_EQ(start_of("5.5", "[[5, 0]]", "\"random\""), "");
  EXPECT_THAT(start_of("30", "\"square\"", "[[1, 1]]"), HasSubstr("expected at most 0"));
  EXPECT_THAT(start_of("30", "\"hexagonal\"", "[[1, 1]]"), HasSubstr("expected at most 0"));
}

// The limit of a thermostat depends on the lightest disk that moves: fixed disks have no mass.
TEST(KeysTogether, AThermostatIsForDisksThatMove) {
  const auto with_mass = [](const std::string& mass) {
    return complaint(
        "[box]\nwidth = 10\nheight = 8\n[[disks]]\nfixed = true\ncount = 1\npositions = [[5, 4]]\nradius = 1\n"
        "[[disks]]\ncount = 1\npositions = [[1, 1]]\nradius = 0.1\nmass = " +
        mass +
        "\n[physics]\nthermostat = { kind = \"langevin\", temperature = 1e40, rate = 0.5, dt = 0.1 }\n"
        "[run]\nt_end = 1\n");
  };
  EXPECT_EQ(with_mass("1e40"), "");
  EXPECT_THAT(with_mass("1"), HasSubstr("a disk of mass 1"));
}

TEST(KeysTogether, BrownianDisksAndSinks) {
  const std::string brownian = "diffusion = 0.1\n";
  const std::string run = "t_end = 10.0\ndt = 0.01\n";
  EXPECT_THAT(
      complaint(scene_with("", brownian, "", "[[walls]]\nfrom = [12, 2]\nto = [14, 8]\nkind = \"sink\"\n", run)),
      HasSubstr("walls.0.kind: a sink inside the box cannot be used with Brownian motion"));
  const std::string source = "[[sources]]\nside = \"left\"\nrate = 1.0\nradius = 1.0\nmass = 2.0\n";
  EXPECT_THAT(complaint(scene_with("left = \"sink\"\n", brownian, "", source, run)),
              HasSubstr("sources.0.side: left is a sink, which would remove Brownian disks"));
  EXPECT_THAT(complaint(scene_with("left = \"sink\"\n", brownian + "accumulate = true\n", "", source, run)), IsEmpty());
}

TEST(KeysTogether, AStartRegionHoldsWholeDisksBothWays) {
  const auto region = [](const char* corners) {
    return complaint(replaced(scene_with("", "", fmt::format("region = {}\n", corners), ""), "[[2, 2], [5, 5], [8, 2]]",
                              "\"square\""));
  };
  EXPECT_THAT(region("[1, 1, 8, 3]"), IsEmpty());
  EXPECT_THAT(region("[1, 1, 8, 2.9]"), HasSubstr("disks.0.region: is too small for a disk of radius 1"));
  EXPECT_THAT(region("[1, 1, 2.9, 8]"), HasSubstr("disks.0.region: is too small for a disk of radius 1"));
}

// By rounding 0.3 - 0.1 is below 0.2.
TEST(KeysTogether, AStartRegionHoldsARowOfDisksInDecimals) {
  const auto placed = [](const char* positions, const char* corners) {
    return complaint(
        "[box]\nwidth = 20.0\nheight = 10.0\n[[disks]]\ncount = 9\nradius = 0.1\nmass = 1.0\npositions = \"" +
        std::string(positions) + "\"\nregion = " + corners + "\n[run]\nt_end = 1.0\n");
  };
  for (const char* positions : {"random", "square", "hexagonal"}) {
    EXPECT_THAT(placed(positions, "[0.0, 0.1, 10.0, 0.3]"), IsEmpty()) << positions;
    EXPECT_THAT(placed(positions, "[0.1, 0.0, 0.3, 10.0]"), IsEmpty()) << positions;
    EXPECT_THAT(placed(positions, "[0.0, 0.1, 10.0, 0.299999999]"), HasSubstr("too small")) << positions;
  }
}

// By rounding 10.8 + 0.3 * 3 is above 11.7, and 11.7 - 11.4 below 0.3.
TEST(KeysTogether, ASideThatComesToTheEdgeInDecimalsStaysInTheBox) {
  const auto with_right = [](const std::string& side) {
    return complaint("[box]\nwidth = 11.7\nheight = 10.0\nright = { " + side +
                     " }\n[[disks]]\ncount = 1\npositions = [[2, 2]]\nradius = 1.0\nmass = 2.0\n[run]\nt_end = 3.0\n");
  };
  EXPECT_THAT(with_right("place = 10.8, motion = { velocity = [0.3, 0.0] }"), IsEmpty());
  EXPECT_THAT(with_right("place = 11.4, motion = { vibrate = [0.3, 0.0], period = 2.0 }"), IsEmpty());
  EXPECT_THAT(with_right("place = 10.8, motion = { velocity = [0.3000000001, 0.0] }"), HasSubstr("out of the box"));
  EXPECT_THAT(with_right("place = 11.4, motion = { vibrate = [0.3000000001, 0.0], period = 2.0 }"),
              HasSubstr("out of the box"));
}

// By rounding 1.1 - 0.3 - 0.6 is below 0.2: the message was once "0.2, expected at least 0.2".
TEST(KeysTogether, SidesThatComeToADiameterInDecimalsLeaveADiskRoom) {
  const auto with_speed = [](const char* speed) {
    return complaint(
        fmt::format("[box]\nwidth = 1.1\nheight = 10.0\nleft = {{ motion = {{ velocity = [{}, 0.0] }} }}\n"
                    "right = {{ motion = {{ velocity = [-0.2, 0.0] }} }}\n[[disks]]\ncount = 1\n"
                    "positions = [[0.5, 2.0]]\nradius = 0.1\nmass = 1.0\n[run]\nt_end = 3.0\n",
                    speed));
  };
  EXPECT_THAT(with_speed("0.1"), IsEmpty());
  EXPECT_THAT(with_speed("0.1000001"), HasSubstr("brings the left and right sides within 0.2 of each other"));
}

// A side and a wall that both move steadily: the side starts behind the wall and is faster.
TEST(KeysTogether, ASideMayNotOvertakeAWall) {
  const auto said = [](const char* speed) {
    return complaint(scene_with(fmt::format("left = {{ motion = {{ velocity = [{}, 0.0] }} }}\n", speed), "", "",
                                "[[walls]]\nfrom = [11, 2]\nto = [11, 8]\nmotion = { velocity = [0.5, 0.0] }\n"));
  };
  EXPECT_THAT(said("1.55"), Not(HasSubstr("walls.0")));
  EXPECT_THAT(said("1.7"), HasSubstr("walls.0.motion: the left side enters the path of this wall"));
}

// If both vibrate in phase they may be in the same places at different times; they are closest at a quarter or at three
// quarters of a period.
TEST(KeysTogether, ASideAndAWallMaySwingTogether) {
  const auto said = [](const char* x, const char* period) {
    return complaint(scene_with("left = { place = 2.0, motion = { vibrate = [1.0, 0.0], period = 2.0 } }\n", "", "",
                                fmt::format("[[walls]]\nfrom = [{0}, 2]\nto = [{0}, 8]\nmotion = {{ vibrate = [4.0, "
                                            "0.0], period = {1} }}\n",
                                            x, period)));
  };
  const auto swept = HasSubstr("walls.0.motion: the left side enters the path of this wall");
  EXPECT_THAT(said("6.0", "2.0"), Not(HasSubstr("walls.0")));
  EXPECT_THAT(said("4.5", "2.0"), swept) << "the wall is at 0.5 when the side is at 1";
  EXPECT_THAT(said("6.0", "3.0"), swept);
}

TEST(KeysTogether, AWallStaysInTheBox) {
  const auto said = [](const char* velocity) {
    return complaint(scene_with(
        "", "", "", fmt::format("[[walls]]\nfrom = [12, 5]\nto = [14, 5]\nmotion = {{ velocity = {} }}\n", velocity)));
  };
  EXPECT_THAT(said("[0.0, -1.0]"), HasSubstr("walls.0.motion: brings the wall to y = -5, beyond the bottom side"));
  EXPECT_THAT(said("[0.0, 1.0]"), HasSubstr("walls.0.motion: brings the wall to y = 15, beyond the top side"));
  EXPECT_THAT(said("[-2.0, 0.0]"), HasSubstr("walls.0.motion: brings the wall to x = -8, beyond the left side"));
  EXPECT_THAT(said("[1.0, 0.0]"), HasSubstr("walls.0.motion: brings the wall to x = 24, beyond the right side"));
}

// The nearer end of a wall counts, and a side that just reaches it, up to rounding, does not run into it.
TEST(KeysTogether, ASideRunsIntoTheNearerEndOfAWall) {
  const auto said = [](const char* side, const char* from, const char* to) {
    return complaint(scene_with(std::string(side) + "\n", "", "",
                                fmt::format("[[walls]]\nfrom = {}\nto = {}\n", from, to), "t_end = 3.0\n"));
  };
  const char* const right = "right = { motion = { velocity = [-2.5, 0.0] } }";  // as far as 12.5
  EXPECT_THAT(said(right, "[10, 4]", "[12, 4]"), IsEmpty());
  EXPECT_THAT(said(right, "[10, 4]", "[14, 4]"), HasSubstr("walls.0: the right side hits this wall at t = 2.4"));
  const char* const left = "left = { motion = { velocity = [0.1, 0.0] } }";  // as far as 3 * 0.1, which is above 0.3
  EXPECT_THAT(said(left, "[0.3, 4]", "[0.3, 6]"), IsEmpty());
  EXPECT_THAT(said(left, "[0.29, 4]", "[0.29, 6]"), HasSubstr("walls.0: the left side hits this wall"));
}

// A side may come over a source's region as long as there is room in it for a centre, a radius away from the side.
TEST(KeysTogether, ASideLeavesASourceRoom) {
  const auto said = [](const char* speed) {
    return complaint(scene_with(fmt::format("left = {{ motion = {{ velocity = [{}, 0.0] }} }}\n", speed), "", "",
                                "[[sources]]\nregion = [6, 4, 12, 6]\nrate = 1.0\nradius = 1.0\nmass = 2.0\n"));
  };
  EXPECT_THAT(said("1.05"), IsEmpty());
  EXPECT_THAT(said("1.15"), HasSubstr("sources.0.region: the left side leaves no place in this region for the centre "
                                      "of a disk of radius 1 from t = 9.56"));
}

// Each group draws its radii by the ids of its disks, which go on from those of the groups before.
TEST(KeysTogether, PackingFractionCountsTheDisksThatAreDrawn) {
  const std::string drawn =
      "[[disks]]\ncount = 5\npositions = \"random\"\nradius = { uniform = [0.1, 1.0] }\nmass = 1.0\n";
  const Scene scene = scene_from("[box]\npacking_fraction = 0.2\n" + drawn + drawn + "[run]\nt_end = 1.0\n");
  const Disks disks = initial_state(scene).disks;
  double area = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) area += 3.14159265358979 * disks.radius_of(i) * disks.radius_of(i);
  EXPECT_NEAR(area / (scene.box.width * scene.box.height), 0.2, 1e-12);
}

// Fixed disks have no motion and are in no frame: their name is only for [[physics.pairs]].
TEST(KeysTogether, FixedDisksAreNotSelected) {
  const auto select = [](const char* name) {
    return complaint(scene_with("", "", "name = \"gas\"\n",
                                fmt::format("[[disks]]\nname = \"pegs\"\nfixed = true\ncount = 1\npositions = [[15, "
                                            "5]]\nradius = 1.0\n[output]\ntrajectory = \"xyz\"\nselect = \"{}\"\n",
                                            name)));
  };
  EXPECT_THAT(select("gas"), IsEmpty());
  EXPECT_THAT(select("pegs"), HasSubstr("output.select: unknown group \"pegs\""));
}

// The scene written out is the scene that was read: runs are resumed from it.
TEST(KeysTogether, AResolvedSceneKeepsWhatTheyAre) {
  const Scene scene = scene_from(
      "[box]\nwidth = 20.0\nheight = 10.0\nwall_restitution = 0.5\nbottom = \"sink\"\nwall_roughness = { "
      "tangential_restitution = 0.25, friction = 0.5 }\n"
      "left = { restitution = 0.75 }\n"
      "right = { motion = { velocity = [-0.1, 0.0] }, place = 19.0 }\n"
      "top = { motion = { vibrate = [0.0, -0.5], period = 2.0, shape = \"sine\" } }\n"
      "[physics]\nrestitution = { viscoelastic = 0.1, least = 0.4 }\nroughness = { tangential_restitution = 0.5 }\n"
      "thermostat = { kind = \"andersen\", temperature = 2.0, rate = 0.5, dt = 0.125 }\n"
      "[[disks]]\ncount = 2\npositions = [[4, 5], [8, 5]]\nradius = 1.0\nmass = 2.0\n"
      "[[sources]]\nside = \"bottom\"\nrate = 1.0\nradius = 0.5\nmass = 2.0\nlimit = 7\n"
      "[[walls]]\nfrom = [12, 4]\nto = [14, 6]\nkind = \"sink\"\n"
      "[[walls]]\nfrom = [10, 3]\nto = [10, 5]\nrestitution = 0.875\n"
      "[run]\nt_end = 10.0\n[output]\ntrajectory = \"h5md\"\ndimensions = 3\n");
  const Scene again = scene_from(resolved_toml(scene));
  EXPECT_EQ(again.box.sides, scene.box.sides);
  EXPECT_EQ(again.box.restitutions, scene.box.restitutions);
  EXPECT_EQ(again.box.motions, scene.box.motions);
  EXPECT_EQ(again.side_places, scene.side_places);
  EXPECT_EQ(again.physics.restitution, 0.4);
  EXPECT_EQ(again.physics.law.viscosity, 0.1);
  EXPECT_EQ(again.physics.surfaces.walls, scene.physics.surfaces.walls);
  EXPECT_EQ(again.physics.thermostat.kind, Thermostat::Kind::andersen);
  EXPECT_EQ(again.physics.thermostat.dt, 0.125);
  EXPECT_EQ(again.sources.at(0).limit, 7U);
  EXPECT_TRUE(again.walls.at(0).sink);
  EXPECT_EQ(again.walls.at(1).restitution, 0.875);
  EXPECT_EQ(again.output.dimensions, 3);
}

}  // namespace
}  // namespace carom
