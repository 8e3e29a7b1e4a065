// A step allocates no memory once the engine is warm: this program counts every operator new, its own and the engine's.
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t bytes, std::size_t alignment) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  void* const memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// The other forms call these. None is inlined: if g++ inlines one of a pair, as with the address sanitizer, it takes
// free() on the other's memory for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  return counted(bytes, alignof(std::max_align_t));
}
[[gnu::noinline]] void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return counted(bytes, static_cast<std::size_t>(alignment));
}
// std::stable_sort gets its scratch memory this way; the address sanitizer has its own form of it.
[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return std::malloc(bytes);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace carom {
namespace {

// The number of allocations in 60 steps after a warm-up in which every list reaches its greatest length. The warm-up is
// ten times as long, so that new maxima are rare in the steps counted, and growing vectors double in size. The steps
// counted include some that sort, known by their new order of storage, unless disks lie still.
long allocations_when_warm(const std::string& text, int threads, int warm_up = 600) {
  const Scene scene = parse_scene(text + "[run]\nmethod = \"pairwise\"\ndt = 0.005\nt_end = 1000.0\n", "warm", "");
  const auto engine = make_parallel_engine(scene, initial_state(scene), {threads, 16});
  for (int k = 0; k < warm_up; ++k) engine->step();
  long sum = 0;
  int sorts = 0;
  for (int k = 0; k < 60; ++k) {
    const std::vector<DiskId> order = engine->state().disks.id;
    const long before = allocations.load();
    engine->step();
    const long made = allocations.load() - before;
    const bool sorted = engine->state().disks.id != order;
    sorts += sorted ? 1 : 0;
    sum += made;
  }
  EXPECT_TRUE(sorts > 0 || !engine->state().loads.empty());
  EXPECT_LT(sorts, 30);
  return sum;
}

const std::string gas =
    "[box]\nwidth = 80.0\nheight = 80.0\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
    "top = \"periodic\"\n[[disks]]\ncount = 4000\npositions = \"hexagonal\"\nvelocities = { maxwell = 1.0 }\n"
    "mass = 1.0\n";

class WarmStep : public ::testing::TestWithParam<int> {};
using LongWarmStep = WarmStep;

TEST_P(WarmStep, OfAGasAllocatesNothing) {
  EXPECT_EQ(allocations_when_warm(gas + "radius = 0.5\n", GetParam()), 0);
}

TEST_P(WarmStep, OfMixedRadiiAllocatesNothing) {
  EXPECT_EQ(allocations_when_warm(gas + "radius = { uniform = [0.25, 0.5] }\n", GetParam()), 0);
}

TEST_P(WarmStep, BetweenWallsUnderGravityAllocatesNothing) {
  EXPECT_EQ(allocations_when_warm("[box]\nwidth = 80.0\nheight = 80.0\n[physics]\ngravity = 0.1\n[[disks]]\n"
                                  "count = 4000\npositions = \"square\"\nvelocities = { maxwell = 1.0 }\n"
                                  "radius = 0.5\nmass = 1.0\n",
                                  GetParam()),
            0);
}

// Disks that fell a tiny distance onto each other: supports, their loads and pushing in every step. They find their
// last neighbours later and are sorted less often, so lists need more steps to reach their greatest length.
TEST_P(LongWarmStep, OfAPileAllocatesNothing) {
  EXPECT_EQ(allocations_when_warm("[box]\nwidth = 40.0\nheight = 30.0\nwall_restitution = 0.5\n[physics]\n"
                                  "gravity = 1.0\nrestitution = 0.5\n[[disks]]\ncount = 1000\n"
                                  "positions = \"hexagonal\"\nvelocities = { maxwell = 0.01 }\n"
                                  "radius = { uniform = [0.5, 0.55] }\nmass = 1.0\n",
                                  GetParam(), 3000),
            0);
}

INSTANTIATE_TEST_SUITE_P(Threads, WarmStep, ::testing::Values(1, 2));
INSTANTIATE_TEST_SUITE_P(Threads, LongWarmStep, ::testing::Values(1, 2));

}  // namespace
}  // namespace carom
