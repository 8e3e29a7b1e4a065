// The conversion of places in the box to whole numbers and back.
#include "parallel/exact/listed_box.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

// Periodic along x, between walls along y.
ListedBox half_periodic() {
  return ListedBox(test::box_of(20.0, 10.0, test::Periodic::x));
}

TEST(ListedBox, RoundsPlacesDownByLessThanAUnit) {
  const ListedBox box = half_periodic();
  for (const double x : {0.0, 1e-9, 3.7, 19.999999}) {
    const Vec2 there = box.position_of(box.fixed_point(x, 0.5 * x));
    EXPECT_LE(there.x, x);
    EXPECT_LT(x - there.x, box.unit.x);
    EXPECT_LE(there.y, 0.5 * x);
    EXPECT_LT(0.5 * x - there.y, box.unit.y);
  }
}

TEST(ListedBox, WrapsAlongAPeriodAndKeepsToWalls) {
  const ListedBox box = half_periodic();
  EXPECT_EQ(box.fixed_point(20.0, 5.0).x, 0U);
  EXPECT_EQ(box.fixed_point(-5.0, 5.0).x, box.fixed_point(15.0, 5.0).x);
  EXPECT_EQ(box.fixed_point(5.0, -1.0).y, 0U);
  EXPECT_EQ(box.position_of(box.fixed_point(5.0, 11.0)).y, 10.0);
}

TEST(ListedBox, TakesTheNearestImageAlongAPeriodAlone) {
  const Vec2 d = half_periodic().nearest_image_of({-12.0, 8.0});
  EXPECT_DOUBLE_EQ(d.x, 8.0);
  EXPECT_EQ(d.y, 8.0);
}

TEST(ListedBox, IsLeftAlongAPeriodAlone) {
  const ListedBox box = half_periodic();
  EXPECT_FALSE(box.is_outside(0.0, -1.0));
  EXPECT_FALSE(box.is_outside(19.0, 11.0));
  EXPECT_TRUE(box.is_outside(20.0, 5.0));
  EXPECT_TRUE(box.is_outside(-0.1, 5.0));
}

TEST(ListedBox, DepthIsThatOfThePlaceWhereADiskIsListed) {
  const ListedBox box = half_periodic();
  EXPECT_EQ(box.depth_beyond_border({23.0, 11.0}, {3.0, 9.0}, 2.0).x, 3.0);
  EXPECT_EQ(box.depth_beyond_border({-3.0, 5.0}, {17.0, 5.0}, 2.0).x, 3.0);
  EXPECT_EQ(box.depth_beyond_border({23.0, 11.0}, {3.0, 9.0}, 3.5).x, 0.0) << "listed nearer to the border than 3.5";
  EXPECT_EQ(box.depth_beyond_border({3.0, 5.0}, {3.0, 5.0}, 2.0).x, 0.0) << "within the box";
  EXPECT_EQ(box.depth_beyond_border({23.0, 11.0}, {3.0, 9.0}, 0.5).y, 0.0) << "walls are no border";
}

// A box of width 1, periodic along x, with pairs of disks far from each other.
Scene long_scene(double height, bool periodic_y) {
  Scene scene = test::scene_of(Method::exact, 1.0, height, 0.0, 5.0);
  test::set_sides(scene.box, SideKind::periodic, periodic_y ? SideKind::periodic : SideKind::wall);
  return scene;
}

State pairs_in(const Scene& scene, int pairs) {
  test::Draws draws(3);
  std::vector<Disk> list;
  for (int k = 0; k < 2 * pairs; ++k) {
    const double y = (k / 2 + 0.5) * scene.box.height / pairs + (k % 2) * 0.3;
    list.push_back({draws.in(0.2, 0.7), y, draws.in(-1.0, 1.0), draws.in(-1.0, 1.0), 0.1, 1.0});
  }
  return test::state_of(scene, list);
}

// A disk that leaves its skin as soon as it is listed would be relisted for ever.
TEST(ListedBox, HasRoomForASkinUnlessItIsFarLongerThanItsPeriod) {
  EXPECT_TRUE(can_list_in(test::box_of(1.0, 1e10)));
  EXPECT_TRUE(can_list_in(test::box_of(1.0, 1e10, test::Periodic::y)));
  for (const bool periodic_y : {false, true}) {
    for (const double height : {1e6, 1e8, 1e11}) {
      const Scene scene = long_scene(height, periodic_y);
      EXPECT_EQ(can_list_in(scene.box), height < 1e7);
      const State start = pairs_in(scene, 30);
      const auto reference = make_reference_engine(scene, start);
      const auto one = make_parallel_engine(scene, start, {1});
      const auto three = make_parallel_engine(scene, start, {3, 256});
      for (Engine* engine : {reference.get(), one.get(), three.get()}) {
        while (engine->state().time < scene.run.t_end) engine->step();
        EXPECT_EQ(state_hash(engine->state().disks), state_hash(reference->state().disks)) << "height " << height;
      }
      EXPECT_GT(reference->state().counters.collisions, 5U);
    }
  }
}

TEST(ListedBox, TakesNoMoreDisksWithoutASkinThanMemoryHoldsPairs) {
  const Scene scene = long_scene(1e10, false);
  const auto engine = make_parallel_engine(scene, pairs_in(scene, 5001), {1});
  EXPECT_THROW(engine->step(), RunError);
}

}  // namespace
}  // namespace carom
