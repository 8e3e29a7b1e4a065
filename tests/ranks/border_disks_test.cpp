// Disks that have left their slabs, as known to the ranks, compared with a look at all disks: how far they have left,
// which are at a border, whether all pairs are of neighbouring ranks, and pair distances and psi6.
#include "parallel/slabs/border_disks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "core/measure/bond_correlation.hpp"
#include "core/measure/bond_order.hpp"
#include "core/measure/pair_records.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "parallel/slabs/slab_orders.hpp"
#include "parallel/slabs/slab_pairs.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

constexpr DiskId disks = 320;
constexpr double width = 40.0, height = 60.0;

enum class Way { up, down, both };

// Disks were divided among slabs, the second of which is the thinnest, and have moved since, every fourth one far; in
// some gases the lower part is denser. If they moved both ways, two disks are as close to each other across the second
// slab as is possible.
struct Gas {
  Gas(bool periodic, Way way, double furthest, std::uint64_t seed)
      : box(test::box_of(width, height, periodic ? test::Periodic::both : test::Periodic::x)) {
    test::Draws draws(seed);
    const double thickness = draws.in(6.5, 14.0), low = draws.in(15.0, 17.0);
    cut.bounds = {0.0, low, low + thickness, height};
    if (seed % 2 == 0) cut.bounds.insert(cut.bounds.end() - 1, 0.5 * (low + thickness + height));
    for (DiskId id = 0; id < disks; ++id) {
      const double even = draws.in(0.0, 1.0), before = height * (seed % 3 == 0 ? even * even : even);
      const double most = id % 4 == 0 ? furthest : 0.2 * furthest;
      const double moved = draws.in(way == Way::up ? 0.0 : -most, way == Way::down ? 0.0 : most);
      add({draws.in(0.0, width), before + moved}, draws.in(0.1, 0.5), cut.rank_at(before));
    }
    if (way != Way::both) return;
    add({0.5 * width, cut.high(0) + furthest}, 0.1, 0);
    add({0.5 * width, cut.low(2) - furthest}, 0.1, 2);
  }

  void add(Vec2 place, double radius, int rank) {
    const double y = box.periodic_y() ? wrap(place.y, height) : std::clamp(place.y, 0.0, height);
    push_back(all, {place.x, y, 0.0, 0.0, radius, 1.0, static_cast<DiskId>(owner.size())}, {.radius = true});
    owner.push_back(rank);
  }

  Disks of_rank(int rank) const {
    Disks own;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (owner[i] == rank) push_back(own, disk_at(all, i), {.radius = true});
    }
    return own;
  }
  bool are_neighbours(int one, int other) const {
    const int apart = std::abs(one - other);
    return apart == 1 || (box.periodic_y() && apart == cut.ranks() - 1);
  }
  double distance(std::size_t i, std::size_t k) const {
    return std::sqrt(nearest_distance2({all.x[i] - all.x[k], all.y[i] - all.y[k]}, box));
  }
  // The largest distance of a disk from its slab, across the sides of a periodic box.
  double excursion() const {
    double furthest = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      double left = HUGE_VAL;
      for (const double image : {all.y[i] - height, all.y[i], all.y[i] + height}) {
        left = std::min(left, std::abs(image - std::clamp(image, cut.low(owner[i]), cut.high(owner[i]))));
      }
      furthest = std::max(furthest, left);
    }
    return furthest;
  }
  // The least distance of two disks whose ranks are neither the same nor neighbours; length.
  double least_distance_of_strangers() const {
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if (owner[i] == owner[k] || are_neighbours(owner[i], owner[k])) continue;
        least = std::min(least, distance(i, k));
      }
    }
    return least;
  }

  Domain box;
  SlabCut cut;
  Disks all;
  std::vector<int> owner;
};

// Calls see() for gases in boxes with walls and periodic ones, on three and four ranks.
void for_gases(const std::function<void(const Gas&, std::uint64_t)>& see) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    for (const bool periodic : {false, true}) {
      for (const Way way : {Way::up, Way::down, Way::both}) {
        for (const double furthest : {0.0, 0.7, 2.9}) {
          see(Gas(periodic, way, furthest, seed), seed);
          if (testing::Test::HasFailure()) return;
        }
      }
    }
  }
}

TEST(ExcursionOverRanks, IsThatOfTheDiskFurthestFromItsSlab) {
  for_gases([](const Gas& gas, std::uint64_t) {
    const double expected = gas.excursion();
    run_on_local_ranks(gas.cut.ranks(), [&](Ranks& ranks) {
      const Slab slab = slab_of(gas.cut, gas.box, ranks.rank());
      EXPECT_NEAR(excursion_over_ranks(ranks, slab, gas.box, gas.of_rank(ranks.rank())), expected, 1e-12 * height);
    });
  });
}

// How often each disk occurs among these.
std::vector<int> times_in(const Disks& some) {
  std::vector<int> times(disks + 2, 0);
  for (const DiskId id : some.id) ++times[id];
  return times;
}

// All pairs of two neighbours within reach are found, on both ranks, and no disk that is too deep in its slab for a
// pair.
TEST(DisksAtBorders, AreThoseOfAllPairsOfNeighbours) {
  std::atomic<int> pairs = 0;
  for_gases([&](const Gas& gas, std::uint64_t seed) {
    const double reach = 0.3 * static_cast<double>(seed), excursion = gas.excursion();
    // In a periodic box each of three ranks is a neighbour of both others, so distant disks may also meet across the
    // third.
    const bool all_are_neighbours = gas.are_neighbours(0, 2);
    const double across_border = all_are_neighbours ? gas.cut.thinnest() - 2.0 * excursion : HUGE_VAL;
    run_on_local_ranks(gas.cut.ranks(), [&](Ranks& ranks) {
      const int rank = ranks.rank();
      const Slab slab = slab_of(gas.cut, gas.box, rank);
      const auto border = disks_at_borders(ranks, slab, gas.box, gas.of_rank(rank), reach, excursion);
      const std::vector<int> own = times_in(border.own), others = times_in(border.others);
      for (std::size_t i = 0; i < gas.all.size(); ++i) {
        const Beyond b = beyond(slab, gas.box, gas.all.y[i]);
        const double depth = -std::max(slab.has_lower ? b.lower : -HUGE_VAL, slab.has_upper ? b.upper : -HUGE_VAL);
        const bool deep = depth > gas.all.radius[i] + reach + excursion + 1e-9;
        ASSERT_LE(own[i], gas.owner[i] == rank && !deep ? 1 : 0);
        ASSERT_LE(others[i], gas.are_neighbours(gas.owner[i], rank) ? 1 : 0);
        if (gas.owner[i] != rank) continue;
        for (std::size_t k = 0; k < gas.all.size(); ++k) {
          if (!gas.are_neighbours(gas.owner[k], rank)) continue;
          const double apart = gas.distance(i, k);
          if (apart > std::min(gas.all.radius[i], gas.all.radius[k]) + reach || apart >= across_border) continue;
          ASSERT_TRUE(own[i] == 1 && others[k] == 1) << i << " of " << rank << ", " << k << " of " << gas.owner[k];
          ++pairs;
        }
      }
    });
  });
  EXPECT_GT(pairs, 5000);
}

TEST(IsWithinNeighbours, UnlessTwoDisksOfOtherRanksMayBeInReach) {
  for_gases([](const Gas& gas, std::uint64_t) {
    const double excursion = gas.excursion();
    const double may_be_near = gas.cut.thinnest() - 2.0 * excursion;
    EXPECT_TRUE(is_within_neighbours(gas.cut, gas.box, may_be_near - 1e-6, excursion));
    EXPECT_FALSE(is_within_neighbours(gas.cut, gas.box, may_be_near, excursion));
    EXPECT_FALSE(is_within_neighbours(gas.cut, gas.box, gas.least_distance_of_strangers(), excursion));
  });
}

// The ranks give the right result or say that they cannot; they can if all pairs within reach are of neighbours.
TEST(PairsOverRanks, AreThoseOfAllDisksOrNotKnown) {
  std::atomic<int> known = 0, unknown = 0;
  for_gases([&](const Gas& gas, std::uint64_t seed) {
    AnalysisPlan plan;
    plan.wanted[static_cast<std::size_t>(Quantity::pair_correlation)] = true;
    plan.pairs = {2.0 + 0.7 * static_cast<double>(seed), 30};
    const auto expected = pairs_of_plan(plan, gas.all, gas.box, run_in_order);
    const bool can_tell = is_within_neighbours(gas.cut, gas.box, plan.pairs.r_max, gas.excursion());
    run_on_local_ranks(gas.cut.ranks(), [&](Ranks& ranks) {
      const auto pairs = pairs_over_ranks(ranks, plan, gas.box, gas.of_rank(ranks.rank()), gas.cut, run_in_order);
      ASSERT_EQ(pairs.has_value(), can_tell);
      ++(can_tell ? known : unknown);
      if (!can_tell) return;
      ASSERT_EQ(pairs->size(), 1U);
      EXPECT_EQ(pairs->front().centres, expected.front().centres);
      EXPECT_EQ(pairs->front().counts, expected.front().counts);
    });
  });
  EXPECT_GT(known, 100);
  EXPECT_GT(unknown, 100);
}

// Either all ranks know the result or none does.
TEST(OrdersOverRanks, AreThoseOfAllDisksOrNotKnown) {
  int known = 0, unknown = 0;
  for_gases([&](const Gas& gas, std::uint64_t) {
    const auto expected = bond_orders(gas.all, gas.box);
    std::atomic<int> knowing = 0;
    run_on_local_ranks(gas.cut.ranks(), [&](Ranks& ranks) {
      const auto orders = orders_over_ranks(ranks, {}, gas.box, gas.of_rank(ranks.rank()), gas.cut);
      if (!orders) return;
      ++knowing;
      for (std::size_t i = 0; i < orders->size(); ++i) {
        EXPECT_EQ(orders->vx[i], expected[orders->id[i]].x);
        EXPECT_EQ(orders->vy[i], expected[orders->id[i]].y);
      }
    });
    ++(knowing > 0 ? known : unknown);
    EXPECT_EQ(knowing, knowing > 0 ? gas.cut.ranks() : 0);
  });
  EXPECT_GT(known, 40);
  EXPECT_GT(unknown, 40);
}

// The disks of a rank by their places.
Disks those_of(const Disks& all, const SlabCut& cut, int rank) {
  Disks own;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (cut.rank_at(all.y[i]) == rank) append(own, disk_at(all, i));
  }
  return own;
}

void expect_orders(const std::optional<Disks>& found, const std::vector<Vec2>& expected) {
  ASSERT_TRUE(found.has_value());
  for (std::size_t i = 0; i < found->size(); ++i) {
    ASSERT_EQ(found->vx[i], expected[found->id[i]].x);
    ASSERT_EQ(found->vy[i], expected[found->id[i]].y);
  }
}

// Two crowds, and between them one disk at the border of two slabs, whose neighbours are on both sides and further away
// than in a uniform gas. The ranks must search again: the six neighbours that its own rank knows are not the nearest.
TEST(OrdersOverRanks, AreThoseOfAllDisksWhereNeighboursAreFar) {
  const Domain box = test::box_of(width, height, test::Periodic::x);
  const SlabCut cut{{0.0, 30.0, height}};
  EXPECT_LT(first_reach(box, 401), 7.5);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Draws draws(seed);
    Disks all;
    append(all, {draws.in(0.0, width), 30.01, 0.0, 0.0, 0.1, 1.0, 0});
    for (DiskId id = 1; id <= 400; ++id) {
      const double y = id % 2 == 0 ? draws.in(0.0, 22.5) : draws.in(37.5, height);
      append(all, {draws.in(0.0, width), y, 0.0, 0.0, 0.1, 1.0, id});
    }
    const auto expected = bond_orders(all, box);
    run_on_local_ranks(2, [&](Ranks& ranks) {
      expect_orders(orders_over_ranks(ranks, {}, box, those_of(all, cut, ranks.rank()), cut), expected);
    });
  }
}

// Seven disks in all are enough, however few each rank has.
TEST(OrdersOverRanks, NeedSevenDisksOfAllRanks) {
  const Domain box = test::box_of(width, height, test::Periodic::x);
  const SlabCut cut{{0.0, 0.5 * height, height}};
  AnalysisPlan plan;
  plan.wanted[static_cast<std::size_t>(Quantity::bond_correlation)] = true;
  plan.bonds = {18.0, 5};
  test::Draws draws(3);
  Disks all;
  for (DiskId id = 0; id < 6; ++id) {
    append(all, {draws.in(0.0, width), draws.in(0.0, height), 0.0, 0.0, 0.1, 1.0, id});
  }
  run_on_local_ranks(2, [&](Ranks& ranks) {
    const auto orders = orders_over_ranks(ranks, plan, box, those_of(all, cut, ranks.rank()), cut);
    ASSERT_TRUE(orders.has_value());
    for (const double re : orders->vx) EXPECT_TRUE(std::isnan(re));
    EXPECT_FALSE(bond_pairs_over_ranks(ranks, plan, box, *orders, cut, run_in_order).has_value());
  });
  append(all, {0.5 * width, 0.4 * height, 0.0, 0.0, 0.1, 1.0, 6});
  const auto expected = bond_orders(all, box);
  const BondPairs pairs = bond_pairs(with_orders(all, expected), box, distance_bins(plan.bonds));
  run_on_local_ranks(2, [&](Ranks& ranks) {
    const auto orders = orders_over_ranks(ranks, plan, box, those_of(all, cut, ranks.rank()), cut);
    expect_orders(orders, expected);
    const auto found = bond_pairs_over_ranks(ranks, plan, box, *orders, cut, run_in_order);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->counts, pairs.counts);
  });
}

// These pairs are known up to their own distances, whether or not g(r) is wanted.
TEST(BondPairsOverRanks, AreThoseOfAllDisksOrNotKnown) {
  std::atomic<int> known = 0, unknown = 0;
  for_gases([&](const Gas& gas, std::uint64_t seed) {
    if (seed % 3 != 0) return;  // a third of the cases is enough, on three and four ranks
    AnalysisPlan plan;
    plan.wanted[static_cast<std::size_t>(Quantity::bond_correlation)] = true;
    plan.bonds = {2.0 + static_cast<double>(seed), 30};
    const std::vector<Vec2> psi = bond_orders(gas.all, gas.box);
    const BondPairs expected = bond_pairs(with_orders(gas.all, psi), gas.box, distance_bins(plan.bonds));
    const bool can_tell = is_within_neighbours(gas.cut, gas.box, plan.bonds.r_max, gas.excursion());
    run_on_local_ranks(gas.cut.ranks(), [&](Ranks& ranks) {
      Disks own = gas.of_rank(ranks.rank());
      for (std::size_t i = 0; i < own.size(); ++i) {
        own.vx[i] = psi[own.id[i]].x;
        own.vy[i] = psi[own.id[i]].y;
      }
      const auto pairs = bond_pairs_over_ranks(ranks, plan, gas.box, own, gas.cut, run_in_order);
      ASSERT_EQ(pairs.has_value(), can_tell);
      ++(can_tell ? known : unknown);
      if (!can_tell) return;
      EXPECT_EQ(pairs->counts, expected.counts);
      for (std::size_t k = 0; k < expected.product.size(); ++k) {
        EXPECT_EQ(value_of(pairs->product[k]), value_of(expected.product[k])) << k;
      }
    });
  });
  EXPECT_GT(known, 30);
  EXPECT_GT(unknown, 30);
}

}  // namespace
}  // namespace carom
