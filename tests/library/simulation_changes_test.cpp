// carom::Simulation: adding, removing and redirecting disks between steps gives the bits of the reference; and refused
// changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/base/check.hpp"
#include "core/disks/domain.hpp"
#include "core/measure/invariants.hpp"
#include "core/step/edit.hpp"
#include "run/simulation/simulation.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/simulation_support.hpp"

namespace carom {
namespace {

using test::choice;
using test::gas;
using test::methods;

// The same changes are made at the same steps with both engines.
TEST(SimulationChanges, ChangesBetweenStepsHaveTheReferencesBits) {
  for (const char* method : methods) {
    const auto hash = [&](const EngineChoice& engine) {
      Simulation s(gas(method), engine);
      s.step(10);
      EXPECT_TRUE(s.remove(17));
      EXPECT_FALSE(s.remove(17));
      EXPECT_TRUE(s.set_velocity(3, {5.0, -1.0}));
      s.step(10);
      const Vec2 free = [&] {
        for (double x = 0.5;; x += 0.25) {
          const Disks d = s.disks();
          bool room = true;
          for (std::size_t i = 0; i < d.size(); ++i) {
            room = room && std::hypot(nearest_image(d.x[i] - x, s.scene().box.width), d.y[i] - 4.0) > d.radius[i] + 0.3;
          }
          if (room) return Vec2{x, 4.0};
        }
      }();
      const std::optional<DiskId> id = s.add({free.x, free.y, 1.0, 0.0, 0.25, 2.0});
      EXPECT_EQ(id, DiskId{200});
      EXPECT_FALSE(s.add({free.x + 0.1, free.y, 1.0, 0.0, 0.25, 2.0}));
      s.step(30);
      EXPECT_EQ(s.state().disks.size(), 200U);
      EXPECT_LE(method == std::string("exact") ? max_overlap(s.state().disks, s.scene().box) : 0.0, 1e-9);
      return s.hash();
    };
    const std::uint64_t reference = hash(choice("reference"));
    EXPECT_EQ(hash(choice("parallel", 1)), reference) << method;
    EXPECT_EQ(hash(choice("parallel", 3)), reference) << method;
  }
}

// Changes before the first step belong to the start of the summary: there is no gain of energy, and the pressure is
// known. The same holds after saving. Later changes are part of the run.
TEST(SimulationChanges, ThoseBeforeTheFirstStepBelongToTheStart) {
  Simulation s(
      parse_scene("[box]\nwidth = 5.0\nheight = 5.0\n[[disks]]\ncount = 2\npositions = [[1.0, 1.0], [3.0, 3.0]]\n"
                  "radius = 0.5\nmass = 1.0\n[run]\nt_end = 50.0\n",
                  "rest", ""),
      choice("parallel", 1));
  s.set_velocity(0, {1.0, 0.5});
  s.add({4.0, 1.0, -1.0, 0.0, 0.5, 2.0});
  EXPECT_DOUBLE_EQ(s.summary().energy_initial, 1.625);
  Simulation saved = Simulation::from_bytes(s.save(), choice("parallel", 1));
  for (Simulation* run : {&s, &saved}) {
    run->run_until(50.0);
    const Summary summary = run->summary();
    EXPECT_DOUBLE_EQ(summary.energy_initial, 1.625);
    EXPECT_NEAR(summary.energy_final, 1.625, 1e-12);
    EXPECT_GT(summary.pressure, 0.0) << "known";
    run->remove(0);
    EXPECT_DOUBLE_EQ(run->summary().energy_initial, 1.625);
  }
}

// Adds a disk of radius 0.3 at the first free one of eight random places.
bool add_where_there_is_room(Simulation& s, Vec2 velocity, test::Draws& draw) {
  const Domain& box = s.scene().box;
  for (int k = 0; k < 8; ++k) {
    const double x = draw.in(0.7, box.width - 0.7);
    if (s.add({x, draw.in(0.7, box.height - 0.7), velocity.x, velocity.y, 0.3, 1.0})) return true;
  }
  return false;
}

// Many changes of all kinds, in a box where the engines keep cells and lists from step to step.
std::uint64_t hash_after_changes(const Scene& scene, const EngineChoice& engine, int rounds) {
  Simulation s(scene, engine);
  test::Draws draw(5);
  int removed = 0, redirected = 0, added = 0, stepped = 0;
  for (int round = 0; round < rounds; ++round) {
    for (int k = 0; k < 6; ++k) {
      const auto id = static_cast<DiskId>(draw.bits() % s.state().next_id);
      const Vec2 velocity{draw.in(-2.0, 2.0), draw.in(-2.0, 2.0)};
      switch (draw.bits() % 3) {
        case 0:
          removed += s.remove(id);
          break;
        case 1:
          redirected += s.set_velocity(id, velocity);
          break;
        default:
          added += add_where_there_is_room(s, velocity, draw);
      }
    }
    const auto steps = static_cast<Count>(draw.bits() % 3);
    s.step(steps);
    stepped += steps > 0;
  }
  EXPECT_GT(std::min({removed, redirected, added, stepped}), 1)
      << "there must be changes of each kind, and steps in between";
  return s.hash();
}

TEST(LongSimulationChanges, ManyChangesHaveTheReferencesBits) {
  for (const char* method : methods) {
    for (const char* radius : {"0.3", "{ uniform = [0.1, 0.6] }"}) {
      for (const char* sides : {"", "left = \"periodic\"\nright = \"periodic\"\n"}) {
        const Scene scene = parse_scene(std::string("[box]\npacking_fraction = 0.2\n") + sides +
                                            "[[disks]]\ncount = 3000\npositions = \"random\"\nmass = 1.0\n"
                                            "velocities = { maxwell = 1.0 }\nradius = " +
                                            radius + "\n[run]\ndt = 0.01\nt_end = 1e3\nmethod = \"" + method + "\"\n",
                                        "gas.toml", "");
        const int rounds = method == std::string("exact") ? 7 : 15;
        const std::uint64_t reference = hash_after_changes(scene, choice("reference"), rounds);
        EXPECT_EQ(hash_after_changes(scene, choice("parallel", 1), rounds), reference) << method << radius << sides;
        EXPECT_EQ(hash_after_changes(scene, choice("parallel", 2), rounds), reference) << method << radius << sides;
      }
    }
  }
}

// Makes one of three kinds of change in both simulations; new disks come in pairs, of which the second disk flies into
// the first.
void change_both(Simulation& one, Simulation& other, bool mixed, test::Draws& draw) {
  const auto id = static_cast<DiskId>(draw.bits() % one.state().next_id);
  const Vec2 v{draw.in(-4.0, 4.0), draw.in(-4.0, 4.0)};
  const std::uint64_t kind = draw.bits() % 4;
  if (kind < 2) {
    const bool there = kind == 0 ? one.remove(id) : one.set_velocity(id, v);
    EXPECT_EQ(kind == 0 ? other.remove(id) : other.set_velocity(id, v), there);
    return;
  }
  const double x = draw.in(1.0, one.scene().box.width - 3.0), y = draw.in(1.0, one.scene().box.height - 1.0);
  const double sizes[] = {0.05, 0.2, 0.3, 0.8};
  const double r = mixed ? sizes[draw.bits() % 4] : 0.3;
  EXPECT_EQ(one.add({x, y, v.x, v.y, r, 1.0}), other.add({x, y, v.x, v.y, r, 1.0}));
  const Disk second{x + r + 0.32, y, v.x - 2.0, v.y, 0.3, 1.0};
  EXPECT_EQ(one.add(second), other.add(second));
}

// Each disk must be found where it is, however far it has left the cell into which it was sorted, and each contact
// once.
TEST(SimulationChanges, ManyInASmallBoxHaveTheReferencesBitsAfterEachStep) {
  for (const char* radius : {"0.3", "{ uniform = [0.1, 0.4] }"}) {
    const bool mixed = radius[0] == '{';
    const Scene scene = parse_scene(
        std::string("[box]\nwidth = 20.0\nheight = 16.0\nleft = \"periodic\"\nright = \"periodic\"\n[[disks]]\n"
                    "count = 200\npositions = \"random\"\nmass = 1.0\nvelocities = { maxwell = 1.0 }\nradius = ") +
            radius + "\n[run]\ndt = 0.01\nt_end = 1e3\nmethod = \"pairwise\"\n",
        "gas.toml", "");
    Simulation reference(scene, choice("reference")), parallel(scene, choice());
    test::Draws draw(5);
    for (int round = 0; round < 150; ++round) {
      if (round % 3 == 0) change_both(reference, parallel, mixed, draw);
      const Disks& all = reference.state().disks;
      for (std::size_t i = 0; i < all.size(); ++i) {
        const Vec2 corner{all.x[i] - 0.001, all.y[i] - 0.001}, end{all.x[i] + 0.001, all.y[i] + 0.001};
        ASSERT_EQ(parallel.disks_in(corner, end).size(), 1U) << radius << " in round " << round;
      }
      reference.step(1);
      parallel.step(1);
      ASSERT_EQ(parallel.hash(), reference.hash()) << radius << " in round " << round;
      ASSERT_TRUE(parallel.contacts() == reference.contacts()) << radius << " in round " << round;
    }
    EXPECT_GT(reference.state().counters.collisions, 200U);
  }
}

// The last disk takes the storage place of a removed one, and may be removed from there itself.
TEST(SimulationChanges, DisksInThePlacesOfOthersMeetOnce) {
  for (const char* radius : {"0.3", "{ uniform = [0.1, 0.4] }"}) {
    const Scene scene = parse_scene(std::string("[box]\npacking_fraction = 0.5\n[[disks]]\ncount = 500\nmass = 1.0\n"
                                                "positions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = ") +
                                        radius + "\n[run]\ndt = 0.03\nt_end = 1e3\nmethod = \"pairwise\"\n",
                                    "gas.toml", "");
    Simulation reference(scene, choice("reference")), parallel(scene, choice());
    test::Draws draw(6);
    for (int round = 0; round < 12; ++round) {
      for (int k = 0; k < 25; ++k) {
        const auto id = static_cast<DiskId>(draw.bits() % 500);
        ASSERT_EQ(parallel.remove(id), reference.remove(id));
      }
      reference.step(1);
      parallel.step(1);
      ASSERT_EQ(parallel.hash(), reference.hash()) << radius << " in round " << round;
      ASSERT_TRUE(parallel.contacts() == reference.contacts()) << radius << " in round " << round;
    }
  }
}

// The cells of the lists were made for disks of a few sizes, none of them as small.
TEST(SimulationChanges, AddsADiskSmallerThanAllWithTheReferencesBits) {
  for (const char* radius : {"0.3", "{ uniform = [0.3, 0.5] }", "{ uniform = [0.1, 0.6] }"}) {
    const Scene scene =
        parse_scene(std::string("[box]\npacking_fraction = 0.2\n[[disks]]\ncount = 500\npositions = \"random\"\nmass = "
                                "1.0\nvelocities = { maxwell = 1.0 }\nradius = ") +
                        radius + "\n[run]\nt_end = 1e3\nmethod = \"exact\"\n",
                    "gas.toml", "");
    const auto hash = [&](const EngineChoice& engine) {
      Simulation s(scene, engine);
      s.step(2);
      test::Draws draw(3);
      int added = 0;
      for (int k = 0; k < 40; ++k) {
        const double x = draw.in(0.1, scene.box.width - 0.1);
        if (s.add({x, draw.in(0.1, scene.box.height - 0.1), 3.0, 1.0, 0.01, 0.1})) ++added;
      }
      EXPECT_GT(added, 10);
      s.step(4);
      EXPECT_LE(max_overlap(s.state().disks, s.scene().box), 1e-9);
      return s.hash();
    };
    EXPECT_EQ(hash(choice("parallel", 1)), hash(choice("reference"))) << radius;
  }
}

// A step is split according to the fastest and the smallest disk after a change, not before it.
TEST(SimulationChanges, ChangesSplitStepsAsTheReferenceDoes) {
  const auto expect_same = [](const std::string& radii, double speed, const auto& change) {
    const std::string text =
        "[box]\nwidth = 100.0\nheight = 100.0\n[physics]\ngravity = 20.0\n[[disks]]\ncount = 3\n"
        "positions = [[20, 50], [50, 60], [80, 50]]\nvelocities = [[0, 0], [" +
        std::to_string(speed) + ", 0], [0, 0]]\nradius = " + radii +
        "\nmass = 1.0\n[run]\nmethod = \"pairwise\"\ndt = 0.02\nt_end = 10.0\n";
    const auto hash = [&](const char* engine) {
      Simulation s(parse_scene(text, "three.toml", ""), choice(engine));
      s.step(3);
      change(s);
      s.step(3);
      return s.hash();
    };
    EXPECT_EQ(hash("parallel"), hash("reference"));
  };
  expect_same("0.5", 1.0, [](Simulation& s) { s.set_velocity(2, {60.0, 0.0}); });
  expect_same("0.5", 1.0, [](Simulation& s) { s.add({20.0, 80.0, 5.0, 0.0, 0.01, 1.0}); });
  expect_same("[0.05, 0.5, 0.5]", 10.0, [](Simulation& s) { s.remove(0); });
}

// There are so many disks that the new one is not sorted among them at once.
TEST(SimulationChanges, AFastDiskThatComesToManySplitsAllStepsThatFollow) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 100.0\nheight = 100.0\n[[disks]]\ncount = 400\npositions = \"square\"\nregion = [0, 0, 100, 60]\n"
      "radius = 0.5\nmass = 1.0\n[run]\nmethod = \"pairwise\"\ndt = 0.02\nt_end = 10.0\n",
      "many.toml", "");
  Simulation reference(scene, choice("reference")), parallel(scene, choice());
  for (Simulation* s : {&reference, &parallel}) {
    s->step(1);
    s->add({10.0, 80.0, 61.7, -13.1, 0.5, 1.0});
  }
  for (int k = 0; k < 40; ++k) {
    reference.step(1);
    parallel.step(1);
    ASSERT_EQ(parallel.hash(), reference.hash()) << "step " << k;
  }
}

// A change ends the paths of the last window.
TEST(SimulationChanges, HasNoDisksOfEarlierAfterAChange) {
  Simulation s(gas("exact"), choice());
  s.step(3);
  Disks then;
  const double before = std::nextafter(s.time(), 0.0);
  EXPECT_EQ(s.disks_at(before, then), before);
  s.set_velocity(7, {1.0, 2.0});
  EXPECT_EQ(s.disks_at(before, then), s.time());
  EXPECT_EQ(then.vx[7], 1.0);
  s.remove(0);
  EXPECT_EQ(s.disks_at(before, then), s.time());
  EXPECT_EQ(then.size(), 199U);
}

TEST(SimulationChanges, AddsNoDiskOnAFixedOne) {
  const Scene scene = parse_scene(R"(
    [box]
    width = 20.0
    height = 10.0
    left = "periodic"
    right = "periodic"
    [[disks]]
    count = 1
    positions = [[0.5, 5.0]]
    radius = 1.0
    fixed = true
    [[disks]]
    count = 1
    positions = [[10.0, 5.0]]
    velocities = [[1.0, 0.0]]
    radius = 1.0
    mass = 1.0
    [[walls]]
    from = [14.0, 2.0]
    to = [16.0, 4.0]
    [run]
    method = "exact"
    t_end = 10.0
)",
                                  "fixed.toml", "");
  Simulation s(scene, choice());
  EXPECT_FALSE(s.add({0.5, 6.5, 0.0, 0.0, 0.6, 1.0}));
  EXPECT_FALSE(s.add({19.5, 5.0, 0.0, 0.0, 0.5, 1.0})) << "it would reach over the side";
  EXPECT_FALSE(s.add({15.5, 2.5, 0.0, 0.0, 0.8, 1.0})) << "it would overlap a wall";
  EXPECT_TRUE(s.add({0.5, 7.0, 0.0, -1.0, 0.6, 1.0}));
  EXPECT_TRUE(s.add({15.5, 2.5, 0.0, 0.0, 0.6, 1.0}));
  s.run_until(5.0);
  EXPECT_GT(s.state().counters.collisions + s.state().counters.wall_collisions, 0U);
}

// A moving side is where it is at the present time.
TEST(SimulationChanges, AddsNoDiskBeyondASideThatHasMovedIn) {
  for (const std::string method : methods) {
    SCOPED_TRACE(method);
    Simulation simulation(
        parse_scene("[box]\nwidth = 20.0\nheight = 20.0\nleft = { motion = { velocity = [1.0, 0.0] } }\n"
                    "[[disks]]\ncount = 1\npositions = [[18.0, 10.0]]\nvelocities = [[0.0, 0.0]]\nradius = 0.5\n"
                    "mass = 1.0\n[run]\ndt = 0.01\nt_end = 8.0\nmethod = \"" +
                        method + "\"\n",
                    "piston.toml", ""),
        choice());
    simulation.run_until(4.0);
    const double side = simulation.time();
    EXPECT_FALSE(simulation.add({1.0, 3.0, 0.0, 0.0, 0.5, 1.0}));
    EXPECT_FALSE(simulation.add({side + 0.4, 3.0, 0.0, 0.0, 0.5, 1.0}));
    EXPECT_TRUE(simulation.add({side + 0.6, 3.0, 0.0, 0.0, 0.5, 1.0}));
  }
}

TEST(SimulationChanges, RefusesDisksThatCannotBe) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Simulation s(gas("exact"), choice());
  const std::uint64_t before = s.hash();
  EXPECT_THROW(s.add({nan, 5.0, 0.0, 0.0, 0.1, 1.0}), InputError);
  EXPECT_THROW(s.add({5.0, 5.0, nan, 0.0, 0.1, 1.0}), InputError);
  EXPECT_THROW(s.add({5.0, 5.0, 0.0, 0.0, 0.0, 1.0}), InputError);
  EXPECT_THROW(s.add({5.0, 5.0, 0.0, 0.0, 0.1, -1.0}), InputError);
  EXPECT_THROW(s.add({5.0, 0.05, 0.0, 0.0, 0.1, 1.0}), InputError);  // it would reach through the floor
  EXPECT_THROW(s.add({-0.1, 5.0, 0.0, 0.0, 0.1, 1.0}), InputError);
  EXPECT_THROW(s.add({5.0, 5.0, 0.0, 0.0, 1000.0, 1.0}), InputError);
  const double width = s.scene().box.width;
  EXPECT_THROW(s.add({width, 5.0, 0.0, 0.0, 0.1, 1.0}), InputError);  // this is the same as x = 0
  EXPECT_THROW(s.add({0.5 * width, 0.5 * width, 0.0, 0.0, 0.3 * width, 1.0}), InputError) << "would meet its image";
  EXPECT_THROW(s.set_velocity(3, {nan, 0.0}), InputError);
  EXPECT_THROW(s.run_until(nan), InputError);
  EXPECT_EQ(s.hash(), before);
}

// In a sheared box disks may be only half as large as in others: two disks of radius 0.237 in a box of width 1 were
// once brought together by images behind the nearest ones, and no collision was found.
TEST(SimulationChanges, AddsNoDiskThatAShearedBoxIsTooSmallFor) {
  Simulation s(parse_scene("[box]\nwidth = 1.0\nheight = 3.0\nleft = \"periodic\"\nright = \"periodic\"\n"
                           "bottom = \"periodic\"\ntop = \"periodic\"\nshear_rate = -0.32\n[[disks]]\ncount = 0\n"
                           "positions = \"random\"\nradius = 0.1\nmass = 1.0\n[run]\nt_end = 1.0\n",
                           "flow.toml", ""),
               choice());
  EXPECT_THROW(s.add({0.99, 2.48, 2.03, 1.26, 0.237, 1.0}), InputError);
  EXPECT_THROW(s.add({0.99, 2.48, 2.03, 1.26, 0.126, 1.0}), InputError);
  EXPECT_TRUE(s.add({0.99, 2.48, 2.03, 1.26, 0.125, 1.0}));
}

// In binary numbers 3.3 - 1.1 is less than 2.2. A scene may have such a disk, and so may a program.
TEST(SimulationChanges, AddsADiskThatTouchesASideInDecimals) {
  for (const std::string method : methods) {
    SCOPED_TRACE(method);
    Simulation s(parse_scene("[box]\nwidth = 3.3\nheight = 9.0\n[[disks]]\ncount = 1\npositions = [[1.5, 7.0]]\n"
                             "radius = 1.1\nmass = 1.0\n[run]\ndt = 0.01\nt_end = 1.0\nmethod = \"" +
                                 method + "\"\n",
                             "decimals.toml", ""),
                 choice());
    EXPECT_TRUE(s.add({2.2, 2.0, 0.0, 0.0, 1.1, 1.0}));
    EXPECT_THROW(s.add({2.2 + 1e-9, 4.5, 0.0, 0.0, 1.1, 1.0}), InputError);
    s.run_until(0.5);
    EXPECT_LE(wall_overlap(s.state().disks, s.scene().box), 1e-12);
  }
}

// With a removed disk goes all that the state keeps of it: its spin, and its loads as first or second disk.
TEST(SimulationChanges, ADiskThatGoesTakesItsSpinAndItsLoadsAlong) {
  State state;
  state.disks.inertia = 0.5;
  for (DiskId id = 0; id < 3; ++id) append(state.disks, {1.0 + id, 1.0, 0, 0, 0.5, 1.0, id, 10.0 + id});
  state.next_id = 3;
  state.loads = {{0, 1, 5.0}, {0, 2, 6.0}, {1, 2, 7.0}};
  apply({Edit::Kind::remove, {}, 1}, state);
  EXPECT_EQ(state.disks.id, (std::vector<DiskId>{0, 2}));
  EXPECT_EQ(state.disks.spin, (std::vector<double>{10.0, 12.0}));
  ASSERT_EQ(state.loads.size(), 1U);
  EXPECT_EQ(state.loads[0].force, 6.0) << "the load of disks 0 and 2";
}

}  // namespace
}  // namespace carom
