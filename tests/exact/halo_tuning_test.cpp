// Halos and slices adapt to the needs of the last windows.
#include "parallel/exact/halo_tuning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace carom {
namespace {

// The needs of earlier windows are forgotten when halos are made anew.
TEST(HaloTuning, WidensHalosThatAreTooNarrow) {
  HaloTuning tuning(8.0, true);
  tuning.see_window({});
  tuning.adapt();
  EXPECT_EQ(tuning.spacings(), 8.0) << "no window has needed anything yet";
  tuning.see_window({3.1, 2.0});
  EXPECT_FALSE(tuning.is_too_narrow());
  tuning.see_window({2.9, 2.0});
  tuning.see_window({5.0, 2.0});
  EXPECT_TRUE(tuning.is_too_narrow());
  tuning.adapt();
  EXPECT_FALSE(tuning.is_too_narrow());
  EXPECT_EQ(tuning.spacings(), 8.5);
  EXPECT_EQ(tuning.slices(), 4);
  for (int k = 0; k < 60; ++k) {
    tuning.see_void();
    EXPECT_TRUE(tuning.is_too_narrow());
    tuning.adapt();
    EXPECT_EQ(tuning.slices(), std::min(64, 8 << std::min(k, 3)));
  }
  EXPECT_EQ(tuning.spacings(), 32.0);
}

TEST(HaloTuning, HasFewerSlicesAndThenNarrowerHalos) {
  HaloTuning tuning(5.0, true);
  tuning.see_void();
  tuning.adapt();
  const auto widths = [&] {
    tuning.see_window({4.0, 1.9});
    tuning.adapt();
    return std::pair(tuning.slices(), tuning.spacings());
  };
  EXPECT_EQ(widths(), std::pair(4, 5.5));
  EXPECT_EQ(widths(), std::pair(4, 5.0));
  for (int k = 0; k < 5; ++k) widths();
  EXPECT_EQ(tuning.spacings(), 4.0);
}

TEST(HaloTuning, LeavesAllAsItIsWhereItDoesNotAdapt) {
  HaloTuning tuning(4.0, false);
  tuning.see_void();
  EXPECT_FALSE(tuning.is_too_narrow());
  tuning.adapt();
  EXPECT_EQ(tuning.spacings(), 4.0);
  EXPECT_EQ(tuning.slices(), 4);
}

// Of several slices the largest need counts, separately for each quantity.
TEST(HaloUse, IsOfTheNearestAndTheDeepest) {
  HaloUse use;
  use.see({5.0, 1.0});
  use.see({7.0, 2.0});
  EXPECT_EQ(use.rest(), 3.0);
}

}  // namespace
}  // namespace carom
