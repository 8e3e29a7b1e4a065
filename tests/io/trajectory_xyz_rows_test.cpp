// Frames of more disks than fit into one batch of numbers and one block of lines: each line has the numbers of its own
// disk, in order of id, whichever ids there are.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "io/trajectory/trajectory_xyz.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

class TrajectoryXyzRows : public ::testing::Test {
 protected:
  // The lines of the disks of a frame, or of the last of several.
  std::vector<std::string> lines_of_last(const std::vector<Disks>& frames, const XyzPlan& plan) const {
    XyzWriter writer(path_, plan);
    for (const Disks& disks : frames) writer.write(disks, 0.0);
    writer.close();
    const std::string all = test::text_of(path_);
    std::vector<std::string> lines;
    for (std::size_t at = all.find('\n', all.rfind("Lattice")) + 1; at < all.size();) {
      const std::size_t end = all.find('\n', at);
      lines.push_back(all.substr(at, end - at));
      at = end + 1;
    }
    return lines;
  }

  const test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
  const std::string path_ = folder_.path() / "trajectory.xyz";
};

// Disks of these ids, in no order, with numbers of many sizes. Some velocities are too small or too large for the
// kernel that converts a batch.
Disks disks_of(std::vector<DiskId> ids) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  std::shuffle(ids.begin(), ids.end(), random);
  Disks disks;
  disks.inertia = 0.5;
  for (const DiskId id : ids) {
    const double size = std::exp(6.0 * normal(random));
    append(disks, {std::abs(normal(random)), std::abs(normal(random)), size * normal(random), -size, 0.01, 1.0, id,
                   normal(random)});
  }
  return disks;
}

std::vector<DiskId> ids_from(DiskId first, std::size_t count) {
  std::vector<DiskId> ids(count);
  std::iota(ids.begin(), ids.end(), first);
  return ids;
}

template <class Number>
std::string text_of(Number number) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

template <class Number = double>
std::string line_of(const Disks& disks, std::size_t i, bool spins = false) {
  const auto text = [](double number) { return text_of(static_cast<Number>(number)); };
  return fmt::format("X {} {} 0 {} {} 0 0.01 1 {}{}", text(disks.x[i]), text(disks.y[i]), text(disks.vx[i]),
                     text(disks.vy[i]), disks.id[i], spins ? " " + text(disks.spin_of(i)) : "");
}

template <class Number = double>
std::vector<std::string> lines_of(const Disks& disks, bool spins = false) {
  std::vector<std::string> lines;
  for (const std::size_t i : by_id(disks)) lines.push_back(line_of<Number>(disks, i, spins));
  return lines;
}

TEST_F(TrajectoryXyzRows, AreThoseOfTheDisksInOrderOfId) {
  for (const std::size_t count : {1U, 15U, 16U, 17U, 4096U, 5003U}) {
    const Disks disks = disks_of(ids_from(3, count));
    EXPECT_EQ(lines_of_last({disks}, {}), lines_of(disks)) << count;
  }
}

TEST_F(TrajectoryXyzRows, AreFewerWhenDisksHaveLeft) {
  std::vector<DiskId> ids = ids_from(3, 300);
  const Disks all = disks_of(ids), first = disks_of(ids_from(3, 200)), last = disks_of(ids_from(100, 200));
  std::erase_if(ids, [](DiskId id) { return id % 7 == 4; });
  const Disks some = disks_of(ids);
  std::erase_if(ids, [](DiskId id) { return id % 2 == 0; });
  const Disks half = disks_of(ids), two = disks_of({4, 6}), three = disks_of({0, 1, 3});
  for (const Disks& disks : {some, half, first, last, two, three}) {
    EXPECT_EQ(lines_of_last({all, disks}, {}), lines_of(disks)) << disks.size();
    EXPECT_EQ(lines_of_last({disks, all}, {}), lines_of(all)) << disks.size();
  }
}

TEST_F(TrajectoryXyzRows, AreThoseOfTheSelectedDisks) {
  const Disks disks = disks_of(ids_from(0, 300));
  XyzPlan plan;
  plan.select.stride = 7;
  std::vector<std::string> expected;
  for (const std::size_t i : by_id(disks)) {
    if (disks.id[i] % 7 == 0) expected.push_back(line_of(disks, i));
  }
  EXPECT_EQ(lines_of_last({disks}, plan), expected);
}

TEST_F(TrajectoryXyzRows, HaveNumbersInSinglePrecision) {
  const Disks disks = disks_of(ids_from(0, 333));
  XyzPlan plan;
  plan.spins = plan.single = true;
  EXPECT_EQ(lines_of_last({disks}, plan), lines_of<float>(disks, true));
}

// No disk is lost if a damaged file gives two the same id.
TEST_F(TrajectoryXyzRows, AreThereForBothDisksOfAnId) {
  const Disks before = disks_of({1, 2, 3}), disks = disks_of({5, 7, 7});
  const std::vector<std::string> lines = lines_of_last({before, disks}, {}), expected = lines_of(disks);
  EXPECT_EQ(std::multiset<std::string>(lines.begin(), lines.end()),
            std::multiset<std::string>(expected.begin(), expected.end()));
}

// As much room is reserved as the text of the blocks takes.
TEST_F(TrajectoryXyzRows, LeaveNoRoomBehindThem) {
  const std::vector<std::string> lines = lines_of_last({disks_of(ids_from(0, 20'000))}, {});
  ASSERT_EQ(lines.size(), 20'000U);
  struct stat status {};
  ASSERT_EQ(stat(path_.c_str(), &status), 0);
  ASSERT_GT(status.st_size, 1 << 20) << "less is not reserved";
  EXPECT_LT(status.st_blocks * 512, status.st_size + (1 << 17));
}

}  // namespace
}  // namespace carom
