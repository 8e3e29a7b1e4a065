// Contacts that rounding decides, several windows after they were first predicted: disks that pass each other exactly
// at their contact distance, and disks that rise just to the ceiling. Each window's paths start from rounded positions,
// so disks that missed each other by a rounding may then touch.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "parallel/exact/exact_engine.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

// Pairs of disks, each in a cell of its own.
struct Pairs {
  int a_side = 0;
  double cell = 0.0;  // side of a cell; length
  double side() const { return a_side * cell + 2.0; }
};

Pairs some_pairs(test::Draws& draws) {
  const int a_side = 2 + static_cast<int>(draws.bits() % 7);
  return {a_side, draws.in(6.0, 14.0)};
}

Vec2 in_cell(test::Draws& draws, const Pairs& pairs, int k) {
  const double x = k % pairs.a_side + 0.5;
  const double y = k / pairs.a_side + 0.5;
  return {x * pairs.cell + draws.in(-0.5, 0.5), y * pairs.cell + draws.in(-0.5, 0.5)};
}

// The second disk of each pair moves along a line that passes the first one at their contact distance.
State passing(test::Draws& draws, const Pairs& pairs, bool unequal_radii, double unit) {
  std::vector<Disk> list;
  for (int k = 0; k < pairs.a_side * pairs.a_side; ++k) {
    const Vec2 at = in_cell(draws, pairs, k);
    const double first = unequal_radii ? draws.in(0.05, 0.6) : 0.5;
    const double second = unequal_radii ? draws.in(0.05, 0.6) : 0.5;
    const double way = draws.in(0.05, 0.5 * pairs.cell - 1.6);
    const double angle = draws.in(0.0, 2.0 * std::numbers::pi);
    const double c = std::cos(angle), s = std::sin(angle);
    // Some disks are slow.
    const double speed = draws.in(0.5, 2.0) * (k % 4 == 0 ? std::pow(10.0, -draws.in(0.0, 6.0)) : 1.0);
    const Vec2 both = k % 2 == 0 ? Vec2{} : Vec2{draws.in(-1.0, 1.0), draws.in(-1.0, 1.0)};
    const double beside = first + second;
    const auto add = [&](double x, double y, double vx, double vy, double radius) {
      list.push_back({x * unit, y * unit, vx * unit, vy * unit, radius * unit, 1.0});
    };
    add(at.x, at.y, both.x, both.y, first);
    add(at.x + way * c - beside * s, at.y + way * s + beside * c, both.x - speed * c, both.y - speed * s, second);
  }
  return test::state_of(list);
}

State rising(test::Draws& draws, const Pairs& pairs, double g) {
  constexpr double radius = 0.5;
  std::vector<Disk> list;
  for (int k = 0; k < pairs.a_side * pairs.a_side; ++k) {
    const Vec2 at = in_cell(draws, pairs, k);
    list.push_back({at.x, at.y, draws.in(-0.1, 0.1), std::sqrt(2.0 * g * (pairs.side() - radius - at.y)), radius, 1.0});
  }
  return test::state_of(list);
}

// A source that has room for a few small disks in a corner, and afterwards still cuts windows short.
Source cutting_source(const Pairs& pairs, double rate) {
  Source source;
  const double at = pairs.side() - 0.3;
  source.region_low = {at, at};
  source.region_high = {at + 1e-3, at + 1e-3};
  source.rate = rate;
  source.radius.value = 0.01;
  source.mass.value = 1.0;
  return source;
}

// A box with a source. For one seed in three its rate makes all windows a hundredth of their usual length; otherwise
// windows are cut short now and then.
Scene cut_scene(const Pairs& pairs, std::uint32_t seed) {
  const bool periodic = seed % 2 == 0;
  Scene scene = plain_scene(
      test::box_of(pairs.side(), pairs.side(), periodic ? test::Periodic::both : test::Periodic::none), 1e9);
  scene.sources.push_back(cutting_source(pairs, seed % 3 == 0 ? 200.0 : 3.0));
  return scene;
}
int cut_windows(std::uint32_t seed) {
  return seed % 3 == 0 ? 400 : 60;
}

// Compares every window of one queue, of parts and of regions with the reference. Returns the number of collisions.
Count expect_reference(const Scene& scene, State start, int windows) {
  start.sources.resize(scene.sources.size());
  const auto reference = make_reference_exact(scene, start);
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(make_parallel_engine(scene, start, {1}));
  engines.push_back(make_parallel_engine(scene, start, {2, 1024}));
  engines.push_back(make_parallel_exact(scene, start, {2, 1024}, [](const SliceBorders&) {}));
  // The watch is called once for some thousand events, so a window may call it only a few times; more calls mean that
  // it hangs.
  int asked = 0;
  for (const auto& engine : engines) engine->set_watch([&asked] { return ++asked < 1000; });
  for (int k = 0; k < windows && !testing::Test::HasFailure(); ++k) {
    reference->step();
    const std::string right = fingerprint(reference->state());
    for (std::size_t e = 0; e < engines.size(); ++e) {
      asked = 0;
      engines[e]->step();
      EXPECT_EQ(fingerprint(engines[e]->state()), right) << "engine " << e << ", window " << k;
    }
  }
  const Counters& all = reference->state().counters;
  return all.collisions + all.wall_collisions;
}

// The sum of count(seed, draws, pairs) over these seeds, for scenes made from them.
template <class CountOf>
Count over_seeds(std::uint32_t seeds, CountOf&& count) {
  Count all = 0;
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    test::Draws draws(seed);
    const Pairs pairs = some_pairs(draws);
    all += count(seed, draws, pairs);
  }
  return all;
}

struct Case {
  const char* name;
  Gravity gravity{};
  bool unequal_radii = false;
  double shear_rate = 0.0;
  double unit = 1.0;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class Grazing : public testing::TestWithParam<Case> {};

TEST_P(Grazing, DisksThatPassAtTheirContactDistance) {
  const Case& c = GetParam();
  const Count collisions = over_seeds(8, [&c](std::uint32_t seed, test::Draws& draws, const Pairs& pairs) {
    const double side = pairs.side() * c.unit;
    const bool periodic = c.shear_rate != 0.0 || seed % 2 == 0;
    Scene scene = plain_scene(test::box_of(side, side, periodic ? test::Periodic::both : test::Periodic::none), 1e9);
    scene.physics.gravity = c.gravity;
    if (c.shear_rate != 0.0) scene.box.shear = {c.shear_rate, c.shear_rate * side, 0.0};
    return expect_reference(scene, passing(draws, pairs, c.unequal_radii, c.unit), 12);
  });
  EXPECT_GT(collisions, 100U);
}

INSTANTIATE_TEST_SUITE_P(Paths, Grazing,
                         testing::Values(Case{"straight"}, Case{"falling", Gravity(0.0, 0.4)},
                                         Case{"falling_askew", Gravity(0.3, -0.2)}, Case{"radii", {}, true},
                                         Case{"sheared", {}, false, 0.1}, Case{"large", {}, false, 0.0, 0x1.8p20},
                                         Case{"small", {}, true, 0.0, 0x1.4p-20}),
                         [](const auto& p) { return std::string(p.param.name); });

// The same with windows cut short: many windows, each starting with rounded paths, lie between the prediction of a
// contact and the contact.
TEST(GrazingSources, DisksThatPassAtTheirContactDistance) {
  const Count collisions = over_seeds(9, [](std::uint32_t seed, test::Draws& draws, const Pairs& pairs) {
    return expect_reference(cut_scene(pairs, seed), passing(draws, pairs, false, 1.0), cut_windows(seed));
  });
  EXPECT_GT(collisions, 100U);
}

// The heights of rise end exactly at the ceiling, up to the last bits.
TEST(GrazingSides, DisksThatRiseToTheCeiling) {
  const Count collisions = over_seeds(24, [](std::uint32_t /*seed*/, test::Draws& draws, const Pairs& pairs) {
    const double g = draws.in(0.1, 1.0);
    const Scene scene = plain_scene(test::box_of(pairs.side(), pairs.side()), 1e9, g);
    return expect_reference(scene, rising(draws, pairs, g), 20);
  });
  EXPECT_GT(collisions, 1000U);
}

// The ceiling vibrates as a sine. Disks rise at the speed that it has when it comes nearest to them, and then just
// reach their edges, up to the last bits; they come from below, so that it has not met them before.
State under_a_sine(test::Draws& draws, double side, const SideMotion& ceiling) {
  constexpr double radius = 0.5, apart = 2.2 * radius;
  std::vector<Disk> list;
  for (double x = radius; x < side - 4.0 * radius; x += apart) {
    // This time is in the second quarter of a period, when the ceiling goes up again.
    const double nearest_at = ceiling.period * (std::floor(draws.in(0.0, 6.0)) + draws.in(0.3, 0.45));
    const SidePlace there = ceiling.at(nearest_at);
    const double y = side - radius - there.inset + there.speed * nearest_at;
    if (y > radius) list.push_back({x, y, 0.0, -there.speed, radius, 1.0});
  }
  return test::state_of(list);
}

TEST(GrazingSides, DisksUnderASineThatComesAsFarAsTheirEdges) {
  const Count contacts = over_seeds(12, [](std::uint32_t /*seed*/, test::Draws& draws, const Pairs& pairs) {
    Scene scene = plain_scene(test::box_of(pairs.side(), pairs.side()), 1e9);
    SideMotion& ceiling = scene.box.motions[static_cast<std::size_t>(Side::top)];
    ceiling.kind = SideMotion::Kind::sine;
    ceiling.amplitude = 0.4;
    ceiling.inset = 0.5;
    ceiling.furthest = 0.9;
    ceiling.period = draws.in(2.0, 4.0);
    Source source = cutting_source(pairs, 3.0);
    source.region_low.y = source.region_high.y = 0.3;
    scene.sources.push_back(source);
    return expect_reference(scene, under_a_sine(draws, pairs.side(), ceiling), 80);
  });
  EXPECT_GT(contacts, 100U);
}

// Every second cell has a fixed disk, the others the end of an inner wall; a disk moves along a line that passes it at
// the contact distance.
State passing_obstacles(test::Draws& draws, const Pairs& pairs, Scene& scene) {
  constexpr double radius = 0.5;
  std::vector<Disk> list;
  std::vector<Obstacle> obstacles;
  for (int k = 0; k < pairs.a_side * pairs.a_side; ++k) {
    const Vec2 at = in_cell(draws, pairs, k);
    const double angle = draws.in(0.0, 2.0 * std::numbers::pi);
    const double c = std::cos(angle), s = std::sin(angle);
    double beside = radius;
    if (k % 2 == 0) {
      const double fixed = draws.in(0.05, 0.6);
      obstacles.push_back({at.x, at.y, 0.0, 0.0, fixed, 1.0, static_cast<DiskId>(1000 + k), ObstacleKind::disk});
      beside += fixed;
    } else {
      obstacles.push_back({at.x, at.y, s, -c, 0.0, 1.0, static_cast<DiskId>(scene.walls.size()), ObstacleKind::wall});
      scene.walls.push_back({.points = {at, {at.x + s, at.y - c}}});
    }
    const double way = draws.in(0.05, 0.5 * pairs.cell - 1.6);
    const double speed = draws.in(0.5, 2.0);
    list.push_back({at.x + way * c - beside * s, at.y + way * s + beside * c, -speed * c, -speed * s, radius, 1.0});
  }
  State state = test::state_of(list);
  state.obstacles = obstacles;
  return state;
}

TEST(GrazingObstacles, DisksThatPassAtTheirContactDistance) {
  const Count contacts = over_seeds(12, [](std::uint32_t seed, test::Draws& draws, const Pairs& pairs) {
    Scene scene = cut_scene(pairs, seed);
    const State start = passing_obstacles(draws, pairs, scene);
    return expect_reference(scene, start, cut_windows(seed));
  });
  EXPECT_GT(contacts, 100U);
}

// With these seeds a disk near a border between regions falls freely through a whole window and has to be relisted at
// its very end, for which the last slice must wait.
TEST(GrazingSides, DisksThatAreRelistedAtTheEndOfAWindow) {
  for (const std::uint32_t seed : {1305U, 1491U, 1906U}) {
    SCOPED_TRACE(seed);
    test::Draws draws(seed);
    const Pairs pairs = some_pairs(draws);
    const double g = draws.in(0.1, 1.0);
    const Scene scene = plain_scene(test::box_of(pairs.side(), pairs.side()), 1e9, g);
    expect_reference(scene, rising(draws, pairs, g), 16);
  }
}

}  // namespace
}  // namespace carom::exact_tests
