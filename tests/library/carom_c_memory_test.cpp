// A world in a program without memory left: a call fails, the program goes on, and the world is as it was.
#include <carom/carom.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/failing_memory.hpp"

namespace carom {
namespace {

struct Call {
  const char* name;
  std::function<carom_status(carom_world*)> make;
};

// A world of some disks after some steps.
carom_world* make_world(const char* method) {
  const std::string text = std::string(R"(
    [box]
    width = 20.0
    height = 20.0
    [physics]
    gravity = 0.1
    restitution = 0.9
    [[disks]]
    count = 100
    positions = "square"
    velocities = { maxwell = 1.0 }
    radius = 0.5
    mass = 1.0
    [run]
    dt = 0.01
    t_end = 10.0
    method = ")") + method +
                           "\"\n";
  carom_world* world = nullptr;
  EXPECT_EQ(carom_from_text(text.data(), text.size(), nullptr, &world), CAROM_OK) << carom_error(world);
  EXPECT_EQ(carom_step(world, 3), CAROM_OK);
  return world;
}

std::vector<Call> calls() {
  const carom_disk small{0.2, 0.2, 0.0, 0.0, 0.05, 1.0, 0, 0.0};
  return {
      {"step", [](carom_world* w) { return carom_step(w, 1); }},
      {"add", [small](carom_world* w) { return carom_add(w, &small, nullptr); }},
      {"remove", [](carom_world* w) { return carom_remove(w, 7); }},
      {"set_velocity", [](carom_world* w) { return carom_set_velocity(w, 3, 0.5, -0.5); }},
      {"disks",
       [](carom_world* w) {
         static carom_disk disks[200];
         return carom_disks(w, disks, 200);
       }},
      {"contacts",
       [](carom_world* w) {
         static carom_contact met[1000];
         std::size_t count = 0;
         return carom_contacts(w, met, 1000, &count);
       }},
      {"save_memory",
       [](carom_world* w) {
         std::size_t size = 0;
         return carom_save_memory(w, nullptr, 0, &size);
       }},
      {"kinetic_energy", [](carom_world* w) { return std::isnan(carom_kinetic_energy(w)) ? CAROM_FAILED : CAROM_OK; }},
      {"potential_energy",
       [](carom_world* w) { return std::isnan(carom_potential_energy(w)) ? CAROM_FAILED : CAROM_OK; }},
  };
}

std::string saved(const carom_world* world) {
  std::size_t size = 0;
  EXPECT_EQ(carom_save_memory(world, nullptr, 0, &size), CAROM_OK);
  std::string bytes(size, '\0');
  EXPECT_EQ(carom_save_memory(world, bytes.data(), bytes.size(), &size), CAROM_OK);
  return bytes;
}

carom_world* loaded(const std::string& bytes) {
  carom_world* world = nullptr;
  EXPECT_EQ(carom_from_memory(bytes.data(), bytes.size(), nullptr, &world), CAROM_OK);
  return world;
}

// The hash after the call and one more step.
std::uint64_t hash_after(const Call& call, carom_world* world) {
  EXPECT_EQ(call.make(world), CAROM_OK) << carom_error(world);
  EXPECT_EQ(carom_step(world, 1), CAROM_OK) << carom_error(world);
  const std::uint64_t hash = carom_hash(world);
  carom_destroy(world);
  return hash;
}

// Repeats the call with memory for n allocations, until that is enough. If it fails, either the world is as it was
// before, or its state is lost, which is reported until another state is loaded. No world may go on half changed.
void expect_all_or_nothing(const Call& call, const std::string& start) {
  const std::uint64_t expected = hash_after(call, loaded(start));
  for (std::size_t n = 0; n < 5000; ++n) {
    carom_world* const world = loaded(start);
    const std::uint64_t before = carom_hash(world);
    carom_status status = CAROM_OK;
    test::with_allocations(n, [&] { status = call.make(world); });
    if (status == CAROM_OK) return carom_destroy(world);
    ASSERT_EQ(status, CAROM_FAILED) << n;
    ASSERT_STREQ(carom_error(world), "out of memory");
    if (carom_count(world) == 0) {
      ASSERT_EQ(carom_step(world, 1), CAROM_FAILED);
      ASSERT_NE(std::string(carom_error(world)).find("the state is lost"), std::string::npos);
      ASSERT_EQ(carom_load_memory(world, start.data(), start.size()), CAROM_OK);
    }
    ASSERT_EQ(carom_hash(world), before) << n;
    ASSERT_EQ(hash_after(call, world), expected) << n;
  }
  FAIL() << "the call fails with any amount of memory";
}

TEST(CaromCMemory, CallsFailAndTheWorldIsAsItWasOrSaysThatItIsLost) {
  for (const char* method : {"exact", "pairwise", "rollback"}) {
    carom_world* const world = make_world(method);
    const std::string start = saved(world);
    carom_destroy(world);
    for (const Call& call : calls()) {
      SCOPED_TRACE(std::string(method) + " " + call.name);
      expect_all_or_nothing(call, start);
    }
  }
}

}  // namespace
}  // namespace carom
