// Changes and searches between two steps in an engine that runs its windows in parts: it finds the disks near a place,
// and gives a disk another velocity.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/disks/state_hash.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

constexpr double side = 130.0;
constexpr double half_width = 3.0;
constexpr double half_height = 2.0;

Scene gas_of(const std::string& sides) {
  return make_scene({side, side, sides, "",
                     "[[disks]]\ncount = 6000\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\n"
                     "mass = 1.0\n",
                     1000, ""});
}

double distance(double a, double b, bool periodic) {
  const double d = std::abs(a - b);
  return periodic ? std::min(d, side - d) : d;
}

TEST(ChangesInParts, AllNearAPlaceAreFoundAndFewOthers) {
  for (const std::string sides : {"periodic", "wall"}) {
    const Scene scene = gas_of(sides);
    const auto engine = make_parallel_engine(scene, initial_state(scene), {2});
    test::Draws draw(5);
    for (int window = 0; window < 4; ++window) {
      engine->step();
      const Disks& d = engine->state().disks;
      std::size_t visits = 0;
      for (int k = 0; k < 50; ++k) {
        const Vec2 place{draw.in(0.0, side), draw.in(0.0, side)};
        std::set<std::size_t> seen;
        ASSERT_TRUE(engine->visit_near(place, half_width, half_height, [&](std::size_t i) {
          seen.insert(i);
          ++visits;
        }));
        for (std::size_t i = 0; i < d.size(); ++i) {
          const bool near = distance(d.x[i], place.x, sides == "periodic") <= half_width &&
                            distance(d.y[i], place.y, sides == "periodic") <= half_height;
          EXPECT_TRUE(!near || seen.count(i) == 1) << sides << ", disk " << d.id[i];
        }
      }
      EXPECT_LT(visits, 50 * d.size() / 20);
    }
  }
}

// The search covers all rows of a part and beyond, up to rows that are closer to its first row around the box.
TEST(ChangesInParts, AllAreFoundWhereTheSearchIsLargerThanAPart) {
  for (const std::string sides : {"periodic", "wall"}) {
    const Scene scene = gas_of(sides);
    for (const Threads threads : {Threads{2, 1}, Threads{3, 8}}) {
      const auto engine = make_parallel_engine(scene, initial_state(scene), threads);
      engine->step();
      const Disks& d = engine->state().disks;
      test::Draws draw(7);
      for (int k = 0; k < 40; ++k) {
        const Vec2 place{draw.in(0.0, side), draw.in(0.0, side)};
        const double half = draw.in(0.3, 0.5) * side;
        std::set<std::size_t> seen;
        ASSERT_TRUE(engine->visit_near(place, half_width, half, [&](std::size_t i) { seen.insert(i); }));
        std::size_t missed = 0;
        for (std::size_t i = 0; i < d.size(); ++i) {
          const bool near = distance(d.x[i], place.x, sides == "periodic") <= half_width &&
                            distance(d.y[i], place.y, sides == "periodic") <= half;
          missed += near && seen.count(i) == 0;
        }
        EXPECT_EQ(missed, 0U) << sides << ", " << threads.count << " threads, y = " << place.y << " +- " << half;
      }
    }
  }
}

std::size_t place_of(const Disks& d, DiskId id) {
  return static_cast<std::size_t>(std::find(d.id.begin(), d.id.end(), id) - d.id.begin());
}

// The disks are anywhere in the box, many of them in the halo of the other part.
TEST(ChangesInParts, OtherVelocitiesHaveTheBitsOfOneQueue) {
  const Scene scene = gas_of("periodic");
  const auto one_queue = make_parallel_engine(scene, initial_state(scene), {1});
  const auto in_parts = make_parallel_engine(scene, initial_state(scene), {2});
  test::Draws draw(6);
  for (int window = 0; window < 12; ++window) {
    one_queue->step();
    in_parts->step();
    ASSERT_EQ(state_hash(in_parts->state().disks), state_hash(one_queue->state().disks)) << "window " << window;
    for (int k = 0; k < 40; ++k) {
      const auto id = static_cast<DiskId>(draw.bits() % 6000);
      Edit edit{Edit::Kind::set_velocity, {}, 0};
      edit.disk.vx = draw.in(-3.0, 3.0);
      edit.disk.vy = draw.in(-3.0, 3.0);
      for (const auto& engine : {&one_queue, &in_parts}) {
        edit.index = place_of((*engine)->state().disks, id);
        ASSERT_TRUE((*engine)->edit(edit));
      }
    }
    // Parts stay valid after a change of velocities.
    EXPECT_TRUE(in_parts->visit_near({1.0, 1.0}, 1.0, 1.0, [](std::size_t) {}));
  }
}

// Parts become invalid when a disk is added or removed. Whatever is asked before the next window, a search finds all
// disks or is refused, and further changes are applied to the right disks.
TEST(ChangesInParts, AreKnownNoMoreWhereADiskComesOrGoes) {
  for (const Edit::Kind kind : {Edit::Kind::add, Edit::Kind::remove}) {
    const Scene scene = gas_of("wall");
    const auto one_queue = make_parallel_engine(scene, initial_state(scene), {1});
    const auto in_parts = make_parallel_engine(scene, initial_state(scene), {2});
    const auto change = [&](Edit edit, DiskId id) {
      for (const auto& engine : {&one_queue, &in_parts}) {
        edit.index = place_of((*engine)->state().disks, id);
        ASSERT_TRUE((*engine)->edit(edit));
      }
    };
    for (int window = 0; window < 4; ++window) {
      one_queue->step();
      in_parts->step();
      ASSERT_EQ(state_hash(in_parts->state().disks), state_hash(one_queue->state().disks)) << "window " << window;
      EXPECT_TRUE(in_parts->visit_near({1.0, 1.0}, 1.0, 1.0, [](std::size_t) {})) << "the window was not run in parts";
      // This disk is so small that there is room for it in the corner.
      const Disk small{0.005 + 0.01 * window, 0.002, 0.0, 3.0, 0.001, 1.0, 6000U + static_cast<DiskId>(window)};
      change({kind, small, 0}, static_cast<DiskId>(100 * window));
      const Disks& d = in_parts->state().disks;
      ASSERT_EQ(d.size(), one_queue->state().disks.size());
      std::set<std::size_t> seen;
      if (in_parts->visit_near({10.0, 10.0}, side, side, [&](std::size_t i) { seen.insert(i); })) {
        EXPECT_EQ(seen.size(), d.size());
      }
      Edit faster{Edit::Kind::set_velocity, {}, 0};
      faster.disk.vx = 4.0;
      change(faster, static_cast<DiskId>(100 * window + 1));
    }
  }
}

}  // namespace
}  // namespace carom::exact_tests
