// Disks sent between ranks in many messages: each arrives at the rank whose slab it is in, with all its data, and as a
// ghost at its neighbours.
#include "parallel/slabs/redistribute.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "parallel/ranks/local_ranks.hpp"
#include "parallel/slabs/disk_pieces.hpp"
#include "parallel/slabs/exact_ghosts.hpp"
#include "parallel/slabs/slab_pairwise.hpp"
#include "tests/support/slab_support.hpp"

namespace carom {
namespace {

constexpr DiskId disks = 24000;
constexpr DiskColumns columns{true, false, true};

// All data of a disk follow from its id.
MovingDisk disk_of(DiskId id, double height) {
  const double k = id;
  return {{k, height, k + 0.25, -k, 0.5 + 1e-6 * k, 2.0, id, 3.0 * k}, 10.0 * k, 7 * id};
}

Domain periodic_box() {
  Domain box;
  box.width = disks;
  box.height = 100.0;
  box.sides.fill(SideKind::periodic);
  return box;
}

std::vector<double> random_heights() {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> height(0.0, 100.0);
  std::vector<double> heights(disks);
  for (double& h : heights) h = height(random);
  return heights;
}

// A state without disks, but with entries for all ids.
State empty_state() {
  State state;
  state.disks.common_mass = 2.0;
  state.disks.inertia = 0.5;
  state.last_contact.assign(disks, 0.0);
  state.thermal_hits.assign(disks, 0);
  state.next_id = disks;
  return state;
}

void expect_disk(const State& state, std::size_t i, double height) {
  const DiskId id = state.disks.id[i];
  const MovingDisk expected = disk_of(id, height);
  const MovingDisk found = moving_disk(state, i);
  EXPECT_EQ(found.disk.x, expected.disk.x);
  EXPECT_EQ(found.disk.y, expected.disk.y);
  EXPECT_EQ(found.disk.vx, expected.disk.vx);
  EXPECT_EQ(found.disk.vy, expected.disk.vy);
  EXPECT_EQ(found.disk.radius, expected.disk.radius);
  EXPECT_EQ(found.disk.mass, expected.disk.mass);
  EXPECT_EQ(found.disk.spin, expected.disk.spin);
  EXPECT_EQ(found.last_contact, expected.last_contact);
  EXPECT_EQ(found.thermal_hits, expected.thermal_hits);
}

// The state has exactly the disks for which belongs(height) holds, with all their data.
template <class Belongs>
void expect_disks(const State& state, const std::vector<double>& heights, Belongs&& belongs) {
  std::vector<DiskId> expected;
  for (DiskId id = 0; id < disks; ++id) {
    if (belongs(heights[id])) expected.push_back(id);
  }
  std::vector<DiskId> found = state.disks.id;
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found, expected);
  for (std::size_t i = 0; i < found.size(); ++i) expect_disk(state, i, heights[state.disks.id[i]]);
}

// first_rank(id, to): the rank that first has a disk belonging to rank `to`.
template <class FirstRank>
void expect_sent(int count, FirstRank&& first_rank) {
  const std::vector<double> heights = random_heights();
  SlabCut cut;
  for (int r = 0; r <= count; ++r) cut.bounds.push_back(100.0 * r / count);
  run_on_local_ranks(count, [&](Ranks& ranks) {
    State state = empty_state();
    for (DiskId id = 0; id < disks; ++id) {
      const int to = cut.rank_at(heights[id]);
      if (first_rank(id, to) == ranks.rank()) take_in(state, disk_of(id, heights[id]), columns);
    }
    redistribute(ranks, cut, columns, state);
    expect_disks(state, heights, [&](double h) { return cut.rank_at(h) == ranks.rank(); });
  });
}

TEST(Redistribute, SendsEachDiskToANeighbour) {
  for (const int count : {2, 3, 4}) {
    SCOPED_TRACE(count);
    static_assert(disks / 4 / 2 > disks_a_message, "many messages");
    expect_sent(count, [&](DiskId id, int to) { return (to + (id % 2 == 0 ? 1 : count - 1)) % count; });
    expect_sent(count, [&](DiskId id, int to) { return id % 5 == 0 ? (to + 1) % count : to; });
  }
}

TEST(Redistribute, SendsDisksAnywhere) {
  expect_sent(4, [&](DiskId id, int) { return static_cast<int>(id % 4); });
  expect_sent(4, [&](DiskId, int) { return 0; });
  expect_sent(4, [&](DiskId id, int to) { return id == 100 ? (to + 2) % 4 : to; });
}

TEST(Redistribute, ShowsGhostsInManyMessagesAndDropsThem) {
  constexpr int count = 3;
  constexpr double depth = 20.0;
  const std::vector<double> heights = random_heights();
  const Domain box = periodic_box();
  const SlabCut cut{{0.0, 30.0, 65.0, 100.0}};
  run_on_local_ranks(count, [&](Ranks& ranks) {
    State state = empty_state();
    const auto is_own = [&](double h) { return cut.rank_at(h) == ranks.rank(); };
    for (DiskId id = 0; id < disks; ++id) {
      if (is_own(heights[id])) take_in(state, disk_of(id, heights[id]), columns);
    }
    const Slab slab = slab_of(cut, box, ranks.rank());
    ExactGhosts ghosts(ranks);
    ghosts.see(slab, box, depth, columns, state);
    EXPECT_GT(ghosts.count(), 2 * disks_a_message);
    const auto is_here = [&](double h) {
      const Beyond b = beyond(slab, box, h);
      return is_own(h) || (b.lower > 0.0 ? b.lower < depth : b.upper < depth);
    };
    expect_disks(state, heights, is_here);
    // In another order, as after a sort.
    Disks& d = state.disks;
    for (std::size_t i = 0; 2 * i < d.size(); ++i) {
      const MovingDisk other = moving_disk(state, d.size() - 1 - i);
      copy_within(d, i, d.size() - 1 - i);
      put_at(d, i, other.disk);
    }
    ghosts.find_places(d);
    const std::vector<unsigned char> marks = ghosts.ghosts_among(d.size());
    for (std::size_t i = 0; i < d.size(); ++i) EXPECT_EQ(marks[i] == 0, is_own(d.y[i]));
    EXPECT_EQ(ghosts.own_among(d.size()) + ghosts.count(), d.size());
    ghosts.drop(state);
    expect_disks(state, heights, is_own);
  });
}

// Rank 1 has more disks than fit into one message; none may be lost at the ends of messages.
TEST(CollectOnFirst, BringsAllDisksAndLoadsInManyMessages) {
  const std::vector<double> heights = random_heights();
  run_on_local_ranks(3, [&](Ranks& ranks) {
    State state = empty_state();
    for (DiskId id = 0; id < disks; ++id) {
      const int owner = id % 12 > 1 ? 1 : id % 12 == 0 ? 0 : 2;
      if (owner != ranks.rank()) continue;
      take_in(state, disk_of(id, heights[id]), columns);
    }
    if (ranks.rank() < 2) state.loads = {{7, 9, 2.0}};
    if (ranks.rank() == 2) state.loads = {{1, 7, 1.0}, {8, 9, 3.0}};
    collect_on_first(ranks, columns, state);
    expect_disks(state, heights, [&](double) { return ranks.rank() == 0; });
    if (ranks.rank() > 0) return;
    ASSERT_EQ(state.loads.size(), 3U) << "the load across a border must occur once";
    EXPECT_EQ(state.loads[0].force, 1.0);
    EXPECT_EQ(state.loads[1].force, 2.0);
    EXPECT_EQ(state.loads[2].force, 3.0);
  });
}

// Slabs have about equal numbers of disks, whichever ranks have them: there are ten in the middle of each of a hundred
// rows.
TEST(CutByRowsOfAll, SharesDisksOut) {
  const Domain box = periodic_box();
  for (const int count : {2, 4, 5}) {
    run_on_local_ranks(count, [&](Ranks& ranks) {
      Disks own;
      for (DiskId id = 0; id < 1000; ++id) {
        if (static_cast<int>(id) % count != ranks.rank()) continue;
        append(own, {0.0, (id % 100) + 0.5, 0.0, 0.0, 0.5, 2.0, id});
      }
      const SlabCut cut = cut_by_rows_of_all(ranks, box, own);
      std::vector<int> disks_of(static_cast<std::size_t>(count), 0);
      for (DiskId id = 0; id < 1000; ++id) ++disks_of[static_cast<std::size_t>(cut.rank_at((id % 100) + 0.5))];
      for (const int n : disks_of) EXPECT_EQ(n, 1000 / count);
    });
  }
}

// The first newcomers set the common values of all ranks; values that differ make a column, and do not change those of
// earlier disks.
TEST(TakeNewcomers, KeepsWhatTheOthersHave) {
  const SlabCut cut{{0.0, 5.0, 10.0}};
  const auto newcomers = [](double radius, double mass, DiskId id) {
    Disks some;
    append(some, {1.0, 2.0, 0.0, 0.0, radius, mass, id});
    append(some, {1.0, 8.0, 0.0, 0.0, radius, mass, id + 1});
    return some;
  };
  for (const int rank : {0, 1}) {
    DiskColumns there;
    Disks own;
    take_newcomers(cut, rank, newcomers(0.5, 2.0, 0), true, there, own);
    EXPECT_FALSE(there.radius || there.mass);
    EXPECT_EQ(own.common_radius, 0.5);
    EXPECT_EQ(own.common_mass, 2.0);
    take_newcomers(cut, rank, newcomers(0.5, 3.0, 2), false, there, own);
    EXPECT_TRUE(there.mass && !there.radius);
    take_newcomers(cut, rank, newcomers(0.7, 2.0, 4), false, there, own);
    EXPECT_TRUE(there.mass && there.radius);
    ASSERT_EQ(own.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(own.id[i], 2 * i + static_cast<std::size_t>(rank));
      EXPECT_EQ(own.radius_of(i), i < 2 ? 0.5 : 0.7);
      EXPECT_EQ(own.mass_of(i), i == 1 ? 3.0 : 2.0);
    }
  }
}

// All ranks have the same columns, even if only one has the newcomer, since disks may move to any rank.
TEST(TakeNewcomers, MakesColumnsWhereNoneOfThemIs) {
  const SlabCut cut{{0.0, 5.0, 10.0}};
  DiskColumns there;
  Disks own, first, newcomer;
  append(first, {1.0, 2.0, 0.0, 0.0, 0.5, 2.0, 0});
  append(newcomer, {1.0, 8.0, 0.0, 0.0, 0.7, 3.0, 1});
  take_newcomers(cut, 0, first, true, there, own);
  take_newcomers(cut, 0, newcomer, false, there, own);
  EXPECT_TRUE(there.radius && there.mass);
  EXPECT_EQ(own.radius, std::vector<double>{0.5});
  EXPECT_EQ(own.mass, std::vector<double>{2.0});
}

// Rank 0 starts with all disks, and cuts slabs at once.
TEST(Redistribute, GivesDisksToOtherRanksInManyMessages) {
  const Scene scene = test::slab_scene("hot", "width = 100.0\nheight = 120.0\n",
                                       "count = 7000\npositions = \"square\"\nradius = 0.5\nmass = 1.0\n"
                                       "velocities = { maxwell = 1.0 }\n",
                                       0.02, 10);
  const State start = initial_state(scene);
  const test::SlabTrace expected = test::one_machine_trace(scene, start);
  for (const int count : {2, 3}) {
    run_on_local_ranks(count, [&](Ranks& ranks) {
      const SlabStart slabs = slab_start(scene, start.disks, count);
      State part = start;
      if (ranks.rank() > 0) truncate(part.disks, 0);
      const auto engine = make_slab_part(scene, std::move(part), slabs, {1}, ranks);
      for (const std::uint64_t hash : expected.hashes) {
        engine->step();
        ASSERT_EQ(test::state_hash_over_ranks(ranks, engine->state().disks), hash);
        EXPECT_LT(engine->state().disks.size(), 4000U);
      }
      EXPECT_EQ(engine->state().counters.collisions, expected.counters.collisions);
      EXPECT_EQ(engine->state().counters.wall_collisions, expected.counters.wall_collisions);
    });
  }
}

}  // namespace
}  // namespace carom
