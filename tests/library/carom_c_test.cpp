// The C interface of libcarom.so: its statuses, texts and bits.
#include <carom/carom.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <carom/carom.hpp>
#include <carom/eigen.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "core/load/scene_file.hpp"
#include "run/simulation/simulation.hpp"
#include "tests/support/library_scene.hpp"
#include "tests/support/test_folder.hpp"

namespace {

using carom::World;
using carom::test::box;

constexpr double nan_number = std::numeric_limits<double>::quiet_NaN();

constexpr std::string_view gas = R"(
[box]
packing_fraction = 0.3
[[disks]]
count = 200
positions = "random"
mass = 1.0
velocities = { maxwell = 1.0 }
radius = { uniform = [0.3, 0.6] }
[run]
method = "pairwise"
dt = 0.01
t_end = 5.0
)";

TEST(CaromC, HasTheBitsOfASimulation) {
  World world = World::from_text(gas);
  carom::Simulation simulation(carom::parse_scene(gas, "gas", ""), carom::choose_engine("parallel", 1));
  world.run_until(2.0);
  simulation.run_until(2.0);
  EXPECT_EQ(world.hash(), simulation.hash());
  EXPECT_EQ(world.time(), simulation.time());
  EXPECT_EQ(world.collisions(), simulation.state().counters.collisions);
  const std::vector<carom_disk> disks = world.disks();
  ASSERT_EQ(disks.size(), 200U);
  std::vector<double> places(400), velocities(400), radii(200);
  std::vector<std::uint32_t> ids(200);
  world.positions(places);
  world.velocities(velocities);
  world.radii(radii);
  world.ids(ids);
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const std::size_t i = simulation.order()[k];
    EXPECT_EQ(disks[k].id, k);
    EXPECT_EQ(ids[k], k);
    EXPECT_EQ(disks[k].x, simulation.state().disks.x[i]);
    EXPECT_EQ(places[2 * k], disks[k].x);
    EXPECT_EQ(places[2 * k + 1], disks[k].y);
    EXPECT_EQ(velocities[2 * k], disks[k].vx);
    EXPECT_EQ(velocities[2 * k + 1], disks[k].vy);
    EXPECT_EQ(radii[k], disks[k].radius);
  }
}

// The text may be part of a larger text, or of a mapped file.
TEST(CaromC, ATextIsAsLongAsItIsSaidToBe) {
  const std::string longer = std::string(gas) + "no TOML";
  const World world = World::from_text(std::string_view(longer).substr(0, gas.size()));
  EXPECT_EQ(world.disks().size(), 200U);
  EXPECT_THROW(World::from_text(longer), carom::Error);
}

TEST(CaromC, StructAndTextAreTheSameScene) {
  carom_scene scene = box();
  scene.left = scene.right = CAROM_PERIODIC;
  scene.gravity = 0.1;
  scene.restitution = 0.9;
  scene.t_end = 7.0;
  World of_struct(scene);
  World of_text = World::from_text(
      "[box]\nwidth = 20\nheight = 10\nleft = \"periodic\"\nright = \"periodic\"\n[physics]\ngravity = 0.1\n"
      "restitution = 0.9\n[[disks]]\ncount = 0\npositions = \"random\"\nradius = 1.0\nmass = 1.0\n[run]\nmethod = "
      "\"pairwise\"\n"
      "dt = 0.01\nt_end = 7.0\n");
  for (World* world : {&of_struct, &of_text}) {
    EXPECT_EQ(world->add({1.0, 5.0, 1.0, 0.0, 0.5, 1.0, 99}), 0U);
    EXPECT_EQ(world->add({3.0, 5.0, -1.0, 0.0, 0.7, 2.0, 99}), 1U);
    EXPECT_FALSE(world->add({3.1, 5.0, -1.0, 0.0, 0.7, 2.0, 0}));
    world->run_until(100.0);
    EXPECT_TRUE(world->done());
    EXPECT_EQ(world->time(), 7.0);
  }
  EXPECT_EQ(of_struct.hash(), of_text.hash());
}

// Also diffusion, if it is given.
TEST(CaromC, DisksOfAStructMayDiffuse) {
  carom_scene scene = box();
  scene.diffusion = 0.5;
  World of_struct(scene);
  World of_text = World::from_text(
      "[box]\nwidth = 20\nheight = 10\n[physics]\ndiffusion = 0.5\n[[disks]]\ncount = 0\npositions = \"random\"\n"
      "radius = 1.0\nmass = 1.0\n[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 1e9\n");
  for (World* world : {&of_struct, &of_text}) {
    world->add({10.0, 5.0, 0.0, 0.0, 0.5, 1.0, 0});
    world->step(10);
    EXPECT_NE(world->find(0)->x, 10.0);
  }
  EXPECT_EQ(of_struct.hash(), of_text.hash());
}

// Each function returns its own number: disks that come, disks that go, present disks, and their energies under
// gravity.
TEST(CaromC, CountsAndEnergiesAreThoseOfTheSimulation) {
  const std::string flow =
      "[box]\nwidth = 20\nheight = 10\nright = \"sink\"\n[physics]\ngravity = 0.5\n[[disks]]\ncount = 1\n"
      "positions = [[15, 5]]\nvelocities = [[9, 0]]\nradius = 0.2\nmass = 2\n[[sources]]\nside = \"left\"\nrate = 5\n"
      "velocities = { maxwell = 4.0 }\nradius = 0.2\nmass = 1\n[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 5\n";
  World world = World::from_text(flow);
  carom::Simulation simulation(carom::parse_scene(flow, "flow", ""), carom::choose_engine("parallel", 1));
  world.run_until(2.0);
  simulation.run_until(2.0);
  const carom::State& state = simulation.state();
  EXPECT_EQ(world.steps(), state.counters.steps);
  EXPECT_EQ(world.steps(), 200U);
  EXPECT_EQ(world.collisions(), state.counters.collisions);
  EXPECT_EQ(world.wall_collisions(), state.counters.wall_collisions);
  EXPECT_GT(state.counters.wall_collisions, 0U);
  EXPECT_NE(state.counters.wall_collisions, state.counters.collisions);
  EXPECT_EQ(world.end_time(), 5.0);
  EXPECT_EQ(world.width(), 20.0);
  EXPECT_EQ(world.height(), 10.0);
  EXPECT_EQ(world.removed(), state.counters.removed);
  EXPECT_EQ(world.emitted(), state.counters.emitted);
  EXPECT_GT(state.counters.removed, 0U);
  EXPECT_GT(state.counters.emitted, state.counters.removed);
  EXPECT_EQ(world.size(), 1 + state.counters.emitted - state.counters.removed);
  double kinetic = 0.0, potential = 0.0;
  for (const carom_disk& d : world.disks()) {
    kinetic += 0.5 * d.mass * (d.vx * d.vx + d.vy * d.vy);
    potential += d.mass * 0.5 * d.y;
  }
  EXPECT_NEAR(world.kinetic_energy(), kinetic, 1e-12 * kinetic);
  EXPECT_NEAR(world.potential_energy(), potential, 1e-12 * potential);
}

TEST(CaromC, HasSpinsWhereDisksAreRough) {
  const std::string rough = "[physics]\nroughness = { tangential_restitution = 0.9 }" + std::string(gas);
  World world = World::from_text(rough);
  world.run_until(1.0);
  std::vector<double> spins(world.size());
  world.spins(spins);
  const std::vector<carom_disk> disks = world.disks();
  double most = 0.0;
  for (std::size_t k = 0; k < disks.size(); ++k) {
    EXPECT_EQ(disks[k].spin, spins[k]);
    most = std::max(most, std::abs(spins[k]));
  }
  EXPECT_GT(most, 0.1) << "collisions must have changed the spins";
  world.remove(0);
  const std::optional<std::uint32_t> id = world.add({disks[0].x, disks[0].y, 0.0, 0.0, 0.01, 1.0, 0, -2.5});
  ASSERT_TRUE(id);
  EXPECT_EQ(world.find(*id)->spin, -2.5);
  EXPECT_THROW(world.add({1.0, 1.0, 0.0, 0.0, 0.01, 1.0, 0, std::nan("")}), carom::Error);
  World smooth(box());
  EXPECT_EQ(smooth.find(smooth.add({5.0, 5.0, 0.0, 0.0, 1.0, 1.0, 0, std::nan("")}).value())->spin, 0.0);
}

// As in trajectories, ids go on from table to table, including fixed disks, and later ids belong to no table.
TEST(CaromC, GroupsAreTheTablesOfTheScene) {
  World world = World::from_text(
      "[box]\nwidth = 20\nheight = 10\n[[disks]]\ncount = 2\npositions = [[3, 3], [3, 6]]\nradius = 0.5\nmass = 1\n"
      "[[disks]]\ncount = 1\nfixed = true\npositions = [[10, 5]]\nradius = 0.5\n[[disks]]\ncount = 0\nradius = 0.5\n"
      "mass = 1\npositions = \"random\"\n[[disks]]\ncount = 1\npositions = [[15, 2]]\nradius = 0.5\nmass = 1\n[run]\n"
      "t_end = 1\n");
  ASSERT_EQ(world.add({17.0, 7.0, 0.0, 0.0, 0.5, 1.0, 0}), 4U);
  std::vector<std::uint32_t> groups(world.size());
  world.groups(groups);
  EXPECT_THAT(groups, testing::ElementsAre(0, 0, 3, 4));
  EXPECT_EQ(world.group_of(world.cast_ray(10.0, 1.0, 0.0, 1.0, 9.0)->id), 1U);
  world.remove(0);
  EXPECT_EQ(world.group_of(0), 0U);
  EXPECT_EQ(world.group_of(4000000000), 4U);
  EXPECT_EQ(carom_group_of(nullptr, 3), 0U);
  std::vector<std::byte> saved;
  world.save(saved);
  EXPECT_EQ(World::from_memory(saved).group_of(3), 3U);
}

TEST(CaromC, GravityMayBeAVector) {
  carom_scene scene = box(CAROM_EXACT);
  scene.gravity = 0.5;
  scene.gravity_x = -0.25;
  World world(scene);
  world.add({10.0, 5.0, 1.0, 2.0, 0.5, 1.0, 0});
  world.run_until(2.0);
  const double t = world.time();
  const carom_disk disk = world.find(0).value();
  EXPECT_NEAR(disk.vx, 1.0 - 0.25 * t, 1e-12);
  EXPECT_NEAR(disk.vy, 2.0 - 0.5 * t, 1e-12);
  scene.gravity_x = std::numeric_limits<double>::infinity();
  EXPECT_THROW(World{scene}, carom::Error);
}

TEST(CaromC, InnerWallsStopRays) {
  World world = World::from_text(
      "[box]\nwidth = 20\nheight = 10\n[[walls]]\nfrom = [12, 1]\nto = [12, 4]\n[[walls]]\nkind = \"sink\"\n"
      "from = [8, 1]\nto = [8, 6]\n[[disks]]\ncount = 2\nradius = 0.5\nmass = 1\npositions = [[15, 2], [15, "
      "5]]\n[run]\n"
      "method = \"pairwise\"\ndt = 0.01\nt_end = 7\n");
  const carom_hit wall = world.cast_ray(10, 2, 1, 0, 9).value();
  EXPECT_EQ(wall.what, CAROM_MET_WALL);
  EXPECT_EQ(wall.id, 0U);
  EXPECT_NEAR(wall.distance, 2.0, 1e-14);
  EXPECT_NEAR(wall.x, 12.0, 1e-14);
  const carom_hit disk = world.cast_ray(10, 5, 1, 0, 9).value();
  EXPECT_EQ(disk.what, CAROM_MET_DISK);
  EXPECT_EQ(disk.id, 1U);
  EXPECT_EQ(world.cast_ray(10, 5, -1, 0, 9)->what, CAROM_MET_SINK);
  EXPECT_FALSE(world.cast_ray(10, 7, -1, 0, 9));
}

// Fixed disks are found, although they do not count in the world's size.
TEST(CaromC, DisksInARectangleMayBeFixedOnes) {
  World world = World::from_text(
      "[box]\nwidth = 20\nheight = 10\n[[disks]]\ncount = 1\npositions = [[3, 3]]\nradius = 0.5\nmass = 1\n"
      "[[disks]]\ncount = 3\nfixed = true\npositions = [[10, 5], [12, 5], [14, 5]]\nradius = 0.5\n[run]\nt_end = 1\n");
  ASSERT_EQ(world.size(), 1U);
  EXPECT_THAT(world.disks_in(0, 0, 20, 10), testing::ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(world.disks_in(11, 0, 20, 10), testing::ElementsAre(2, 3));
  ASSERT_TRUE(world.remove(0));
  EXPECT_THAT(world.disks_in(0, 0, 20, 10), testing::ElementsAre(1, 2, 3));
  EXPECT_THROW(world.disks_in(nan_number, 0, 20, 10), carom::Error);
}

TEST(CaromC, SavesOverCheckpointsAlone) {
  const carom::test::TestFolder folder("carom_c_save_over");
  World world = World::from_text(gas);
  const std::string thesis = folder.write("thesis.txt", "all of it");
  EXPECT_EQ(carom_save(world.get(), thesis.c_str()), CAROM_INPUT);
  EXPECT_STREQ(carom_error(world.get()),
               (thesis + ": is there, and is no checkpoint; expected a name for a checkpoint").c_str());
  EXPECT_EQ(carom::test::text_of(thesis), "all of it");
  const std::string empty = folder.write("empty", "");
  world.save(empty);
  world.step(10);
  world.save(empty);
  EXPECT_EQ(World::from_checkpoint(empty).hash(), world.hash());
}

TEST(CaromC, SavesAndLoadsInMemoryAndInFiles) {
  const carom::test::TestFolder folder("carom_c_save");
  World world = World::from_text(gas);
  world.step(30);
  std::vector<std::byte> saved;
  world.save(saved);
  const std::string file = (folder.path() / "a.carom").string();
  world.save(file);
  world.step(30);
  const std::uint64_t hash = world.hash();
  world.load(saved);
  EXPECT_NE(world.hash(), hash);
  world.step(30);
  EXPECT_EQ(world.hash(), hash);
  World of_bytes = World::from_memory(saved), of_file = World::from_checkpoint(file);
  for (World* other : {&of_bytes, &of_file}) {
    other->step(30);
    EXPECT_EQ(other->hash(), hash);
  }
  saved[100] ^= std::byte{1};
  EXPECT_THROW(world.load(saved), carom::Error);
  EXPECT_EQ(world.hash(), hash);
}

TEST(CaromC, ContactsOfTheLastStep) {
  World world = World::from_text(gas);
  EXPECT_TRUE(world.contacts().empty());
  std::size_t met = 0;
  for (int k = 0; k < 50; ++k) {
    world.step();
    const std::vector<carom_contact> contacts = world.contacts();
    met += contacts.size();
    for (const carom_contact& c : contacts) {
      EXPECT_LT(c.id1, c.id2);
      EXPECT_EQ(c.time, world.time());
    }
    if (contacts.empty()) continue;
    std::size_t count = 0;
    std::vector<carom_contact> few(contacts.size());
    EXPECT_EQ(carom_contacts(world.get(), few.data(), few.size() - 1, &count), CAROM_INPUT);
    EXPECT_EQ(count, contacts.size());
    EXPECT_EQ(carom_contacts(world.get(), nullptr, few.size(), &count), CAROM_INPUT);
    EXPECT_EQ(carom_contacts(world.get(), few.data(), few.size(), nullptr), CAROM_INPUT);
  }
  EXPECT_GE(met, world.collisions());
  EXPECT_GT(met, 0U);
  world.set_velocity(0, 0.0, 0.0);
  EXPECT_TRUE(world.contacts().empty());
  EXPECT_EQ(carom_contacts(nullptr, nullptr, 0, nullptr), CAROM_INPUT);
}

TEST(CaromC, DisksAsEigenMatrices) {
  World world = World::from_text(gas);
  world.step(20);
  const std::vector<carom_disk> disks = world.disks();
  const Eigen::Matrix2Xd places = carom::positions(world), velocities = carom::velocities(world);
  const Eigen::VectorXd radii = carom::radii(world);
  const carom::DiskColumn vx = carom::column(disks, &carom_disk::vx);
  ASSERT_EQ(places.cols(), 200);
  EXPECT_EQ(vx.data(), &disks[0].vx);
  for (Eigen::Index k = 0; k < places.cols(); ++k) {
    const carom_disk& disk = disks[static_cast<std::size_t>(k)];
    EXPECT_EQ(places.col(k), Eigen::Vector2d(disk.x, disk.y));
    EXPECT_EQ(velocities.col(k), Eigen::Vector2d(disk.vx, disk.vy));
    EXPECT_EQ(radii[k], disk.radius);
    EXPECT_EQ(vx[k], disk.vx);
  }
  const Eigen::ArrayXd speed2 = vx.square() + carom::column(disks, &carom_disk::vy).square();
  EXPECT_NEAR(0.5 * speed2.sum(), world.kinetic_energy(), 1e-9);
  EXPECT_EQ(carom::column({}, &carom_disk::x).size(), 0);
}

TEST(CaromC, TwoWorldsInTwoThreads) {
  const auto hash = [](int threads) {
    carom_options options = carom::default_options();
    options.threads = threads;
    World world = World::from_text(gas, options);
    world.step(200);
    return world.hash();
  };
  const std::uint64_t alone = hash(1);
  std::array<std::uint64_t, 2> both{};
  {
    std::jthread one([&] { both[0] = hash(2); });
    both[1] = hash(1);
  }
  EXPECT_THAT(both, testing::Each(alone));
}

}  // namespace
