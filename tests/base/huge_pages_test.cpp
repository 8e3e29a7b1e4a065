#include "core/base/huge_pages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace carom {
namespace {

constexpr std::size_t many = std::size_t{1} << 18;  // 2 MiB, more than one page of any usual size

TEST(HugePages, ReserveAddsNothing) {
  std::vector<double> v{1.0, 2.0};
  reserve_in_huge_pages(v, many);
  EXPECT_EQ(v, (std::vector<double>{1.0, 2.0}));
  EXPECT_GE(v.capacity(), many);
}

TEST(HugePages, ResizeFillsWithTheValue) {
  std::vector<double> v{1.0};
  resize_in_huge_pages(v, many, 3.0, 2 * many);
  ASSERT_EQ(v.size(), many);
  EXPECT_EQ(v.front(), 1.0);
  EXPECT_TRUE(std::all_of(v.begin() + 1, v.end(), [](double x) { return x == 3.0; }));
  EXPECT_GE(v.capacity(), 2 * many);
}

TEST(HugePages, GrowKeepsTheEntries) {
  std::vector<double> v{1.0, 2.0};
  grow_in_huge_pages(v, many);
  ASSERT_EQ(v.size(), many);
  EXPECT_EQ(v[1], 2.0);
  EXPECT_EQ(v.back(), 0.0);
  const double* const there = v.data();
  grow_in_huge_pages(v, 2);
  grow_in_huge_pages(v, many);
  EXPECT_EQ(v.data(), there) << "there was room";
}

// A long array goes to other memory with its entries, a short one stays.
TEST(HugePages, MoveKeepsTheEntries) {
  std::vector<double> v(4 * many + 1, 7.0), few{1.0, 2.0};
  v[many] = 8.0;
  const std::vector<double> copy = v;
  const double* const there = v.data();
  const double* const few_there = few.data();
  move_to_huge_pages(v);
  move_to_huge_pages(few);
  EXPECT_EQ(v, copy);
  EXPECT_NE(v.data(), there);
  EXPECT_EQ(few.data(), few_there);
}

// Freed memory reads as zero, page by page; other memory is unchanged.
TEST(HugePages, GiveBackWholePagesOfAPartOnly) {
  std::vector<std::uint64_t> v(many, 7);
  const std::size_t begin = many / 4 + 1;
  const std::size_t end = many / 2 + 1;
  give_back_pages(v, begin, end);
  EXPECT_TRUE(std::all_of(v.begin(), v.begin() + begin, [](std::uint64_t x) { return x == 7; }));
  EXPECT_TRUE(std::all_of(v.begin() + end, v.end(), [](std::uint64_t x) { return x == 7; }));
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) / sizeof(v[0]);
  const auto zeros = static_cast<std::size_t>(std::count(v.begin(), v.end(), std::uint64_t{0}));
  EXPECT_EQ(zeros % page, 0U);
  EXPECT_GE(zeros + 2 * page, end - begin);
  EXPECT_LE(zeros, end - begin);
}

// Less than a page is not freed.
TEST(HugePages, GiveBackNothingOfAFewEntries) {
  std::vector<std::uint64_t> v(16, 7);
  give_back_pages(v, 1, 15);
  EXPECT_EQ(v, std::vector<std::uint64_t>(16, 7));
}

}  // namespace
}  // namespace carom
