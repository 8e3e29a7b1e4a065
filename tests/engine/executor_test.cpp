// Several executors in one process, as when a user of the library has several simulations.
#include "parallel/threads/executor.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <atomic>
#include <cstddef>
#include <vector>

namespace carom {
namespace {

// oneTBB allows a process the smallest of all limits set in it; an executor that set its own number once took threads
// from the others.
TEST(Executor, TakesNoThreadsFromThoseBesideIt) {
  const Executor few(2), many(6);
  std::atomic<std::size_t> run = 0;
  few.run(64, [&](std::size_t) { ++run; });
  many.run(64, [&](std::size_t) { ++run; });
  EXPECT_EQ(run, 128U);
  using Control = tbb::global_control;
  EXPECT_GE(Control::active_value(Control::max_allowed_parallelism), 6U);
}

// Blocks of 8192 suit a large system, but would divide 10^4 disks into a whole block and a small rest.
TEST(Executor, SharesOutTenThousandItemsEvenly) {
  constexpr std::size_t usual = 8192;
  const Executor executor(2);
  EXPECT_EQ(executor.blocks(0, usual), 0U);
  EXPECT_EQ(executor.blocks(usual, usual), 1U);
  EXPECT_EQ(executor.block_size(10'000, usual), 5000U);
  EXPECT_EQ(executor.blocks(2 * usual, usual), 2U);
  EXPECT_EQ(executor.blocks(2 * usual + 1, usual), 4U);
  EXPECT_EQ(executor.blocks(5 * usual, usual), 8U);
  EXPECT_EQ(executor.blocks(8 * usual, usual), 8U);
  EXPECT_EQ(executor.blocks(8 * usual + 1, usual), 9U);
  EXPECT_EQ(executor.blocks(1025, 1024), 2U);             // blocks this small stay as they are
  EXPECT_EQ(Executor(2, 64).blocks(10'000, usual), 79U);  // of 128 each
}

// Each block runs once, whichever way blocks are distributed.
TEST(Executor, RunsEachBlockOnce) {
  const Executor executor(3);
  for (const std::size_t blocks : {1U, 2U, 4U, 5U, 100U}) {
    std::vector<std::atomic<int>> runs(blocks);
    executor.run_alike(blocks, [&](std::size_t b) { ++runs[b]; });
    executor.run(blocks, [&](std::size_t b) { ++runs[b]; });
    for (const auto& n : runs) EXPECT_EQ(n, 2);
  }
}

TEST(Executor, BlocksCoverAllItemsOnceAndInOrder) {
  for (const std::size_t n : {1U, 8'193U, 16'384U, 16'385U, 65'535U, 100'003U}) {
    const Executor executor(1);
    std::size_t next = 0, count = 0;
    executor.for_ranges(n, 8192, [&](std::size_t b, std::size_t begin, std::size_t end) {
      EXPECT_EQ(b, count++);
      EXPECT_EQ(begin, next);
      EXPECT_LT(begin, end);
      next = end;
    });
    EXPECT_EQ(next, n);
    EXPECT_EQ(count, executor.blocks(n, 8192));
  }
}

}  // namespace
}  // namespace carom
