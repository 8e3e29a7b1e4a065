// The neighbour lists of the exact engine: the disks in them, before and after disks are relisted, and the kernel that
// finds them.
#include "parallel/exact/neighbour_lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/physics/boundary.hpp"
#include "parallel/exact/list_kernel.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

Disks random_disks(test::Draws& draws, std::size_t n, double width, double height, bool mixed) {
  Disks d;
  d.common_radius = 0.5;
  for (std::size_t i = 0; i < n; ++i) {
    d.x.push_back(draws.in(0.0, width));
    d.y.push_back(draws.in(0.0, height));
    d.vx.push_back(0.0);
    d.vy.push_back(0.0);
    d.id.push_back(static_cast<DiskId>(i));
    if (mixed) d.radius.push_back(i % 9 == 0 ? draws.in(1.0, 2.0) : draws.in(0.05, 0.4));
  }
  return d;
}

double apart(double a, double b, double period, bool periodic) {
  const double d = std::abs(a - b);
  return periodic ? std::min(d, period - d) : d;
}

// Disks whose listed positions are within r_i + r_j + 2 skin list each other, once; in all-pairs mode all disks do.
// Listed positions are the given ones, to within rounding.
void expect_complete(const NeighbourLists& lists, const Disks& d, const std::vector<Vec2>& given, const Domain& box) {
  std::vector<Vec2> place;
  for (std::uint32_t i = 0; i < d.size(); ++i) {
    place.push_back(lists.listed_position(i));
    const double tolerance = 1e-9 * (box.width + box.height);
    ASSERT_LE(apart(place[i].x, given[i].x, box.width, box.periodic_x()), tolerance);
    ASSERT_LE(apart(place[i].y, given[i].y, box.height, box.periodic_y()), tolerance);
  }
  for (std::uint32_t i = 0; i < d.size(); ++i) {
    std::vector<std::uint32_t> listed;
    lists.for_each_neighbour(i, [&](std::uint32_t j) { listed.push_back(j); });
    std::sort(listed.begin(), listed.end());
    ASSERT_EQ(std::adjacent_find(listed.begin(), listed.end()), listed.end()) << "disk " << i;
    ASSERT_FALSE(std::binary_search(listed.begin(), listed.end(), i));
    for (std::uint32_t j = 0; j < d.size(); ++j) {
      if (j == i) continue;
      const double dx = apart(place[i].x, place[j].x, box.width, box.periodic_x());
      const double dy = apart(place[i].y, place[j].y, box.height, box.periodic_y());
      const double cutoff = (d.radius_of(i) + d.radius_of(j) + 2.0 * lists.skin()) * (1.0 - 1e-12);
      if (lists.mode() != EngineMode::all_pairs && dx * dx + dy * dy > cutoff * cutoff) continue;
      ASSERT_TRUE(std::binary_search(listed.begin(), listed.end(), j)) << i << " and " << j;
    }
  }
}

// The distance of a place from the nearest periodic border.
double depth_of(Vec2 at, const Domain& box) {
  const double in_x = box.periodic_x() ? std::min(at.x, box.width - at.x) : HUGE_VAL;
  const double in_y = box.periodic_y() ? std::min(at.y, box.height - at.y) : HUGE_VAL;
  return std::min(in_x, in_y);
}

// Checks the marks of lists, which must hold while disks are within the skin of their listed positions: if a list is
// marked as having no images, none of its disks can have crossed a border, and if it does not name a wall, the disk
// cannot touch that wall.
void expect_marks(const NeighbourLists& lists, const Disks& d, const Domain& box) {
  const double skin = lists.skin() * (1.0 - 1e-9);
  int inside = 0;
  for (std::uint32_t i = 0; i < d.size() && lists.mode() != EngineMode::all_pairs; ++i) {
    const ListRow& row = lists.rows().row(i);
    const Vec2 at = lists.listed_position(i);
    for (const Side side : all_sides) {
      if (box.side(side) == SideKind::periodic || (row.sides >> static_cast<unsigned>(side) & 1U) != 0) continue;
      ASSERT_GE(-reach_beyond(side, at.x, at.y, d.radius_of(i), box), skin) << "disk " << i;
    }
    if (!row.is_inside()) continue;
    ++inside;
    ASSERT_GE(depth_of(at, box), skin) << "disk " << i;
    lists.for_each_neighbour(i, [&](std::uint32_t j) {
      EXPECT_GE(depth_of(lists.listed_position(j), box), skin) << "disk " << i << " lists " << j;
    });
  }
  if (lists.mode() != EngineMode::all_pairs) {
    EXPECT_GT(inside, 20);
  }
}

void expect_lists(std::size_t n, const ListLayout& layout, bool mixed, bool periodic) {
  test::Draws draws(n + layout.disks_per_tile);
  Domain box;
  box.width = 40.0;
  box.height = 25.0;
  if (periodic) box.sides.fill(SideKind::periodic);
  Disks d = random_disks(draws, n, box.width, box.height, mixed);
  NeighbourLists lists;
  const Executor executor(2, 64);
  lists.build(d, box, layout, executor);
  EXPECT_EQ(lists.first_disk_of(0), 0U);
  EXPECT_EQ(lists.first_disk_of(lists.tiles()), n);
  std::vector<Vec2> place;
  for (std::size_t i = 0; i < n; ++i) place.push_back({d.x[i], d.y[i]});
  expect_complete(lists, d, place, box);
  expect_marks(lists, d, box);
  FoundNeighbours found;
  for (std::size_t k = 0; k < 2 * n; ++k) {
    const auto i = static_cast<std::uint32_t>(draws.bits() % n);
    place[i] = {draws.in(0.0, box.width), draws.in(0.0, box.height)};
    ASSERT_TRUE(lists.relist(i, place[i], d, ListRegion{}, found));
  }
  expect_complete(lists, d, place, box);
  expect_marks(lists, d, box);
}

TEST(NeighbourLists, HoldAllDisksNear) {
  for (const bool mixed : {false, true}) {
    for (const bool periodic : {false, true}) {
      expect_lists(30, {EngineMode::all_pairs, 0, 0, 1.0, false}, mixed, periodic);
      expect_lists(400, {EngineMode::single_queue, 0, 0, 1.0, false}, mixed, periodic);
      for (const std::size_t disks_per_tile : {1U, 10U, 100U}) {
        expect_lists(400, {EngineMode::regions, disks_per_tile, 2, 0.9, false}, mixed, periodic);
      }
    }
  }
}

bool lists_disk(const NeighbourLists& lists, std::uint32_t i, std::uint32_t j) {
  bool found = false;
  lists.for_each_neighbour(i, [&](std::uint32_t k) { found = found || k == j; });
  return found;
}

// Pairs of disks whose listed positions are about as far apart as lists reach, within a few parts in 10^4, the
// precision of slots and of single precision. Pairs within the reach must list each other; of the others both disks do
// or neither does. Returns the number that did.
int expect_lists_at_reach(const ListLayout& layout, bool mixed, bool periodic, double unit) {
  constexpr std::size_t n = 400;
  constexpr int pairs = 12000;
  test::Draws draws(7);
  Domain box;
  box.width = 40.0 * unit;
  box.height = 25.0 * unit;
  if (periodic) box.sides.fill(SideKind::periodic);
  Disks d = random_disks(draws, n, box.width, box.height, mixed);
  d.common_radius *= unit;
  for (double& radius : d.radius) radius *= unit;
  NeighbourLists lists;
  lists.build(d, box, layout, Executor(1));
  FoundNeighbours found;
  int listed = 0;
  for (int k = 0; k < pairs; ++k) {
    const auto i = static_cast<std::uint32_t>(draws.bits() % n);
    const auto j = static_cast<std::uint32_t>((i + 1 + draws.bits() % (n - 1)) % n);
    const double reach = d.radius_of(i) + d.radius_of(j) + 2.0 * lists.skin();
    const double distance = reach * (1.0 + draws.in(-3e-4, 3e-4));
    Vec2 first{draws.in(0.0, box.width), draws.in(0.0, box.height)};
    double angle = draws.in(0.0, 2.0 * std::numbers::pi);
    if (k % 4 != 0) {
      // Near an axis a single coordinate decides which cells are searched. The reach is made to end at a border of
      // cells, for various numbers of cells.
      const double cells = 2.0 + static_cast<double>(draws.bits() % 32);
      const double share = static_cast<double>(draws.bits() % 32) / cells + draws.in(-5e-6, 5e-6);
      const int quarter = k % 4;
      if (quarter == 2) {
        first.x = share * box.width + reach;
      } else {
        first.y = share * box.height + (quarter == 1 ? -reach : reach);
      }
      if (!(first.x >= 0.0 && first.x < box.width && first.y >= 0.0 && first.y < box.height)) continue;
      angle = 0.5 * std::numbers::pi * quarter + draws.in(-1e-3, 1e-3);
    }
    Vec2 second{first.x + distance * std::cos(angle), first.y + distance * std::sin(angle)};
    if (periodic) second = {wrap(second.x, box.width), wrap(second.y, box.height)};
    if (second.x < 0.0 || second.x > box.width || second.y < 0.0 || second.y > box.height) continue;
    EXPECT_TRUE(lists.relist(i, first, d, ListRegion{}, found) && lists.relist(j, second, d, ListRegion{}, found));
    const Vec2 a = lists.listed_position(i), b = lists.listed_position(j);
    const double dx = apart(a.x, b.x, box.width, periodic), dy = apart(a.y, b.y, box.height, periodic);
    const bool within = std::hypot(dx, dy) <= reach * (1.0 - 1e-12);
    const bool in_list = lists_disk(lists, i, j);
    EXPECT_TRUE(in_list || !within) << "pair " << k << ": " << dx << ", " << dy << " of " << reach;
    EXPECT_EQ(in_list, lists_disk(lists, j, i)) << "pair " << k << ": " << dx << ", " << dy << " of " << reach;
    // The result must not depend on which disk is listed last.
    EXPECT_TRUE(lists.relist(i, first, d, ListRegion{}, found));
    EXPECT_EQ(in_list, lists_disk(lists, i, j)) << "pair " << k << ": " << dx << ", " << dy << " of " << reach;
    listed += in_list ? 1 : 0;
  }
  return listed;
}

TEST(NeighbourLists, AreMutualAtTheEndOfTheirReach) {
  for (const bool mixed : {false, true}) {
    for (const bool periodic : {false, true}) {
      SCOPED_TRACE(testing::Message() << (mixed ? "mixed" : "equal") << (periodic ? ", periodic" : ""));
      EXPECT_GT(expect_lists_at_reach({EngineMode::single_queue, 0, 0, 1.0, false}, mixed, periodic, 1.0), 1000);
      EXPECT_GT(expect_lists_at_reach({EngineMode::regions, 20, 2, 0.9, false}, mixed, periodic, 0x1.7p20), 1000);
    }
  }
}

// While disks are within the skin of their listed positions, the lists must name all disks that a newcomer at any place
// may overlap, and all disks whose centres may be in a rectangle.
TEST(NeighbourLists, NameAllThatMayBeAtAPlace) {
  for (const bool mixed : {false, true}) {
    test::Draws draws(21);
    Domain box;
    box.width = 60.0;
    box.height = 40.0;
    box.sides.fill(SideKind::periodic);
    Disks d = random_disks(draws, 1500, box.width, box.height, mixed);
    NeighbourLists lists;
    lists.build(d, box, {EngineMode::single_queue, 0, 0, 1.0, false}, Executor(1));
    for (int k = 0; k < 300; ++k) {
      const Vec2 at{draws.in(0.0, box.width), draws.in(0.0, box.height)};
      const double radius = draws.in(0.05, 0.5), half = draws.in(0.01, 2.0);
      std::vector<unsigned char> touched(d.size(), 0), near(d.size(), 0);
      lists.visit_possible_overlaps(at.x, at.y, radius, [&](std::uint32_t i) { touched[i] = 1; });
      lists.visit_near(at, half, 0.5 * half, [&](std::uint32_t i) { near[i] = 1; });
      for (std::uint32_t i = 0; i < d.size(); ++i) {
        const Vec2 place = lists.listed_position(i);
        const double dx = apart(place.x, at.x, box.width, true), dy = apart(place.y, at.y, box.height, true);
        const double skin = lists.skin() * (1.0 - 1e-9);
        const bool may_touch = std::hypot(dx, dy) < radius + d.radius_of(i) + skin;
        const bool may_be_in = dx < half + skin && dy < 0.5 * half + skin;
        ASSERT_TRUE(touched[i] != 0 || !may_touch) << "disk " << i;
        ASSERT_TRUE(near[i] != 0 || !may_be_in) << "disk " << i;
      }
    }
  }
}

// Disks at the bottom of a tall box list their neighbours, not the whole pile: about pi 2.05^2 of them, since cutoffs
// are at most 2.05 spacings of the place where they are.
TEST(NeighbourLists, OfAPileInATallBoxAreAsLongAsOfAGas) {
  constexpr std::size_t n = 1000;
  for (const double height : {40.0, 400.0, 40000.0}) {
    test::Draws draws(11);
    Domain box;
    box.width = 40.0;
    box.height = height;
    Disks d = random_disks(draws, n, 40.0, 40.0, false);
    NeighbourLists lists;
    lists.build(d, box, {EngineMode::single_queue, 0, 0, 1.0, false}, Executor(1));
    std::vector<Vec2> place;
    std::size_t listed = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      place.push_back({d.x[i], d.y[i]});
      lists.for_each_neighbour(i, [&](std::uint32_t) { ++listed; });
    }
    expect_complete(lists, d, place, box);
    EXPECT_LT(listed, 18 * n) << "height " << height;
  }
}

// In a sheared box listed positions move with the flow: a disk that does so, too, need not be relisted, wherever it is,
// until the lists are rebuilt.
TEST(NeighbourLists, GoWithTheFlow) {
  constexpr std::size_t n = 1000;
  for (const double rate : {0.3, -20.0}) {
    test::Draws draws(3);
    Domain box;
    box.width = 40.0;
    box.height = 60.0;
    box.sides.fill(SideKind::periodic);
    box.shear = {rate, rate * box.height, 0.0};
    const double start = 1.7;
    box.move_images(start);
    Disks d = random_disks(draws, n, box.width, box.height, false);
    NeighbourLists lists;
    lists.follow_flow(box, start, 0.0);
    lists.build(d, box, {EngineMode::single_queue, 0, 0, 1.0, false}, Executor(1));
    const double until = 0.24 / std::abs(rate);  // strains up to 1/4 are allowed
    ASSERT_FALSE(lists.is_strained(start + until));
    for (std::uint32_t i = 0; i < n; ++i) {
      const PathSegment path{0.0, d.x[i], d.y[i], box.shear.flow(d.y[i], box.height), 0.0};
      ASSERT_GT(lists.earliest_relist_time(i, path, 0.0, 0.0, Gravity(), lists.relist_distance_elsewhere()), until);
      ASSERT_TRUE(lists.stays_listed_bent(i, path, 0.0, until, Gravity(), lists.relist_distance_elsewhere()));
    }
  }
}

// A disk whose new list would reach beyond the region is not relisted, and its list does not change.
TEST(NeighbourLists, KeepToTheirRegion) {
  test::Draws draws(5);
  Domain box;
  box.width = box.height = 60.0;
  box.sides.fill(SideKind::periodic);
  Disks d = random_disks(draws, 2000, 60.0, 60.0, false);
  NeighbourLists lists;
  const Executor executor(1);
  lists.build(d, box, {EngineMode::regions, 100, 2, 0.9, false}, executor);
  const std::uint32_t half = lists.tiles() / 2;
  const ListRegion region = lists.region_of_tiles(0, half);
  FoundNeighbours found;
  int refused = 0;
  int listed = 0;
  for (std::uint32_t i = region.first_disk; i < region.last_disk; ++i) {
    std::vector<std::uint32_t> before;
    lists.for_each_neighbour(i, [&](std::uint32_t j) { before.push_back(j); });
    if (lists.relist(i, {d.x[i], d.y[i]}, d, region, found)) {
      ++listed;
      EXPECT_TRUE(
          std::all_of(found.disks().begin(), found.disks().end(), [&](std::uint32_t j) { return region.holds(j); }));
      continue;
    }
    ++refused;
    std::vector<std::uint32_t> after;
    lists.for_each_neighbour(i, [&](std::uint32_t j) { after.push_back(j); });
    EXPECT_EQ(before, after);
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(listed, refused);
}

// Distances equal to the cutoff, where the last bits decide: if one disk lists the other, the other must list it. The
// sum of three floats depends on their order.
TEST(ListKernel, OfTwoDisksEachFindsTheOther) {
  test::Draws draws(9);
  int near = 0;
  for (int k = 0; k < 200'000; ++k) {
    ListQuery a;
    a.unit_x = a.unit_y = 0x7fff;
    a.cutoff = static_cast<float>(draws.in(20.0, 200.0));
    a.radius = static_cast<float>(draws.in(10.0, 4000.0));
    ListQuery b = a;
    b.radius = static_cast<float>(draws.in(10.0, 4000.0));
    const double reach = static_cast<double>(a.cutoff) + static_cast<double>(a.radius) + static_cast<double>(b.radius);
    const double angle = draws.in(0.0, 1.5707);
    a.position = {30000, 30000};
    b.position.x = static_cast<std::uint16_t>(30000.0 + std::floor(reach * std::cos(angle)));
    const double dx = b.position.x - 30000.0;
    b.position.y = static_cast<std::uint16_t>(30000.0 + std::round(std::sqrt(std::max(reach * reach - dx * dx, 0.0))));
    const bool a_lists_b = is_neighbour(a, b.position, b.radius);
    ASSERT_EQ(a_lists_b, is_neighbour(b, a.position, a.radius)) << a.cutoff << " " << a.radius << " " << b.radius;
    near += a_lists_b ? 1 : 0;
  }
  EXPECT_GT(near, 50'000);
  EXPECT_LT(near, 150'000);
}

TEST(ListKernel, AllVersionsFindTheSame) {
  test::Draws draws(8);
  constexpr std::uint32_t cells = 51;
  constexpr double units_per_length = 0x1p16 / 10.0;
  std::vector<SlotCell> cell(cells);
  std::vector<float> radius;
  for (std::uint32_t s = 0; s < cells * slots_a_cell; ++s) {
    cell[s / slots_a_cell].position[s % slots_a_cell] = {static_cast<std::uint16_t>(draws.bits()),
                                                         static_cast<std::uint16_t>(draws.bits())};
    cell[s / slots_a_cell].disk[s % slots_a_cell] = draws.bits() % 4 == 0 ? empty_slot : s;
    radius.push_back(static_cast<float>(draws.in(0.05, 2.0) * units_per_length));
  }
  std::size_t found = 0;
  for (std::uint32_t round = 0; round < 300; ++round) {
    ListQuery query;
    query.self = static_cast<std::uint32_t>(draws.bits() % radius.size());
    query.position = cell[query.self / slots_a_cell].position[query.self % slots_a_cell];
    query.unit_x = 0x7fff;
    query.unit_y = round % 3 == 0 ? 0x7fff : 26214;
    query.cutoff = static_cast<float>(draws.in(0.2, 3.0) * units_per_length);
    query.radius = static_cast<float>(0.5 * units_per_length);
    const SlotColumns columns{cell.data(), round % 2 == 0 ? radius.data() : nullptr};
    const auto draw = [&](std::uint32_t most) { return 1 + static_cast<std::uint32_t>(draws.bits() % most); };
    const std::uint32_t rows = draw(6);
    const std::uint32_t stride = draw(cells / rows);
    const std::uint32_t width = draw(stride);
    const CellBlock block{draw(cells + 1 - (rows - 1) * stride - width) - 1, width, rows, stride};
    const std::size_t room = std::size_t{rows} * width * slots_a_cell + list_kernel_padding;
    std::vector<std::uint32_t> a(room);
    std::vector<std::uint32_t> b(room);
    a.resize(list_kernel_baseline(query, columns, block, a.data()));
    b.resize(choose_list_kernel()(query, columns, block, b.data()));
    ASSERT_EQ(a, b);
    found += a.size();
  }
  EXPECT_GT(found, 1000U);
}

}  // namespace
}  // namespace carom
