// The layout of neighbour lists: the order in which disks are stored, and the margins of lists.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "parallel/exact/neighbour_lists.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

Disks random_disks(test::Draws& draws, std::size_t n, double side, double smallest, double largest) {
  Disks d;
  for (std::size_t i = 0; i < n; ++i) {
    d.x.push_back(draws.in(0.0, side));
    d.y.push_back(draws.in(0.0, side));
    d.radius.push_back(draws.in(smallest, largest));
    d.id.push_back(static_cast<DiskId>(i));
  }
  d.vx = d.vy = std::vector<double>(n, 0.0);
  return d;
}

// Disks of all sizes are stored near their neighbours: hardly any offset needs more than 16 bits, except those across
// the border along y.
TEST(ListLayout, OfManySizesHasSmallOffsets) {
  test::Draws draws(12);
  Domain box;
  box.width = box.height = 300.0;
  box.sides.fill(SideKind::periodic);
  Disks d = random_disks(draws, 80000, box.width, 0.1, 0.5);
  NeighbourLists lists;
  lists.build(d, box, {}, Executor(1));
  std::size_t far = 0, listed = 0;
  for (std::uint32_t i = 0; i < d.size(); ++i) {
    lists.for_each_neighbour(i, [&](std::uint32_t j) {
      ++listed;
      far += std::max(i, j) - std::min(i, j) > 32767 ? 1U : 0U;
    });
  }
  EXPECT_GT(listed, 5 * d.size());
  EXPECT_LT(far, listed / 50);
}

// The growth of radii is subtracted from the distance after which disks are relisted, unless too little would be left.
TEST(ListLayout, LeavesRoomForGrowth) {
  test::Draws draws(11);
  Domain box;
  box.width = box.height = 40.0;
  Disks d = random_disks(draws, 500, box.width, 0.2, 2.0);
  NeighbourLists lists;
  const auto build = [&](double growth) {
    ListLayout layout;
    layout.growth = growth;
    lists.build(d, box, layout, Executor(1));
  };
  build(0.0);
  const double skin = lists.skin();
  EXPECT_EQ(lists.relist_distance_elsewhere().length, skin);
  build(0.5 * skin);
  EXPECT_NEAR(lists.skin(), skin, 1e-12);
  EXPECT_EQ(lists.growth(), 0.5 * skin);
  EXPECT_EQ(lists.relist_distance_elsewhere().length, lists.skin() - 0.5 * skin);
  build(0.9 * skin);
  EXPECT_EQ(lists.growth(), 0.0);
  EXPECT_EQ(lists.relist_distance_elsewhere().length, lists.skin());
}

// A disk that comes to a part may be a little larger than all the part had before; a giant elsewhere in the box must
// not lengthen searches.
TEST(ListLayout, TakesUpDisksALittleLarger) {
  test::Draws draws(13);
  Domain box;
  box.width = box.height = 30.0;
  Disks d = random_disks(draws, 300, box.width, 0.2, 0.4);
  const double largest = largest_radius(d);
  NeighbourLists lists;
  const auto listed = [&](double largest_of_box) {
    ListLayout layout;
    layout.largest_of_box = largest_of_box;
    lists.build(d, box, layout, Executor(1));
    return lists.largest_listed();
  };
  EXPECT_EQ(listed(0.0), largest);
  EXPECT_EQ(listed(1.05 * largest), 1.05 * largest);
  EXPECT_EQ(listed(2.0 * largest), largest);
}

}  // namespace
}  // namespace carom
