// trajectory.h5 of runs: the same bits as trajectory.xyz, also read by h5py; selections; single precision; a full disk.
#include "io/trajectory/trajectory_h5md.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include "io/trajectory/h5md_reader.hpp"
#include "io/trajectory/trajectory_xyz.hpp"
#include "tests/support/scene_support.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using test::TestFolder;
using testing::HasSubstr;

constexpr const char* open_scene = R"(title = "disks come and go"
seed = 5
[box]
width = 20.0
height = 12.0
left = "sink"
bottom = "periodic"
top = "periodic"
[[disks]]
count = 20
positions = "random"
velocities = { uniform = 2.0 }
radius = { uniform = [0.2, 0.6] }
mass = { from_radius = 1.0 }
[[disks]]
count = 3
positions = [[3, 3], [6, 6], [9, 3]]
radius = 0.5
mass = 2.0
[[sources]]
side = "right"
rate = 4.0
radius = 0.3
mass = 1.0
velocities = { maxwell = 2.0 }
[run]
method = "exact"
t_end = 8.0
[output]
every = 0.25
trajectory = "xyz"
)";

// Standard output of a command, and its exit status.
std::pair<int, std::string> shell(const std::string& command) {
  std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

// Runs the scene with these options; the results are in the folder `name`.
void run_scene(const TestFolder& folder, const std::string& name, const std::string& options = "") {
  const std::string scene = folder.write("scene.toml", open_scene);
  const auto [status, text] = shell(std::string(CAROM_PROGRAM) + " run " + scene + " --quiet -o " +
                                    (folder.path() / name).string() + " " + options);
  ASSERT_EQ(status, 0) << text;
}

std::pair<int, std::string> compare(const TestFolder& folder, const std::string& a, const std::string& b) {
  return shell(std::string(CAROM_PROGRAM) + " compare " + (folder.path() / a).string() + " " +
               (folder.path() / b).string());
}

TEST(LongTrajectoryH5md, PythonReadsTheSameBitsFromBothFormats) {
  const TestFolder folder("h5md_python");
  run_scene(folder, "xyz");
  run_scene(folder, "h5", "--set output.trajectory=h5md");
  const auto at = [&](const char* name) { return (folder.path() / name).string(); };
  const auto [status, text] =
      shell("/usr/bin/python3 " CAROM_SOURCE_DIR "/tests/io/read_trajectories.py " + at("xyz/trajectory.xyz") + " " +
            at("h5/trajectory.h5") + " " + at("h5/scene.toml"));
  EXPECT_EQ(status, 0) << text;
  EXPECT_THAT(text, HasSubstr("species 0 0 0"));
  EXPECT_THAT(compare(folder, "xyz", "h5").second, HasSubstr("same bits in all 33 frames"));
}

TEST(TrajectoryH5md, SubsetsHoldTheDisksAskedFor) {
  const TestFolder folder("h5md_subset");
  for (const std::string select : {"\"every 3rd\"", "\"three\"", "[2, 2, 14, 9.5]"}) {
    const std::string option = "--force --set disks.1.name='\"three\"' --set 'output.select=" + select + "'";
    run_scene(folder, "xyz", option);
    run_scene(folder, "h5", option + " --set output.trajectory=h5md");
    EXPECT_THAT(compare(folder, "xyz", "h5").second, HasSubstr("same bits in all 33 frames")) << select;
    H5mdReader reader((folder.path() / "h5/trajectory.h5").string());
    TrajectoryFrame frame;
    std::size_t seen = 0;
    while (reader.read(frame)) {
      for (std::size_t i = 0; i < frame.disks.size(); ++i, ++seen) {
        const Disks& d = frame.disks;
        if (select == "\"three\"") {
          EXPECT_TRUE(d.id[i] >= 20 && d.id[i] < 23) << d.id[i];
        } else if (select[0] == '"') {
          EXPECT_EQ(d.id[i] % 3, 0U);
        } else {
          EXPECT_TRUE(d.x[i] >= 2 && d.x[i] <= 14 && d.y[i] >= 2 && d.y[i] <= 9.5);
        }
      }
    }
    EXPECT_GT(seen, select == "\"three\"" ? 30U : 100U);
    const bool moving = select[0] == '[';  // rows change their disks, so each frame has its own sizes
    const std::string xdmf = test::text_of((folder.path() / "h5/trajectory.xdmf").string());
    EXPECT_THAT(xdmf, HasSubstr(moving ? "/disks/radius/value</DataItem>" : "/disks/radius</DataItem>"));
  }
}

TEST(TrajectoryH5md, SinglePrecisionIsTheNearestFloat) {
  const TestFolder folder("h5md_single");
  run_scene(folder, "xyz");
  run_scene(folder, "h5", "--set output.trajectory=h5md --set output.precision=single");
  XyzReader all((folder.path() / "xyz/trajectory.xyz").string());
  H5mdReader rounded((folder.path() / "h5/trajectory.h5").string());
  TrajectoryFrame a, b;
  while (all.read(a)) {
    ASSERT_TRUE(rounded.read(b));
    ASSERT_EQ(a.disks.id, b.disks.id);
    for (std::size_t i = 0; i < a.disks.size(); ++i) {
      EXPECT_EQ(static_cast<double>(static_cast<float>(a.disks.x[i])), b.disks.x[i]);
      EXPECT_EQ(static_cast<double>(static_cast<float>(a.disks.vy[i])), b.disks.vy[i]);
      EXPECT_EQ(a.disks.radius[i], b.disks.radius[i]);
    }
  }
  EXPECT_FALSE(rounded.read(b));
}

// The fewest digits that give the same float back.
TEST(TrajectoryXyzSingle, IsTheNearestFloat) {
  const TestFolder folder("xyz_single");
  run_scene(folder, "all");
  run_scene(folder, "single", "--set output.precision=single");
  const std::string path = (folder.path() / "single/trajectory.xyz").string();
  XyzReader all((folder.path() / "all/trajectory.xyz").string()), rounded(path);
  TrajectoryFrame a, b;
  while (all.read(a)) {
    ASSERT_TRUE(rounded.read(b));
    ASSERT_EQ(a.disks.id, b.disks.id);
    for (std::size_t i = 0; i < a.disks.size(); ++i) {
      EXPECT_EQ(static_cast<float>(a.disks.x[i]), static_cast<float>(b.disks.x[i]));
      EXPECT_EQ(static_cast<float>(a.disks.vy[i]), static_cast<float>(b.disks.vy[i]));
      EXPECT_EQ(a.disks.radius[i], b.disks.radius[i]);
    }
  }
  EXPECT_FALSE(rounded.read(b));
  EXPECT_THAT(test::text_of(path), testing::ContainsRegex("\nX [0-9]+\\.[0-9]{1,8} [0-9.]{1,10} 0 -?[0-9]\\.[0-9]+ "));
}

// Such a speed was once written as infinite, without an error.
TEST(TrajectoryH5md, SinglePrecisionHasNoPlaceForTheFastest) {
  const TestFolder folder("h5md_fast");
  const std::string scene = folder.write("fast.toml", R"([box]
width = 1e28
height = 1e28
[[disks]]
count = 1
positions = [[5e27, 5e27]]
velocities = [[0.0, -1e39]]
radius = 1e27
mass = 1.0
[run]
t_end = 1e-12
[output]
trajectory = "h5md"
precision = "single"
)");
  const std::string command = CAROM_PROGRAM " run " + scene + " --quiet --force -o " + (folder.path() / "out").string();
  const auto [status, text] = shell(command);
  EXPECT_EQ(status, 2);
  EXPECT_THAT(text, HasSubstr("trajectory.h5 in single precision cannot hold -1e+39: it ends at 3.4e38; expected "
                              "output.precision = \"double\"\n"));
  EXPECT_THAT(shell(command + " --set output.trajectory=xyz").second,
              HasSubstr("error: trajectory.xyz in single precision cannot hold -1e+39: it ends at 3.4e38"));
  EXPECT_EQ(shell(command + " --set output.precision=double").first, 0);
}

TEST(TrajectoryH5md, KeysAreChecked) {
  const std::string start = std::string(test::sound_scene) + "[output]\n";
  EXPECT_THAT(test::complaint(start + "select = \"every 2nd\""),
              HasSubstr("gas.toml:25: output.select: selects disks, but there is no"));
  EXPECT_THAT(test::complaint(start + "trajectory = \"xyz\"\nselect = \"every other\""),
              HasSubstr("expected \"every 100th\""));
  EXPECT_THAT(test::complaint(start + "trajectory = \"xyz\"\nselect = \"every 0th\""),
              HasSubstr("expected \"every 100th\""));
  EXPECT_THAT(test::complaint(start + "trajectory = \"xyz\"\nselect = [1, 2, 3]"), HasSubstr("has 3 numbers"));
  EXPECT_THAT(test::complaint(start + "trajectory = \"xyz\"\nselect = [3, 1, 1, 2]"), HasSubstr("not in order"));
  EXPECT_THAT(test::complaint(start + "precision = \"single\""),
              HasSubstr("output.precision: is given, but there is no trajectory; expected trajectory = \"xyz\" or"));
  EXPECT_THAT(test::complaint(start + "trajectory = \"h5md\"\nprecision = \"half\""), HasSubstr("double, single"));
}

TEST(TrajectoryH5md, AFullDiskIsReported) {
  const TestFolder folder("h5md_full");
  const std::string scene = folder.write("scene.toml", open_scene);
  const auto [status, text] = shell("(ulimit -f 300; " + std::string(CAROM_PROGRAM) + " run " + scene +
                                    " --set output.trajectory=h5md --set output.every=0.01 --quiet -o " +
                                    (folder.path() / "out").string() + ")");
  EXPECT_EQ(status, 1) << text;
  EXPECT_THAT(text, HasSubstr("trajectory.h5: File too large"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace carom
