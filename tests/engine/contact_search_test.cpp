// The engine's search in sorted cells, compared with a test of all pairs, in scenes that are hard for a grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "parallel/stepping/drift_blocks.hpp"
#include "parallel/stepping/find_contacts.hpp"
#include "tests/support/all_pairs.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

using test::box_of;
using test::Periodic;
using test::periodic_along;

struct Searched {
  std::vector<Pair> pairs;  // by their ids
  std::size_t strays = 0;
};

std::vector<Pair> as_ids(const std::vector<Pair>& pairs, const Disks& d) {
  std::vector<Pair> ids;
  for (const Pair& p : pairs) {
    const Pair q = in_id_order(d.id.data(), p);
    ids.push_back({d.id[q.i1], d.id[q.i2]});
  }
  std::sort(ids.begin(), ids.end(),
            [](const Pair& a, const Pair& b) { return a.i1 != b.i1 ? a.i1 < b.i1 : a.i2 < b.i2; });
  return ids;
}

CellGrid grid_for(const Disks& d, const Domain& box) {
  const double largest = largest_radius(d);
  return make_grid(box, largest, count_classes(d, largest));
}

// Sorts the disks, moves each of them by up to `moved` of its radius, and searches. found: is reused for further
// searches, as an engine does, since making it takes longer than searching.
Searched search(Disks d, const Domain& box, double moved, int threads, std::size_t divisor, FoundContacts& found,
                Disks* at_search = nullptr) {
  const Executor executor(threads, divisor);
  CellList cells;
  cells.grid = grid_for(d, box);
  sort_into_cells(d, cells.grid, executor, cells.sorted);
  for (std::size_t i = 0; i < d.size(); ++i) {
    const TwoUniforms u = uniforms(99, Stream::velocity, d.id[i], 0);
    const double step = moved * d.radius_of(i);
    d.x[i] += step * (2.0 * u.a - 1.0);
    d.y[i] += step * (2.0 * u.b - 1.0);
    if (box.periodic_x()) d.x[i] = wrap(d.x[i], box.width);
    if (box.periodic_y()) d.y[i] = wrap(d.y[i], box.height);
  }
  begin_coarse_positions(d, executor, cells);
  note_coarse_positions(d, box, executor, cells);
  Searched result;
  result.strays = find_contacts(d, box, cells, executor, found);
  std::vector<Pair> pairs;
  for (std::size_t b = 0; b < found.used; ++b) {
    pairs.insert(pairs.end(), found.buffers[b].begin(), found.buffers[b].end());
  }
  result.pairs = as_ids(pairs, d);
  if (at_search != nullptr) *at_search = d;
  return result;
}

// n disks anywhere in the box and a little beyond, which may overlap; radii from small to large, log-uniform.
Disks scattered(const Domain& box, std::size_t n, double small, double large, std::uint64_t seed) {
  Disks d;
  for (std::size_t i = 0; i < n; ++i) {
    const auto id = static_cast<DiskId>(i);
    const TwoUniforms place = uniforms(seed, Stream::position, id, 0);
    const TwoUniforms size = uniforms(seed, Stream::radius, id, 0);
    const double r = small * std::pow(large / small, size.a);
    const double beyond_x = box.periodic_x() ? 0.0 : 0.02 * box.width;
    const double beyond_y = box.periodic_y() ? 0.0 : 0.02 * box.height;
    append(d, {(box.width + 2 * beyond_x) * place.a - beyond_x, (box.height + 2 * beyond_y) * place.b - beyond_y, 0, 0,
               r, 1.0, id});
  }
  return d;
}

void expect_all_pairs(const Disks& d, const Domain& box, double moved, FoundContacts& found) {
  Disks now;
  const Searched one = search(d, box, moved, 1, 1, found, &now);
  EXPECT_EQ(one.pairs, as_ids(test::touching_among_all_pairs(now, box), now));
  EXPECT_EQ(one.pairs, search(d, box, moved, 3, 4096, found).pairs);
}

void expect_all_pairs(const Disks& d, const Domain& box, double moved) {
  FoundContacts found;
  expect_all_pairs(d, box, moved, found);
}

class ContactSearch : public ::testing::TestWithParam<int> {};

TEST_P(ContactSearch, FindsAllPairsOfScatteredDisks) {
  const bool px = (GetParam() & 1) != 0;
  const bool py = (GetParam() & 2) != 0;
  FoundContacts found;
  for (const double ratio : {1.0, 1.9, 5.0, 100.0, 1000.0}) {
    for (const auto& [width, height] : {std::pair{50.0, 40.0}, {300.0, 9.0}, {9.0, 300.0}}) {
      SCOPED_TRACE(ratio);
      SCOPED_TRACE(width);
      const Domain box = box_of(width, height, periodic_along(px, py));
      const double large = ratio > 10.0 ? 2.0 : 0.6;
      expect_all_pairs(scattered(box, 700, large / ratio, large, 5), box, 0.0, found);
      expect_all_pairs(scattered(box, 700, large / ratio, large, 6), box, 0.19, found);
      expect_all_pairs(scattered(box, 700, large / ratio, large, 7), box, 1.5, found);
    }
  }
}

// A few disks that reach over one, several or very many cells of small disks, and small disks near a crowd of larger
// ones in a few cells.
TEST_P(ContactSearch, FindsPairsOfFewLargeDisksAmongManySmallOnes) {
  const Domain box = box_of(24.0, 20.0, periodic_along((GetParam() & 1) != 0, (GetParam() & 2) != 0));
  const Domain corner = box_of(8.0, 6.0);
  Disks d = scattered(box, 6000, 0.05, 0.07, 21);
  for (const Disks& more : {scattered(corner, 150, 0.14, 0.22, 22), scattered(box, 5, 3.0, 6.0, 23)}) {
    for (std::size_t i = 0; i < more.size(); ++i)
      append(d, {more.x[i], more.y[i], 0, 0, more.radius_of(i), 1.0, static_cast<DiskId>(d.size())});
  }
  expect_all_pairs(d, box, 0.0);
  expect_all_pairs(d, box, 0.19);
}

TEST_P(ContactSearch, FindsPairsOnEdgesAndCorners) {
  const bool px = (GetParam() & 1) != 0;
  const bool py = (GetParam() & 2) != 0;
  const Domain box = box_of(24.0, 12.0, periodic_along(px, py));
  Disks d;
  DiskId id = 0;
  // Touching disks whose centres lie exactly on edges and corners of cells and on the box's edge.
  for (int i = 0; i < 24; ++i) {
    for (int j = 0; j < 12; ++j) append(d, {i * 1.0, j * 1.0, 0, 0, 0.5, 1.0, id++});
  }
  expect_all_pairs(d, box, 0.0);
}

// The positions used by the search are rounded to a few thousandths of a diameter.
TEST_P(ContactSearch, FindsPairsThatOnlyJustTouch) {
  const Domain box = box_of(400.0, 320.0, periodic_along((GetParam() & 1) != 0, (GetParam() & 2) != 0));
  for (const double ratio : {1.0, 1.5, 0.3, 0.02}) {  // the last two have several size classes
    Disks d;
    for (DiskId id = 0; id < 8000; id += 2) {
      const TwoUniforms place = uniforms(11, Stream::position, id, 0);
      const TwoUniforms other = uniforms(11, Stream::radius, id, 0);
      const double radius = 0.5 * std::pow(ratio, other.b);
      const double x = 5.0 * (id / 2 % 80) + 1.5 + 0.9 * place.a;
      const double y = 5.0 * (id / 160) + 1.5 + 0.9 * place.b;
      const double apart = (0.5 + radius) * (1.0 - 1e-12);
      append(d, {x, y, 0, 0, 0.5, 1.0, id});
      append(d,
             {x + apart * std::cos(6.28 * other.a), y + apart * std::sin(6.28 * other.a), 0, 0, radius, 1.0, id + 1});
    }
    FoundContacts found;
    EXPECT_EQ(search(d, box, 0.0, 1, 1, found).pairs.size(), 4000U) << ratio;
  }
}

TEST_P(ContactSearch, FindsPairsInOneCellAndAmongEmptyOnes) {
  const bool px = (GetParam() & 1) != 0;
  const bool py = (GetParam() & 2) != 0;
  const Domain one_cell = box_of(4.5, 4.5, periodic_along(px, py));
  expect_all_pairs(scattered(one_cell, 12, 1.0, 1.0, 7), one_cell, 0.1);
  const Domain empty = box_of(1e4, 1e4, periodic_along(px, py));
  Disks d;
  append(d, {0.1, 0.1, 0, 0, 1.0, 1.0, 0});
  append(d, {9999.5, 9999.5, 0, 0, 1.0, 1.0, 1});
  append(d, {5000.0, 0.2, 0, 0, 1.0, 1.0, 2});
  append(d, {5001.0, 9999.8, 0, 0, 1.0, 1.0, 3});
  expect_all_pairs(d, empty, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Sides, ContactSearch, ::testing::Values(0, 1, 2, 3));

// Disks that have left their cells by more than the margin are strays: they must be noticed, and no pair may be missed.
TEST(ContactSearchStrays, AreNoticedAndSearchedFor) {
  const Domain box = box_of(50.0, 40.0, Periodic::both);
  const Disks d = scattered(box, 500, 0.5, 0.5, 8);
  FoundContacts found;
  EXPECT_EQ(search(d, box, 0.0, 1, 1, found).strays, 0U);
  EXPECT_GT(search(d, box, 1.5, 1, 1, found).strays, 20U);
  for (const double moved : {0.3, 0.6, 1.5, 5.0}) expect_all_pairs(d, box, moved);
}

// The counting sort: keys ascend, no disk is lost, disks of a cell keep their order, and the number of threads does not
// matter.
TEST(CountingSort, IsStableAndIndependentOfThreads) {
  const Domain box = box_of(60.0, 45.0);
  const Disks start = scattered(box, 5000, 0.1, 0.9, 9);
  const CellGrid grid = grid_for(start, box);
  Disks expected;
  for (const auto& [threads, divisor] : {std::pair{1, 1U}, {3, 100U}, {8, 30000U}}) {
    Disks d = start;
    SortedCells cells;
    sort_into_cells(d, grid, Executor(threads, divisor), cells);
    ASSERT_TRUE(std::is_sorted(cells.key.begin(), cells.key.end()));
    for (std::size_t i = 0; i + 1 < d.size(); ++i) {
      if (cells.key[i] == cells.key[i + 1]) {
        ASSERT_LT(d.id[i], d.id[i + 1]);
      }
    }
    for (std::size_t i = 0; i < d.size(); ++i) {
      ASSERT_GE(i, cells.start[cells.key[i]]);
      ASSERT_LT(i, cells.start[cells.key[i] + 1]);
      ASSERT_EQ(d.x[i], start.x[d.id[i]]);
      ASSERT_EQ(d.radius[i], start.radius[d.id[i]]);
    }
    if (expected.empty()) expected = d;
    EXPECT_EQ(d.id, expected.id);
  }
}

}  // namespace
}  // namespace carom
