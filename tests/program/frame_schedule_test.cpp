// The times of frames: the start, every multiple of an interval, and the end, for any steps in between.
#include "run/loop/frame_schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace carom {
namespace {

using ::testing::ElementsAre;

// The times at which a run with steps of dt makes frames.
std::vector<double> frame_times(FrameSchedule schedule, double dt, double t_end) {
  std::vector<double> times;
  double now = 0.0;
  for (Count step = 0;; ++step) {
    while (const std::optional<double> due = schedule.due(now)) {
      times.push_back(*due);
      schedule.made(*due);
    }
    if (now >= t_end) return times;
    now = std::min(now + dt, t_end);
  }
}

TEST(FrameSchedule, AddedUpStepsMakePunctualFrames) {
  const auto times = frame_times(FrameSchedule(0.1, 0.7, 1e-6), 0.01, 0.7);
  ASSERT_EQ(times.size(), 8U);
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(times[k], 0.1 * static_cast<double>(k), 1e-12);
  EXPECT_EQ(frame_count(0.1, 0.7), 8U);
}

TEST(FrameSchedule, FirstAndLastAlways) {
  EXPECT_THAT(frame_times(FrameSchedule(0.0, 2.0, 0.0), 0.5, 2.0), ElementsAre(0.0, 2.0));
  EXPECT_THAT(frame_times(FrameSchedule(5.0, 2.0, 0.0), 0.5, 2.0), ElementsAre(0.0, 2.0));
  EXPECT_THAT(frame_times(FrameSchedule(0.75, 2.0, 0.0), 2.0, 2.0), ElementsAre(0.0, 0.75, 1.5, 2.0));
  EXPECT_EQ(frame_count(0.0, 2.0), 2U);
  for (const double every : {0.0, 1.0}) {
    EXPECT_THAT(frame_times(FrameSchedule(every, 0.0, 0.0), 1.0, 0.0), ElementsAre(0.0));
    EXPECT_EQ(frame_count(every, 0.0), 1U) << "the first frame is the last";
  }
}

TEST(FrameSchedule, IntervalsFarBelowAStepDoNotHang) {
  FrameSchedule schedule(1e-300, 1.0, 1e-6);
  schedule.made(0.5);
  EXPECT_EQ(schedule.due(0.25), std::nullopt);
  ASSERT_TRUE(schedule.due(0.75).has_value());
  EXPECT_GT(*schedule.due(0.75), 0.5) << "no time may occur twice";
}

// A frame that is a rounding before the last one counts as the last one.
TEST(FrameSchedule, LastFrameSwallowsOneJustBefore) {
  const double t_end = 3.0 + 1e-9;
  FrameSchedule schedule(1.0, t_end, 0.0);
  schedule.made(2.0);
  EXPECT_FALSE(schedule.due(3.0));
  EXPECT_EQ(schedule.due(t_end), t_end);
  EXPECT_EQ(frame_count(1.0, t_end), 4U);
}

// In doubles (start + k * every - start) / every may be less than k: without slack a frame could then be due a second
// time, a rounding later.
TEST(FrameSchedule, NoFrameComesTwiceWhereItsTimeIsRoundedDown) {
  std::size_t rounded_down = 0;
  for (const double start : {0.1, 0.3, 1.38, 7.7}) {
    for (int k = 1; k < 100; ++k) rounded_down += (start + k * 0.1 - start) / 0.1 < k ? 1 : 0;
    const double t_end = start + 100 * 0.1;
    EXPECT_EQ(frame_times(FrameSchedule(0.1, t_end, 0.0, start), t_end, t_end).size(), 101U) << start;
  }
  EXPECT_GT(rounded_down, 10U) << "too few times are rounded down, so this tests nothing";
}

// The sum of steps is a little less than the time of a frame.
TEST(FrameSchedule, FrameIsDueARoundingEarlyWhereStepsAreCounted) {
  FrameSchedule schedule(0.1, 1.0, 1e-6);
  schedule.made(0.0);
  EXPECT_FALSE(schedule.due(0.0999));
  EXPECT_EQ(schedule.due(0.1 - 1e-9), 0.1 - 1e-9);
}

// Frames may begin later than the run, as samples do. In doubles 1.38 + (9.38 - 1.38) is less than 9.38, and a last
// frame at that time would not be the last; 0.3 + (0.9 - 0.3) is more than 0.9, a time that no state has.
TEST(FrameSchedule, TheLastFrameIsAtTheEndWhereverTheFirstIs) {
  EXPECT_THAT(frame_times(FrameSchedule(3.0, 9.38, 0.0, 1.38), 0.5, 9.38), ElementsAre(1.38, 4.38, 7.38, 9.38));
  EXPECT_THAT(frame_times(FrameSchedule(0.0, 9.38, 0.0, 1.38), 0.5, 9.38), ElementsAre(1.38, 9.38));
  EXPECT_THAT(frame_times(FrameSchedule(1.0, 0.9, 1e-6, 0.3), 0.1, 0.9), ElementsAre(0.3, 0.9));
  EXPECT_THAT(frame_times(FrameSchedule(1.0, 2.0, 0.0, 2.0), 0.5, 2.0), ElementsAre(2.0));
}

}  // namespace
}  // namespace carom
