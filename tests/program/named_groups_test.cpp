// Groups with names: their columns, how select shows and measures them, and messages for bad names.
#include <cmath>
#include <map>

#include "core/measure/invariants.hpp"
#include "core/scene/scene_text.hpp"
#include "io/tables/group_columns.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/motion_of_group.hpp"
#include "tests/support/program_support.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using test::scene_from;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* three_groups = R"(title = "tracer in a bath"
seed = 3
[box]
width = 20.0
height = 20.0
left = "periodic"
right = "periodic"
[[disks]]
name = "bath"
count = 60
positions = "random"
velocities = { maxwell = 1.0 }
radius = 0.5
mass = 1.0
[[disks]]
count = 5
positions = "random"
velocities = { maxwell = 1.0 }
radius = 0.4
mass = 1.0
[[disks]]
name = "tracer"
count = 20
positions = "random"
velocities = { maxwell = 3.0 }
radius = 0.3
mass = 2.0
[[sources]]
side = "top"
rate = 2.0
radius = 0.3
mass = 1.0
velocities = { maxwell = 1.0 }
[run]
t_end = 3.0
[output]
every = 0.25
trajectory = "xyz"
series = true
)";

std::string with(const std::string& lines) {
  return three_groups + lines;
}

TEST(NamedGroups, MotionIsThatOfTheMembers) {
  const Disks d = test::disks_of({{1, 1, 3, 0, 0.1, 2, 0}, {2, 2, 100, 9, 0.1, 5, 0}, {3, 3, -1, 4, 0.1, 6, 0}});
  const std::vector<std::size_t> members{0, 2};
  const GroupMotion motion = test::group_motion(d, members);
  EXPECT_EQ(motion.velocity, (Vec2{0.0, 3.0}));
  EXPECT_EQ(motion.kinetic, 0.5 * 2 * 9 + 0.5 * 6 * 17);
  // Relative to (0, 3) they have (3, -3) with mass 2 and (-1, 1) with mass 6.
  EXPECT_EQ(motion.temperature, (0.5 * 2 * 18 + 0.5 * 6 * 2) / 2);
  EXPECT_TRUE(std::isnan(test::group_motion(d, {}).temperature));
}

TEST(NamedGroups, RowsDoNotDependOnStorageAndEveryBlockHasItsTemperature) {
  const Scene scene = scene_from(with(""));
  Disks disks = initial_state(scene).disks;
  const GroupMeter meter(scene);
  const std::vector<double> row = meter.row(disks);
  std::map<std::string, double> value;
  const std::vector<GroupColumn> columns = meter.columns();
  ASSERT_EQ(row.size(), columns.size());
  for (std::size_t k = 0; k < row.size(); ++k) value[columns[k].name] = row[k];
  EXPECT_EQ(value["disks_bath"], 60.0);
  EXPECT_EQ(value["disks_tracer"], 20.0);
  EXPECT_EQ(value["disks_sources"], 0.0);
  EXPECT_TRUE(std::isnan(value["temperature_sources"]));
  EXPECT_NEAR(value["temperature_bath"], 1.0, 1e-12);
  EXPECT_NEAR(value["temperature_tracer"], 3.0, 1e-12);
  EXPECT_NEAR(value["kinetic_tracer"], 60.0, 1e-10);
  EXPECT_EQ(value.size(), 18U) << "without a position along the periodic axis";
  EXPECT_EQ(value.count("x_tracer"), 0U);
  EXPECT_TRUE(value["y_tracer"] > 0.0 && value["y_tracer"] < 20.0);
  EXPECT_TRUE(std::isnan(value["y_sources"]));
  Disks turned;
  for (std::size_t i = disks.size(); i-- > 0;) append(turned, disk_at(disks, i));
  const std::vector<double> again = meter.row(turned);
  for (std::size_t k = 0; k < row.size(); ++k) EXPECT_TRUE(row[k] == again[k] || std::isnan(row[k])) << k;
}

// In a shear flow energy and velocity of a group are those of the laboratory frame, as for all disks; its temperature
// excludes the flow and the group's motion in the flow.
TEST(NamedGroups, TemperaturesAreRelativeToAShearFlow) {
  const Scene scene = scene_from(R"(
[box]
width = 20.0
height = 30.0
left = "periodic"
right = "periodic"
bottom = "periodic"
top = "periodic"
shear_rate = 0.5
[[disks]]
name = "some"
count = 50
positions = "random"
velocities = { maxwell = 2.0 }
drift = [3.0, 0.0]
radius = 0.2
mass = 1.0
[run]
t_end = 1.0
)");
  const Disks disks = initial_state(scene).disks;
  const std::vector<double> row = GroupMeter(scene).row(disks);
  ASSERT_EQ(row.size(), 5U);
  const Energy energy = energy_of(disks, scene.physics.gravity);
  EXPECT_NEAR(row[1], energy.kinetic, 1e-9 * energy.kinetic);
  EXPECT_NEAR(row[2], 2.0, 1e-12);
  EXPECT_NEAR(row[3], momentum_of(disks).x / 50.0, 1e-12);
  EXPECT_GT(energy.kinetic, 2.0 * 50.0 + 0.5 * 50.0 * 9.0);
}

TEST(NamedGroups, WithoutNamesThereAreNoColumns) {
  EXPECT_TRUE(GroupMeter(scene_from(test::sound_scene)).columns().empty());
}

TEST(NamedGroups, AResolvedSceneKeepsThem) {
  const std::string text = with("select = \"tracer\"\n[analysis]\nwhat = [\"speeds\"]\nselect = \"bath\"\n");
  const Scene scene = scene_from(resolved_toml(scene_from(text)));
  EXPECT_EQ(scene.groups[2].name, "tracer");
  EXPECT_EQ(scene.groups[1].name, "");
  EXPECT_EQ(scene.output.select.ids, (IdRange{65, 85}));
  EXPECT_EQ(scene.analysis.ids, (IdRange{0, 60}));
}

TEST(NamedGroups, BadNamesAreNamedByFileLineAndKey) {
  const auto named = [](const char* name) { return complaint(replaced(three_groups, "\"tracer\"\n", name)); };
  EXPECT_THAT(named("\"tracer,2\"\n"), StartsWith("gas.toml:22: disks.2.name: is \"tracer,2\"; expected a letter"));
  EXPECT_THAT(named("\"\"\n"), HasSubstr("disks.2.name: is \"\"; expected a letter"));
  EXPECT_THAT(named("\"2nd\"\n"), HasSubstr("expected a letter"));
  EXPECT_THAT(named("\"sources\"\n"), HasSubstr("is \"sources\", which names the disks of all [[sources]]"));
  EXPECT_THAT(
      named("\"bath\"\n"),
      StartsWith(
          "gas.toml:22: disks.2.name: is \"bath\", the name of disks.0; expected a name that no other group has"));
  EXPECT_THAT(named("7\n"), HasSubstr("disks.2.name: is an integer; expected a string"));
}

TEST(NamedGroups, UnknownNamesGetTheNearest) {
  EXPECT_THAT(complaint(with("select = \"tracr\"\n")),
              StartsWith("gas.toml:40: output.select: unknown group \"tracr\"; expected one of bath, tracer, sources "
                         "(nearest: tracer)"));
  EXPECT_THAT(complaint(with("[analysis]\nwhat = [\"speeds\"]\nselect = \"bth\"\n")),
              StartsWith("gas.toml:42: analysis.select: unknown group \"bth\"; expected one of bath, tracer, sources "
                         "(nearest: bath)"));
  EXPECT_THAT(complaint(std::string(test::sound_scene) + "[analysis]\nwhat = [\"speeds\"]\nselect = \"bath\"\n"),
              HasSubstr("expected the name of a [[disks]] block, and none has one"));
}

class NamedGroupsRun : public test::ProgramTest {};
using LongNamedGroupsRun = NamedGroupsRun;

TEST_F(NamedGroupsRun, ATrajectoryShowsTheGroupInBothFormats) {
  write("scene.toml", with(""));
  const std::map<std::string, std::pair<std::string, std::string>> cases{{"tracer", {"65", "84"}},
                                                                         {"sources", {"85", "89"}}};
  for (const auto& [name, ids] : cases) {
    const std::string run = "run scene.toml --quiet --force --set output.select=" + name;
    ASSERT_EQ(carom(run + " -o xyz").status, 0);
    ASSERT_EQ(carom(run + " -o h5 --set output.trajectory=h5md").status, 0);
    EXPECT_THAT(carom("compare xyz h5").out, HasSubstr("same bits in all 13 frames")) << name;
    const std::string last = shell("tail -n 1 xyz/trajectory.xyz").out;
    EXPECT_THAT(last, HasSubstr(" " + ids.second + " ")) << "the last id of the group";
    if (name == "tracer") {
      EXPECT_EQ(shell("grep -c '^X' xyz/trajectory.xyz").out, "260\n");
    }
    EXPECT_EQ(shell("awk '/^X/ && $10 < " + ids.first + "' xyz/trajectory.xyz").out, "");
  }
  EXPECT_EQ(shell("/usr/bin/python3 -c 'import h5py; f = h5py.File(\"h5/trajectory.h5\"); "
                  "print(f[\"observables/disks_sources/value\"][-1], f[\"particles/disks/id/value\"].shape[1])'")
                .out,
            "5 20\n");
}

// The analysis of a group is the same as in a scene without other disks.
TEST_F(LongNamedGroupsRun, AnalysisOfAGroupIsThatOfItsDisksAlone) {
  const std::string what =
      "[analysis]\nwhat = [\"pair_correlation\", \"displacement\", \"speeds\", \"density\", \"collision_rate\"]\n"
      "pair_correlation = { r_max = 4.0, bins = 20 }\nselect = \"tracer\"\n";
  // The largest radius in the scene must stay, as it affects the counting of pairs at walls.
  const std::string text = replaced(with(what), "rate = 2.0\nradius = 0.3", "rate = 2.0\nradius = 0.5");
  write("all.toml", text);
  ASSERT_EQ(carom("run all.toml --quiet -o all --t-end 0").status, 0);
  std::string alone = replaced(text, "count = 60", "count = 0");
  alone = replaced(alone, "count = 5", "count = 0");
  write("alone.toml",
        replaced(alone, "positions = \"random\"\nvelocities = { maxwell = 3.0 }\nradius = 0.3\nmass = 2.0",
                 "positions = { file = \"p.csv\" }\nvelocities = { file = \"v.csv\" }\nradius = 0.3\n"
                 "mass = 2.0"));
  shell("awk '/^X/ && $10 >= 65 {print $2 \",\" $3}' all/trajectory.xyz > p.csv");
  shell("awk '/^X/ && $10 >= 65 {print $5 \",\" $6}' all/trajectory.xyz > v.csv");
  const test::Outcome o = carom("run alone.toml --quiet -o alone --t-end 0");
  ASSERT_EQ(o.status, 0) << o.err;
  const std::string read =
      "import h5py\nfor run in \"all\", \"alone\":\n f = h5py.File(run + \"/analysis.h5\")\n print([f[k][:].tolist() "
      "for k "
      "in (\"samples/disks\", \"samples/temperature\", \"pair_correlation/pairs\", \"pair_correlation/g\", "
      "\"speeds/counts\", \"density/packing_fraction\", \"displacement/disks\")])\n";
  write("read.py", read);
  const test::Outcome python = shell("/usr/bin/python3 read.py");
  const std::size_t half = python.out.size() / 2;
  EXPECT_THAT(python.out, HasSubstr("[[20], [")) << python.err;
  EXPECT_EQ(python.out.substr(0, half), python.out.substr(half));
}

TEST_F(LongNamedGroupsRun, ResumedTheColumnsGoOn) {
  write("scene.toml", with("movie = { colour = \"group\" }\n"));
  ASSERT_EQ(carom("run scene.toml --quiet -o whole --t-end 3").status, 0);
  const Resumed resumed =
      resume_to_the_end("parts", carom("run scene.toml --quiet -o parts --t-end 3 --max-walltime 1e-9"));
  EXPECT_EQ(resumed.last.status, 0) << resumed.last.err;
  EXPECT_GE(resumed.parts, 2);
  expect_same_results("whole", "parts");
  EXPECT_THAT(test::text_of(at("whole/series.csv")),
              HasSubstr(",vy_bath,y_bath,disks_tracer,kinetic_tracer,temperature_tracer,"));
  EXPECT_EQ(carom("render whole -o legend.png --quiet").status, 0);
}

TEST_F(NamedGroupsRun, BrownianDisksHaveNoTemperature) {
  write("scene.toml", replaced(with(""), "[run]\n", "[physics]\ndiffusion = 0.1\n[run]\ndt = 0.01\n"));
  ASSERT_EQ(carom("run scene.toml --quiet -o out --t-end 0.5").status, 0);
  EXPECT_THAT(shell("tail -n 1 out/series.csv").out,
              testing::MatchesRegex(".*,60,nan,nan,nan,nan,1[0-9.]+,20,nan,nan,nan,nan,[19][0-9.]+,[^\n]*\n"));
}

}  // namespace
}  // namespace carom
