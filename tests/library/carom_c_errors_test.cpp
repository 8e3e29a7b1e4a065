// The C interface of libcarom.so with bad arguments: there is a status and a text, and the world does not change.
#include <carom/carom.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/draws.hpp"
#include "tests/support/library_scene.hpp"

namespace {

using carom::World;
using carom::test::box;
using testing::HasSubstr;

constexpr double nan_number = std::numeric_limits<double>::quiet_NaN();

TEST(CaromCErrors, SaysWhatIsWrongWithAScene) {
  carom_world* world = nullptr;
  const std::string text = "[box]\nwidht = 3\n";
  EXPECT_EQ(carom_from_text(text.data(), text.size(), nullptr, &world), CAROM_INPUT);
  EXPECT_THAT(carom_error(world), HasSubstr("scene:2: box.widht"));
  EXPECT_EQ(carom_step(world, 1), CAROM_INPUT);
  EXPECT_THAT(carom_error(world), HasSubstr("could not be made"));
  EXPECT_EQ(carom_count(world), 0U);
  carom_destroy(world);
  EXPECT_EQ(carom_from_file("/no/such/scene.toml", nullptr, &world), CAROM_INPUT);
  EXPECT_THAT(carom_error(world), HasSubstr("/no/such/scene.toml"));
  carom_destroy(world);
  carom_scene scene = box();
  scene.width = nan_number;
  EXPECT_EQ(carom_from_scene(&scene, nullptr, &world), CAROM_INPUT);
  EXPECT_THAT(carom_error(world), HasSubstr("width"));
  carom_destroy(world);
  scene = box();
  scene.top = 17;
  EXPECT_EQ(carom_from_scene(&scene, nullptr, &world), CAROM_INPUT);
  EXPECT_THAT(carom_error(world), HasSubstr("top: is 17"));
  carom_destroy(world);
  scene.top = CAROM_WALL;
  const carom_options options{-1, 0};
  EXPECT_EQ(carom_from_scene(&scene, &options, &world), CAROM_INPUT);
  EXPECT_THAT(carom_error(world), HasSubstr("threads is -1"));
  carom_destroy(world);
}

TEST(CaromCErrors, NullPointersAreAStatusAndAText) {
  EXPECT_EQ(carom_from_text("x", 1, nullptr, nullptr), CAROM_INPUT);
  EXPECT_EQ(carom_step(nullptr, 1), CAROM_INPUT);
  EXPECT_STREQ(carom_error(nullptr), "the world is a null pointer");
  EXPECT_EQ(carom_next_warning(nullptr), nullptr);
  EXPECT_EQ(carom_hash(nullptr), 0U);
  EXPECT_EQ(carom_time(nullptr), 0.0);
  EXPECT_EQ(carom_kinetic_energy(nullptr), 0.0);
  carom_destroy(nullptr);
  carom_options_init(nullptr);
  carom_scene_init(nullptr);
  const auto no_world = [](const auto& make) {
    carom_world* none = nullptr;
    EXPECT_EQ(make(&none), CAROM_INPUT);
    EXPECT_THAT(carom_error(none), HasSubstr("null pointer"));
    carom_destroy(none);
  };
  no_world([](carom_world** w) { return carom_from_file(nullptr, nullptr, w); });
  no_world([](carom_world** w) { return carom_from_text(nullptr, 0, nullptr, w); });
  no_world([](carom_world** w) { return carom_from_scene(nullptr, nullptr, w); });
  no_world([](carom_world** w) { return carom_from_checkpoint(nullptr, nullptr, w); });
  no_world([](carom_world** w) { return carom_from_memory(nullptr, 0, nullptr, w); });
  World owner(box());
  carom_world* const world = owner.get();
  owner.add({5.0, 5.0, 0.0, 0.0, 1.0, 1.0, 0});
  const auto complains = [&](carom_status status) {
    EXPECT_EQ(status, CAROM_INPUT);
    EXPECT_THAT(carom_error(world), HasSubstr("null pointer"));
  };
  complains(carom_disks(world, nullptr, 10));
  complains(carom_ids(world, nullptr, 10));
  complains(carom_positions(world, nullptr, 10));
  complains(carom_velocities(world, nullptr, 10));
  complains(carom_radii(world, nullptr, 10));
  complains(carom_spins(world, nullptr, 10));
  complains(carom_groups(world, nullptr, 10));
  complains(carom_contacts(world, nullptr, 10, nullptr));
  complains(carom_disks_at(world, 0.0, nullptr, 10, nullptr, nullptr));
  complains(carom_get(world, 0, nullptr));
  complains(carom_add(world, nullptr, nullptr));
  complains(carom_query_box(world, 0, 0, 1, 1, nullptr, 10, nullptr));
  std::size_t count = 0;
  complains(carom_query_box(world, 0, 0, 20, 10, nullptr, 10, &count));
  complains(carom_nearest(world, 1, 1, nullptr, nullptr));
  complains(carom_cast_ray(world, 1, 1, 1, 0, 1, nullptr));
  complains(carom_save(world, nullptr));
  complains(carom_save_memory(world, nullptr, 0, nullptr));
  complains(carom_load_memory(world, nullptr, 0));
  complains(carom_run_while(world, 1.0, nullptr, nullptr));
}

TEST(CaromCErrors, ShortArraysAndNumbersThatAreNone) {
  World owner(box());
  carom_world* const world = owner.get();
  for (int k = 0; k < 5; ++k) owner.add({2.0 + 3.0 * k, 5.0, 1.0, 0.0, 1.0, 1.0, 0});
  carom_disk disks[4];
  EXPECT_EQ(carom_disks(world, disks, 4), CAROM_INPUT);
  EXPECT_THAT(carom_error(world), HasSubstr("room for 4 disks, and there are 5"));
  std::uint32_t ids[4];
  std::size_t count = 0;
  EXPECT_EQ(carom_query_box(world, 0, 0, 20, 10, ids, 4, &count), CAROM_INPUT);
  EXPECT_EQ(count, 5U);
  std::size_t size = 0;
  char byte = 0;
  EXPECT_EQ(carom_save_memory(world, &byte, 1, &size), CAROM_INPUT);
  EXPECT_GT(size, 100U);
  const std::uint64_t before = carom_hash(world);
  const carom_disk bad{nan_number, 5.0, 0.0, 0.0, 0.1, 1.0, 0};
  EXPECT_EQ(carom_add(world, &bad, nullptr), CAROM_INPUT);
  const carom_disk large{10.0, 5.0, 0.0, 0.0, 5.5, 1.0, 0};  // there is no room for it anywhere in the box
  EXPECT_EQ(carom_add(world, &large, nullptr), CAROM_INPUT);
  EXPECT_STREQ(carom_error(world),
               "radius: is 5.5; expected at most 5, half the box, for a disk that has to lie inside it");
  EXPECT_EQ(carom_set_velocity(world, 0, nan_number, 0.0), CAROM_INPUT);
  EXPECT_EQ(carom_run_until(world, nan_number), CAROM_INPUT);
  EXPECT_EQ(carom_disks_at(world, nan_number, disks, 4, &count, nullptr), CAROM_INPUT);
  EXPECT_EQ(carom_get(world, 77, disks), CAROM_NOT_FOUND);
  EXPECT_EQ(carom_remove(world, 77), CAROM_NOT_FOUND);
  EXPECT_EQ(carom_hash(world), before);
}

// A step that is far too long returns an error, but the world can still be looked at.
TEST(CaromCErrors, PhysicsThatCannotGoOn) {
  World world(box());
  world.add({5.0, 5.0, 1e6, 0.0, 0.1, 1.0, 0});
  EXPECT_EQ(carom_step(world.get(), 1), CAROM_PHYSICS);
  EXPECT_THAT(carom_error(world.get()), HasSubstr("run.dt"));
  EXPECT_EQ(world.size(), 1U);
}

// A program has no command line, so remedies in messages are keys of the scene.
TEST(CaromCErrors, RemediesAreNoOptionsOfACommandLine) {
  const auto world_of = [](const std::string& keys, const std::string& run) {
    const std::string text = "[box]\nwidth = 10.0\nheight = 10.0\n" + keys +
                             "[[disks]]\ncount = 30\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\n" +
                             "radius = 0.5\nmass = 1.0\n[run]\nt_end = 100.0\n" + run;
    return World::from_text(text);
  };
  World coarse = world_of("", "method = \"pairwise\"\ndt = 0.2\n");
  coarse.run_until(20.0);
  std::string told;
  while (const char* const warning = carom_next_warning(coarse.get())) told += std::string(warning) + "\n";
  EXPECT_THAT(told, HasSubstr("use a smaller dt or run.method = \"exact\""));
  World pile =
      world_of("wall_restitution = 0.5\n[physics]\ngravity = 1.0\nrestitution = 0.5\n", "method = \"exact\"\n");
  EXPECT_EQ(carom_run_until(pile.get(), 100.0), CAROM_PHYSICS);
  const std::string collapse = carom_error(pile.get());
  EXPECT_THAT(collapse, HasSubstr("or use run.method = \"pairwise\""));
  EXPECT_THAT(told + collapse, testing::Not(HasSubstr("--")));
}

// Random calls, with valid numbers and invalid ones.
class RandomCalls {
 public:
  RandomCalls(World& owner, carom::test::Draws& draw) : owner_(owner), draw_(draw) { owner.save(saved_); }

  carom_status next() {
    carom_world* const world = owner_.get();
    std::uint32_t id = static_cast<std::uint32_t>(draw_.bits() % 64);
    std::uint32_t ids[16];
    std::size_t count = 0;
    carom_hit hit;
    carom_disk disk{number(), number(), draw_.in(-5.0, 5.0), number(), draw_.in(-0.1, 1.0), draw_.in(-0.1, 2.0), 0};
    switch (draw_.bits() % 10) {
      case 0:
      case 1:
      case 2:
        return carom_add(world, &disk, nullptr);
      case 3:
        return carom_remove(world, id);
      case 4:
        return carom_set_velocity(world, id, number(), draw_.in(-5.0, 5.0));
      case 5:
        return carom_query_box(world, number(), number(), number(), number(), ids, 16, &count);
      case 6:
        return carom_cast_ray(world, number(), number(), number(), number(), number(), &hit);
      case 7:
        return carom_nearest(world, number(), number(), &id, nullptr);
      case 8:
        if (draw_.bits() % 20 == 0) owner_.load(saved_);
        if (draw_.bits() % 20 == 0) owner_.save(saved_);
        return CAROM_OK;
      default:
        return carom_step(world, 1);
    }
  }

 private:
  double number() {
    switch (draw_.bits() % 12) {
      case 0:
        return nan_number;
      case 1:
        return std::numeric_limits<double>::infinity();
      case 2:
        return -1e300;
      default:
        return draw_.in(-1.0, 21.0);
    }
  }

  World& owner_;
  carom::test::Draws& draw_;
  std::vector<std::byte> saved_;
};

// For any order of calls there is a status, and the world stays valid.
TEST(CaromCErrors, RandomCallsLeaveAWorld) {
  carom::test::Draws draw(11);
  for (const int method : {CAROM_EXACT, CAROM_PAIRWISE, CAROM_ROLLBACK}) {
    World owner(box(method));
    RandomCalls calls(owner, draw);
    for (int k = 0; k < 1000; ++k) {
      const carom_status status = calls.next();
      ASSERT_GE(status, CAROM_OK);
      ASSERT_LE(status, CAROM_NOT_FOUND);
      ASSERT_NE(std::strlen(carom_status_text(status)), 0U);
      ASSERT_TRUE(status == CAROM_OK || std::strlen(carom_error(owner.get())) != 0);
    }
    for (const carom_disk& disk : owner.disks()) EXPECT_TRUE(std::isfinite(disk.x + disk.y + disk.vx + disk.vy));
  }
}

}  // namespace
