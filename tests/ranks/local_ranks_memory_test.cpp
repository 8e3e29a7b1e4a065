// Threads that act as ranks, one of which cannot be started: the others end, and the caller gets an error.
#include <gtest/gtest.h>

#include <new>

#include "parallel/ranks/local_ranks.hpp"
#include "tests/support/failing_memory.hpp"

namespace carom {
namespace {

// Each rank waits for all the others. Starting a thread takes memory of the thread that starts it.
TEST(LocalRanksMemory, RanksEndWhereOneCannotBegin) {
  int failures = 0;
  for (std::size_t n = 0;; ++n) {
    bool ended = false;
    test::with_allocations(n, [&] {
      try {
        run_on_local_ranks(4, [](Ranks& ranks) { ranks.any(false); });
        ended = true;
      } catch (const std::bad_alloc&) {
        ++failures;
      }
    });
    if (ended) break;
    ASSERT_LT(n, 1000U);
  }
  EXPECT_GT(failures, 4);
}

}  // namespace
}  // namespace carom
