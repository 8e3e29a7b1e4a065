// Which method and step an accuracy needs: the same on every machine, and right for the scenes that come with Carom.
#include "core/load/method_choice.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/load/scene_check.hpp"
#include "core/load/scene_file.hpp"
#include "core/scene/scene_text.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using test::scene_from;
using test::sound_scene;
using testing::HasSubstr;
using testing::StartsWith;

const std::string folder = CAROM_SOURCE_DIR "/scenes/";

// "pairwise 0.01", "exact", or "none".
std::string choice_of(const Scene& scene, double accuracy) {
  const MethodChoice choice = choose_method(scene, accuracy);
  if (choice.best < 0) return "none";
  const MethodOffer& best = choice.offers[static_cast<std::size_t>(choice.best)];
  EXPECT_LE(best.error, accuracy);
  const std::string name = best.method == Method::exact ? "exact" : "pairwise";
  return best.dt > 0.0 ? fmt::format("{} {:g}", name, best.dt) : name;
}

struct Expected {
  const char* scene;
  const char* coarse;  // 1e-2
  const char* fine;    // 1e-4
  const char* finest;  // 1e-8
};

// A gas: steps where 1e-2 will do, exact below. A pile: exact would collapse. Brownian motion: its own interval is the
// error, and no run of 1e9 steps is offered.
TEST(MethodChoice, OfTheScenesThatComeWithCarom) {
  const Expected all[] = {
      {"two_disks.toml", "pairwise 0.022", "exact", "exact"},
      {"production_a.toml", "pairwise 0.032", "exact", "exact"},
      {"production_b.toml", "pairwise 0.0051", "pairwise 6e-05", "none"},
      {"production_c.toml", "pairwise 0.011", "pairwise 0.00013", "none"},
      {"brownian_sink.toml", "pairwise 0.0011", "exact 1.8e-06", "none"},
      {"gas_million.toml", "pairwise 0.012", "exact", "exact"},
  };
  for (const Expected& e : all) {
    const std::string file = e.scene;
    std::vector<Override> fewer;
    if (file == "gas_million.toml") fewer = {{"disks.0.count", "10000"}};
    const Scene scene = load_scene(folder + file, fewer);
    EXPECT_EQ(choice_of(scene, 1e-2), e.coarse) << file;
    EXPECT_EQ(choice_of(scene, 1e-4), e.fine) << file;
    EXPECT_EQ(choice_of(scene, 1e-8), e.finest) << file;
  }
}

// A tenth of the error takes a smaller step, never a larger one, down to where exact takes over.
TEST(MethodChoice, StepsFallWithTheError) {
  const Scene scene = load_scene(folder + "production_b.toml");
  double last = 1.0;
  for (const double accuracy : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    const MethodOffer pairwise = choose_method(scene, accuracy).offers.at(0);
    EXPECT_LT(pairwise.dt, last);
    EXPECT_LE(pairwise.error, accuracy);
    last = pairwise.dt;
  }
}

TEST(MethodChoice, ScalesOfTheFluidAreThoseOfTheory) {
  const Scene scene = load_scene(folder + "gas_million.toml", {{"disks.0.count", "10000"}});
  const SceneScales s = scales_of(scene);
  EXPECT_DOUBLE_EQ(s.disks, 10000.0);
  EXPECT_DOUBLE_EQ(s.diameter, 1.0);
  EXPECT_NEAR(s.packing_fraction, 0.5, 1e-12);
  EXPECT_NEAR(s.speed, 1.0, 1e-12);
  EXPECT_NEAR(s.collision_rate, 7.007, 0.02);  // docs/reference_values.md: Gamma at 0.5
  EXPECT_FALSE(s.settles);
  EXPECT_FALSE(s.may_collapse);
}

// Collapse rules exact out until the scene names the remedy, whose own error counts.
TEST(MethodChoice, CollapseNeedsItsRemedy) {
  Scene scene = load_scene(folder + "gas_million.toml", {{"disks.0.count", "1000"}});
  scene.physics.restitution = 0.9;
  EXPECT_EQ(choice_of(scene, 1e-6), "exact") << "e = 0.9 does not collapse in two dimensions";
  scene.physics.restitution = 0.5;
  EXPECT_THAT(choice_of(scene, 1e-5), StartsWith("pairwise"));
  scene.physics.collapse_contact_time = 1e-9;
  EXPECT_EQ(choice_of(scene, 1e-5), "exact");
  scene.physics.collapse_contact_time = 1e-5;
  EXPECT_THAT(choice_of(scene, 1e-5), StartsWith("pairwise")) << "2 Gamma t_c = 1.4e-4 is too much";
}

TEST(MethodChoice, NothingThatMovesNeedsNoSteps) {
  Scene scene = load_scene(folder + "gas_million.toml", {{"disks.0.count", "100"}});
  scene.groups.at(0).velocities = {};
  EXPECT_NE(choice_of(scene, 1e-3), "none");
  scene.groups.clear();
  EXPECT_NE(choice_of(scene, 1e-3), "none");
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

TEST(MethodAuto, WhatCannotBeChosenIsAnError) {
  EXPECT_THAT(complaint(automatic("")), HasSubstr("run.accuracy: missing; expected the relative error"));
  EXPECT_THAT(complaint(automatic("accuracy = 0.0")), HasSubstr("run.accuracy: is 0"));
  EXPECT_THAT(complaint(automatic("accuracy = 0.5")), HasSubstr("run.accuracy: is 0.5; expected at most 0.1"));
  const std::string brownian = replaced(automatic("accuracy = 1e-7"), "restitution = 0.5", "diffusion = 1.0");
  EXPECT_THAT(complaint(brownian), HasSubstr("run.accuracy: 1e-07 cannot be had"));
  EXPECT_THAT(complaint(replaced(brownian, "diffusion = 1.0", "diffusion = 1.0\naccumulate = true")),
              HasSubstr("name a method and its dt"));
}

}  // namespace
}  // namespace carom
