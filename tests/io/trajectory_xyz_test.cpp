// Trajectories are read back bit for bit, in order of ids, and errors in damaged ones are reported with their lines.
#include "io/trajectory/trajectory_xyz.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using ::testing::HasSubstr;

class TrajectoryXyz : public ::testing::Test {
 protected:
  std::string text() const { return test::text_of(path_); }
  void write_text(const std::string& text) const { std::ofstream(path_) << text; }

  // The error when the file is read to its end.
  std::string error() const {
    try {
      XyzReader reader(path_);
      XyzFrame frame;
      while (reader.read(frame)) {
      }
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }

  const test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
  const std::string path_ = folder_.path() / "trajectory.xyz";
};

Disks three_disks() {
  Disks d;
  append(d, {0.1, 1.0 / 3.0, -0.0, 5e-324, 0.5, 2.0, 7});
  append(d, {std::nextafter(1.0, 2.0), 1e300, -1.7976931348623157e308, 3.0, 0.25, 2.0, 0});
  append(d, {2.0, 3.0, 1e-17, -4.0, 0.5, 0.1, 3});
  return d;
}

Domain box_with_periodic_x() {
  Domain box;
  box.width = 100.0;
  box.height = 0.1;
  box.sides[0] = box.sides[1] = SideKind::periodic;
  return box;
}

TEST_F(TrajectoryXyz, HeaderIsTheContract) {
  XyzWriter writer(path_, {box_with_periodic_x()});
  writer.write(three_disks(), 0.1);
  writer.close();
  EXPECT_THAT(text(), HasSubstr("3\nLattice=\"100 0 0 0 0.1 0 0 0 1\" Origin=\"0 0 0\" pbc=\"T F F\" "
                                "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1 "
                                "Time=0.1\nX 1.0000000000000002 1e+300 0 "
                                "-1.7976931348623157e+308 3 0 0.25 2 0\n"));
}

// Columns that only some scenes have: the group, if there are several, and rounds, if a side is periodic.
TEST_F(TrajectoryXyz, GroupsAndRoundsAreColumnsOfTheirOwn) {
  DisplacementTally rounds;
  Disks disks = three_disks();
  disks.x = {99.0, 50.0, 1.0};  // for ids 7, 0 and 3
  follow_rounds(rounds, disks, box_with_periodic_x(), 0.0);
  XyzWriter writer(path_, {box_with_periodic_x(), {}, {1, 4}, &rounds});
  writer.write(disks, 0.0);
  for (const double x : {20.0, 40.0, 60.0, 80.0, 1.0}) {
    disks.x = {x, 50.0, 100.0 - x};
    follow_rounds(rounds, disks, box_with_periodic_x(), x);
  }
  append(disks, {5.0, 0.0, 0.0, 0.0, 0.5, 1.0, 8});
  follow_rounds(rounds, disks, box_with_periodic_x(), 1.0);
  writer.write(disks, 1.0);
  writer.close();
  const std::string all = text();
  EXPECT_THAT(all, HasSubstr(":id:I:1:group:I:1:map_shift:I:3 Time=0\n"));
  const std::string second = all.substr(all.find("4\nLattice"));
  EXPECT_THAT(second, HasSubstr(" 0 0 0 0 0\n")) << "disk 0 stayed";
  EXPECT_THAT(second, HasSubstr(" 3 1 -2 0 0\n")) << "disk 3 went down across it twice";
  EXPECT_THAT(second, HasSubstr(" 7 2 2 0 0\n")) << "disk 7 went up across it twice; it came from a source";
  EXPECT_THAT(second, HasSubstr(" 8 2 0 0 0\n")) << "disk 8 is new";

  XyzReader reader(path_);
  XyzFrame frame;
  ASSERT_TRUE(reader.read(frame) && reader.read(frame));
  EXPECT_THAT(frame.group, ::testing::ElementsAre(0U, 1U, 2U, 2U));
  EXPECT_THAT(frame.disks.x, ::testing::ElementsAre(50.0, 99.0, 1.0, 5.0));
  EXPECT_THAT(frame.disks.vy, ::testing::ElementsAre(3.0, -4.0, 5e-324, 0.0));
}

// As Carom wrote it before there was a third coordinate, and in other orders of columns.
TEST_F(TrajectoryXyz, OtherLayoutsAreReadByTheirColumns) {
  const std::string head = "1\nLattice=\"9 0 0 0 8 0 0 0 1\" Origin=\"0 0 0\" pbc=\"F T F\" Properties=";
  for (const std::string rest :
       {"species:S:1:pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1 Time=2\nD 1 2 3 4 5 6 7\n",
        "id:I:1:mass:R:1:colour:R:3:radius:R:1:velo:R:3:pos:R:3 Time=2\n7 6 .1 .2 .3 5 3 4 0 1 2 0\n"}) {
    write_text(head + rest);
    XyzReader reader(path_);
    XyzFrame frame;
    ASSERT_TRUE(reader.read(frame)) << rest;
    EXPECT_EQ(frame.time, 2.0);
    EXPECT_TRUE(frame.box.periodic_y());
    const Disks& d = frame.disks;
    EXPECT_THAT((std::vector<double>{d.x[0], d.y[0], d.vx[0], d.vy[0], d.radius[0], d.mass[0]}),
                ::testing::ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
    EXPECT_EQ(d.id[0], 7U);
    EXPECT_TRUE(frame.group.empty());
  }
}

TEST_F(TrajectoryXyz, WhatIsNotInThePlaneOrNotThereIsRefused) {
  const std::string head = "1\nLattice=\"9 0 0 0 8 0 0 0 1\" pbc=\"F F F\" Properties=";
  write_text(head + "pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1 Time=0\n1 2 0.5 3 4 0 5 6 7\n");
  EXPECT_EQ(error(), path_ + ":3: z is 0.5, expected 0: disks move in a plane");
  write_text(head + "pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1 Time=0\n1 2 0 3 4 -7 5 6 7\n");
  EXPECT_EQ(error(), path_ + ":3: z is -7, expected 0: disks move in a plane");
  write_text(head + "pos:R:3:velo:R:3:radius:R:1:id:I:1 Time=0\n1 2 0 3 4 0 5 6\n");
  EXPECT_THAT(error(), HasSubstr(":2: expected Properties=species:S:1:pos:R:3:"));
  EXPECT_THAT(error(), HasSubstr("'mass' has 0 columns"));
  write_text(head + "pos:R:4:velo:R:3:radius:R:1:mass:R:1:id:I:1 Time=0\n");
  EXPECT_THAT(error(), HasSubstr("'pos' has 4 columns"));
  write_text(head + "pos:R:3:velo:R:-3 Time=0\n");
  EXPECT_THAT(error(), HasSubstr("'-3' is not a number of columns"));
}

constexpr const char* columns = "Properties=pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1";

// The first two lines of a frame.
std::string head_of(int disks, const std::string& keys) {
  return fmt::format("{}\n{} {}", disks, columns, keys);
}

// In a box that is oblique or has another origin the disks would be shown at wrong places.
TEST_F(TrajectoryXyz, OtherBoxesAreRefused) {
  const auto said = [&](const std::string& lattice, const std::string& more) {
    write_text(head_of(1, fmt::format("Lattice=\"{}\" {} Time=0\n1 2 3 4 5 6 7\n", lattice, more)));
    return error();
  };
  const std::string sound = "9 0 0 0 8 0 0 0 1";
  EXPECT_EQ(said(sound, "pbc=\"T F F\""), "no error");
  EXPECT_EQ(said(sound, "Origin=\"0 0 0\" pbc=\"T F F\""), "no error");
  EXPECT_EQ(said("9 0 0 0 8 0 0 0 20", "pbc=\"T F F\""), "no error")
      << "vectors perpendicular to the plane do not matter";
  EXPECT_EQ(said("9 0 0 3 8 0 0 0 1", "pbc=\"T F F\""),
            path_ + ":2: Lattice is \"9 0 0 3 8 0 0 0 1\", expected \"W 0 0 0 H 0 0 0 1\", W and H above 0");
  for (const char* const bad : {"-9 0 0 0 8 0 0 0 1", "9 0 0 0 0 0 0 0 1", "9 1 0 0 8 0 0 0 1", "9 0 0 0 8 0 0 2 1"}) {
    EXPECT_THAT(said(bad, "pbc=\"T F F\""), HasSubstr(":2: Lattice is ")) << bad;
  }
  for (const char* const bad : {"9 0 0 0 8", "9 0 0 0 8 0 0 0 1 0"}) {
    EXPECT_EQ(said(bad, "pbc=\"T F F\""), path_ + ":2: expected Lattice=\"W 0 0 0 H 0 0 0 1\"") << bad;
  }
  EXPECT_EQ(said(sound, "Origin=\"0 -4 0\" pbc=\"T F F\""), path_ + ":2: Origin is \"0 -4 0\", expected \"0 0 0\"");
  EXPECT_EQ(said(sound, "pbc=\"1 0 0\""), path_ + ":2: pbc has '1', expected T or F");
  EXPECT_EQ(said(sound, "pbc=\"T F\""), path_ + ":2: expected pbc=\"T F F\", T for each direction that is periodic");
}

// Keys are whole words outside quotes, and values are whole numbers.
TEST_F(TrajectoryXyz, OnlyWhatItSaysIsReadFromAHead) {
  const std::string box = "Lattice=\"9 0 0 0 8 0 0 0 1\" pbc=\"F F F\" ";
  const std::string disk = "\n1 2 3 4 5 6 7\n";
  write_text("1\nRunTime=77 comment=\"at Time=5\" empty=\"\" alone Time=2 " + box + columns + disk);
  XyzReader reader(path_);
  XyzFrame frame;
  ASSERT_TRUE(reader.read(frame));
  EXPECT_EQ(frame.time, 2.0);
  write_text("1\n" + box + columns + disk);
  EXPECT_EQ(error(), path_ + ":2: expected Time=0.5, the time of the frame");
  for (const char* const time : {"nan", "inf", "1.0.0"}) {
    write_text("1\n" + box + columns + " Time=" + time + disk);
    EXPECT_EQ(error(), fmt::format("{}:2: '{}' is not a finite number", path_, time));
  }
  for (const char* const count : {"1.9e3", "1x", "1 disk", "-1", ""}) {
    write_text(fmt::format("{}\n{}{} Time=0{}", count, box, columns, disk));
    EXPECT_THAT(error(), HasSubstr(fmt::format(":1: '{}' is not a number of disks", count)));
  }
}

// Lines may end with CR LF, and a file may start with the byte order mark that some editors add.
TEST_F(TrajectoryXyz, LinesEndAsOnOtherSystems) {
  write_text(
      "\xef\xbb\xbf"
      "1 \r\nLattice=\"9 0 0 0 8 0 0 0 1\" pbc=\"F F F\" Time=0.5 " +
      std::string(columns) + "\r\n1 2 3 4 5 6 7\r\n");
  XyzReader reader(path_);
  XyzFrame frame;
  ASSERT_TRUE(reader.read(frame)) << error();
  EXPECT_EQ(frame.time, 0.5);
  EXPECT_FALSE(reader.read(frame));
}

TEST_F(TrajectoryXyz, BlankLinesAtTheFilesEndAreNoFrame) {
  const std::string frame_text =
      "1\nLattice=\"9 0 0 0 8 0 0 0 1\" pbc=\"F F F\" Time=0.5 " + std::string(columns) + "\n1 2 3 4 5 6 7\n";
  for (const char* end : {"\n", "\n \t\r\n", "\n\n  "}) {
    write_text(frame_text + end);
    XyzReader reader(path_);
    XyzFrame frame;
    ASSERT_TRUE(reader.read(frame)) << error();
    EXPECT_FALSE(reader.read(frame));
  }
  write_text(frame_text + "\n\n" + frame_text);
  EXPECT_EQ(error(), path_ + ":6: the line before is blank; expected a frame, or the end of the file");
}

// Other programs may have sorted the disks in another way.
TEST_F(TrajectoryXyz, DisksComeInOrderOfIdHoweverTheyStand) {
  const std::string head =
      "3\nLattice=\"9 0 0 0 8 0 0 0 1\" pbc=\"F F F\" Time=0 "
      "Properties=id:I:1:pos:R:2:velo:R:2:radius:R:1:mass:R:1:group:I:1:spin:R:1\n";
  write_text(head + "5 1 2 3 4 .5 6 0 9\n2 11 12 13 14 .25 16 1 19\n3 21 22 23 24 .125 26 2 29\n");
  XyzReader reader(path_);
  XyzFrame frame;
  ASSERT_TRUE(reader.read(frame));
  EXPECT_THAT(frame.disks.id, ::testing::ElementsAre(2U, 3U, 5U));
  EXPECT_THAT(frame.disks.x, ::testing::ElementsAre(11.0, 21.0, 1.0));
  EXPECT_THAT(frame.disks.vy, ::testing::ElementsAre(14.0, 24.0, 4.0));
  EXPECT_THAT(frame.disks.radius, ::testing::ElementsAre(0.25, 0.125, 0.5));
  EXPECT_THAT(frame.disks.mass, ::testing::ElementsAre(16.0, 26.0, 6.0));
  EXPECT_THAT(frame.disks.spin, ::testing::ElementsAre(19.0, 29.0, 9.0));
  EXPECT_THAT(frame.group, ::testing::ElementsAre(1U, 2U, 0U));
  write_text(head + "5 1 2 3 4 .5 6 0 9\n2 11 12 13 14 .25 16 1 19\n5 21 22 23 24 .125 26 2 29\n");
  EXPECT_EQ(error(), path_ + ":5: disk 5 appears twice in its frame");
}

// Each frame's rounds are sorted with its disks.
TEST_F(TrajectoryXyz, RoundsComeInOrderOfIdToo) {
  const std::string head =
      "2\nLattice=\"8 0 0 0 6 0 0 0 1\" pbc=\"T T F\" "
      "Properties=pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1:map_shift:I:2 Time=0\n";
  write_text(head + "1 2 0 0 1 1 5 3 -4\n3 4 0 0 1 1 2 -1 2\n" + head + "1 2 0 0 1 1 5 4 -5\n3 4 0 0 1 1 2 -2 3\n");
  XyzReader reader(path_);
  XyzFrame frame;
  for (const int k : {0, 1}) {
    ASSERT_TRUE(reader.read(frame));
    EXPECT_THAT(frame.disks.id, ::testing::ElementsAre(2U, 5U));
    EXPECT_THAT(frame.image_x, ::testing::ElementsAre(-1 - k, 3 + k));
    EXPECT_THAT(frame.image_y, ::testing::ElementsAre(2 + k, -4 - k));
  }
}

TEST_F(TrajectoryXyz, ValuesThatNoDiskHasAreRefused) {
  const auto said = [&](const std::string& disk) {
    write_text(head_of(1, "Lattice=\"9 0 0 0 8 0 0 0 1\" pbc=\"F F F\" Time=0\n" + disk + "\n"));
    return error();
  };
  EXPECT_EQ(said("1 nan 3 4 5 6 7"), path_ + ":3: 'nan' is not a finite number");
  EXPECT_EQ(said("1 2 3 inf 5 6 7"), path_ + ":3: 'inf' is not a finite number");
  EXPECT_EQ(said("1 2 3 4 5 6 7.5"), path_ + ":3: '7.5' is no disk id");
  EXPECT_EQ(said("1 2 3 4 5 6 4294967296"), path_ + ":3: '4294967296' is no disk id");
  EXPECT_EQ(said("1 2 3 4 -5 6 7"), path_ + ":3: radius is -5, expected a number above 0");
  EXPECT_EQ(said("1 2 3 4 5 0 7"), path_ + ":3: mass is 0, expected a number above 0");
  EXPECT_THAT(said("1 2 3 4 5 6 7 8"), HasSubstr(":3: 8 columns, expected 7: pos:R:2"));
}

// Each frame declares its own columns.
TEST_F(TrajectoryXyz, AFrameMayHaveOtherColumnsThanTheOneBefore) {
  const std::string box = " Lattice=\"9 0 0 0 8 0 0 0 1\" pbc=\"F F F\" Time=0\n";
  const std::string properties = columns;
  write_text("1\n" + properties + ":group:I:1:spin:R:1" + box + "1 2 3 4 5 6 7 3 0.5\n1\n" + properties + box +
             "1 2 3 4 5 6 8\n1\n" + properties + ":group:I:1" + box + "1 2 3 4 5 6 9 4\n");
  XyzReader reader(path_);
  XyzFrame frame;
  ASSERT_TRUE(reader.read(frame));
  EXPECT_THAT(frame.group, ::testing::ElementsAre(3U));
  EXPECT_THAT(frame.disks.spin, ::testing::ElementsAre(0.5));
  ASSERT_TRUE(reader.read(frame));
  EXPECT_TRUE(frame.group.empty() && frame.disks.spin.empty());
  ASSERT_TRUE(reader.read(frame));
  EXPECT_THAT(frame.group, ::testing::ElementsAre(4U));
}

// A run has written half of a line: the frame does not exist yet, and is read from its start once it is complete.
// Errors in it still name the right line.
TEST_F(TrajectoryXyz, AGrowingFileIsReadOn) {
  const std::string head = "1\nLattice=\"9 0 0 0 8 0 0 0 1\" pbc=\"F F F\" Time=0 " + std::string(columns) + "\n";
  write_text(head + "1 2 3 4 5 6 7\n" + head + "1 2 3 4 5 6 1");
  XyzReader reader(path_, true);
  XyzFrame frame;
  ASSERT_TRUE(reader.read(frame));
  for (int k = 0; k < 3; ++k) EXPECT_FALSE(reader.read(frame));
  std::ofstream(path_, std::ios::app) << "7\n" << head << "1 2 3 4 5 six 1\n";
  ASSERT_TRUE(reader.read(frame));
  EXPECT_THAT(frame.disks.id, ::testing::ElementsAre(17U));
  try {
    reader.read(frame);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_EQ(e.what(), path_ + ":9: 'six' is not a finite number");
  }
}

// Frames are skipped whatever their lines contain. In a growing file a frame cut short does not exist yet.
TEST_F(TrajectoryXyz, FramesArePassedOver) {
  const std::string head = "\nLattice=\"9 0 0 0 8 0 0 0 1\" pbc=\"F F F\" Time=3 " + std::string(columns) + "\n";
  write_text("2\nof something else\n\n\n0\nof nothing\n1" + head + "1 2 3 4 5 6 7\n2" + head + "1 2 3 4 5 6 1\n");
  XyzFrame frame;
  for (const bool growing : {false, true}) {
    XyzReader reader(path_, growing);
    EXPECT_TRUE(reader.skip() && reader.skip()) << growing;
    ASSERT_TRUE(reader.read(frame)) << growing;
    EXPECT_EQ(frame.time, 3.0);
    if (!growing) {
      EXPECT_THROW(reader.skip(), InputError);
      continue;
    }
    EXPECT_FALSE(reader.skip());
    std::ofstream(path_, std::ios::app) << "1 2 3 4 5 6 2\n";
    EXPECT_TRUE(reader.skip());
    EXPECT_FALSE(reader.skip());
  }
}

// A reader of a run that is going on sees every frame that has been written.
TEST_F(TrajectoryXyz, AFrameIsInTheFileAsSoonAsItIsWritten) {
  XyzWriter writer(path_, {box_with_periodic_x()});
  XyzReader reader(path_, true);
  XyzFrame frame;
  for (int k = 0; k < 3; ++k) {
    writer.write(three_disks(), k);
    ASSERT_TRUE(reader.read(frame));
    EXPECT_EQ(frame.time, k);
    EXPECT_FALSE(reader.read(frame));
  }
  EXPECT_EQ(writer.mark().frames, 3U);
  EXPECT_EQ(XyzWriter(path_, {box_with_periodic_x()}, writer.mark()).mark().frames, 3U) << "it goes on from there";
}

// Rough disks in a periodic box have both kinds of columns, each under its name.
TEST_F(TrajectoryXyz, RoundsAndSpinsStandUnderTheirNames) {
  DisplacementTally rounds;
  Disks disks;
  disks.inertia = 0.5;
  append(disks, {50.0, 0.05, 1.0, 0.0, 0.5, 2.0, 0, 0.75});
  follow_rounds(rounds, disks, box_with_periodic_x(), 0.0);
  XyzWriter writer(path_, {box_with_periodic_x(), {}, {}, &rounds, true});
  writer.write(disks, 0.0);
  writer.close();
  EXPECT_THAT(text(), HasSubstr(":id:I:1:map_shift:I:3:spin:R:1 Time=0\nX 50 0.05 0 1 0 0 0.5 2 0 0 0 0 0.75\n"));
  XyzReader reader(path_);
  XyzFrame frame;
  ASSERT_TRUE(reader.read(frame));
  EXPECT_THAT(frame.disks.spin, ::testing::ElementsAre(0.75));
}

TEST_F(TrajectoryXyz, EveryBitComesBackInOrderOfId) {
  const Disks original = three_disks();
  XyzWriter writer(path_, {box_with_periodic_x()});
  writer.write(original, 1.0 / 7.0);
  writer.write({}, 2.0);
  writer.close();

  XyzReader reader(path_);
  XyzFrame frame;
  ASSERT_TRUE(reader.read(frame));
  EXPECT_EQ(frame.time, 1.0 / 7.0);
  EXPECT_EQ(frame.box.width, 100.0);
  EXPECT_EQ(frame.box.height, 0.1);
  EXPECT_TRUE(frame.box.periodic_x());
  EXPECT_FALSE(frame.box.periodic_y());
  EXPECT_THAT(frame.disks.id, ::testing::ElementsAre(0U, 3U, 7U));
  EXPECT_THAT(frame.disks.radius, ::testing::ElementsAre(0.25, 0.5, 0.5));
  EXPECT_THAT(frame.disks.mass, ::testing::ElementsAre(2.0, 0.1, 2.0));
  EXPECT_EQ(state_hash(frame.disks), state_hash(original));
  ASSERT_TRUE(reader.read(frame));
  EXPECT_EQ(frame.disks.size(), 0U);
  EXPECT_FALSE(reader.read(frame));
}

TEST_F(TrajectoryXyz, DamageIsNamedByLine) {
  XyzWriter writer(path_, {box_with_periodic_x()});
  writer.write(three_disks(), 0.0);
  writer.close();
  const std::string whole = text();

  write_text(whole.substr(0, whole.rfind("X ")));
  EXPECT_EQ(error(), path_ + ":5: the file ends inside a frame");
  std::string damaged = whole;
  damaged.replace(damaged.find("1e+300"), 6, "1e+3x0");
  write_text(damaged);
  EXPECT_EQ(error(), path_ + ":3: '1e+3x0' is not a finite number");
  write_text("hello\n");
  EXPECT_THAT(error(), HasSubstr(path_ + ":1: 'hello' is not a number of disks; expected trajectory.xyz"));
  write_text("\xff\x1b[31m\n");
  EXPECT_THAT(error(), HasSubstr(path_ + ":1: '??[31m' is not a number of disks"));
  write_text("1\nH 0 0 0\nH 1 1 1\n");
  EXPECT_THAT(error(), HasSubstr(":2: expected Properties=species"));
}

TEST_F(TrajectoryXyz, MissingFileOrFolder) {
  EXPECT_THAT(error(), HasSubstr("cannot be read"));
  EXPECT_THROW(XyzReader("/"), InputError);
}

TEST(TrajectoryXyzDisk, AFullDiskIsAnError) {
  XyzWriter writer("/dev/full", {box_with_periodic_x()});
  try {
    writer.write(three_disks(), 0.0);
    FAIL() << "no error";
  } catch (const RunError& e) {
    EXPECT_STREQ(e.what(), "cannot write /dev/full: No space left on device");
  }
}

}  // namespace
}  // namespace carom
