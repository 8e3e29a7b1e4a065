// The positions of images above a sheared box, and of moving sides, follow from the time of the run. Late in a run its
// rounding is much coarser than that of coordinates: pairs across the border that approach slowly touch some windows
// earlier or later than first predicted, and disks touch a side that they should miss.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "core/physics/boundary.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

constexpr double width = 19.7, height = 60.0, radius = 0.5;

Scene sheared_scene() {
  Scene scene = test::scene_of(Method::exact, width, height, 0.0, 1.0);
  test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  scene.box.shear.rate = 1.0;
  scene.box.shear.jump = height;
  return scene;
}

// Disks that move nearly with the flow, and pairs of a disk below the top and one above the bottom. The image of the
// latter approaches the former so slowly that the pairs touch one after the other.
State slow_pairs(const Scene& scene, double time, double approach) {
  constexpr int pairs = 5, rows = 10;
  const double offset = box_at(scene.box, time).shear.offset;
  const double rise = 0.1;
  std::vector<Disk> list;
  const auto add = [&](double x, double y, double towards) {
    list.push_back({wrap(x, width), y, scene.box.shear.flow(y, height) - towards, 0.0, radius, 1.0});
  };
  for (int k = 0; k < pairs; ++k) {
    const double x = width * (k + 0.5) / pairs;
    const double apart = std::sqrt(4.0 * radius * radius - rise * rise) + approach * 0.1 * (k + 0.5);
    const double back = 0.1 * k;
    add(x, height - 0.5 * rise, back);
    add(x + apart - offset, 0.5 * rise, back + approach + scene.box.shear.rate * rise);
    for (int row = 1; row < rows; ++row) add(x, row * height / rows, back);
  }
  State state = test::state_of(scene, list);
  state.time = time;
  return state;
}

// Compares both engines window by window. until: the end of the run.
void expect_bits_of_reference(Scene scene, const State& start, double until, Count least_contacts) {
  scene.run.t_end = until;
  const auto reference = make_reference_engine(scene, start);
  const auto one = make_parallel_engine(scene, start, {1});
  const auto three = make_parallel_engine(scene, start, {3, 128});
  while (reference->state().time < until) {
    for (Engine* engine : {reference.get(), one.get(), three.get()}) engine->step();
    const Counters& right = reference->state().counters;
    for (const Engine* engine : {one.get(), three.get()}) {
      ASSERT_EQ(engine->state().time, reference->state().time);
      ASSERT_EQ(engine->state().counters.collisions, right.collisions);
      ASSERT_EQ(engine->state().counters.wall_collisions, right.wall_collisions);
      ASSERT_EQ(state_hash(engine->state().disks), state_hash(reference->state().disks))
          << "at " << reference->state().time - start.time << " after t = " << start.time;
    }
  }
  const Counters& all = reference->state().counters;
  EXPECT_GE(all.collisions + all.wall_collisions, least_contacts);
}

TEST(LateTimes, PairsAcrossTheBorderOfAShearTouchWhenTheReferenceSays) {
  for (const double late : {1e4, 1e5, 1e6, 1e7, 1e8}) {
    const Scene scene = sheared_scene();
    expect_bits_of_reference(scene, slow_pairs(scene, late, late * 3e-13), late + 1.0, 5);
  }
}

// The bottom rises and slows down, in a parabola from the start. Disks have its speed at the time when it comes nearest
// to them, and then it just reaches their edges, or comes a little further. One disk far above is so fast that windows
// are short.
State passed_by_the_bottom(const Scene& scene, double time, double furthest) {
  constexpr int disks = 45;
  const SideMotion& bottom = scene.box.motions[static_cast<std::size_t>(Side::bottom)];
  std::vector<Disk> list;
  for (int k = 0; k < disks; ++k) {
    const double nearest_at = 0.02 * bottom.half() * (1.0 + (7 * k % disks) * 0.5);
    const SidePlace there = bottom.at(nearest_at);
    const double beyond = furthest * (2.0 * k / disks - 1.0);
    list.push_back(
        {1.0 + 2.2 * k, radius + there.inset - there.speed * nearest_at - beyond, 0.0, there.speed, radius, 1.0});
  }
  list.push_back({50.0, scene.box.height - 2.0 * radius, 60.0, 0.0, radius, 1.0});
  State state = test::state_of(scene, list);
  state.time = time;
  return state;
}

TEST(LateTimes, DisksTouchASideThatMovesWhereTheReferenceSays) {
  for (const double late : {1e8, 2e8, 3e8, 4e8, 5e8, 6e8, 7e8, 8e8, 9e8, 1e9}) {
    Scene scene = test::scene_of(Method::exact, 100.0, 14.0, 0.0, 1.0);
    SideMotion& bottom = scene.box.motions[static_cast<std::size_t>(Side::bottom)];
    bottom = {.kind = SideMotion::Kind::parabolas, .inset = 2.0, .amplitude = 2.0, .period = 100.0, .furthest = 4.0};
    expect_bits_of_reference(scene, passed_by_the_bottom(scene, late, late * 2e-17), late + 24.0, 10);
  }
}

// The position, after some time, of a disk that bounces between walls at `low` and `high`.
double folded(double place, double speed, double low, double high, double time) {
  const double room = high - low;
  const double way = std::fmod(place - low + speed * time, 2.0 * room);
  return low + (way <= room ? way : 2.0 * room - way);
}

// A window lasts as long as the clock advances, in whole units of the clock's last place: disks must be where that time
// puts them.
TEST(LateTimes, ADiskIsWhereItsPathHasBroughtIt) {
  for (const double late : {0.0, 1e6, 1e9, 1e12}) {
    const double span = 4096.0;
    Scene scene = test::scene_of(Method::exact, 10.0, 10.0, 0.0, 1.0);
    scene.run.t_end = late + span;
    State start = test::state_of(scene, {{3.0, 4.0, 0.3, 0.7, 0.5, 1.0}});
    start.time = late;
    for (const auto& engine : {make_reference_engine(scene, start), make_parallel_engine(scene, start, {1})}) {
      while (engine->state().time < scene.run.t_end) engine->step();
      const Disks& d = engine->state().disks;
      EXPECT_NEAR(d.x[0], folded(3.0, 0.3, 0.5, 9.5, span), 1e-11) << "from t = " << late;
      EXPECT_NEAR(d.y[0], folded(4.0, 0.7, 0.5, 9.5, span), 1e-11) << "from t = " << late;
      EXPECT_GT(engine->state().counters.steps, 5U);
    }
  }
}

}  // namespace
}  // namespace carom
