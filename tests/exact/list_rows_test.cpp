// The rows of the neighbour lists: what does not fit in a row lies elsewhere, and stays a neighbour whatever goes
// first.
#include "parallel/exact/list_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace carom {
namespace {

std::vector<std::uint32_t> list_of(const ListRows& rows, std::uint32_t i) {
  std::vector<std::uint32_t> list;
  rows.for_each_neighbour(i, [&](std::uint32_t j) { list.push_back(j); });
  std::sort(list.begin(), list.end());
  return list;
}

// Disk 0 and all others list each other.
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

// Once all that lay in the row are gone, the others are still to be found, and to be taken out.
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

}  // namespace
}  // namespace carom
