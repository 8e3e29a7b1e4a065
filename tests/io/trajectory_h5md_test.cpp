// trajectory.h5: the same bits as trajectory.xyz, read by h5py too; subsets; files of killed writers; going on.
#include "io/trajectory/trajectory_h5md.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/base/check.hpp"
#include "io/trajectory/h5md_reader.hpp"
#include "io/trajectory/trajectory_xyz.hpp"
#include "tests/support/disks_by_hand.hpp"
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

// Runs the scene in `name`/, with these options.
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
    const bool moving = select[0] == '[';  // places change hands: the sizes of a frame are its own
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

// As few digits as give the float back.
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

// It was written as an infinite one, without a word.
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
  EXPECT_EQ(status, 1);
  EXPECT_THAT(text, HasSubstr("trajectory.h5 in single precision has no place for -1e+39: it ends at 3.4e38; expected "
                              "output.precision = \"double\"\n"));
  EXPECT_THAT(shell(command + " --set output.trajectory=xyz").second,
              HasSubstr("error: trajectory.xyz in single precision has no place for -1e+39: it ends at 3.4e38"));
  EXPECT_EQ(shell(command + " --set output.precision=double").first, 0);
}

TEST(TrajectoryH5md, KeysAreChecked) {
  const std::string start = std::string(test::sound_scene) + "[output]\n";
  EXPECT_THAT(test::complaint(start + "select = \"every 2nd\""),
              HasSubstr("gas.toml:25: output.select: selects disks of no"));
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

// --- Writers by themselves
// --------------------------------------------------------------------------------------------

Scene drifting_scene() {
  Scene scene = test::scene_of(Method::pairwise, 100.0, 100.0, 0.5, 50.0);
  scene.groups.resize(1);
  scene.groups[0].count = 40;
  scene.sources.resize(1);  // the number of disks may grow
  return scene;
}

// Frame k: disks k to 40 + k are left, each at a place that follows from its id and the frame.
Disks frame_disks(Count k) {
  Disks disks;
  for (Count id = k; id < 40 + k; ++id) {
    const auto number = static_cast<double>(id);
    append(disks, {number / 7.0, static_cast<double>(k) / 3.0, std::sqrt(number), -1.0 / (number + 1.0), 0.5,
                   1.0 + number, static_cast<DiskId>(id)});
  }
  return disks;
}

void write_frames(H5mdWriter& writer, Count from, Count to) {
  for (Count k = from; k < to; ++k) writer.write(frame_disks(k), 0.5 * static_cast<double>(k), k, {});
}

// Reads all frames, expecting those of frame_disks, and returns their number.
Count check_frames(const std::string& path) {
  H5mdReader reader(path);
  TrajectoryFrame frame;
  Count k = 0;
  for (; reader.read(frame); ++k) {
    const Disks expected = frame_disks(k);
    EXPECT_EQ(frame.time, 0.5 * static_cast<double>(k));
    EXPECT_EQ(frame.disks.id, expected.id);
    EXPECT_EQ(frame.disks.x, expected.x);
    EXPECT_EQ(frame.disks.vy, expected.vy);
    EXPECT_EQ(frame.disks.mass, expected.mass);
  }
  return k;
}

// Width and height, which sides are periodic, and what a disk has for ever, whether the file has two dimensions or
// three.
TEST(TrajectoryH5md, KeepsTheBoxAndTheSizes) {
  const test::TestFolder folder("h5md_box");
  const std::string path = (folder.path() / "trajectory.h5").string();
  for (const int dimensions : {2, 3}) {
    for (const bool periodic_x : {true, false}) {
      Scene scene = drifting_scene();
      scene.output.dimensions = dimensions;
      scene.box.width = 200.0;
      test::set_sides(scene.box, periodic_x ? SideKind::periodic : SideKind::wall,
                      periodic_x ? SideKind::wall : SideKind::periodic);
      H5mdWriter writer(path, scene);
      write_frames(writer, 0, 1);
      writer.close();
      H5mdReader reader(path);
      TrajectoryFrame frame;
      ASSERT_TRUE(reader.read(frame));
      EXPECT_EQ(frame.box.width, 200.0);
      EXPECT_EQ(frame.box.height, 100.0);
      EXPECT_EQ(frame.box.periodic_x(), periodic_x);
      EXPECT_EQ(frame.box.periodic_y(), !periodic_x);
      EXPECT_EQ(frame.disks.radius, std::vector<double>(40, 0.5));
      EXPECT_EQ(frame.disks.mass, frame_disks(0).mass);
    }
  }
}

TEST(TrajectoryH5md, GoesOnAfterAnyFrame) {
  const TestFolder folder("h5md_going_on");
  const std::string path = (folder.path() / "trajectory.h5").string();
  for (const Count kept : {0U, 1U, 7U, 30U}) {
    {
      H5mdWriter writer(path, drifting_scene());
      write_frames(writer, 0, 30);
      writer.close();
    }
    H5mdWriter(path, drifting_scene(), kept).close();
    EXPECT_EQ(check_frames(path), kept) << "cut off, if nothing follows";
    H5mdWriter writer(path, drifting_scene(), kept);
    EXPECT_EQ(writer.frames(), kept);
    write_frames(writer, kept, 35);
    writer.close();
    EXPECT_EQ(check_frames(path), 35U) << kept;
  }
  EXPECT_THROW(H5mdWriter(path, drifting_scene(), 36), RunError);
  // Of a run that ended before its first frame: masses and radii are still to come.
  H5mdWriter(path, drifting_scene()).close();
  H5mdWriter writer(path, drifting_scene(), Count{0});
  write_frames(writer, 0, 2);
  writer.close();
  EXPECT_EQ(check_frames(path), 2U);
  Scene other = drifting_scene();
  other.sources.clear();
  EXPECT_THROW(H5mdWriter(path, other, 2), RunError);
}

// The same frames are the same bytes, whenever they were written and however long that took.
TEST(LongTrajectoryH5md, EqualRunsLeaveEqualFiles) {
  const TestFolder folder("h5md_equal");
  const std::string path = (folder.path() / "trajectory.h5").string();
  // Until the clock shows another second: longer than anything that a clock might decide, or leave in the file.
  const auto await_next_second = [] {
    const auto second = [] { return std::chrono::system_clock::now().time_since_epoch() / std::chrono::seconds(1); };
    for (const auto begun = second(); second() == begun;) usleep(1000);
  };
  Scene fixed = drifting_scene();
  fixed.sources.clear();
  fixed.groups[0].count = 1300;
  for (const Scene& scene : {drifting_scene(), fixed}) {
    std::string expected;
    for (const bool slow : {false, true}) {
      H5mdWriter writer(path, scene);
      for (Count k = 0; k < 1200; ++k) {
        if (slow && k % 500 == 33) await_next_second();
        writer.write(frame_disks(k), 0.5 * static_cast<double>(k), 10'000 * k, {});
      }
      writer.close();
      std::ostringstream text;
      text << std::ifstream(path, std::ios::binary).rdbuf();
      if (!slow) expected = text.str();
      EXPECT_TRUE(text.str() == expected);
    }
  }
}

// A child writes and flushes frame after frame, and is killed as soon as it has reported the k-th, while it writes one
// of the next. A later kill finds the file that an earlier one left.
TEST(LongTrajectoryH5md, AKilledWritersFileIsWholeAndGoesOn) {
  const TestFolder folder("h5md_killed");
  const std::string path = (folder.path() / "trajectory.h5").string();
  Count kept = 0;
  for (int round = 0; round < 12; ++round) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      const auto writer = kept == 0 ? std::make_unique<H5mdWriter>(path, drifting_scene())
                                    : std::make_unique<H5mdWriter>(path, drifting_scene(), kept);
      for (Count k = kept;; ++k) {
        write_frames(*writer, k, k + 1);
        writer->flush();
        if (write(ends[1], "x", 1) != 1) _exit(1);
      }
    }
    close(ends[1]);
    char told = 0;
    for (int k = 0; k < 5 + round; ++k) ASSERT_EQ(read(ends[0], &told, 1), 1);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(ends[0]);
    const Count whole = check_frames(path);
    ASSERT_GE(whole, kept + 5 + static_cast<Count>(round));
    kept = whole - 2;
  }
  H5mdWriter writer(path, drifting_scene(), kept);
  write_frames(writer, kept, kept + 3);
  writer.close();
  EXPECT_EQ(check_frames(path), kept + 3);
}

TEST(TrajectoryH5md, WhatIsNoTrajectoryIsNamed) {
  const TestFolder folder("h5md_damaged");
  const auto message = [](const std::string& path) {
    try {
      H5mdReader reader(path);
      TrajectoryFrame frame;
      while (reader.read(frame)) {
      }
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string path = (folder.path() / "trajectory.h5").string();
  {
    H5mdWriter writer(path, drifting_scene());
    write_frames(writer, 0, 10);
    writer.close();
  }
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  const std::string whole = text.str();
  for (const double share : {0.1, 0.5, 0.95}) {
    const std::string part = whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size())));
    EXPECT_THAT(message(folder.write("part.h5", part)), HasSubstr("part.h5: was cut short (truncated file")) << share;
  }
  // Its first block has a checksum: no bit of it may be lost, nor the reader for ever at it.
  for (std::size_t at = 0; at < 48; ++at) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    EXPECT_THAT(message(folder.write("flipped.h5", flipped)), HasSubstr("flipped.h5")) << at;
  }
  EXPECT_THAT(message(folder.write("text.h5", "3\n")), HasSubstr("expected a trajectory.h5 that Carom wrote"));
  EXPECT_THAT(message((folder.path() / "none.h5").string()), HasSubstr("none.h5"));
  EXPECT_THROW(H5mdWriter("/proc/trajectory.h5", drifting_scene()), RunError);
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
