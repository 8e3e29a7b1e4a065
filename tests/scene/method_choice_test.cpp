// The choice of a method and a step for an accuracy: properties that must hold for every choice, whatever the rates on
// which it is based.
#include "core/load/method_choice.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/chart/chart_scenes.hpp"
#include "core/load/scene_file.hpp"
#include "core/load/scene_warnings.hpp"
#include "core/scene/scene_text.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using test::scene_from;
using test::sound_scene;
using testing::HasSubstr;
using testing::Not;

const std::string folder = CAROM_SOURCE_DIR "/scenes/";

// Half decades, since steps are rounded to two digits.
constexpr double accuracies[] = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7, 1e-8};

// The scenes that come with Carom, by the names of their files.
std::vector<std::pair<std::string, Scene>> scenes() {
  std::vector<std::pair<std::string, Scene>> all;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (!name.ends_with(".toml")) continue;
    std::vector<Override> fewer;
    if (name == "gas_million.toml") fewer = {{"disks.0.count", "10000"}};
    all.emplace_back(name, load_scene(folder + name, fewer));
  }
  EXPECT_GE(all.size(), 6U);
  return all;
}

// An elastic fluid at packing fraction 0.5 with a temperature of 1, diameter 1.
Scene fluid(int disks) {
  return load_scene(folder + "gas_million.toml", {{"disks.0.count", fmt::format("{}", disks)}});
}

MethodOffer pairwise_of(const MethodChoice& choice) {
  EXPECT_EQ(choice.offers.at(0).method, Method::pairwise);
  return choice.offers.at(0);
}

MethodOffer exact_of(const MethodChoice& choice) {
  EXPECT_EQ(choice.offers.at(1).method, Method::exact);
  return choice.offers.at(1);
}

TEST(MethodChoice, WhatIsPossibleKeepsToTheAccuracy) {
  for (const auto& [name, scene] : scenes()) {
    for (const double accuracy : accuracies) {
      SCOPED_TRACE(fmt::format("{} {:g}", name, accuracy));
      const MethodChoice choice = choose_method(scene, accuracy);
      ASSERT_EQ(choice.offers.size(), 2U);
      EXPECT_GT(pairwise_of(choice).dt, 0.0);
      for (const MethodOffer& offer : choice.offers) {
        EXPECT_NE(offer.why, "");
        EXPECT_GE(offer.error, 0.0);
        EXPECT_GE(offer.seconds, 0.0);
        EXPECT_LE(offer.dt, scene.run.t_end);
        EXPECT_TRUE(!offer.possible || offer.error <= accuracy) << offer.error;
      }
    }
  }
}

TEST(MethodChoice, TheCheapestOfThePossibleIsTaken) {
  for (const auto& [name, scene] : scenes()) {
    for (const double accuracy : accuracies) {
      SCOPED_TRACE(fmt::format("{} {:g}", name, accuracy));
      const MethodChoice choice = choose_method(scene, accuracy);
      if (choice.best >= 0) {
        EXPECT_TRUE(choice.offers.at(static_cast<std::size_t>(choice.best)).possible);
      } else {
        EXPECT_THAT(choice.why, HasSubstr("no method reaches it"));
      }
      for (const MethodOffer& offer : choice.offers) {
        if (!offer.possible) continue;
        ASSERT_GE(choice.best, 0);
        EXPECT_LE(choice.offers.at(static_cast<std::size_t>(choice.best)).seconds, offer.seconds);
      }
    }
  }
}

TEST(MethodChoice, MoreAccuracyIsNeverCheaperNorMorePossible) {
  for (const auto& [name, scene] : scenes()) {
    MethodChoice last = choose_method(scene, most_accuracy);
    for (const double accuracy : accuracies) {
      SCOPED_TRACE(fmt::format("{} {:g}", name, accuracy));
      const MethodChoice choice = choose_method(scene, accuracy);
      for (std::size_t k = 0; k < 2; ++k) {
        const MethodOffer& coarse = last.offers.at(k);
        const MethodOffer& fine = choice.offers.at(k);
        EXPECT_LE(fine.dt, coarse.dt);
        EXPECT_LE(fine.error, coarse.error);
        EXPECT_GE(fine.seconds, coarse.seconds);
        EXPECT_TRUE(coarse.possible || !fine.possible);
      }
      last = choice;
    }
  }
}

// In a step no disk may move further than half its radius, at five times the root mean square speed.
TEST(MethodChoice, StepsAreShortAgainstTheSmallestDisk) {
  for (const auto& [name, scene] : scenes()) {
    const bool brownian = scene.physics.diffusion > 0.0;
    const MethodChoice choice = choose_method(scene, most_accuracy);
    const double dt = pairwise_of(choice).dt;
    const double travel = brownian ? std::sqrt(2.0 * scene.physics.diffusion * dt) : choice.scales.speed * dt;
    EXPECT_LE(5.0 * travel, 0.5 * choice.scales.smallest_radius) << name;
  }
}

// exact has no error in an elastic gas, and the same cost for any accuracy. The error of pairwise is of first order in
// its step, so that its cost grows at least in proportion to the accuracy: from some accuracy on exact is cheaper.
TEST(MethodChoice, ExactTakesOverInAnElasticGas) {
  const Scene scene = fluid(10'000);
  const MethodChoice coarse = choose_method(scene, 1e-5), fine = choose_method(scene, 1e-7);
  EXPECT_EQ(exact_of(coarse).error, 0.0);
  EXPECT_EQ(exact_of(fine).seconds, exact_of(coarse).seconds);
  EXPECT_NEAR(pairwise_of(coarse).dt / pairwise_of(fine).dt, 100.0, 12.0) << "both have two digits";
  bool taken = false;
  for (const double accuracy : accuracies) {
    const MethodChoice choice = choose_method(scene, accuracy);
    EXPECT_TRUE(exact_of(choice).possible);
    EXPECT_TRUE(choice.best == 1 || !taken) << accuracy;
    taken = choice.best == 1;
  }
  EXPECT_TRUE(taken);
}

// McNamara and Young (1996): in two dimensions a gas with restitution 0.6 or less collapses, one with 0.9 does not. On
// a floor that dissipates every disk comes to rest.
TEST(MethodChoice, ExactIsRefusedWhereCollapseIsToBeExpected) {
  Scene gas = fluid(1000);
  for (const double restitution : {0.9, 0.99, 1.0}) {
    gas.physics.restitution = restitution;
    EXPECT_TRUE(exact_of(choose_method(gas, 1e-6)).possible) << restitution;
  }
  Scene pile = load_scene(folder + "production_c.toml");
  pile.physics.collapse_contact_time.reset();
  for (const double restitution : {0.2, 0.5, 0.6}) {
    gas.physics.restitution = pile.physics.restitution = restitution;
    pile.box.restitutions.fill(restitution);
    for (const Scene& scene : {gas, pile}) {
      for (const double accuracy : accuracies) {
        const MethodChoice choice = choose_method(scene, accuracy);
        EXPECT_FALSE(exact_of(choice).possible);
        EXPECT_NE(choice.best, 1);
        EXPECT_THAT(exact_of(choice).why, HasSubstr("physics.collapse makes it possible"));
      }
    }
  }
}

// Two disks make no pile, but each of them comes to rest on a shelf, on a slide or between pegs that dissipate.
TEST(MethodChoice, ExactIsRefusedWhereDisksRestOnObstacles) {
  const auto exact = [](const std::string& gravity, const std::string& obstacles) {
    const std::string disks = "[[disks]]\ncount = 2\npositions = \"random\"\nradius = 0.3\nmass = 1.0\n";
    const Scene scene = scene_from("[box]\nwidth = 20.0\nheight = 20.0\n[physics]\ngravity = " + gravity + "\n" +
                                   obstacles + disks + "[run]\nt_end = 40.0\n");
    return exact_of(choose_method(scene, 1e-3)).possible;
  };
  const std::string shelf = "[[walls]]\nfrom = [1.0, 5.0]\nto = [19.0, 5.0]\n";
  const std::string post = "[[walls]]\nfrom = [5.0, 5.0]\nto = [5.0, 15.0]\nrestitution = 0.5\n";
  EXPECT_TRUE(exact("1.0", shelf));
  EXPECT_FALSE(exact("1.0", shelf + "restitution = 0.5\n"));
  EXPECT_TRUE(exact("1.0", shelf + "kind = \"sink\"\n"));
  EXPECT_TRUE(exact("1.0", post)) << "gravity does not press disks against it";
  EXPECT_FALSE(exact("[1.0, -1.0]", post));
  EXPECT_TRUE(exact("0.0", shelf + "restitution = 0.7\n"));
  const std::string pegs = "[[disks]]\ncount = 2\nfixed = true\npositions = [[8.0, 3.0], [9.5, 3.0]]\nradius = 0.5\n";
  EXPECT_TRUE(exact("1.0", pegs));
  EXPECT_FALSE(exact("1.0\nrestitution = 0.7", pegs));
}

// The error of the TC model is 2 Gamma t_c (docs/methods.md), with Gamma = 7.007, the published rate at packing
// fraction 0.5.
TEST(MethodChoice, TheRemedyOfCollapseHasItsOwnError) {
  Scene scene = fluid(1000);
  scene.physics.restitution = 0.5;
  for (const double contact_time : {1e-9, 1e-7, 1e-5}) {
    scene.physics.collapse_contact_time = contact_time;
    const double expected = 2.0 * 7.007 * contact_time;
    EXPECT_NEAR(exact_of(choose_method(scene, 2.0 * expected)).error, expected, 0.01 * expected);
    EXPECT_TRUE(exact_of(choose_method(scene, 1.1 * expected)).possible);
    EXPECT_FALSE(exact_of(choose_method(scene, 0.9 * expected)).possible);
  }
}

// The interval between two draws determines the error, which goes as its square root. 1e-8 would need so many steps
// that no run is offered.
TEST(MethodChoice, BrownianMotionIsAsAccurateAsItsInterval) {
  const Scene scene = load_scene(folder + "brownian_sink.toml");
  const MethodChoice coarse = choose_method(scene, 1e-3), fine = choose_method(scene, 1e-4);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(coarse.offers.at(k).dt / fine.offers.at(k).dt, 100.0, 20.0)
        << "both have two digits; nearly of first order";
  }
  EXPECT_EQ(choose_method(scene, 1e-8).best, -1);
}

struct ChartRow {
  std::string scene;
  double dt = 0.0, error = 0.0, standard_error = 0.0;
};

// Measured errors of pairwise in collision rate, pressure and cooling rate.
std::vector<ChartRow> measured_errors() {
  std::ifstream file(CAROM_SOURCE_DIR "/docs/chart.csv");
  std::vector<ChartRow> rows;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> fields;
    std::istringstream text(line);
    for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
    if (fields.size() < 8 || fields[1] != "pairwise" || (fields[5] != "rate" && fields[5] != "figure")) continue;
    if (fields[0] == "brownian") continue;  // its error is that of the interval, which both methods have
    rows.push_back({fields[0], std::stod(fields[2]), std::stod(fields[6]), std::stod(fields[7])});
  }
  return rows;
}

// With the step offered, or a shorter one, the errors in the chart are at most those asked for (within four standard
// errors, as there are a hundred numbers).
TEST(MethodChoice, ErrorsOfTheChartAreNoLargerThanAskedFor) {
  const std::vector<ChartRow> rows = measured_errors();
  std::size_t compared = 0;
  for (const chart::ChartScene& of_chart : chart::chart_scenes()) {
    const Scene scene = chart::scene_of(of_chart, 1, Method::exact, 0.0, of_chart.length);
    if (scene.box.shear.acts()) continue;  // with a shear "auto" is refused
    for (const double accuracy : accuracies) {
      const double dt = pairwise_of(choose_method(scene, accuracy)).dt;
      for (const ChartRow& row : rows) {
        if (row.scene != of_chart.name || row.dt > dt) continue;
        EXPECT_LE(std::abs(row.error), accuracy + 4.0 * row.standard_error)
            << row.scene << ", dt = " << row.dt << ", asked for " << accuracy;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 100U);
}

double collision_rate(const Scene& scene, const State& start) {
  const auto engine = make_parallel_engine(scene, start, {1});
  while (engine->state().time < scene.run.t_end) engine->step();
  const double disk_time = static_cast<double>(start.disks.size()) * engine->state().time;
  return 2.0 * static_cast<double>(engine->state().counters.collisions) / disk_time;
}

// A run with the step offered compared with a run of exact from the same start. There are 25,000 collisions, whose
// number scatters by less than Poisson's 1 / sqrt(25,000).
TEST(MethodChoice, ARunKeepsToTheAccuracyThatItsStepWasChosenFor) {
  Scene scene = fluid(1000);
  scene.run = {Method::exact, 0.0, 7.0};
  const State start = initial_state(scene);
  const double exact = collision_rate(scene, start);
  for (const double accuracy : {1e-1, 3e-2}) {
    scene.run = {Method::pairwise, pairwise_of(choose_method(scene, accuracy)).dt, 7.0};
    EXPECT_NEAR(collision_rate(scene, start) / exact, 1.0, accuracy + 3.0 * std::sqrt(2.0 / 25'000.0));
  }
}

// Seconds on one thread of an idle machine with the step offered for 1e-3: production B 6.5 to 8.5, C 7 to 9 (742f5b1).
// The limits are half of the least and twice the most of these, as a factor of two is allowed.
TEST(MethodChoice, StepsInAPileCostWhatTheyTake) {
  for (const std::string name : {"production_b", "production_c"}) {
    const Scene scene = load_scene(CAROM_SOURCE_DIR "/scenes/" + name + ".toml");
    const double seconds = pairwise_of(choose_method(scene, 1e-3)).seconds;
    EXPECT_GT(seconds, 3.0) << name;
    EXPECT_LT(seconds, 18.0) << name;
  }
  Scene falling = load_scene(CAROM_SOURCE_DIR "/scenes/production_b.toml");
  falling.run.t_end = 1.0;
  const MethodOffer offer = pairwise_of(choose_method(falling, 1e-3));
  EXPECT_LT(offer.seconds, 0.01 * 6.5);  // a hundredth of the time, in which no disk comes to rest
}

TEST(MethodChoice, WhatDoesNotMoveCanBeRun) {
  Scene scene = fluid(100);
  scene.groups.at(0).velocities = {};
  EXPECT_GE(choose_method(scene, 1e-3).best, 0);
  scene.groups.clear();
  EXPECT_GE(choose_method(scene, 1e-3).best, 0);
}

// Stopping a disk with e = 0.99 takes 50 times what a collision loses (docs/methods.md).
TEST(MethodChoice, NearlyElasticDisksUnderGravityAskForShortSteps) {
  Scene scene = fluid(1000);
  scene.physics.gravity = Gravity(0.1);
  scene.box.sides.at(static_cast<std::size_t>(Side::bottom)) = SideKind::wall;
  scene.box.sides.at(static_cast<std::size_t>(Side::top)) = SideKind::wall;
  const auto dt = [&](double restitution) {
    scene.physics.restitution = restitution;
    return pairwise_of(choose_method(scene, 1e-3)).dt;
  };
  const double soft = dt(0.5);
  EXPECT_LT(dt(0.99), 0.5 * soft);
  EXPECT_LT(dt(0.999), 0.1 * soft);
  scene.physics.gravity = Gravity(0.1, 0.0);  // along periodic sides no disk is stopped
  EXPECT_EQ(dt(0.99), dt(0.5));
  scene.physics.gravity = Gravity();
  EXPECT_EQ(dt(0.99), dt(0.5));
}

// There is at most one kick of a thermostat in a step.
TEST(MethodChoice, StepsAreNoLongerThanThatOfAThermostat) {
  const std::string gas =
      "[box]\nwidth = 20\nheight = 20\n[physics]\nthermostat = { kind = \"langevin\", temperature = 1.0, rate = 1.0, "
      "dt = "
      "1e-4 }\n[[disks]]\ncount = 20\npositions = \"random\"\nradius = 0.5\nmass = 1\n"
      "velocities = { maxwell = 1.0 }\n[run]\nmethod = \"exact\"\nt_end = 1\n";
  const MethodChoice choice = choose_method(parse_scene(gas, "gas", ""), 0.01);
  ASSERT_EQ(choice.offers[0].method, Method::pairwise);
  EXPECT_EQ(choice.offers[0].dt, 1e-4);
  EXPECT_THAT(choice.offers[0].why, ::testing::HasSubstr("two kicks of the thermostat"));
}

// Moving walls make disks at rest fast, so the step must not follow from the speeds at the start alone.
TEST(MethodChoice, WallsThatMoveSetThePace) {
  const std::vector<std::string> walls = {"motion = { vibrate = [0.0, 0.5], period = 0.1, shape = \"sine\" }",
                                          "motion = { vibrate = [0.0, 0.5], period = 0.1 }",
                                          "motion = { velocity = [0.0, 20.0] }"};
  for (const std::string& motion : walls) {
    for (const bool side : {true, false}) {
      SCOPED_TRACE(motion + (side ? " of a side" : " of an inner wall"));
      const std::string wall = side ? "[box.bottom]\n" : "[[walls]]\nfrom = [2.0, 20.0]\nto = [8.0, 20.0]\n";
      Scene scene = scene_from("[box]\nwidth = 10.0\nheight = 50.0\n" + wall + motion +
                               "\n[physics]\nrestitution = 0.5\n[[disks]]\ncount = 20\npositions = \"random\"\n"
                               "region = [1.0, 25.0, 9.0, 49.0]\nradius = 0.5\nmass = 1.0\n[run]\nt_end = 1.0\n");
      const MethodChoice choice = choose_method(scene, 1e-2);
      ASSERT_EQ(choice.best, 0) << "exact would collapse";
      EXPECT_LE(2.0 * 20.0 * pairwise_of(choice).dt, 0.25) << "half a radius";
      const bool vibrates = motion.find("period") != std::string::npos;
      EXPECT_LE(pairwise_of(choice).dt, vibrates ? 0.1 / 50.0 : 1.0);
      scene.physics.restitution = 1.0;
      EXPECT_EQ(choose_method(scene, 1e-2).best, 1) << "exact does not depend on speeds";
    }
  }
}

std::string automatic(const std::string& accuracy) {
  const std::string text = replaced(sound_scene, "method = \"pairwise\"", "method = \"auto\"\n" + accuracy);
  return replaced(text, "dt = 0.01\n", "");
}

TEST(MethodAuto, TakesTheChoiceAndWritesIt) {
  const Scene scene = scene_from(automatic("accuracy = 1e-4"));
  EXPECT_TRUE(scene.run.automatic);
  const MethodChoice choice = choose_method(scene, 1e-4);
  ASSERT_GE(choice.best, 0);
  EXPECT_EQ(scene.run.method, choice.offers[static_cast<std::size_t>(choice.best)].method);
  EXPECT_EQ(scene.run.dt, choice.offers[static_cast<std::size_t>(choice.best)].dt);
  const std::string resolved = resolved_toml(scene);
  EXPECT_THAT(resolved, HasSubstr("# chosen by method = \"auto\", accuracy = 0.0001: "));
  const Scene again = scene_from(resolved);
  EXPECT_FALSE(again.run.automatic);
  EXPECT_EQ(again.run.method, scene.run.method);
  EXPECT_EQ(again.run.dt, scene.run.dt);
  EXPECT_TRUE(scene_warnings(again).empty());
}

// Any dt is enough, but a scene with Brownian motion must have one.
TEST(MethodAuto, ChoosesAStepForBrownianMotionWithoutDisks) {
  const Scene scene = scene_from(
      "[box]\nwidth = 20.0\nheight = 20.0\n[physics]\ndiffusion = 0.1\n[[disks]]\ncount = 0\npositions = "
      "\"random\"\nradius = 0.5\nmass = 1.0\n[run]\nmethod = \"auto\"\naccuracy = 1e-3\nt_end = 1.0\n");
  EXPECT_GT(scene.run.dt, 0.0);
  EXPECT_EQ(scene_from(resolved_toml(scene)).run.dt, scene.run.dt);
}

// A dt given together with "auto" is not used, and the line that states the choice says so.
TEST(MethodAuto, SaysThatADtBesideItIsNotUsed) {
  const Scene scene = scene_from(automatic("accuracy = 1e-4"));
  const Scene beside = scene_from(automatic("accuracy = 1e-4\ndt = 0.025"));
  EXPECT_EQ(beside.run.dt, scene.run.dt);
  EXPECT_EQ(choice_text(beside).find('\n'), std::string::npos);
  EXPECT_THAT(choice_text(beside), HasSubstr("; run.dt = 0.025 of the scene is not used)"));
  EXPECT_THAT(choice_text(scene), Not(HasSubstr("run.dt")));
  EXPECT_THAT(choose_method(scene, 1e-4).why, Not(HasSubstr("run.dt"))) << "dt is the one chosen";
}

TEST(MethodAuto, WhatCannotBeChosenIsAnError) {
  EXPECT_THAT(complaint(automatic("")), HasSubstr("run.accuracy: missing; expected the relative error"));
  EXPECT_THAT(complaint(automatic("accuracy = 0.0")), HasSubstr("run.accuracy: is 0"));
  EXPECT_THAT(complaint(automatic("accuracy = 0.5")), HasSubstr("run.accuracy: is 0.5; expected at most 0.1"));
  const std::string brownian = replaced(automatic("accuracy = 1e-7"), "restitution = 0.5", "diffusion = 1.0");
  EXPECT_THAT(complaint(brownian), HasSubstr("run.accuracy: is 1e-07: no method reaches it: pairwise: dt = "));
  EXPECT_THAT(complaint(replaced(brownian, "diffusion = 1.0", "diffusion = 1.0\naccumulate = true")),
              HasSubstr("state a method and its dt"));
}

}  // namespace
}  // namespace carom
