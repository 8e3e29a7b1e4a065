// The times of steps, and the number of parts into which a long step is divided.
#include "core/step/step_clock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

// The message with which a step of 1 time unit, far too long, is refused.
std::string refusal_of(double travel2) {
  try {
    parts_of_step(travel2, 0.0, 1.0);
  } catch (const PhysicsError& error) {
    return error.what();
  }
  return "";
}

TEST(StepClock, TimesAreProducts) {
  const StepClock clock = make_step_clock(0.1, 100.0);
  ASSERT_EQ(clock.steps, 1000U);
  double sum = 0.0;
  for (Count k = 0; k < 999; ++k) {
    EXPECT_EQ(clock.start(k), static_cast<double>(k) * 0.1);
    EXPECT_EQ(clock.end(k), clock.start(k + 1));
    EXPECT_EQ(clock.length(k), 0.1);
    sum += 0.1;
  }
  EXPECT_NE(sum, clock.end(998));  // adding up dt would give another time
  EXPECT_EQ(clock.end(999), 100.0);
  EXPECT_EQ(clock.length(999), 0.1);
}

// Decimal numbers whose quotient is nearly a whole number, a little above or below it.
TEST(StepClock, NearlyWholeQuotients) {
  EXPECT_EQ(make_step_clock(0.1, 0.3).steps, 3U);  // 0.3 / 0.1 < 3
  EXPECT_EQ(make_step_clock(0.01, 10.0).steps, 1000U);
  EXPECT_EQ(make_step_clock(0.001, 4.35).steps, 4350U);
  for (Count n = 1; n < 3000; ++n) {
    const StepClock clock = make_step_clock(0.007, 0.007 * static_cast<double>(n));
    EXPECT_EQ(clock.steps, n);
    EXPECT_EQ(clock.length(n - 1), 0.007);
  }
}

TEST(StepClock, LastStepIsShortWhereTheTimeIsNoMultiple) {
  const StepClock clock = make_step_clock(0.25, 1.0625);
  EXPECT_EQ(clock.steps, 5U);
  EXPECT_EQ(clock.length(3), 0.25);
  EXPECT_EQ(clock.length(4), 0.0625);
  EXPECT_EQ(clock.end(4), 1.0625);
  const StepClock one = make_step_clock(3.0, 1.0);
  EXPECT_EQ(one.steps, 1U);
  EXPECT_EQ(one.length(0), 1.0);
  EXPECT_EQ(make_step_clock(0.1, 0.0).steps, 0U);
}

// Engines end exactly at t_end, when a free disk has moved by v t_end.
TEST(StepClock, EnginesEndAtTheEnd) {
  for (Method method : test::stepping_methods) {
    for (const double dt : {0.25, 0.3, 5.0}) {
      const Scene scene = test::scene_of(method, 10.0, 10.0, dt, 1.0625);
      const State end = test::run(scene, test::state_of(scene, {{2.0, 5.0, 2.0, 0.0, 1.0, 1.0}}));
      EXPECT_EQ(end.time, 1.0625) << test::name_of(method);
      EXPECT_NEAR(end.disks.x[0], 4.125, 1e-14);
      const auto engine = make_reference_engine(scene, end);
      engine->step();  // no time is left, so this must do nothing
      EXPECT_EQ(engine->state().time, 1.0625);
      EXPECT_EQ(engine->state().disks.x[0], end.disks.x[0]);
    }
  }
}

// For disks of any speed the number in the message has few digits.
TEST(Parts, AStepFarTooLongIsSaidInFewDigits) {
  EXPECT_EQ(refusal_of(4e6),
            "run.dt: the fastest disk moves 2000 radii in one step, more than 500; choose a smaller dt "
            "or the exact method");
  EXPECT_THAT(refusal_of(6.25e100), testing::HasSubstr(" moves 2.5e+50 radii "));
}

TEST(Parts, NoDiskMovesMoreThanHalfItsRadius) {
  EXPECT_EQ(parts_of_step(0.0, 0.0, 1.0), 1U);
  EXPECT_EQ(parts_of_step(1.0, 0.0, 0.5), 1U);
  EXPECT_EQ(parts_of_step(1.0, 0.0, 0.501), 2U);
  EXPECT_EQ(parts_of_step(900.0, 0.0, 1.0), 60U);
  EXPECT_EQ(parts_of_step(0.25, 0.5, 1.0), 2U);  // gravity contributes
  EXPECT_EQ(parts_of_step(250000.0, 0.0, 1.0), 1000U);
  test::Draws draws(1);
  for (int k = 0; k < 1000; ++k) {
    const double speed = draws.decades(1e-3, 1e3);  // radii / time
    const double dt = draws.decades(1e-3, 0.4);
    const double part = dt / static_cast<double>(parts_of_step(speed * speed, 0.0, dt));
    EXPECT_LE(speed * part, 0.5 * (1.0 + 1e-14));
  }
}

TEST(Parts, AbsurdStepsAreRefused) {
  EXPECT_THROW(parts_of_step(251000.0, 0.0, 1.0), PhysicsError);
  EXPECT_THROW(parts_of_step(HUGE_VAL, 0.0, 1.0), PhysicsError);
  try {
    parts_of_step(1e12, 0.0, 1.0);
    FAIL();
  } catch (const PhysicsError& error) {
    EXPECT_NE(std::string(error.what()).find("smaller dt"), std::string::npos) << error.what();
  }
}

// A quotient within 1e-9 of a whole number gives that number of steps, and the last one is full; otherwise there is one
// more step, or the last one is short.
TEST(StepClock, AQuotientIsWholeWithinABillionth) {
  for (const double off : {-9e-10, 9e-10}) {
    const StepClock whole = make_step_clock(0.5, 50.0 * (1.0 + off));
    EXPECT_EQ(whole.steps, 100U);
    EXPECT_EQ(whole.length(99), 0.5);
  }
  const StepClock more = make_step_clock(0.5, 50.0 * (1.0 + 1.1e-9));
  EXPECT_EQ(more.steps, 101U);
  EXPECT_NEAR(more.length(100), 5.5e-8, 1e-12);
  const StepClock less = make_step_clock(0.5, 50.0 * (1.0 - 1.1e-9));
  EXPECT_EQ(less.steps, 100U);
  EXPECT_LT(less.length(99), 0.5);
}

// The time summed over a million steps is wrong by at most one rounding of the sum.
TEST(CountStep, AddsUpWithoutDrift) {
  Counters counters;
  for (int k = 0; k < 1000000; ++k) count_step(counters, 0.1);
  EXPECT_EQ(counters.steps, 1000000U);
  EXPECT_NEAR(counters.disk_time, 1e5, 2e-11);
}

}  // namespace
}  // namespace carom
