// Trajectories come back bit for bit, in order of id, and damaged ones are named by line.
#include "io/trajectory/trajectory_xyz.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>

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

  // The message of the error that reading the file to its end gives.
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

// Columns that only some scenes have: a group where there are several, rounds where a side is periodic.
TEST_F(TrajectoryXyz, GroupsAndRoundsAreColumnsOfTheirOwn) {
  DisplacementTally rounds;
  Disks disks = three_disks();
  disks.x = {99.0, 50.0, 1.0};  // of ids 7, 0 and 3
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

// As Carom wrote it before there was a third coordinate, and as others may order it.
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
  write_text(head + "pos:R:3:velo:R:3:radius:R:1:id:I:1 Time=0\n1 2 0 3 4 0 5 6\n");
  EXPECT_THAT(error(), HasSubstr(":2: expected Properties=species:S:1:pos:R:3:"));
  EXPECT_THAT(error(), HasSubstr("'mass' has 0 columns"));
  write_text(head + "pos:R:4:velo:R:3:radius:R:1:mass:R:1:id:I:1 Time=0\n");
  EXPECT_THAT(error(), HasSubstr("'pos' has 4 columns"));
  write_text(head + "pos:R:3:velo:R:-3 Time=0\n");
  EXPECT_THAT(error(), HasSubstr("'-3' is no number of columns"));
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
  EXPECT_EQ(error(), path_ + ":3: '1e+3x0' is no finite number");
  write_text("hello\n");
  EXPECT_THAT(error(), HasSubstr(path_ + ":1: 'hello' is no number of disks; expected trajectory.xyz"));
  write_text("\xff\x1b[31m\n");
  EXPECT_THAT(error(), HasSubstr(path_ + ":1: '??[31m' is no number of disks"));
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
