// The event queue: every event pushed, at any time, is popped once, in order of time, with ties in order of ids.
#include "parallel/exact/event_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "tests/support/draws.hpp"

namespace carom {
namespace {

void keep_ids(QueuedEvent&) {}
void ignore(std::uint32_t) {}

using Fields = std::tuple<double, DiskId, DiskId>;

Fields fields_of(const QueuedEvent& e) {
  return {e.time, e.id1, e.id2};
}

// Events on a later page get their ids when that page is turned to; here the ids are taken from a list, by disk.
std::vector<QueuedEvent> random_events(test::Draws& draws, std::uint32_t count) {
  std::vector<QueuedEvent> events(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    // Times are coarse, so that many are equal; some are before the start or after the end.
    const double time = std::floor(draws.in(-2.0, 12.0) * 8.0) / 8.0;
    events[k] = {time, static_cast<DiskId>(draws.bits() % 7), static_cast<DiskId>(7 + draws.bits() % 9), k};
  }
  return events;
}

TEST(EventQueue, GivesBackWhatWasPushedInCanonicalOrder) {
  test::Draws draws(3);
  EventQueue queue;
  for (const std::size_t expected : {std::size_t{0}, std::size_t{10}, std::size_t{3000}}) {
    const std::vector<QueuedEvent> events = random_events(draws, 500);
    queue.begin(0.0, 10.0, expected);
    for (const QueuedEvent& e : events) queue.push(e);
    std::vector<int> popped(events.size(), 0);
    Fields last{-HUGE_VAL, 0, 0};
    QueuedEvent e;
    while (queue.pop(
        e, [&](QueuedEvent& now) { now = events[now.disk]; }, ignore)) {
      ASSERT_LT(e.disk, events.size());
      EXPECT_EQ(fields_of(e), fields_of(events[e.disk]));
      EXPECT_LE(last, fields_of(e));
      last = fields_of(e);
      ++popped[e.disk];
    }
    EXPECT_EQ(popped, std::vector<int>(events.size(), 1)) << "expected " << expected;
  }
}

// As in a run, every event pushes another one, at its own time or later.
TEST(EventQueue, TakesEventsWhileItGivesBack) {
  test::Draws draws(4);
  EventQueue queue;
  queue.begin(0.0, 1.0, 100);
  using Entry = std::tuple<double, std::uint32_t>;
  std::vector<Entry> pushed;
  std::vector<Entry> popped;
  const auto push = [&](double time, std::uint32_t disk) {
    queue.push({time, 0, 0, disk});
    pushed.emplace_back(time, disk);
  };
  for (std::uint32_t k = 0; k < 100; ++k) push(draws.in(0.0, 0.2), k);
  QueuedEvent e;
  double last = 0.0;
  while (queue.pop(e, keep_ids, ignore)) {
    EXPECT_GE(e.time, last);
    last = e.time;
    popped.emplace_back(e.time, e.disk);
    const double next = e.time + (draws.bits() % 4 == 0 ? 0.0 : draws.in(0.0, 0.1));
    if (next <= 1.0 && popped.size() < 5000) push(next, e.disk);
  }
  EXPECT_GT(popped.size(), 1500U);
  EXPECT_GT(last, 0.9);
  std::sort(pushed.begin(), pushed.end());
  std::sort(popped.begin(), popped.end());
  EXPECT_EQ(popped, pushed);
}

}  // namespace
}  // namespace carom
