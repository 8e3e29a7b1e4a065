// The progress line of a run, with a clock set by the test.
#include "app/cli/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/short_number.hpp"

namespace carom {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

struct Clock {
  double now = 1000.0;
  std::vector<std::string> written;

  StatusPlace place(bool terminal, std::size_t columns = 80) {
    return {terminal, columns, [this] { return now; }, [this](const std::string& text) { written.push_back(text); }};
  }
};

State state_at(double time, Count steps) {
  State state;
  state.time = time;
  state.counters.steps = steps;
  return state;
}

TEST(Progress, OffATerminalIsALineAMinute) {
  Clock clock;
  Progress progress(true, 100.0, state_at(0.0, 0), 10, clock.place(false));
  // A run of three and a half minutes, whose line is updated ten times a second; after two minutes it slows down.
  for (int tenth = 1; tenth <= 2100; ++tenth) {
    clock.now += 0.1;
    const double seconds = 0.1 * tenth;
    const double time = seconds < 120.0 ? 0.25 * seconds : 30.0 + 0.125 * (seconds - 120.0);
    progress.update(state_at(time, static_cast<Count>(100.0 * seconds)));
  }
  progress.clear();
  ASSERT_THAT(clock.written, SizeIs(3));
  EXPECT_THAT(clock.written[0],
              ::testing::MatchesRegex("carom:  15\\.. %  t = 15(\\.0..?)? of 100  100 steps/s  .* left\n"));
  for (const std::string& line : clock.written) {
    EXPECT_TRUE(line.starts_with("carom: ") && line.ends_with(" left\n")) << line;
    EXPECT_EQ(line.find('\r'), std::string::npos) << line;
  }
}

TEST(Progress, AShortRunOffATerminalSaysNothing) {
  Clock clock;
  Progress progress(true, 1.0, state_at(0.0, 0), 10, clock.place(false));
  clock.now += 59.0;
  progress.update(state_at(0.5, 10));
  EXPECT_THAT(clock.written, IsEmpty());
}

TEST(Progress, OnATerminalTheLineIsRenewedInPlace) {
  Clock clock;
  {
    Progress progress(true, 10.0, state_at(0.0, 0), 10, clock.place(true, 20));
    for (int k = 1; k <= 3; ++k) {
      clock.now += 0.15;
      progress.update(state_at(k, static_cast<Count>(k)));
    }
  }
  ASSERT_THAT(clock.written, SizeIs(2)) << "one line after 0.3 s, which is removed at the end";
  EXPECT_EQ(clock.written[0], "\r 20.0 %  t = 2 of 1\x1b[K") << "the line must fit into the terminal";
  EXPECT_EQ(clock.written[1], "\r\x1b[K");
}

TEST(Progress, TimeLeftGoesByWhatWasGained) {
  const ProgressPoint then{10.0, 10.0, 1000}, now{14.0, 12.0, 1400};
  EXPECT_EQ(progress_text(then, now, 50, 100.0),
            " 12.0 %  t = 12 of 100  100 steps/s  5 k disk-steps/s  " + duration_text(4.0 * 88.0 / 2.0) + " left");
  EXPECT_EQ(progress_text(then, {14.0, 10.0, 1400}, 50, 100.0), " 10.0 %  t = 10 of 100  100 steps/s  5 k disk-steps/s")
      << "without progress the time left is unknown";
}

// Ten seconds at one unit of time per second, then ten at half of that: earlier rates are forgotten.
TEST(Progress, RatesAreThoseOfTheLastSeconds) {
  Clock clock;
  Progress progress(true, 100.0, state_at(0.0, 0), 10, clock.place(true, 200));
  for (int second = 1; second <= 20; ++second) {
    clock.now += 1.0;
    const double time = second <= 10 ? second : 10.0 + 0.5 * (second - 10);
    progress.update(state_at(time, static_cast<Count>(10 * second)));
  }
  EXPECT_EQ(clock.written.back(),
            "\r 15.0 %  t = 15 of 100  10 steps/s  100 disk-steps/s  " + duration_text(170.0) + " left\x1b[K");
}

// Seconds with five and with fifteen steps in turn: the rate is that of the last five seconds, not of the last one.
TEST(Progress, RatesAreMeansOfMoreThanAMoment) {
  Clock clock;
  Progress progress(true, 100.0, state_at(0.0, 0), 10, clock.place(true, 200));
  Count steps = 0;
  for (int second = 1; second <= 20; ++second) {
    clock.now += 1.0;
    steps += second % 2 == 1 ? 5 : 15;
    progress.update(state_at(second, steps));
  }
  EXPECT_THAT(clock.written.back(), ::testing::HasSubstr("  11 steps/s  110 disk-steps/s"));
}

// Of ten disks three had come from sources, and one had left before; five more come, and one more leaves.
TEST(Progress, DisksAreThoseThatThereAre) {
  Clock clock;
  State state = state_at(0.0, 0);
  state.counters.emitted = 3;
  state.counters.removed = 1;
  Progress progress(true, 100.0, state, 10, clock.place(true, 200));
  clock.now += 1.0;
  state = state_at(1.0, 10);
  state.counters.emitted = 8;
  state.counters.removed = 2;
  progress.update(state);
  EXPECT_THAT(clock.written.back(), ::testing::HasSubstr("  10 steps/s  140 disk-steps/s"));
}

TEST(Progress, ALineIsTakenAwayOnce) {
  Clock clock;
  Progress progress(true, 100.0, state_at(0.0, 0), 10, clock.place(true));
  progress.clear();
  EXPECT_THAT(clock.written, IsEmpty()) << "there is no line yet";
  clock.now += 1.0;
  progress.update(state_at(1.0, 10));
  progress.clear();
  progress.clear();
  EXPECT_THAT(clock.written, SizeIs(2));
}

TEST(Progress, QuietIsQuiet) {
  for (const bool terminal : {false, true}) {
    Clock clock;
    Progress progress(false, 10.0, state_at(0.0, 0), 10, clock.place(terminal));
    clock.now += 1e4;
    progress.update(state_at(1.0, 1));
    progress.clear();
    EXPECT_THAT(clock.written, IsEmpty());
  }
}

}  // namespace
}  // namespace carom
