// Tests for ranks of any kind; to be called by all ranks of a run at the same time.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "parallel/ranks/message.hpp"
#include "parallel/ranks/ranks.hpp"

namespace carom::test {

inline void expect_numbered(const Ranks& ranks) {
  ASSERT_GE(ranks.rank(), 0);
  ASSERT_LT(ranks.rank(), ranks.count());
  EXPECT_EQ(ranks.above(), (ranks.rank() + 1) % ranks.count());
  EXPECT_EQ(ranks.below(), (ranks.rank() + ranks.count() - 1) % ranks.count());
}

// A message of `length` numbers that tells its sender and direction.
inline Bytes message_from(int rank, bool up, std::size_t length) {
  std::vector<std::uint64_t> numbers(length);
  std::iota(numbers.begin(), numbers.end(), std::uint64_t{1000} * static_cast<std::uint64_t>(rank) + (up ? 1U : 0U));
  Bytes message;
  put(message, up);
  put_all(message, numbers);
  return message;
}

// Messages of many lengths, empty ones and long ones among them, arrive whole, from the right side, in order.
inline void expect_exchanges(Ranks& ranks) {
  for (std::size_t turn = 0; turn < 40; ++turn) {
    const auto length = [&](int rank) {
      const auto r = static_cast<std::size_t>(rank);
      return turn % 3 == 0 ? 0 : turn % 7 == r % 7 ? 300'000 : 10 * turn + r;
    };
    const auto [below, above] = ranks.exchange(message_from(ranks.rank(), false, length(ranks.rank())),
                                               message_from(ranks.rank(), true, length(ranks.rank())));
    ASSERT_EQ(below, message_from(ranks.below(), true, length(ranks.below()))) << turn;
    ASSERT_EQ(above, message_from(ranks.above(), false, length(ranks.above()))) << turn;
  }
  const auto [below, above] = ranks.exchange({}, {});
  EXPECT_TRUE(below.empty());
  EXPECT_TRUE(above.empty());
}

inline void expect_sums_and_maxima(Ranks& ranks) {
  const std::int64_t n = ranks.count();
  const std::int64_t r = ranks.rank();
  std::vector<std::int64_t> numbers{1, r, -r, (std::int64_t{1} << 53) + 1};
  ranks.sum(numbers);
  EXPECT_EQ(numbers,
            (std::vector<std::int64_t>{n, n * (n - 1) / 2, -n * (n - 1) / 2, n * ((std::int64_t{1} << 53) + 1)}));
  std::vector<double> largest{static_cast<double>(r), -static_cast<double>(r), -HUGE_VAL, r == n - 1 ? HUGE_VAL : 0.1};
  ranks.maximum(largest);
  EXPECT_EQ(largest, (std::vector<double>{static_cast<double>(n - 1), 0.0, -HUGE_VAL, HUGE_VAL}));
  EXPECT_FALSE(ranks.any(false));
  EXPECT_TRUE(ranks.any(true));
  EXPECT_TRUE(ranks.any(r == n / 2));
}

inline void expect_gathers(Ranks& ranks) {
  for (std::size_t turn = 0; turn < 20; ++turn) {
    const std::size_t longest = turn == 5 ? 100'000 : turn;
    const auto length = [&](int rank) { return rank % 2 == 0 ? longest : 0; };
    const std::vector<Bytes> all = ranks.gather(message_from(ranks.rank(), true, length(ranks.rank())));
    ASSERT_EQ(all.size(), static_cast<std::size_t>(ranks.count()));
    for (int r = 0; r < ranks.count(); ++r) {
      ASSERT_EQ(all[static_cast<std::size_t>(r)], message_from(r, true, length(r))) << turn;
    }
    ASSERT_EQ(ranks.collect(message_from(ranks.rank(), true, length(ranks.rank()))),
              ranks.rank() == 0 ? all : std::vector<Bytes>());
    ASSERT_EQ(ranks.share(ranks.rank() == 0 ? all[0] : Bytes()), all[0]);
  }
}

}  // namespace carom::test
