// The writer of trajectory.h5 alone: what is stored, files of killed writers, continuation, and damage.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <memory>
#include <sstream>

#include "core/base/check.hpp"
#include "io/trajectory/h5md_reader.hpp"
#include "io/trajectory/trajectory_h5md.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using test::TestFolder;
using testing::HasSubstr;

Scene drifting_scene() {
  Scene scene = test::scene_of(Method::pairwise, 100.0, 100.0, 0.5, 50.0);
  scene.groups.resize(1);
  scene.groups[0].count = 40;
  scene.sources.resize(1);  // the number of disks may grow
  return scene;
}

// In frame k the disks k to 40 + k are left, each at a position that follows from its id and the frame.
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

// Reads all frames, compares them with frame_disks, and returns their number.
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

// Width and height, which sides are periodic, and constant properties of disks, for files of two and of three
// dimensions.
TEST(H5mdWriter, KeepsTheBoxAndTheSizes) {
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

TEST(H5mdWriter, GoesOnAfterAnyFrame) {
  const TestFolder folder("h5md_going_on");
  const std::string path = (folder.path() / "trajectory.h5").string();
  for (const Count kept : {0U, 1U, 7U, 30U}) {
    {
      H5mdWriter writer(path, drifting_scene());
      write_frames(writer, 0, 30);
      writer.close();
    }
    H5mdWriter(path, drifting_scene(), kept).close();
    EXPECT_EQ(check_frames(path), kept) << "the file is cut off, even if no frame follows";
    H5mdWriter writer(path, drifting_scene(), kept);
    EXPECT_EQ(writer.frames(), kept);
    write_frames(writer, kept, 35);
    writer.close();
    EXPECT_EQ(check_frames(path), 35U) << kept;
  }
  EXPECT_THROW(H5mdWriter(path, drifting_scene(), 36), RunError);
  // In a run that ended before its first frame, masses and radii are still missing.
  H5mdWriter(path, drifting_scene()).close();
  H5mdWriter writer(path, drifting_scene(), Count{0});
  write_frames(writer, 0, 2);
  writer.close();
  EXPECT_EQ(check_frames(path), 2U);
  Scene other = drifting_scene();
  other.sources.clear();
  EXPECT_THROW(H5mdWriter(path, other, 2), RunError);
}

// The same frames give the same bytes, whenever they were written and however long that took.
TEST(LongH5mdWriter, EqualRunsLeaveEqualFiles) {
  const TestFolder folder("h5md_equal");
  const std::string path = (folder.path() / "trajectory.h5").string();
  // Waits until the clock shows another second, the unit in which times would be stored in the file.
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

// A child process writes and flushes frame after frame, and is killed as soon as it has reported frame k, while it
// writes one of the next. A later kill finds the file that an earlier one left.
TEST(LongH5mdWriter, AKilledWritersFileIsWholeAndGoesOn) {
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

TEST(H5mdWriter, WhatIsNoTrajectoryIsNamed) {
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
  // The first block has a checksum: any change of a bit must be noticed, and must not make the reader hang.
  for (std::size_t at = 0; at < 48; ++at) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    EXPECT_THAT(message(folder.write("flipped.h5", flipped)), HasSubstr("flipped.h5")) << at;
  }
  EXPECT_THAT(message(folder.write("text.h5", "3\n")), HasSubstr("expected a trajectory.h5 that Carom wrote"));
  EXPECT_THAT(message((folder.path() / "none.h5").string()), HasSubstr("none.h5"));
  EXPECT_THROW(H5mdWriter("/proc/trajectory.h5", drifting_scene()), RunError);
}

}  // namespace
}  // namespace carom
