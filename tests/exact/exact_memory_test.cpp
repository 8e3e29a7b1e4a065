// The memory that the exact engine takes for each disk: this program counts all allocations, its own and the engine's.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>

#include "core/load/memory_need.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"

namespace {

std::atomic<long> allocated{0};  // bytes
std::atomic<long> most{0};

void* counted(std::size_t bytes, std::size_t alignment) {
  void* const memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  const long now = allocated += static_cast<long>(malloc_usable_size(memory));
  long before = most.load();
  while (before < now && !most.compare_exchange_weak(before, now)) {
  }
  return memory;
}

void uncount(void* memory) {
  if (memory != nullptr) allocated -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

// The other forms of operator new call these; see warm_step_allocation_test.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  return counted(bytes, alignof(std::max_align_t));
}
[[gnu::noinline]] void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return counted(bytes, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  uncount(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  uncount(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  uncount(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  uncount(memory);
}

namespace carom {
namespace {

constexpr long disks = 80'000;  // enough for regions, and for freeing memory that is not needed all the time

double most_bytes_a_disk(int threads) {
  const Scene scene = parse_scene(
      "[box]\npacking_fraction = 0.5\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
      "top = \"periodic\"\n[[disks]]\ncount = " +
          std::to_string(disks) +
          "\npositions = \"square\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1.0\n"
          "[run]\nmethod = \"exact\"\nt_end = 100.0\n",
      "memory", "");
  const long before = allocated;
  State initial = initial_state(scene);
  most = allocated.load();
  const auto engine = make_parallel_engine(scene, std::move(initial), {threads});
  engine->forget_paths();
  while (engine->progress().counters.collisions < 4 * disks) engine->step();
  return static_cast<double>(most - before) / static_cast<double>(disks);
}

// The memory with two parts and halos, if one queue takes `least`. Halos are 8 mean spacings wide, two for each part;
// their disks are stored twice, except the state's 36 bytes. Each disk also has two places (4 bytes each), an id (4)
// and a coordinate (8) in its part, and vectors have room for one more disk in 32.
double in_two_parts(double least) {
  constexpr double state = 36.0;
  constexpr double of_parts = 20.0;
  const double ghosts = 4.0 * 8.0 / std::sqrt(static_cast<double>(disks));
  return state + (least - state + of_parts) * (1.0 + ghosts) * (1.0 + 1.0 / 32.0);
}

// The lower bound that is used in the check of scenes is near the memory that runs take, and not above it.
TEST(LongExactMemory, OfADiskIsWhatScenesAreCheckedWith) {
  const double least = least_memory(Method::exact, disks) / static_cast<double>(disks);
  for (const int threads : {1, 2}) {
    const double taken = most_bytes_a_disk(threads);
    RecordProperty("bytes_a_disk_" + std::to_string(threads), std::to_string(taken));
    EXPECT_GT(taken, least) << threads << " threads";
    EXPECT_LT(taken, 1.05 * (threads == 1 ? least : in_two_parts(least))) << threads << " threads";
  }
}

}  // namespace
}  // namespace carom
