// The search of a rank near its borders, compared with a look at all disks: disks near a border or beyond it, how far
// they have left the slab, which of them the neighbours must see, and the pairs across a border. Disks of three size
// classes have moved since they were sorted into cells, most of them within the margin of the cells, some further:
// these are strays.
#include "parallel/slabs/border_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/physics/disk_pair.hpp"
#include "parallel/stepping/drift_blocks.hpp"
#include "parallel/stepping/find_contacts.hpp"
#include "parallel/stepping/sort_rule.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

constexpr double largest = 0.5;
const SlabCut cut{{0.0, 9.0, 21.0, 30.0}};

Disk drawn_disk(test::Draws& draws, double low, double high, DiskId id) {
  Disk disk;
  disk.x = draws.in(0.0, 14.0);
  disk.y = draws.in(low, high);
  disk.radius = id % 9 == 0 ? largest : draws.in(0.08, largest);
  disk.id = id;
  return disk;
}

// The disks of a rank, sorted into the cells of its slab, and moved since then.
struct Part {
  Part(int rank, bool periodic, double moved, std::uint64_t seed)
      : box(test::box_of(14.0, 30.0, periodic ? test::Periodic::both : test::Periodic::x)),
        slab(slab_of(cut, box, rank)),
        draws(seed) {
    for (DiskId id = 0; id < 260; ++id) push_back(d, drawn_disk(draws, slab.low, slab.high, 2 * id), columns);
    make_grid(box, largest, count_classes(d, largest), cells.grid, stepping_margin);
    keep_rows(cells.grid, slab.low, slab.high);
    sort_into_cells(d, cells.grid, executor, cells.sorted);
    begin_coarse_positions(d, executor, cells);
    for (std::size_t i = 0; i < d.size(); ++i) {
      const double most = stepping_margin * 2.0 * d.radius[i] * (i % 4 == 0 ? moved : 0.6);
      d.vx[i] = draws.in(-most, most);
      d.vy[i] = draws.in(-most, most);
    }
    drift_blocks(d, box, 0.0, 1.0, executor, cells);
  }

  // The distance of disk i from the nearest border of its slab, computed directly; negative beyond it.
  double depth_of(double y) const {
    const Beyond b = beyond(slab, box, y);
    return -std::max(slab.has_lower ? b.lower : -HUGE_VAL, slab.has_upper ? b.upper : -HUGE_VAL);
  }

  static constexpr DiskColumns columns{true, false, false};
  Domain box;
  Slab slab;
  Executor executor{1};
  test::Draws draws;
  Disks d;
  CellList cells;
};

// Calls see() for many parts: each rank of a box with walls and of a periodic one, with and without disks that have
// moved far.
template <class See>
void for_parts(See&& see) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    for (const int rank : {0, 1, 2}) {
      for (const bool periodic : {false, true}) {
        for (const double moved : {1.0, 8.0}) {
          Part part(rank, periodic, moved, seed);
          see(part);
          if (testing::Test::HasFatalFailure()) return;
        }
      }
    }
  }
}

// Heights by hand: 1 below a slab, 1 above it, and across the bottom of a periodic box.
TEST(Beyond, IsTheDistanceFromBothBorders) {
  const Domain walls = test::box_of(14.0, 30.0), periodic = test::box_of(14.0, 30.0, test::Periodic::y);
  const Slab lowest = slab_of(cut, walls, 0), middle = slab_of(cut, walls, 1);
  EXPECT_FALSE(lowest.has_lower);
  EXPECT_TRUE(lowest.has_upper && middle.has_lower && middle.has_upper);
  EXPECT_TRUE(slab_of(cut, periodic, 0).has_lower && slab_of(cut, periodic, 2).has_upper);
  EXPECT_EQ(beyond(middle, walls, 8.0).lower, 1.0);
  EXPECT_EQ(beyond(middle, walls, 22.0).upper, 1.0);
  EXPECT_EQ(beyond(slab_of(cut, periodic, 0), periodic, 29.0).lower, 1.0);
  EXPECT_EQ(beyond(slab_of(cut, periodic, 2), periodic, 1.0).upper, 1.0);
}

TEST(NearBorders, AreAllThatLieWithinTheDepthAndEachOnce) {
  std::size_t found = 0, all = 0;
  for_parts([&](Part& part) {
    std::vector<std::uint32_t> near;
    double furthest = 0.0;
    for (const double y : part.d.y) furthest = std::max(furthest, -part.depth_of(y));
    for (const double depth : {0.0, 0.3, 1.1, 2.9, 7.0}) {
      find_near_borders(part.slab, part.d, part.cells, depth, near);
      std::sort(near.begin(), near.end());
      ASSERT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
      for (std::uint32_t i = 0; i < part.d.size(); ++i) {
        if (part.depth_of(part.d.y[i]) > depth) continue;
        ASSERT_TRUE(std::binary_search(near.begin(), near.end(), i)) << part.d.y[i] << ", depth " << depth;
      }
      ASSERT_EQ(excursion_of(part.slab, part.box, part.d, near), furthest);
      if (depth > 3.0) continue;  // then both borders are near
      found += near.size();
      all += part.d.size();
    }
  });
  EXPECT_LT(found, 3 * all / 5);
}

// A disk must be seen beyond a border if the largest disk, outside its own slab by the excursion, could touch it.
TEST(SeenBeyond, AreAllThatMayTouchADiskThere) {
  for_parts([](Part& part) {
    std::vector<std::uint32_t> near;
    for (const double excursion : {0.0, 0.4}) {
      find_near_borders(part.slab, part.d, part.cells, 2.0 * largest + excursion, near);
      SeenBeyond seen;
      find_seen_beyond(part.slab, part.box, part.d, near, largest, excursion, seen);
      std::vector<DiskId> below, above;
      for (const Disk& disk : seen.below) below.push_back(disk.id);
      for (const Disk& disk : seen.above) above.push_back(disk.id);
      for (std::size_t i = 0; i < part.d.size(); ++i) {
        const Beyond b = beyond(part.slab, part.box, part.d.y[i]);
        const double reach = part.d.radius[i] + largest + excursion;
        if (std::abs(b.lower + reach) < 1e-9 || std::abs(b.upper + reach) < 1e-9) continue;
        ASSERT_EQ(std::count(below.begin(), below.end(), part.d.id[i]), part.slab.has_lower && b.lower > -reach);
        ASSERT_EQ(std::count(above.begin(), above.end(), part.d.id[i]), part.slab.has_upper && b.upper > -reach);
      }
    }
  });
}

TEST(CrossingPairs, AreAllThatTouch) {
  std::size_t pairs = 0;
  for_parts([&](Part& part) {
    FoundContacts found;
    find_contacts(part.d, part.box, part.cells, part.executor, found);
    GhostDisks ghosts;
    ghosts.begin(part.d.size());
    std::vector<Disk> others;
    for (DiskId id = 0; id < 900; ++id) {
      const double border = id % 2 == 0 ? part.slab.low : part.slab.high;
      Disk disk = drawn_disk(part.draws, border - 1.5, border + 1.5, 2 * id + 1);
      disk.y = part.box.periodic_y() ? wrap(disk.y, 30.0) : std::clamp(disk.y, 0.0, 30.0);
      others.push_back(disk);
    }
    ghosts.add(others, lower_border, Part::columns, part.d);
    std::vector<Pair> crossing;
    find_crossing_pairs(part.d, part.box, ghosts, part.cells, found.furthest, crossing);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> expected, there;
    for (const Pair& p : crossing) there.emplace_back(p.i2, p.i1);
    std::sort(there.begin(), there.end());
    for (std::uint32_t g = static_cast<std::uint32_t>(ghosts.own()); g < part.d.size(); ++g) {
      for (std::uint32_t i = 0; i < ghosts.own(); ++i) {
        const Vec2 apart{part.d.x[i] - part.d.x[g], part.d.y[i] - part.d.y[g]};
        const double contact = part.d.radius[i] + part.d.radius[g];
        if (touches(nearest_distance2(apart, part.box), contact)) expected.emplace_back(g, i);
      }
    }
    ASSERT_EQ(there, expected);
    pairs += expected.size();
  });
  EXPECT_GT(pairs, 5000U);
}

}  // namespace
}  // namespace carom
