// Durations of wall time as people write them.
#include "core/base/duration.hpp"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(Duration, NumberAndUnit) {
  EXPECT_EQ(parse_duration("90"), 90.0);
  EXPECT_EQ(parse_duration("0.5s"), 0.5);
  EXPECT_EQ(parse_duration("10 min"), 600.0);
  EXPECT_EQ(parse_duration("2h"), 7200.0);
  EXPECT_EQ(parse_duration("1e3  s"), 1000.0);
}

TEST(Duration, NothingElse) {
  for (const char* const text :
       {"", " ", "min", "10 minutes", "-1 s", "0", "inf", "nan h", "1 s ", "1 h 30 min", "1e308 h"}) {
    EXPECT_EQ(parse_duration(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace carom
