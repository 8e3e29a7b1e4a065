// Threads that act as ranks do what engines ask of ranks.
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "parallel/ranks/local_ranks.hpp"
#include "tests/support/ranks_support.hpp"

namespace carom {
namespace {

class LocalRanksOf : public ::testing::TestWithParam<int> {
 protected:
  static void on_all(const std::function<void(Ranks&)>& body) { run_on_local_ranks(GetParam(), body); }
};

TEST_P(LocalRanksOf, HaveNumbersFromBottomToTop) {
  std::atomic<int> sum = 0;
  on_all([&](Ranks& ranks) {
    test::expect_numbered(ranks);
    EXPECT_EQ(ranks.count(), GetParam());
    sum += ranks.rank();
  });
  EXPECT_EQ(sum, GetParam() * (GetParam() - 1) / 2);
}

TEST_P(LocalRanksOf, ExchangeMessagesWithTheirNeighbours) {
  on_all(test::expect_exchanges);
}

TEST_P(LocalRanksOf, AgreeOnSumsAndMaxima) {
  on_all(test::expect_sums_and_maxima);
}

TEST_P(LocalRanksOf, Gather) {
  on_all(test::expect_gathers);
}

INSTANTIATE_TEST_SUITE_P(Counts, LocalRanksOf, ::testing::Values(1, 2));
INSTANTIATE_TEST_SUITE_P(LongCounts, LocalRanksOf, ::testing::Values(3, 4, 7));

// If one rank fails all of them end: no rank waits for it, and the caller gets its exception.
TEST(LocalRanks, EndWithTheExceptionOfTheOneThatFails) {
  for (const bool in_exchange : {false, true}) {
    try {
      run_on_local_ranks(4, [&](Ranks& ranks) {
        if (ranks.rank() == 2) throw std::invalid_argument("rank 2");
        if (in_exchange) ranks.exchange({}, {});
        ranks.any(true);
      });
      FAIL() << "no exception";
    } catch (const std::invalid_argument& error) {
      EXPECT_STREQ(error.what(), "rank 2");
    }
  }
}

// The messages that a rank sends, by kind, counted by hand.
TEST(LocalRanks, CountWhatTheySay) {
  for (const int count : {1, 2, 3}) {
    run_on_local_ranks(count, [&](Ranks& ranks) {
      ranks.exchange(Bytes(3), Bytes(5));
      ranks.exchange({}, {});
      std::vector<std::int64_t> numbers{1, 2};
      ranks.sum(numbers);
      double largest = 1.0;
      ranks.maximum({&largest, 1});
      ranks.any(false);
      ranks.gather(Bytes(static_cast<std::size_t>(7 + ranks.rank())));
      const Traffic& t = ranks.traffic();
      const Count others = count > 1 ? 1 : 0;  // a single rank sends nothing to others
      EXPECT_EQ(t.exchange.messages, others * 4);
      EXPECT_EQ(t.exchange.bytes, others * 8);
      EXPECT_EQ(t.all_reduce.messages, others * 3);
      EXPECT_EQ(t.all_reduce.bytes, others * 32);
      EXPECT_EQ(t.gather.messages, others);
      EXPECT_EQ(t.gather.bytes, others * static_cast<Count>(7 + ranks.rank()));
      EXPECT_EQ(t.all().messages, others * 8);
      EXPECT_GT(t.seconds, 0.0);
    });
  }
}

TEST(LocalRanks, RefuseToReduceDifferentNumbersOfValues) {
  EXPECT_THROW(run_on_local_ranks(2,
                                  [](Ranks& ranks) {
                                    std::vector<double> values(ranks.rank() == 0 ? 1 : 2, 0.0);
                                    ranks.maximum(values);
                                  }),
               std::logic_error);
}

TEST(Message, ThatIsTooShortIsRefused) {
  Bytes message;
  put(message, std::uint32_t{7});
  MessageReader reader(message);
  EXPECT_THROW(reader.get<std::uint64_t>(), std::out_of_range);
  EXPECT_EQ(reader.get<std::uint32_t>(), 7U);
  EXPECT_TRUE(reader.at_end());
  Bytes list;
  put(list, std::size_t{1} << 60);  // longer than the message
  EXPECT_THROW(MessageReader(list).get_all<double>(), std::out_of_range);
}

}  // namespace
}  // namespace carom
