// Every bad scene gives one line that names file, line and key, and says what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using test::sound_scene;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// A single change of the sound scene, and what the error must begin with and contain.
struct Fault {
  std::string_view name;
  std::string_view from, to;
  std::string_view place;  // "line: key: "
  std::string_view says;
};

class BadScene : public testing::TestWithParam<Fault> {};

TEST_P(BadScene, IsNamedByFileLineAndKey) {
  const Fault& fault = GetParam();
  const std::string message = complaint(replaced(sound_scene, fault.from, fault.to));
  EXPECT_THAT(message, AllOf(StartsWith("gas.toml:" + std::string(fault.place)), HasSubstr(std::string(fault.says))));
  EXPECT_THAT(message, HasSubstr("; expected"));
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

std::string name_of(const testing::TestParamInfo<Fault>& info) {
  return std::string(info.param.name);
}

constexpr std::string_view positions = "positions = [[2, 2], [5, 5], [8, 2]]";

const Fault unknown_names[] = {
    {"KeyAtTheTop", "seed = 7", "sed = 7", "2: sed: ", "unknown key; expected one of title, seed,"},
    {"KeyAtTheTopNearest", "seed = 7", "sed = 7", "2: sed: ", "(nearest: seed)"},
    {"KeyInBox", "width = 20.0", "widht = 20.0", "5: box.widht: ", "(nearest: width)"},
    {"KeyInPhysics", "restitution", "restituton", "11: physics.restituton: ", "(nearest: restitution)"},
    {"KeyInDisks", "radius = 1.0", "radus = 1.0", "17: disks.0.radus: ", "(nearest: radius)"},
    {"KeyInRun", "t_end", "tend", "23: run.tend: ", "(nearest: t_end)"},
    {"KeyInOutput", "[run]", "[output]\nmovies = true\n[run]", "21: output.movies: ", "(nearest: movie)"},
    {"KeyInVelocities", "maxwell = 1.0", "maxwel = 1.0", "16: disks.0.velocities.maxwel: ", "(nearest: maxwell)"},
    {"KeyInRadius", "radius = 1.0", "radius = { unifrom = [1, 2] }", "17: disks.0.radius.unifrom: ", "uniform)"},
    {"KeyInMass", "mass = 2.0", "mass = { from_mass = 1 }", "18: disks.0.mass.from_mass: ", "(nearest: from_radius)"},
    {"KeyInPositions", positions, "positions = { fil = \"p\" }", "15: disks.0.positions.fil: ", "(nearest: file)"},
    {"KeyLikeNoOther", "radius = 1.0", "colour = 1.0",
     "17: disks.0.colour: ", "expected one of count, positions, velocities, radius, mass"},
    {"KeyOfAnotherTable", "width = 20.0", "width = 20.0\ngravity = 1",
     "6: box.gravity: ", "wall_roughness (gravity is a key of [physics])"},
    {"KeyOfSeveralTables", "t_end", "every = 1\nt_end", "23: run.every: ", "(every is a key of [output], [analysis])"},
    {"KeyOfTheFile", "t_end", "title = \"gas\"\nt_end",
     "23: run.title: ", "(title is a key of the file itself, before all tables)"},
    {"KeyOfTheFileLikeOneHere", "[run]", "[output]\nseed = 7\n[run]",
     "21: output.seed: ", "(nearest: select) (seed is a key of the file itself, before all tables)"},
    {"Section", "[physics]", "[phsyics]", "10: phsyics: ", "(nearest: physics)"},
    {"SideKind", "left = \"wall\"", "left = \"wal\"", "7: box.left: ", "unknown name \"wal\""},
    {"SideKindInTable", "left = \"wall\"", "left = { kind = \"wal\" }", "7: box.left.kind: ", "unknown name \"wal\""},
    {"KeyOfSide", "left = \"wall\"", "left = { restituton = 0.5 }",
     "7: box.left.restituton: ", "(nearest: restitution)"},
    {"SideKindNearest", "left = \"wall\"", "left = \"wal\"", "7: box.left: ", "(nearest: wall)"},
    {"Method", "pairwise", "pare-wise", "21: run.method: ", "(nearest: pairwise)"},
    {"Positions", positions, "positions = \"randon\"", "15: disks.0.positions: ", "(nearest: random)"},
    {"Plot", "[run]", "[output]\nplots = [\"velocty\"]\n[run]", "21: output.plots.0: ", "(nearest: velocity)"},
    {"Trajectory", "[run]", "[output]\ntrajectory = \"xzy\"\n[run]", "21: output.trajectory: ", "(nearest: xyz)"},
    {"CollapseModel", "restitution = 0.5", "collapse = { model = \"ct\", contact_time = 1 }",
     "11: physics.collapse.model: ", "expected tc"},
};
INSTANTIATE_TEST_SUITE_P(UnknownName, BadScene, testing::ValuesIn(unknown_names), name_of);

const Fault wrong_types[] = {
    {"TextForNumber", "width = 20.0", "width = \"20\"", "5: box.width: ", "is a string; expected a number"},
    {"ListForNumber", "width = 20.0", "width = [20]", "5: box.width: ", "is a list; expected a number"},
    {"NumberForText", "title = \"gas\"", "title = 3", "1: title: ", "is an integer; expected a string"},
    {"DateForNumber", "dt = 0.01", "dt = 2020-01-01", "22: run.dt: ", "is a date or time; expected a number"},
    {"TextForSideRestitution", "left = \"wall\"", "left = { restitution = \"low\" }",
     "7: box.left.restitution: ", "is a string; expected a number"},
    {"NumberForSide", "left = \"wall\"", "left = 1", "7: box.left: ", "is an integer; expected a string"},
    {"FractionForCount", "count = 3", "count = 2.5", "14: disks.0.count: ", "is 2.5; expected a whole number"},
    {"TextForFlag", "[run]", "[output]\nmovie = \"yes\"\n[run]", "21: output.movie: ", "expected true or false"},
    {"TextForRadius", "radius = 1.0", "radius = \"big\"", "17: disks.0.radius: ", "is a string; expected a number, a"},
    {"NumberForPositions", positions, "positions = 3",
     "15: disks.0.positions: ", "expected \"random\", \"growth\", \"square\""},
    {"NumberForVelocities", "{ maxwell = 1.0 }", "1.0", "16: disks.0.velocities: ", "expected { maxwell = T }"},
    {"NumberInPositions", "[5, 5]", "5", "15: disks.0.positions.1: ", "expected two numbers in brackets"},
    {"ThreeNumbers", "[5, 5]", "[5, 5, 5]", "15: disks.0.positions.1: ", "has 3 numbers"},
    {"TextInPosition", "[5, 5]", "[5, \"5\"]", "15: disks.0.positions.1: ", "expected a number"},
    {"TwoLaws", "{ maxwell = 1.0 }", "{ maxwell = 1, uniform = 2 }", "16: disks.0.velocities: ", "has 2 keys"},
    {"NoLaw", "{ maxwell = 1.0 }", "{}", "16: disks.0.velocities: ", "has 0 keys"},
    {"TableForDisks", "[[disks]]", "[disks]", "13: disks: ", "is a table; expected a table [[disks]], in double"},
    {"FractionForSeed", "seed = 7", "seed = 1.5", "2: seed: ", "expected a whole number from 0 to"},
    {"WordForSeed", "seed = 7", "seed = \"seven\"", "2: seed: ", "is \"seven\"; expected a whole number"},
    {"OneLimit", "radius = 1.0", "radius = { uniform = [1] }", "17: disks.0.radius.uniform: ", "has 1 number"},
    {"TextForCollapse", "restitution = 0.5", "collapse = \"tc\"", "11: physics.collapse: ", "expected { model"},
    {"TextForPlots", "[run]", "[output]\nplots = \"velocity\"\n[run]", "21: output.plots: ", "expected a list"},
};
INSTANTIATE_TEST_SUITE_P(WrongType, BadScene, testing::ValuesIn(wrong_types), name_of);

const Fault missing[] = {
    {"Width", "width = 20.0", "", "4: box.width: ", "missing"},
    {"Height", "height = 10.0", "", "4: box.height: ", "missing"},
    {"Count", "count = 3", "", "13: disks.0.count: ", "missing"},
    {"Positions", positions, "", "13: disks.0.positions: ", "missing"},
    {"Radius", "radius = 1.0", "", "13: disks.0.radius: ", "missing"},
    {"Mass", "mass = 2.0", "", "13: disks.0.mass: ", "missing"},
    {"End", "t_end = 10.0", "", "20: run.t_end: ", "missing"},
    {"Run", "[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 10.0", "", "1: run: ", "expected a table [run]"},
    {"StepOfPairwise", "dt = 0.01", "", "20: run.dt: ", "expected the time step of methods rollback and pairwise"},
    {"StepOfRollback", "\"pairwise\"\ndt = 0.01", "\"rollback\"", "20: run.dt: ", "missing"},
    {"CollapseModel", "restitution = 0.5", "collapse = { contact_time = 1 }",
     "11: physics.collapse.model: ", "missing"},
    {"ContactTime", "restitution = 0.5", "collapse = { model = \"tc\" }",
     "11: physics.collapse.contact_time: ", "missing"},
    {"Side", "[run]", "[[sources]]\nrate = 1\nradius = 1\nmass = 1\n[run]", "20: sources.0.side: ", "either side"},
    {"Rate", "[run]", "[[sources]]\nside = \"left\"\nradius = 1\nmass = 1\n[run]", "20: sources.0.rate: ", "missing"},
};
INSTANTIATE_TEST_SUITE_P(Missing, BadScene, testing::ValuesIn(missing), name_of);

const Fault out_of_range[] = {
    {"NegativeRadius", "radius = 1.0", "radius = -1.0", "17: disks.0.radius: ", "is -1; expected a number above 0"},
    {"ZeroRadius", "radius = 1.0", "radius = 0", "17: disks.0.radius: ", "is 0; expected a number above 0"},
    {"NegativeRadiusInList", "radius = 1.0", "radius = [1, -1, 1]", "17: disks.0.radius.1: ", "is -1"},
    {"ZeroMass", "mass = 2.0", "mass = 0.0", "18: disks.0.mass: ", "is 0; expected a number above 0"},
    {"NegativeMassInList", "mass = 2.0", "mass = [1,\n1, -1]", "19: disks.0.mass.2: ", "is -1"},
    {"ZeroDensity", "mass = 2.0", "mass = { from_radius = 0 }", "18: disks.0.mass.from_radius: ", "above 0"},
    {"ChoiceBesideAnotherLaw", "mass = 2.0", "mass = { choice = [1, 2], weights = [1, 1], uniform = [3, 4] }",
     "18: disks.0.mass.uniform: ", "cannot be used with choice"},
    {"ChoiceBesideADensity", "mass = 2.0", "mass = { choice = [1, 2], from_radius = 1 }",
     "18: disks.0.mass.from_radius: ", "cannot be used with choice"},
    {"ZeroLow", "mass = 2.0", "mass = { uniform = [0, 1] }", "18: disks.0.mass.uniform: ", "is [0, 1]; expected"},
    {"LowAboveHigh", "mass = 2.0", "mass = { uniform = [2, 1] }", "18: disks.0.mass.uniform: ", "low <= high"},
    {"RestitutionAboveOne", "restitution = 0.5", "restitution = 1.5", "11: physics.restitution: ", "from 0 to 1"},
    {"RestitutionBelowZero", "restitution = 0.5", "restitution = -0.1", "11: physics.restitution: ", "is -0.1"},
    {"SideRestitution", "left = \"wall\"", "left = { restitution = 1.5 }",
     "7: box.left.restitution: ", "is 1.5; expected a number from 0 to 1"},
    {"ColdSide", "left = \"wall\"", "left = { temperature = 0 }",
     "7: box.left.temperature: ", "is 0; expected a number above 0"},
    {"TemperatureOfSink", "left = \"wall\"", "left = { kind = \"sink\", temperature = 1 }",
     "7: box.left.temperature: ", "cannot be used for a side of kind \"sink\""},
    {"TemperatureAndRestitution", "left = \"wall\"", "left = { temperature = 1, restitution = 1 }",
     "7: box.left.restitution: ", "cannot be used with temperature"},
    {"MotionOfSink", "left = \"wall\"", "left = { kind = \"sink\", motion = { velocity = [1, 0] } }",
     "7: box.left.motion: ", "cannot be used for a side of kind \"sink\""},
    {"MotionOfThermalSide", "left = \"wall\"", "left = { temperature = 1, motion = { velocity = [1, 0] } }",
     "7: box.left.motion: ", "cannot be used with temperature"},
    {"MotionAlong", "left = \"wall\"", "left = { motion = { velocity = [0.1, 1] } }",
     "7: box.left.motion.velocity: ", "is 1 along the side, but a side moves only across itself"},
    {"MotionAsNumber", "left = \"wall\"", "left = { motion = 1 }", "7: box.left.motion: ", "expected { velocity"},
    {"MotionOfOneNumber", "left = \"wall\"", "left = { motion = { velocity = [1] } }",
     "7: box.left.motion.velocity: ", "has 1 number"},
    {"NoMotion", "left = \"wall\"", "left = { motion = {} }",
     "7: box.left.motion: ", "has neither velocity nor vibrate"},
    {"TwoMotions", "left = \"wall\"", "left = { motion = { velocity = [1, 0], vibrate = [1, 0], period = 1 } }",
     "7: box.left.motion: ", "has both velocity and vibrate"},
    {"VibrationWithoutPeriod", "left = \"wall\"", "left = { motion = { vibrate = [1, 0] } }",
     "7: box.left.motion.period: ", "missing"},
    {"PeriodOfVelocity", "left = \"wall\"", "left = { motion = { velocity = [0.1, 0], period = 1 } }",
     "7: box.left.motion.period: ", "cannot be used with a constant velocity"},
    {"ShapeOfVelocity", "left = \"wall\"", "left = { motion = { velocity = [0.1, 0], shape = \"sine\" } }",
     "7: box.left.motion.shape: ", "cannot be used with a constant velocity"},
    {"VibrationAsSaw", "left = \"wall\"", "left = { motion = { vibrate = [1, 0], period = 1, shape = \"sin\" } }",
     "7: box.left.motion.shape: ", "unknown name \"sin\"; expected one of parabola, sine (nearest: sine)"},
    {"PlaceOfSideAtRest", "left = \"wall\"", "left = { place = 1.0 }", "7: box.left.place: ", "does not move"},
    {"SideLeavesTheBox", "left = \"wall\"", "left = { motion = { velocity = [-0.1, 0] } }",
     "7: box.left.motion: ", "brings the left side out of the box before run.t_end = 10"},
    {"SideLeavesTheBoxByItsPlace", "left = \"wall\"", "left = { place = 0.5, motion = { velocity = [-0.1, 0] } }",
     "7: box.left.place: ", "brings the left side out of the box"},
    {"SidesMeet", "left = \"wall\"", "left = { motion = { velocity = [1.9, 0] } }",
     "7: box.left.motion: ", "brings the left and right sides within 1 of each other"},
    {"RestitutionOfSink", "left = \"wall\"", "left = { kind = \"sink\", restitution = 0.5 }",
     "7: box.left.restitution: ", "cannot be used for a side of kind \"sink\""},
    {"WallRestitution", "left = \"wall\"", "wall_restitution = 2", "7: box.wall_restitution: ", "from 0 to 1"},
    {"NegativeGravity", "restitution = 0.5", "gravity = -1",
     "11: physics.gravity: ", "is -1; expected a number, 0 or more, downwards, or [gx, gy]"},
    {"GravityAsAWord", "restitution = 0.5", "gravity = \"down\"",
     "11: physics.gravity: ", "is a string; expected a number, 0 or more, downwards, or [gx, gy]"},
    {"RestitutionAsAWord", "restitution = 0.5", "restitution = \"elastic\"",
     "11: physics.restitution: ", "is a string; expected a number from 0 to 1, or { viscoelastic = ... }"},
    {"GravityOfOneNumber", "restitution = 0.5", "gravity = [1]",
     "11: physics.gravity: ", "has 1 number; expected a number, or [gx, gy]"},
    {"GravityOfThreeNumbers", "restitution = 0.5", "gravity = [1, 2, 3]", "11: physics.gravity: ", "has 3 numbers"},
    {"GravityOfWords", "restitution = 0.5", "gravity = [\"left\", 1]",
     "11: physics.gravity.0: ", "is a string; expected a number"},
    {"GravityAsText", "restitution = 0.5", "gravity = \"down\"", "11: physics.gravity: ", "is a string"},
    {"GravityTooSmall", "restitution = 0.5", "gravity = [1, -1e-91]",
     "11: physics.gravity: ", "is [1, -1e-91]; expected an acceleration from 1e-90 to 1e+90"},
    {"GravityTooStrong", "restitution = 0.5", "gravity = [-1e50, 0]",
     "11: physics.gravity: ", "is [-1e+50, 0]: a disk that falls crosses the box"},
    {"ThermostatAsText", "restitution = 0.5", "thermostat = \"langevin\"",
     "11: physics.thermostat: ", "is a string; expected { kind"},
    {"ThermostatOfUnknownKind", "restitution = 0.5", "thermostat = { kind = \"langevn\", temperature = 1, rate = 1 }",
     "11: physics.thermostat.kind: ", "langevin"},
    {"ThermostatWithoutRate", "restitution = 0.5", "thermostat = { kind = \"andersen\", temperature = 1 }",
     "11: physics.thermostat.rate: ", "missing"},
    {"ThermostatWithoutTemperature", "restitution = 0.5", "thermostat = { kind = \"andersen\", rate = 1 }",
     "11: physics.thermostat.temperature: ", "missing"},
    {"ThermostatAtZero", "restitution = 0.5", "thermostat = { kind = \"andersen\", temperature = 0, rate = 1 }",
     "11: physics.thermostat.temperature: ", "above 0"},
    {"ThermostatBesideDiffusion", "restitution = 0.5",
     "diffusion = 1\nthermostat = { kind = \"andersen\", temperature = 1, rate = 1 }",
     "12: physics.thermostat: ", "cannot be used with physics.diffusion"},
    {"KicksWithinASteps", "restitution = 0.5",
     "thermostat = { kind = \"andersen\", temperature = 1, rate = 1, dt = 0.001 }",
     "11: physics.thermostat.dt: ", "is 0.001, below run.dt = 0.01"},
    {"ThermostatTooStrong", "restitution = 0.5", "thermostat = { kind = \"langevin\", temperature = 1, rate = 101 }",
     "11: physics.thermostat.rate: ", "expected rate dt to be at most 1"},
    {"ThermostatTooHot", "restitution = 0.5", "thermostat = { kind = \"langevin\", temperature = 1e169, rate = 1 }",
     "11: physics.thermostat.temperature: ", "has a speed of"},
    {"ZeroDiffusion", "restitution = 0.5", "diffusion = 0", "11: physics.diffusion: ", "above 0"},
    {"NegativeDiffusion", "restitution = 0.5", "diffusion = -1", "11: physics.diffusion: ", "above 0"},
    {"ZeroContactTime", "restitution = 0.5", "collapse = { model = \"tc\", contact_time = 0 }",
     "11: physics.collapse.contact_time: ", "above 0"},
    {"ZeroWidth", "width = 20.0", "width = 0", "5: box.width: ", "above 0"},
    {"NegativeHeight", "height = 10.0", "height = -10", "6: box.height: ", "above 0"},
    {"ZeroStep", "dt = 0.01", "dt = 0", "22: run.dt: ", "is 0; expected a number above 0"},
    {"NegativeStep", "dt = 0.01", "dt = -0.01", "22: run.dt: ", "is -0.01"},
    {"NegativeEnd", "t_end = 10.0", "t_end = -1", "23: run.t_end: ", "0 or more"},
    {"NegativeEvery", "[run]", "[output]\nevery = -1\n[run]", "21: output.every: ", "0 or more"},
    {"NegativeSeed", "seed = 7", "seed = -7", "2: seed: ", "is -7; expected a whole number from 0 to"},
    {"SeedOf65Bits", "seed = 7", "seed = 18446744073709551616", "2: seed: ", "from 0 to 18446744073709551615"},
    {"NegativeCount", "count = 3", "count = -3", "14: disks.0.count: ", "is -3"},
    {"NegativeTemperature", "maxwell = 1.0", "maxwell = -1.0", "16: disks.0.velocities.maxwell: ", "0 or more"},
    {"NegativeLimit", "maxwell = 1.0", "uniform = -1.0", "16: disks.0.velocities.uniform: ", "0 or more"},
    {"NanRadius", "radius = 1.0", "radius = nan", "17: disks.0.radius: ", "is nan; expected a finite number"},
    {"InfiniteWidth", "width = 20.0", "width = inf", "5: box.width: ", "is inf; expected a finite number"},
    {"NanPosition", "[5, 5]", "[5, nan]", "15: disks.0.positions.1: ", "is nan"},
    {"InfiniteVelocity", "{ maxwell = 1.0 }", "[[0, 0], [0, 0], [-inf, 0]]", "16: disks.0.velocities.2: ", "is -inf"},
    {"NanInList", "mass = 2.0", "mass = [1, nan, 1]", "18: disks.0.mass.1: ", "is nan"},
    {"NanEnd", "t_end = 10.0", "t_end = nan", "23: run.t_end: ", "is nan"},
    {"TooManyDisks", "count = 3", "count = 5000000000", "14: disks.0.count: ", "at most 4000000000"},
    {"CountBeyondAnyInteger", "count = 3", "count = 1e30", "14: disks.0.count: ", "is 1e+30"},
    {"MassOverflows", "radius = 1.0\nmass = 2.0", "radius = 1.0\nmass = { from_radius = 1e308 }",
     "18: disks.0.mass.from_radius: ", "is 1e+308"},
    {"RadiusVanishes", "radius = 1.0\nmass = 2.0", "radius = { from_mass = 1e300 }\nmass = 1e-300",
     "17: disks.0.radius.from_mass: ", "is 1e+300"},
};
INSTANTIATE_TEST_SUITE_P(OutOfRange, BadScene, testing::ValuesIn(out_of_range), name_of);

// A selection of the trajectory by a rectangle that can contain no disk.
const Fault selected[] = {
    {"Above", "[run]", "[output]\ntrajectory = \"xyz\"\nselect = [0.0, 10.0, 20.0, 12.0]\n[run]", "22: output.select: ",
     "the rectangle from (0, 10) to (20, 12) is outside the box of 20 x 10; expected a rectangle that overlaps the "
     "box"},
    {"Below", "[run]", "[output]\ntrajectory = \"xyz\"\nselect = [0.0, -3.0, 20.0, 0.0]\n[run]",
     "22: output.select: ", "is outside the box"},
    {"Right", "[run]", "[output]\ntrajectory = \"h5md\"\nselect = [50.0, 0.0, 60.0, 9.0]\n[run]",
     "22: output.select: ", "is outside the box"},
    {"Left", "[run]", "[output]\ntrajectory = \"xyz\"\nselect = [-5.0, 0.0, -1.0, 9.0]\n[run]",
     "22: output.select: ", "is outside the box"},
    {"Empty", "[run]", "[output]\ntrajectory = \"xyz\"\nselect = [3.0, 0.0, 3.0, 9.0]\n[run]",
     "22: output.select: ", "its corners are not in order"},
};
INSTANTIATE_TEST_SUITE_P(Selected, BadScene, testing::ValuesIn(selected), name_of);

TEST(SelectedRectangle, MayStickOutOfTheBox) {
  const std::string output = "[output]\ntrajectory = \"xyz\"\nselect = [-5.0, 9.9, 30.0, 40.0]\n[run]";
  EXPECT_EQ(test::complaint(test::replaced(test::sound_scene, "[run]", output)), "");
}

}  // namespace
}  // namespace carom
