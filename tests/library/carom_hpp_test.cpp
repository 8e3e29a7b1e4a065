// The C++ layer carom.hpp, and functions of carom.h that it builds on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/load/scene_file.hpp"
#include "run/simulation/simulation.hpp"
#include "tests/support/library_scene.hpp"
#include "tests/support/test_folder.hpp"

namespace {

using carom::World;
using carom::test::box;
using testing::HasSubstr;

// A step that is far too long: some disks move by more than their radius, and reach into walls.
constexpr std::string_view hasty = R"(
[box]
width = 10.0
height = 10.0
[[disks]]
count = 60
positions = "random"
mass = 1.0
velocities = { maxwell = 1.0 }
radius = 0.5
[run]
method = "pairwise"
dt = 0.2
t_end = 20.0
)";

World two_disks(int method) {
  World world(box(method));
  EXPECT_EQ(world.add({5.0, 4.0, 1.0, 0.25, 0.5, 1.0, 0}), 0U);
  EXPECT_EQ(world.add({15.0, 3.0, 0.0, 0.0, 0.5, 1.0, 0}), 1U);
  return world;
}

carom_status status_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const carom::Error& error) {
    return error.status();
  }
  return CAROM_OK;
}

TEST(CaromHpp, AWorldIsMovedAndTheOldHandleIsNone) {
  std::vector<World> worlds;
  worlds.push_back(two_disks(CAROM_EXACT));
  worlds.emplace_back(box());
  World& left = worlds[1];
  carom_world* const first = worlds[0].get();
  left = std::move(worlds[0]);
  EXPECT_EQ(left.get(), first);
  EXPECT_EQ(left.size(), 2U);
  const World last(std::move(worlds[1]));
  EXPECT_EQ(last.get(), first);
  EXPECT_EQ(left.get(), nullptr);
  EXPECT_EQ(left.size(), 0U);
  EXPECT_EQ(status_of([&] { left.step(); }), CAROM_INPUT);
  EXPECT_EQ(status_of([&] { static_cast<void>(left.contacts()); }), CAROM_INPUT);
  EXPECT_EQ(status_of([&] { static_cast<void>(left.disks_in(0, 0, 1, 1)); }), CAROM_INPUT);
}

TEST(CaromHpp, ErrorsSayWhichKindTheyAre) {
  EXPECT_EQ(status_of([] { World::from_text("[box]\nwidht = 1\n"); }), CAROM_INPUT);
  World world(box());
  world.add({5.0, 5.0, 1e6, 0.0, 0.1, 1.0, 0});
  EXPECT_EQ(status_of([&] { world.step(); }), CAROM_PHYSICS);
  EXPECT_EQ(status_of([&] { world.save("/no/such/folder/state.carom"); }), CAROM_FAILED);
  EXPECT_EQ(status_of([&] { static_cast<void>(world.nearest(-1.0, 0.0)); }), CAROM_INPUT);
}

TEST(CaromHpp, AFunctionSaysHowLongARunGoesOn) {
  World world = two_disks(CAROM_PAIRWISE);
  int asked = 0;
  world.run_while(1.0, [&] { return ++asked < 4; });
  EXPECT_EQ(asked, 4);
  EXPECT_EQ(world.steps(), 3U);
  try {
    world.run_while(1.0, [&]() -> bool { throw std::domain_error("enough\nof it"); });
    FAIL();
  } catch (const carom::Error& error) {
    EXPECT_EQ(error.status(), CAROM_FAILED);
    EXPECT_STREQ(error.what(), "enough?of it");
  }
  EXPECT_EQ(world.steps(), 3U);
  world.run_while(0.5, [&] { return true; });
  EXPECT_NEAR(world.time(), 0.5, 1e-9);
  world.step(7);
  EXPECT_EQ(world.steps(), 57U);
  int left = 3;  // in C any value but 0 means to go on
  const auto go_on = [](void* number) { return -(*static_cast<int*>(number))--; };
  EXPECT_EQ(carom_run_while(world.get(), 1.0, go_on, &left), CAROM_OK);
  EXPECT_EQ(world.steps(), 60U);
}

// Files named in a scene are beside it.
TEST(CaromHpp, AFileIsTheSceneOfItsText) {
  const carom::test::TestFolder folder("AFileIsTheSceneOfItsText");
  std::string text(hasty);
  EXPECT_EQ(World::from_file(folder.write("gas.toml", text)).hash(), World::from_text(text).hash());
  text.replace(text.find("\"random\""), 8, "{ file = \"places.csv\" }");
  text.replace(text.find("count = 60"), 10, "count = 2");
  folder.write("places.csv", "3.0,4.0\n5.0,6.0\n");
  EXPECT_EQ(World::from_file(folder.write("two.toml", text)).disks().back().y, 6.0);
}

TEST(CaromHpp, ChangesReachTheDiskThatIsMeant) {
  World world = two_disks(CAROM_PAIRWISE);
  EXPECT_TRUE(world.set_velocity(1, 2.0, -3.0));
  EXPECT_EQ(world.find(1)->vx, 2.0);
  EXPECT_EQ(world.find(1)->vy, -3.0);
  EXPECT_EQ(world.find(0)->vx, 1.0);
  EXPECT_EQ(world.find(0)->vy, 0.25);
  EXPECT_FALSE(world.set_velocity(9, 0.0, 0.0));
  EXPECT_EQ(carom_set_velocity(world.get(), 9, 0.0, 0.0), CAROM_NOT_FOUND);
  EXPECT_FALSE(world.remove(9));
  EXPECT_TRUE(world.remove(0));
  EXPECT_FALSE(world.find(0));
  const carom_disk disk{5.0, 4.0, 0.0, 0.0, 0.5, 1.0, 0};
  EXPECT_EQ(carom_add(world.get(), &disk, nullptr), CAROM_OK) << "the id may be omitted";
  EXPECT_EQ(world.find(2)->x, 5.0);
}

TEST(CaromHpp, TheNearestDiskAndTheFirstOnARay) {
  World world = two_disks(CAROM_EXACT);
  std::uint32_t id = 7;
  double distance = 0.0;
  ASSERT_EQ(carom_nearest(world.get(), 12.0, 7.0, &id, &distance), CAROM_OK);
  EXPECT_EQ(id, 1U);
  EXPECT_DOUBLE_EQ(distance, 5.0);
  EXPECT_EQ(world.nearest(4.0, 9.0), 0U);
  const carom_hit hit = world.cast_ray(15.0, 9.0, 0.0, -2.0, 10.0).value();
  EXPECT_EQ(hit.id, 1U);
  EXPECT_DOUBLE_EQ(hit.distance, 5.5);
  EXPECT_DOUBLE_EQ(hit.x, 15.0);
  EXPECT_DOUBLE_EQ(hit.y, 3.5);
  EXPECT_FALSE(world.cast_ray(15.0, 9.0, 0.0, -2.0, 5.0)) << "the ray is too short";
  world.remove(0);
  world.remove(1);
  EXPECT_FALSE(world.nearest(4.0, 9.0));
  EXPECT_EQ(carom_nearest(world.get(), 4.0, 9.0, &id, nullptr), CAROM_NOT_FOUND);
  EXPECT_STREQ(carom_error(world.get()), "there are no disks");
}

// With exact the disks are those of the time asked for; otherwise those of the step's end, which the time returned
// says.
TEST(CaromHpp, DisksOfATimeWithinTheLastStep) {
  for (const int method : {CAROM_EXACT, CAROM_PAIRWISE}) {
    World world = two_disks(method);
    world.step();
    const double within = 0.75 * world.time();
    std::vector<carom_disk> then(2);
    std::size_t count = 0;
    double time = 0.0;
    ASSERT_EQ(carom_disks_at(world.get(), within, then.data(), 2, &count, &time), CAROM_OK);
    EXPECT_EQ(count, 2U);
    EXPECT_EQ(time, method == CAROM_EXACT ? within : world.time());
    EXPECT_DOUBLE_EQ(then[0].x, method == CAROM_EXACT ? 5.0 + within : world.find(0)->x);
    EXPECT_EQ(carom_disks_at(world.get(), within, then.data(), 2, &count, nullptr), CAROM_OK);
    count = 0;
    EXPECT_EQ(carom_disks_at(world.get(), within, then.data(), 1, &count, &time), CAROM_INPUT);
    EXPECT_EQ(count, 2U) << "the number of disks is returned nevertheless";
    EXPECT_EQ(carom_disks_at(world.get(), within, nullptr, 2, &count, &time), CAROM_INPUT);
    EXPECT_EQ(carom_disks_at(world.get(), -0.5, then.data(), 2, &count, &time), CAROM_INPUT);
    EXPECT_THAT(carom_error(world.get()), HasSubstr("before the last step"));
    EXPECT_EQ(world.disks_at(within, &time).size(), 2U);
    EXPECT_EQ(world.disks_at(within).front().x, then[0].x);
    EXPECT_EQ(status_of([&] { world.disks_at(-0.5); }), CAROM_INPUT);
  }
}

// More than size() disks: one that a sink took in the last step exists before that.
TEST(CaromHpp, DisksOfATimeBeforeASinkTookThem) {
  carom_scene scene = box(CAROM_EXACT);
  scene.right = CAROM_SINK;
  World world(scene);
  ASSERT_TRUE(world.add({scene.width - 2.0, 4.0, 1.0, 0.0, 0.5, 1.0, 0}));
  while (world.removed() == 0 && !world.done()) world.step();
  ASSERT_EQ(world.size(), 0U);
  double time = 0.0;
  ASSERT_EQ(world.disks_at(1.25, &time).size(), 1U);
  EXPECT_EQ(world.disks_at(1.25).front().x, scene.width - 0.75);
  EXPECT_EQ(time, 1.25);
}

TEST(CaromHpp, AnEmptyWorldNeedsNoArrays) {
  World world(box());
  carom_world* const w = world.get();
  std::size_t count = 7;
  EXPECT_EQ(carom_disks(w, nullptr, 0), CAROM_OK);
  EXPECT_EQ(carom_ids(w, nullptr, 0), CAROM_OK);
  EXPECT_EQ(carom_positions(w, nullptr, 0), CAROM_OK);
  EXPECT_EQ(carom_disks_at(w, 0.0, nullptr, 0, &count, nullptr), CAROM_OK);
  EXPECT_EQ(count, 0U);
  count = 7;
  EXPECT_EQ(carom_contacts(w, nullptr, 0, &count), CAROM_OK);
  EXPECT_EQ(count, 0U);
  count = 7;
  EXPECT_EQ(carom_query_box(w, 0, 0, 20, 10, nullptr, 0, &count), CAROM_OK);
  EXPECT_EQ(count, 0U);
  EXPECT_TRUE(world.disks().empty());
}

// These arrays have room for half as many disks.
TEST(CaromHpp, RoomIsCountedInDisks) {
  const World world = two_disks(CAROM_PAIRWISE);
  std::vector<double> xy(4), three(3), one(1);
  std::vector<carom_disk> disk(1);
  std::vector<std::uint32_t> id(1);
  world.positions(xy);
  EXPECT_THAT(xy, testing::ElementsAre(5.0, 4.0, 15.0, 3.0));
  world.velocities(xy);
  EXPECT_THAT(xy, testing::ElementsAre(1.0, 0.25, 0.0, 0.0));
  EXPECT_EQ(status_of([&] { world.positions(three); }), CAROM_INPUT);
  EXPECT_EQ(status_of([&] { world.velocities(three); }), CAROM_INPUT);
  EXPECT_EQ(status_of([&] { world.radii(one); }), CAROM_INPUT);
  EXPECT_EQ(status_of([&] { world.spins(one); }), CAROM_INPUT);
  EXPECT_EQ(status_of([&] { world.disks(disk); }), CAROM_INPUT);
  EXPECT_EQ(status_of([&] { world.ids(id); }), CAROM_INPUT);
  EXPECT_STREQ(carom_error(world.get()), "the array has room for 1 disk, and there are 2");
}

// Two disks in a channel make more contacts in a window than there are disks.
TEST(CaromHpp, MoreContactsThanDisks) {
  carom_scene scene = box(CAROM_EXACT);
  scene.height = 2.5;
  World world(scene);
  world.add({2.0, 1.25, 8.0, 0.0, 1.0, 1.0, 0});
  world.add({17.0, 1.25, -8.0, 0.0, 1.0, 1.0, 0});
  std::size_t most = 0;
  for (int k = 0; k < 20; ++k) {
    world.step();
    const std::vector<carom_contact> met = world.contacts();
    most = std::max(most, met.size());
    for (const carom_contact& c : met) {
      EXPECT_EQ(c.id1, 0U);
      EXPECT_EQ(c.id2, 1U);
      EXPECT_TRUE(c.time > 0.0 && c.time <= world.time());
    }
    std::size_t count = 0;
    carom_contact first{};
    if (met.size() < 2) continue;
    EXPECT_EQ(carom_contacts(world.get(), &first, 1, &count), CAROM_INPUT);
    EXPECT_EQ(carom_error(world.get()),
              "the array has room for 1 contact, and there are " + std::to_string(met.size()));
  }
  EXPECT_GT(most, 2U);
}

TEST(CaromHpp, StatesFitIntoWhatIsThere) {
  World world = two_disks(CAROM_PAIRWISE);
  std::size_t size = 0;
  ASSERT_EQ(carom_save_memory(world.get(), nullptr, 0, &size), CAROM_OK) << "only the size is asked for";
  std::vector<std::byte> bytes(size);
  EXPECT_EQ(carom_save_memory(world.get(), bytes.data(), size - 1, &size), CAROM_INPUT);
  EXPECT_EQ(carom_save_memory(world.get(), bytes.data(), size, &size), CAROM_OK);
  std::vector<std::byte> large(10 * size), none;
  world.save(large);
  world.save(none);
  EXPECT_EQ(large, bytes);
  EXPECT_EQ(none, bytes);
}

TEST(CaromHpp, AllWarningsComeInTheirOrder) {
  World world = World::from_text(hasty);
  carom::Simulation simulation(carom::parse_scene(hasty, "gas", ""), carom::choose_engine("parallel", 1));
  world.run_until(20.0);
  simulation.run_until(20.0);
  const std::vector<std::string> warnings = world.take_warnings();
  EXPECT_GE(warnings.size(), 3U);
  EXPECT_EQ(warnings, simulation.take_warnings());
  EXPECT_TRUE(world.take_warnings().empty());
}

}  // namespace
