// The rows of the neighbour lists: neighbours that do not fit into a row are stored elsewhere, and remain neighbours
// whichever are removed first.
#include "parallel/exact/list_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace carom {
namespace {

std::vector<std::uint32_t> list_of(const ListRows& rows, std::uint32_t i) {
  std::vector<std::uint32_t> list;
  rows.for_each_neighbour(i, [&](std::uint32_t j) { list.push_back(j); });
  std::sort(list.begin(), list.end());
  return list;
}

// Disk 0 and all the others list each other.
ListRows star(std::uint32_t disks) {
  ListRows rows;
  rows.begin(disks, 1);
  rows.clear_block(0);
  for (std::uint32_t i = 0; i < disks; ++i) rows.enter(i, 0, 0);
  std::vector<std::uint32_t> others(disks - 1);
  std::iota(others.begin(), others.end(), 1U);
  rows.replace(0, others, ListRegion{});
  return rows;
}

// When all neighbours in the row are gone, those stored elsewhere must still be found, and be removable.
TEST(ListRows, WhatDidNotFitInARowOutlivesIt) {
  constexpr std::uint32_t disks = ListRows::row_capacity + 9;
  for (const bool from_the_front : {true, false}) {
    ListRows rows = star(disks);
    std::vector<std::uint32_t> expected = list_of(rows, 0);
    ASSERT_EQ(expected.size(), disks - 1U);
    for (std::uint32_t k = 1; k < disks; ++k) {
      const std::uint32_t j = from_the_front ? k : disks - k;
      ASSERT_EQ(list_of(rows, j), std::vector<std::uint32_t>{0});
      rows.replace(j, {}, ListRegion{});
      expected.erase(std::find(expected.begin(), expected.end(), j));
      ASSERT_EQ(list_of(rows, 0), expected) << "without " << j;
      ASSERT_TRUE(list_of(rows, j).empty());
    }
  }
}

// Some of many disks, from three places of the storage. Offsets between two successive places are about the largest and
// the smallest that fit into 16 bits; those between the first and the last place have the same lower 16 bits as offsets
// within a place.
class FewOfMany {
 public:
  static constexpr std::uint32_t a_place = 30, few = 3 * a_place;
  static constexpr std::uint32_t first_of_place[] = {0, 32768, 65536};
  static constexpr std::uint32_t all = 65536 + a_place;

  FewOfMany() : lists_(few) {
    rows_.begin(all, 1);
    rows_.clear_block(0);
    for (std::uint32_t i = 0; i < all; ++i) rows_.enter(i, 0, 0);
  }

  static std::uint32_t disk(std::uint32_t k) { return first_of_place[k / a_place] + k % a_place; }

  // Gives the k-th of these disks this list, by their numbers.
  void replace(std::uint32_t k, const std::set<std::uint32_t>& near) {
    for (const std::uint32_t j : lists_[k]) lists_[j].erase(k);
    for (const std::uint32_t j : near) lists_[j].insert(k);
    lists_[k] = near;
    rows_.replace(disk(k), disks_of(near), ListRegion{});
  }

  const std::set<std::uint32_t>& list(std::uint32_t k) const { return lists_[k]; }
  bool holds(std::uint32_t k) const {
    const std::vector<std::uint32_t> list = list_of(rows_, disk(k));
    return list == disks_of(lists_[k]) && is_padded(disk(k), list);
  }

 private:
  // Is the padding that the kernel reads beyond the ends of rows from the list as well? And is the mark of wide rows
  // right?
  bool is_padded(std::uint32_t i, const std::vector<std::uint32_t>& list) const {
    bool padded = true;
    const auto see = [&](const auto* offset, std::uint32_t count) {
      for (std::uint32_t k = count; k % row_padding != 0; ++k) {
        const std::uint32_t j = i + static_cast<std::uint32_t>(std::int32_t{offset[k]});
        padded = padded && std::binary_search(list.begin(), list.end(), j);
      }
    };
    const ListRow& row = rows_.row(i);
    see(row.offset, row.count);
    rows_.visit_wide_rows(i, see);
    return padded && (row.more != ListRow::none) == ((row.sides & ListRow::has_more) != 0);
  }
  static std::vector<std::uint32_t> disks_of(const std::set<std::uint32_t>& numbers) {
    std::vector<std::uint32_t> disks;
    for (const std::uint32_t k : numbers) disks.push_back(disk(k));
    return disks;
  }

  ListRows rows_;
  std::vector<std::set<std::uint32_t>> lists_;  // the expected lists
};

// -32768 fits into 16 bits, but the offset in the other direction does not.
TEST(ListRows, AnOffsetThatFitsMayNotFitTheOtherWay) {
  FewOfMany rows;
  constexpr std::uint32_t low = 0, high = FewOfMany::a_place, beside = high + 1;
  ASSERT_EQ(FewOfMany::disk(high) - FewOfMany::disk(low), 32768U);
  rows.replace(high, {beside});
  rows.replace(high, {low, beside});
  for (const std::uint32_t k : {low, high, beside}) EXPECT_TRUE(rows.holds(k)) << k;
  rows.replace(high, {beside});
  for (const std::uint32_t k : {low, high, beside}) EXPECT_TRUE(rows.holds(k)) << k;
}

// Lists change a little each time, as when disks are relisted, or are replaced. The greatest length is such that lists
// fit into rows, or just fill one, or are longer. ctest runs this for all kernels.
TEST(ListRows, AreAsTheyWereReplaced) {
  for (const std::uint32_t longest : {6U, ListRows::row_capacity, 40U}) {
    FewOfMany rows;
    std::mt19937 random(longest);
    const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
    for (int turn = 0; turn < 600; ++turn) {
      const std::uint32_t k = below(FewOfMany::few);
      // Most neighbours are in the same place.
      const std::uint32_t own = k / FewOfMany::a_place;
      const std::uint32_t place = below(6) != 0 ? own : below(3);
      std::set<std::uint32_t> near = rows.list(k);
      if (below(20) == 0) near.clear();
      while (near.size() > longest || (!near.empty() && below(2) == 0)) {
        near.erase(std::next(near.begin(), below(near.size())));
      }
      for (std::uint32_t fresh = below(longest); fresh > 0 && near.size() < longest; --fresh) {
        if (const std::uint32_t j = FewOfMany::a_place * place + below(FewOfMany::a_place); j != k) near.insert(j);
      }
      rows.replace(k, near);
      for (std::uint32_t j = 0; j < FewOfMany::few; ++j) {
        ASSERT_TRUE(rows.holds(j)) << "disk " << j << " in turn " << turn << ", lists of " << longest;
      }
    }
  }
}

}  // namespace
}  // namespace carom
