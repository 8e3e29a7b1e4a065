// The calendar of events: whatever is pushed when, it comes out in order of time, ties by ids.
#include "parallel/exact/exact_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/support.hpp"

namespace carom {
namespace {

void keep_ids(QueuedEvent&) {}
void ignore(std::uint32_t) {}

// Events that lie on a page not yet turned get their ids when it is: here from a list, by disk.
std::vector<QueuedEvent> random_events(test::Draws& draws, std::uint32_t count) {
  std::vector<QueuedEvent> events(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    // Coarse times, so that many are equal; some before the start and after the end.
    const double time = std::floor(draws.in(-2.0, 12.0) * 8.0) / 8.0;
    events[k] = {time, static_cast<DiskId>(draws.bits() % 7), static_cast<DiskId>(7 + draws.bits() % 9), k};
  }
  return events;
}

TEST(ExactQueue, GivesBackInCanonicalOrder) {
  test::Draws draws(3);
  ExactQueue queue;
  for (const std::size_t expected : {std::size_t{0}, std::size_t{10}, std::size_t{3000}}) {
    const std::vector<QueuedEvent> events = random_events(draws, 500);
    queue.begin(0.0, 10.0, expected);
    for (const QueuedEvent& e : events) queue.push(e);
    std::vector<QueuedEvent> sorted = events;
    std::sort(sorted.begin(), sorted.end(), [](const QueuedEvent& a, const QueuedEvent& b) { return b.after(a); });
    QueuedEvent e;
    for (const QueuedEvent& next : sorted) {
      ASSERT_TRUE(queue.pop(
          e, [&](QueuedEvent& now) { now = events[now.disk]; }, ignore));
      EXPECT_EQ(e.time, next.time);
      EXPECT_EQ(e.id1, next.id1);
      EXPECT_EQ(e.id2, next.id2);
    }
    EXPECT_FALSE(queue.pop(e, keep_ids, ignore));
  }
}

// As in a run: every event that happens puts in another one, at its own time or later.
TEST(ExactQueue, TakesMoreWhileItGivesBack) {
  test::Draws draws(4);
  ExactQueue queue;
  queue.begin(0.0, 1.0, 100);
  for (std::uint32_t k = 0; k < 100; ++k) queue.push({draws.in(0.0, 0.2), 0, 0, k});
  QueuedEvent e;
  double last = 0.0;
  std::size_t happened = 0;
  while (queue.pop(e, keep_ids, ignore)) {
    EXPECT_GE(e.time, last);
    last = e.time;
    ++happened;
    const double next = e.time + (draws.bits() % 4 == 0 ? 0.0 : draws.in(0.0, 0.1));
    if (next <= 1.0 && happened < 5000) queue.push({next, 0, 0, e.disk});
  }
  EXPECT_GT(happened, 1500U);
  EXPECT_GT(last, 0.9);
}

}  // namespace
}  // namespace carom
