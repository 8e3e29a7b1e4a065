// The event calendar: the first event of all disks in order of time, with the given order of ties, for any times.
#include "parallel/exact/event_calendar.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/draws.hpp"

namespace carom {
namespace {

struct Entries {
  explicit Entries(std::uint32_t disks) : entry(disks + 1), number(disks) {}
  CalendarEntries all() { return {entry.data(), 0, number, number}; }
  std::vector<CalendarEntry> entry;
  std::uint32_t number;
};

bool smaller_number(std::uint32_t a, std::uint32_t b) {
  return a < b;
}

// Enters most disks together, and each third one separately.
void enter_all(Entries& entries, EventCalendar& calendar, const std::vector<double>& time) {
  const auto is_alone = [](std::uint32_t k) { return k % 3 == 2; };
  for (std::uint32_t k = 0; k < time.size(); ++k) entries.entry[k].time = is_alone(k) ? 0.0 : time[k];
  calendar.insert_all([&](std::uint32_t k) { return !is_alone(k); });
  for (std::uint32_t k = 0; k < time.size(); ++k) {
    if (is_alone(k)) calendar.enter(k, time[k], smaller_number);
  }
}

// The time from one event of a disk to its next.
struct Pattern {
  std::string name;
  std::function<double(test::Draws&)> wait;
};

const std::vector<Pattern> patterns = {
    {"spread", [](test::Draws& draws) { return -std::log(1.0 - draws.in(0.0, 1.0)); }},
    {"in turns", [](test::Draws&) { return 0.25; }},
    {"many at once", [](test::Draws& draws) { return std::floor(draws.in(0.0, 4.0)); }},
    {"in clusters", [](test::Draws& draws) { return std::floor(draws.in(0.0, 3.0)) + draws.in(0.0, 1e-9); }},
    {"some at the same time", [](test::Draws& draws) { return draws.bits() % 8 == 0 ? 0.0 : draws.in(0.0, 1.0); }},
    {"some never", [](test::Draws& draws) { return draws.bits() % 50 == 0 ? never : draws.in(0.0, 0.5); }},
};

// The order is compared with a search through all disks.
void expect_order(const Pattern& pattern, std::uint32_t disks, std::size_t expected, bool many) {
  test::Draws draws(disks + expected);
  constexpr double start = 0.5;
  constexpr double end = 8.0;
  Entries entries(disks);
  EventCalendar calendar;
  calendar.begin(start, end, entries.all(), expected, many);
  std::vector<double> time(disks);
  for (std::uint32_t k = 0; k < disks; ++k) {
    // Some events are before the start; they come first.
    time[k] = k % 10 == 0 ? draws.in(-1.0, start) : start + pattern.wait(draws);
  }
  enter_all(entries, calendar, time);
  std::uint32_t found = 0;
  double at = 0.0;
  for (int event = 0; event < 4000; ++event) {
    const auto first = static_cast<std::uint32_t>(std::min_element(time.begin(), time.end()) - time.begin());
    const bool any = calendar.find_first(found, at, smaller_number, [](std::uint32_t, int) {});
    ASSERT_EQ(any, time[first] <= end) << pattern.name << ", event " << event;
    if (!any) return;
    ASSERT_EQ(found, first) << pattern.name << ", event " << event;
    ASSERT_EQ(at, time[found]);
    ASSERT_EQ(calendar.time_of(found), time[found]);
    time[found] += pattern.wait(draws);
    calendar.move(found, time[found], smaller_number);
    // The event of another disk moves, too, as it does when a collision changes the path of its partner.
    const auto other = static_cast<std::uint32_t>(draws.bits() % disks);
    time[other] = std::max(time[other], time[found]) + (draws.bits() % 2 == 0 ? 0.0 : pattern.wait(draws));
    calendar.move(other, time[other], smaller_number);
  }
}

TEST(EventCalendar, GivesTheFirstEventOfAllDisks) {
  for (const Pattern& pattern : patterns) {
    for (const std::uint32_t disks : {1U, 3U, 50U, 700U}) {
      for (const std::size_t expected : {std::size_t{0}, std::size_t{10}, std::size_t{20000}}) {
        expect_order(pattern, disks, expected, false);
        expect_order(pattern, disks, expected, true);
      }
    }
  }
}

TEST(EventCalendar, HoldsTheLastMoment) {
  Entries entries(3);
  EventCalendar calendar;
  calendar.begin(0.0, 1.0, entries.all(), 0, false);
  enter_all(entries, calendar, {1.0, std::nextafter(1.0, 2.0), never});
  std::uint32_t found = 9;
  double at = 0.0;
  ASSERT_TRUE(calendar.find_first(found, at, smaller_number, [](std::uint32_t, int) {}));
  EXPECT_EQ(found, 0U);
  calendar.move(0, never, smaller_number);
  for (int k = 0; k < 2; ++k) {
    EXPECT_FALSE(calendar.find_first(found, at, smaller_number, [](std::uint32_t, int) {}))
        << "there must be no event after the end";
  }
}

// More events at the last moment than a page may have before it is shortened: a page without length cannot be
// shortened.
TEST(EventCalendar, HoldsManyAtTheLastMoment) {
  constexpr std::uint32_t disks = 200;
  Entries entries(disks);
  EventCalendar calendar;
  calendar.begin(0.0, 1.0, entries.all(), 0, false);
  enter_all(entries, calendar, std::vector<double>(disks, 1.0));
  std::uint32_t found = 0;
  double at = 0.0;
  for (std::uint32_t k = 0; k < disks; ++k) {
    ASSERT_TRUE(calendar.find_first(found, at, smaller_number, [](std::uint32_t, int) {}));
    ASSERT_EQ(found, k);
    calendar.move(found, never, smaller_number);
  }
  EXPECT_FALSE(calendar.find_first(found, at, smaller_number, [](std::uint32_t, int) {}));
}

// Whether or not all earlier events were processed, after begin() the calendar contains and announces only the disks
// entered since, as the others may not exist any more.
TEST(EventCalendar, BegunAgainHasOtherDisksAlone) {
  for (const int events : {300, 2000}) {
    Entries entries(2000);
    EventCalendar calendar;
    std::uint32_t first = 0;
    std::uint32_t last = 2000;
    for (const int wanted : {events, 100}) {
      const std::uint32_t disks = last - first;
      for (std::uint32_t k = first; k < last; ++k) entries.entry[k].time = (k - first + 0.5) / disks;
      calendar.begin(0.0, 1.0, {entries.entry.data(), first, last, 2000}, disks, true);
      calendar.insert_all([](std::uint32_t) { return true; });
      std::uint32_t found = 0;
      double at = 0.0;
      for (int k = 0; k < wanted; ++k) {
        const auto soon = [&](std::uint32_t disk, int) { EXPECT_TRUE(disk >= first && disk < last) << disk; };
        ASSERT_TRUE(calendar.find_first(found, at, smaller_number, soon));
        ASSERT_EQ(found, first + static_cast<std::uint32_t>(k));
        calendar.move(found, k % 2 == 0 ? never : at + 2.0, smaller_number);
        if (testing::Test::HasFailure()) return;
      }
      first = 1500;
      last = 1600;
    }
  }
}

// Disks taken out have no event until they are moved in again, some of them to a time that has passed.
TEST(EventCalendar, ForgetsDisksThatAreOut) {
  for (const bool many : {false, true}) {
    test::Draws draws(7);
    constexpr std::uint32_t disks = 300;
    Entries entries(disks);
    EventCalendar calendar;
    calendar.begin(0.0, 4.0, entries.all(), 2000, many);
    std::vector<double> time(disks);
    std::vector<bool> out(disks);
    for (std::uint32_t k = 0; k < disks; ++k) {
      time[k] = draws.in(0.0, 1.0);
      out[k] = k % 7 == 0;
      entries.entry[k].time = time[k];
    }
    calendar.insert_all([&](std::uint32_t k) { return !out[k]; });
    for (int event = 0; event < 3000; ++event) {
      std::uint32_t first = disks;
      for (std::uint32_t k = 0; k < disks; ++k) {
        if (!out[k] && (first == disks || time[k] < time[first])) first = k;
      }
      std::uint32_t found = disks;
      double at = 0.0;
      const bool any = calendar.find_first(found, at, smaller_number, [](std::uint32_t, int) {});
      ASSERT_EQ(any, time[first] <= 4.0) << "event " << event;
      if (!any) break;
      ASSERT_EQ(found, first) << "event " << event;
      time[found] += draws.in(0.0, 0.3);
      calendar.move(found, time[found], smaller_number);
      const auto other = static_cast<std::uint32_t>(draws.bits() % disks);
      if (out[other]) {
        time[other] = calendar.time_of(first) - (event % 2 == 0 ? 0.0 : 0.1);
        calendar.move(other, time[other], smaller_number);
      } else {
        calendar.take_out(other);
        ASSERT_EQ(calendar.time_of(other), time[other]);
      }
      out[other] = !out[other];
      ASSERT_EQ(calendar.holds(other), !out[other]);
    }
  }
}

// The number of disks announced at all stages, in order, before their events. expected: as in EventCalendar::begin().
std::uint32_t announced_in_time(const std::vector<double>& time, std::size_t expected) {
  const auto disks = static_cast<std::uint32_t>(time.size());
  Entries entries(disks);
  EventCalendar calendar;
  calendar.begin(0.0, 1.0, entries.all(), expected, true);
  enter_all(entries, calendar, time);
  std::vector<int> announced(disks, 0);
  const auto soon = [&](std::uint32_t k, int stage) {
    if (announced[k] == stage) ++announced[k];
  };
  std::uint32_t found = 0;
  std::uint32_t in_time = 0;
  double at = 0.0;
  while (calendar.find_first(found, at, smaller_number, soon)) {
    in_time += announced[found] == EventCalendar::stages ? 1U : 0U;
    calendar.move(found, never, smaller_number);
  }
  return in_time;
}

TEST(EventCalendar, AnnouncesWhatComesSoon) {
  std::vector<double> time(2000);
  for (std::size_t k = 0; k < time.size(); ++k) time[k] = (static_cast<double>(k) + 0.5) / 2000.0;
  EXPECT_GT(announced_in_time(time, time.size()), 1800U);
}

// Times are random, and two disks have each of them, as in a collision. A page has one disk on average, so a quarter of
// the disks are behind the second one of their page. Disks may be announced too late only where pages are empty.
TEST(EventCalendar, AnnouncesAllDisksOfAPage) {
  test::Draws draws(11);
  std::vector<double> time(20000);
  for (std::size_t k = 0; k < time.size(); k += 2) time[k] = time[k + 1] = draws.in(0.0, 1.0);
  EXPECT_GT(announced_in_time(time, 12500), 16000U);
}

}  // namespace
}  // namespace carom
