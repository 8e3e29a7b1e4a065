// Several executors in one process, as several simulations of a library's user have.
#include "parallel/threads/executor.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <atomic>
#include <cstddef>

namespace carom {
namespace {

// What oneTBB allows a process is the least of all limits that are set in it: an executor that set its own number took
// threads from those beside it.
TEST(Executor, TakesNoThreadsFromThoseBesideIt) {
  const Executor few(2), many(6);
  std::atomic<std::size_t> run = 0;
  few.run(64, [&](std::size_t) { ++run; });
  many.run(64, [&](std::size_t) { ++run; });
  EXPECT_EQ(run, 128U);
  using Control = tbb::global_control;
  EXPECT_GE(Control::active_value(Control::max_allowed_parallelism), 6U);
}

}  // namespace
}  // namespace carom
