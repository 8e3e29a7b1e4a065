// Operations on whole disks act on each of their columns.
#include "core/disks/disk_columns.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/measure/measured_disks.hpp"

namespace carom {
namespace {

constexpr std::size_t count = 7;
constexpr DiskColumns all_columns{.radius = true, .mass = true, .spin = true};

// A disk whose values all follow from its id.
Disk disk_of(DiskId id) {
  const double k = id;
  return {k, k + 0.125, k + 0.25, -k, 1.0 + k, 2.0 + k, id, 3.0 - k};
}

Disks rough_disks() {
  Disks d;
  d.inertia = 0.5;
  for (DiskId id = 0; id < count; ++id) push_back(d, disk_of(id), all_columns);
  return d;
}

// Smooth disks of one size: without columns for radius, mass and spin.
Disks equal_disks() {
  Disks d;
  for (DiskId id = 0; id < count; ++id) {
    Disk disk = disk_of(id);
    disk.radius = 0.5;
    disk.mass = 2.0;
    append(d, disk);
  }
  return d;
}

void expect_disks(const Disks& d, const std::vector<DiskId>& ids) {
  ASSERT_EQ(d.size(), ids.size());
  const DiskColumns columns = columns_of(d);
  for_each_column([&](const auto& column) {
    const auto& entries = d.*column.entries;
    ASSERT_EQ(entries.size(), column.is_in(columns) ? ids.size() : 0);
    for (std::size_t i = 0; i < entries.size(); ++i) EXPECT_EQ(entries[i], disk_of(ids[i]).*column.value);
  });
}

void expect_moved_whole(const Disks& start) {
  Disks d = start;
  std::vector<unsigned char> gone(count, 0);
  gone[1] = gone[5] = 1;
  EXPECT_EQ(remove_marked(d, gone), 2U);
  expect_disks(d, {0, 2, 3, 4, 6});
  take_out(d, 1);
  expect_disks(d, {0, 6, 3, 4});
  take_out(d, 3);
  expect_disks(d, {0, 6, 3});
  copy_within(d, 2, 0);
  expect_disks(d, {3, 6, 3});
  truncate(d, 2);
  expect_disks(d, {3, 6});
  put_at(d, 0, disk_at(start, 5));
  push_back(d, disk_at(start, 2), columns_of(d));
  expect_disks(d, {5, 6, 2});
  Disks gathered = equal_disks();
  gather_disks(d, std::vector<std::size_t>{2, 0}, gathered);
  expect_disks(gathered, {2, 5});
  EXPECT_EQ(gathered.common_radius, start.common_radius);
  EXPECT_EQ(gathered.common_mass, start.common_mass);
  EXPECT_EQ(gathered.inertia, start.inertia);
  truncate(d, 0);
  expect_disks(d, {});
}

TEST(DiskColumns, AllOfThemMoveTogether) {
  expect_moved_whole(rough_disks());
}

TEST(DiskColumns, NoneArisesThatDisksDoNotNeed) {
  const Disks d = equal_disks();
  const DiskColumns columns = columns_of(d);
  EXPECT_FALSE(columns.radius || columns.mass || columns.spin);
  expect_moved_whole(d);
}

TEST(DiskColumns, ARadiusThatIsNotSharedBecomesOne) {
  Disks d = equal_disks();
  Disk large = disk_of(9);
  large.mass = 2.0;
  append(d, large);
  EXPECT_TRUE(d.mass.empty());
  ASSERT_EQ(d.radius.size(), count + 1);
  EXPECT_EQ(d.radius.front(), 0.5);
  EXPECT_EQ(d.radius.back(), large.radius);
}

TEST(DiskColumns, RoomIsMadeInThoseThatDisksHave) {
  Disks d;
  reserve(d, 100, {.mass = true});
  for_each_column(
      [&](const auto& column) { EXPECT_EQ((d.*column.entries).capacity(), column.is_in({.mass = true}) ? 100U : 0U); });
}

// Copies of a group once lost the columns of rough disks: their spins and their moment of inertia.
TEST(DiskColumns, DisksOfAGroupHaveAllOfThem) {
  const Disks some = disks_of(rough_disks(), {2, 5});
  EXPECT_EQ(some.inertia, 0.5);
  expect_disks(some, {2, 3, 4});
}

}  // namespace
}  // namespace carom
