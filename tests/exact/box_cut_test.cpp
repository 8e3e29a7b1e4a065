// The box cut into parts: about equal numbers of disks in each, halos of the width asked for, and the parts around a
// part.
#include "parallel/exact/box_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "parallel/exact/disks_of_parts.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

Disks spread(std::size_t count, double width, double height) {
  Disks d;
  d.common_radius = 0.1;
  for (std::size_t k = 0; k < count; ++k) {
    const double u = static_cast<double>((k * 7919) % count) / static_cast<double>(count);
    const double v = static_cast<double>((k * 104729) % count) / static_cast<double>(count);
    append(d, {u * width, v * v * height, 0.0, 0.0, 0.1, 1.0, static_cast<DiskId>(k), 0.0});
  }
  return d;
}

std::vector<std::size_t> parts_at(const BoxCut& cut, Vec2 at) {
  std::vector<std::size_t> parts;
  cut.visit_parts_at(at, [&](std::size_t part) { parts.push_back(part); });
  return parts;
}

TEST(BoxCut, PartsHaveAboutAsManyDisks) {
  const Disks d = spread(3001, 10.0, 40.0);
  for (const test::Periodic along : {test::Periodic::both, test::Periodic::none}) {
    const BoxCut cut = cut_box(d, test::box_of(10.0, 40.0, along), {1, 4}, 1.5);
    ASSERT_EQ(cut.parts(), 4U);
    std::vector<std::size_t> own(4, 0);
    for (std::size_t k = 0; k < d.size(); ++k) ++own[cut.part_at({d.x[k], d.y[k]})];
    // Disks are spread unevenly, but the parts have about equal numbers of them.
    for (const std::size_t count : own) EXPECT_NEAR(static_cast<double>(count), 3001.0 / 4.0, 20.0);
  }
}

TEST(BoxCut, HasTheSameWorkOnBothSidesOfALine) {
  const Disks d = spread(4000, 40.0, 10.0);
  const BoxCut halves = cut_box(d, test::box_of(40.0, 10.0), {2, 1}, 1.0);
  EXPECT_NEAR(halves.x.high(0), 20.0, 0.1);
  // A disk in the right half takes three times as much work, so the right part gets two thirds of that half.
  const BoxCut weighted = cut_box(d, test::box_of(40.0, 10.0), {2, 1}, 1.0, {halves, {1.0, 3.0}});
  EXPECT_NEAR(weighted.x.high(0), 20.0 + 20.0 / 3.0, 0.2);
}

TEST(BoxCut, HalosLieBehindTheEnds) {
  const BoxCut cut = cut_box(spread(3001, 40.0, 10.0), test::box_of(40.0, 10.0, test::Periodic::both), {2, 1}, 3.0);
  const double line = cut.x.high(0);
  EXPECT_EQ(parts_at(cut, {line + 2.9, 5.0}), (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(parts_at(cut, {line + 3.1, 5.0}), (std::vector<std::size_t>{1}));
  EXPECT_EQ(parts_at(cut, {37.1, 5.0}), (std::vector<std::size_t>{1, 0})) << "around the box";
  EXPECT_EQ(parts_at(cut, {36.9, 5.0}), (std::vector<std::size_t>{1}));
  EXPECT_EQ(parts_at(cut, {2.9, 5.0}), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(parts_at(cut, {line - 2.9, 5.0}), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(parts_at(cut, {line - 3.1, 5.0}), (std::vector<std::size_t>{0}));
}

TEST(BoxCut, AtACornerThreePartsHaveAGhost) {
  const BoxCut cut = cut_box(spread(3001, 40.0, 40.0), test::box_of(40.0, 40.0, test::Periodic::both), {3, 3}, 3.0);
  ASSERT_EQ(cut.parts(), 9U);
  const double x = cut.x.high(0), y = cut.y.high(0);
  EXPECT_EQ(parts_at(cut, {x - 1.0, y - 1.0}), (std::vector<std::size_t>{0, 1, 3, 4}));
  const double middle = 0.5 * (cut.y.low(1) + cut.y.high(1));
  EXPECT_EQ(parts_at(cut, {x - 1.0, middle}), (std::vector<std::size_t>{3, 4}));
  EXPECT_EQ(parts_at(cut, {1.0, 1.0}), (std::vector<std::size_t>{0, 2, 6, 8})) << "around the box";
}

TEST(BoxCut, WallsHaveNoHalos) {
  const BoxCut cut = cut_box(spread(1000, 10.0, 40.0), test::box_of(10.0, 40.0), {1, 2}, 3.0);
  EXPECT_EQ(parts_at(cut, {5.0, 39.0}), (std::vector<std::size_t>{1}));
  EXPECT_EQ(parts_at(cut, {5.0, 1.0}), (std::vector<std::size_t>{0}));
  const BoxCut five = cut_box(spread(3001, 40.0, 10.0), test::box_of(40.0, 10.0), {5, 1}, 3.0);
  EXPECT_EQ(parts_at(five, {five.x.low(2) + 1.0, 5.0}), (std::vector<std::size_t>{2, 1}));
  EXPECT_EQ(parts_at(five, {five.x.high(2) - 1.0, 5.0}), (std::vector<std::size_t>{2, 3}));
  // By rounding a disk may be slightly outside the box.
  EXPECT_EQ(cut.part_at({-1e-12, -1e-12}), 0U);
  EXPECT_EQ(cut.part_at({10.0 + 1e-12, 40.0 + 1e-12}), 1U);
}

TEST(BoxCut, PiecesAreNotNarrowerThanHalos) {
  const Disks d = spread(1000, 10.0, 40.0);
  const BoxCut cut = cut_box(d, test::box_of(10.0, 40.0), {64, 64}, 6.0);
  EXPECT_EQ(cut.x.pieces(), 1U);
  EXPECT_LE(cut.y.pieces(), 6U);
  for (std::size_t k = 0; k < cut.y.pieces(); ++k) EXPECT_GE(cut.y.width(k), 6.0 - 1e-9);
}

std::vector<std::size_t> neighbours_of(const BoxCut& cut, std::size_t part) {
  const PartNeighbours all = cut.ends_of(part).neighbours;
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < all.count(); ++k) numbers.push_back(all.part(k));
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

TEST(BoxCut, NeighboursAreThoseAtSidesAndCorners) {
  const Disks d = spread(3001, 40.0, 40.0);
  const BoxCut walls = cut_box(d, test::box_of(40.0, 40.0), {3, 3}, 3.0);
  EXPECT_EQ(neighbours_of(walls, 0), (std::vector<std::size_t>{1, 3, 4}));
  EXPECT_EQ(neighbours_of(walls, 4), (std::vector<std::size_t>{0, 1, 2, 3, 5, 6, 7, 8}));
  const BoxCut ring = cut_box(d, test::box_of(40.0, 40.0, test::Periodic::both), {2, 3}, 3.0);
  EXPECT_EQ(neighbours_of(ring, 0), (std::vector<std::size_t>{1, 2, 3, 4, 5})) << "each neighbour once";
  const PartNeighbours of_first = ring.ends_of(0).neighbours;
  EXPECT_EQ(of_first.bit_towards(1, 0), of_first.bit_towards(-1, 0));
  EXPECT_EQ(of_first.bit_towards(0, -1), of_first.bit_of(4));
  EXPECT_EQ(of_first.bit_of(0), 0U);
}

TEST(BestPieces, HaveTheFewestGhosts) {
  const Domain square = test::box_of(1000.0, 1000.0, test::Periodic::both);
  const auto pieces = [](std::size_t parts, const Domain& box) {
    const PieceCounts best = best_pieces(parts, box, 8.0, 2.0);
    return std::pair(best.x, best.y);
  };
  EXPECT_EQ(pieces(2, square), std::pair(std::size_t{1}, std::size_t{2}));
  EXPECT_EQ(pieces(16, square), std::pair(std::size_t{4}, std::size_t{4}));
  EXPECT_EQ(pieces(16, test::box_of(4000.0, 100.0)), std::pair(std::size_t{16}, std::size_t{1}));
  EXPECT_EQ(pieces(13, test::box_of(200.0, 100.0)), std::pair(std::size_t{1}, std::size_t{1}))
      << "no room for several pieces";
  EXPECT_NEAR(share_with_ghosts({4, 4}, square, 8.0), (1.0 + 64.0 / 1000.0) * (1.0 + 64.0 / 1000.0), 1e-12);
  EXPECT_EQ(share_with_ghosts({1, 1}, square, 8.0), 1.0);
}

// These are the parts given by visit_parts_at, disk by disk.
TEST(DisksOfParts, AreThoseOwnedAndThoseOfHalos) {
  const Disks d = spread(5003, 40.0, 40.0);
  const BoxCut cut = cut_box(d, test::box_of(40.0, 40.0, test::Periodic::both), {3, 2}, 3.0);
  std::vector<DisksOfPart> expected(cut.parts());
  for (std::uint32_t k = 0; k < d.size(); ++k) {
    const Vec2 at{d.x[k], d.y[k]};
    ++expected[cut.part_at(at)].own;
    for (const std::size_t part : parts_at(cut, at)) expected[part].index.push_back(k);
  }
  for (const int threads : {1, 3}) {
    const std::vector<DisksOfPart> found = disks_of_parts(d, cut, Executor(threads, 512));
    ASSERT_EQ(found.size(), 6U);
    for (std::size_t part = 0; part < 6; ++part) {
      EXPECT_EQ(found[part].index, expected[part].index);
      EXPECT_EQ(found[part].own, expected[part].own);
    }
  }
}

}  // namespace
}  // namespace carom
