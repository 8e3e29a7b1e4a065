// The structs of carom.h: the effect of each field on a world, and the defaults.
#include <carom/carom.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <carom/carom.hpp>
#include <cfenv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "run/simulation/simulation.hpp"

namespace {

using carom::Side;
using carom::SideKind;
using carom::World;
using testing::HasSubstr;

constexpr std::string_view gas = R"(
[box]
packing_fraction = 0.3
[physics]
gravity = 0.1
[[disks]]
count = 20000
positions = "hexagonal"
mass = 1.1
velocities = { maxwell = 1.3 }
radius = 0.3
[run]
method = "pairwise"
dt = 0.01
t_end = 5.0
)";

// The scene of a world, taken from what it saves.
carom::Scene scene_of(const carom_scene& told) {
  std::vector<std::byte> saved;
  World(told).save(saved);
  return carom::Simulation::from_bytes({reinterpret_cast<const char*>(saved.data()), saved.size()}).scene();
}

TEST(CaromStruct, WhatIsNotSaidIsAsUsual) {
  EXPECT_EQ(carom::default_options().threads, 1);
  EXPECT_EQ(carom::default_options().reference, 0);
  carom_scene scene;
  std::memset(&scene, 0x55, sizeof scene);
  carom_scene_init(&scene);
  EXPECT_THAT((std::array{scene.width, scene.height, scene.wall_restitution, scene.restitution}), testing::Each(1.0));
  EXPECT_THAT((std::array{scene.gravity, scene.gravity_x, scene.diffusion, scene.dt}), testing::Each(0.0));
  EXPECT_THAT((std::array{scene.left, scene.right, scene.bottom, scene.top}), testing::Each(int{CAROM_WALL}));
  EXPECT_EQ(scene.method, CAROM_EXACT);
  EXPECT_EQ(scene.t_end, 1e9);
  EXPECT_EQ(scene.seed, 1U);
}

TEST(CaromStruct, StatusesAndTheVersionAreTexts) {
  EXPECT_THAT(carom_version(), testing::MatchesRegex("[0-9]+[.][0-9]+[.][0-9]+"));
  EXPECT_STREQ(carom_status_text(CAROM_OK), "done");
  EXPECT_STREQ(carom_status_text(CAROM_FAILED), "failed");
  EXPECT_STREQ(carom_status_text(CAROM_INPUT), "bad input");
  EXPECT_STREQ(carom_status_text(CAROM_PHYSICS), "the method cannot continue");
  EXPECT_STREQ(carom_status_text(CAROM_NO_ROOM), "no room");
  EXPECT_STREQ(carom_status_text(CAROM_NOT_FOUND), "not found");
  EXPECT_STREQ(carom_status_text(static_cast<carom_status>(7)), "no such status");
}

TEST(CaromStruct, EveryFieldOfASceneIsItsOwn) {
  carom_scene told = carom::default_scene();
  told.width = 20.0 + 1e-12;
  told.height = 10.0;
  told.right = told.top = CAROM_SINK;
  told.wall_restitution = 0.75;
  told.restitution = 0.5;
  told.gravity = 0.25;
  told.gravity_x = 0.125;
  told.method = CAROM_ROLLBACK;
  told.dt = 0.0625;
  told.t_end = 9.0;
  told.seed = std::numeric_limits<std::uint64_t>::max();
  const carom::Scene scene = scene_of(told);
  EXPECT_EQ(scene.box.width, 20.0 + 1e-12);
  EXPECT_EQ(scene.box.height, 10.0);
  EXPECT_EQ(scene.box.side(Side::left), SideKind::wall);
  EXPECT_EQ(scene.box.side(Side::right), SideKind::sink);
  EXPECT_EQ(scene.box.side(Side::bottom), SideKind::wall);
  EXPECT_EQ(scene.box.side(Side::top), SideKind::sink);
  EXPECT_EQ(scene.box.restitution(Side::left), 0.75);
  EXPECT_EQ(scene.physics.restitution, 0.5);
  EXPECT_EQ(scene.physics.gravity.left, -0.125);
  EXPECT_EQ(scene.physics.gravity.down, 0.25);
  EXPECT_EQ(scene.run.method, carom::Method::rollback);
  EXPECT_EQ(scene.run.dt, 0.0625);
  EXPECT_EQ(scene.run.t_end, 9.0);
  EXPECT_EQ(scene.seed, std::numeric_limits<std::uint64_t>::max());

  told.left = told.bottom = CAROM_SINK;
  told.right = told.top = CAROM_PERIODIC;
  EXPECT_THROW(World{told}, carom::Error) << "opposite sides must both be periodic or neither";
  told.left = told.bottom = CAROM_PERIODIC;
  EXPECT_TRUE(scene_of(told).box.periodic_x() && scene_of(told).box.periodic_y());
}

TEST(CaromStruct, NamesTheFieldThatIsWrong) {
  const auto complaint = [](auto&& spoil) {
    carom_scene scene = carom::default_scene();
    spoil(scene);
    carom_world* world = nullptr;
    EXPECT_EQ(carom_from_scene(&scene, nullptr, &world), CAROM_INPUT);
    const std::string text = carom_error(world);
    carom_destroy(world);
    return text;
  };
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_THAT(complaint([](carom_scene& s) { s.left = -1; }), HasSubstr("left: is -1; expected 0 to 2"));
  EXPECT_THAT(complaint([](carom_scene& s) { s.right = 3; }), HasSubstr("right: is 3; expected 0 to 2"));
  EXPECT_THAT(complaint([](carom_scene& s) { s.bottom = -7; }), HasSubstr("bottom: is -7"));
  EXPECT_THAT(complaint([](carom_scene& s) { s.method = 3; }), HasSubstr("method: is 3; expected 0 to 2"));
  EXPECT_THAT(complaint([](carom_scene& s) { s.t_end = -1.0; }), HasSubstr("t_end"));
  EXPECT_THAT(complaint([=](carom_scene& s) { s.height = infinite; }), HasSubstr("height: is inf; expected a finite"));
  EXPECT_THAT(complaint([=](carom_scene& s) { s.gravity = -infinite; }), HasSubstr("gravity: is -inf"));
  EXPECT_THAT(complaint([](carom_scene& s) { s.method = CAROM_PAIRWISE; }), HasSubstr("dt: missing"));
  EXPECT_THAT(complaint([](carom_scene& s) { s.restitution = 1.5; }), HasSubstr("restitution: is 1.5"));
  EXPECT_THAT(complaint([](carom_scene& s) { s.wall_restitution = -0.5; }), HasSubstr("wall_restitution: is -0.5"));
}

// Results do not depend on these fields, so their effect is looked for in what is saved, and in the threads of the
// process.
TEST(CaromStruct, TheReferenceIsTheOneThatSteps) {
  for (const int reference : {0, 1}) {
    World world(carom::default_scene(), {1, reference});
    std::vector<std::byte> saved;
    world.save(saved);
    const std::string text(reinterpret_cast<const char*>(saved.data()), saved.size());
    EXPECT_EQ(text.find("reference") != std::string::npos, reference == 1);
  }
}

std::ptrdiff_t threads_of_the_process() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

// The number of threads that making a world with this number adds. To be called in a process of its own, in which no
// earlier test has started threads.
int threads_that_come(int threads) {
  World alone = World::from_text(gas, {1, 0});
  alone.step(20);
  const std::ptrdiff_t before = threads_of_the_process();
  World several = World::from_text(gas, {threads, 0});
  several.step(20);
  return static_cast<int>(threads_of_the_process() - before);
}

TEST(CaromStructDeathTest, AWorldHasTheThreadsThatItIsGiven) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(std::_Exit(threads_that_come(2)), testing::ExitedWithCode(1), "");
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "all cores are one";
  const auto some = [](int status) { return WIFEXITED(status) && WEXITSTATUS(status) > 0; };
  EXPECT_EXIT(std::_Exit(threads_that_come(0)), some, "") << "0 means all cores";
}

TEST(CaromStruct, ThreadsHaveALimit) {
  for (const int threads : {-1, 4097, std::numeric_limits<int>::max()}) {
    const carom_scene scene = carom::default_scene();
    const carom_options options{threads, 0};
    carom_world* world = nullptr;
    EXPECT_EQ(carom_from_scene(&scene, &options, &world), CAROM_INPUT);
    EXPECT_THAT(carom_error(world),
                HasSubstr("options: threads is " + std::to_string(threads) + "; expected 0 to 4096"));
    carom_destroy(world);
  }
  EXPECT_EQ(World(carom::default_scene(), {0, 0}).size(), 0U);
}

// The numbers of a scene's text are read, and energies are summed, independently of the rounding mode of the host.
TEST(CaromStruct, NoNumberDependsOnTheRoundingOfTheHost) {
  const World usual = World::from_text(gas);
  std::fesetround(FE_UPWARD);
  const World other = World::from_text(gas);
  const double kinetic = other.kinetic_energy(), potential = other.potential_energy();
  const int mode = std::fegetround();
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(mode, FE_UPWARD);
  EXPECT_EQ(other.hash(), usual.hash());
  EXPECT_EQ(other.width(), usual.width());
  EXPECT_EQ(kinetic, usual.kinetic_energy());
  EXPECT_EQ(potential, usual.potential_energy());
}

}  // namespace
