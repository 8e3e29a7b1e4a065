#include "core/disks/disks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace carom {
namespace {

Disks with_ids(const std::vector<DiskId>& ids) {
  Disks d;
  for (const DiskId id : ids) append(d, {0.0, 0.0, 0.0, 0.0, 0.5, 1.0, id});
  return d;
}

void expect_in_order(const std::vector<DiskId>& ids) {
  const std::vector<std::size_t> order = by_id(with_ids(ids));
  ASSERT_EQ(order.size(), ids.size());
  std::vector<std::size_t> each = order;
  std::sort(each.begin(), each.end());
  std::vector<std::size_t> all(ids.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  EXPECT_EQ(each, all);
  EXPECT_TRUE(
      std::is_sorted(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; }));
}

TEST(ById, OrdersAnyIds) {
  EXPECT_TRUE(by_id({}).empty());
  std::mt19937 random(3);
  // share: disks over the largest id; by_id has another way below a quarter.
  for (const double share : {1.0, 0.9, 0.3, 0.26, 0.24, 0.01}) {
    for (int k = 0; k < 50; ++k) {
      std::vector<DiskId> ids(1 + random() % 300);
      const auto step = static_cast<DiskId>(1.0 / share);
      for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<DiskId>(i * step + random() % step);
      std::shuffle(ids.begin(), ids.end(), random);
      expect_in_order(ids);
    }
  }
  expect_in_order({0xfffffffeU, 7, 0});
}

// A damaged file may have an id twice: then no disk may be lost or listed twice.
TEST(ById, AnIdThatStandsTwice) {
  expect_in_order({3, 3});
  expect_in_order({0, 1, 2, 1});
  expect_in_order({5, 4, 3, 2, 1, 0, 0, 0});
}

}  // namespace
}  // namespace carom
