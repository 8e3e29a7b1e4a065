// The disks known to a rank of `exact` that it does not own, compared with a look at all disks: the band that no
// unknown disk enters, when new ghosts are due, when unknown disks come too near, and the answers of neighbours.
#include "parallel/slabs/exact_ghosts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <tuple>
#include <vector>

#include "parallel/exact/window_state.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "parallel/slabs/border_search.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

constexpr DiskId disks = 90;
constexpr double height = 100.0, depth = 27.0;
constexpr double thinnest = 30.0;
const SlabCut cut{{0.0, 35.0, 65.0, height}};
const Approach approach{3.0, 1.5, thinnest};

// clear: the part of the middle slab that the lowest and the highest rank do not know is empty, and for each of them
// the nearest unknown disks are those of the other.
double first_height(test::Draws& draws, DiskId id, bool clear) {
  const double y = draws.in(0.0, height);
  if (!clear) return y;
  if (id % 9 == 0) return 65.05;
  return y > 35.0 && y < 65.0 ? 45.0 + (y - 35.0) / 3.0 : y;
}

// The height of each disk when ghosts were chosen, and now.
struct Heights {
  Heights(bool periodic, double moved, std::uint64_t seed)
      : box(test::box_of(50.0, height, periodic ? test::Periodic::both : test::Periodic::x)) {
    test::Draws draws(seed);
    for (DiskId id = 0; id < disks; ++id) {
      before.push_back(first_height(draws, id, seed % 4 == 1));
      const double y = before.back() + (id % 3 == 0 ? draws.in(-moved, moved) : draws.in(-0.5, 0.5));
      now.push_back(periodic ? wrap(y, height) : std::clamp(y, 0.0, height));
    }
  }

  Domain box;
  std::vector<double> before, now;
};

// A rank with its disks and ghosts at their present places.
struct Part {
  Part(Ranks& r, const Heights& all) : ranks(r), heights(all), slab(slab_of(cut, all.box, r.rank())), ghosts(r) {
    const DiskColumns columns{};
    for (DiskId id = 0; id < disks; ++id) {
      if (is_own(id)) push_back(state.disks, {1.0, all.before[id], 0.0, 0.0, 0.1, 1.0, id}, columns);
    }
    state.disks.common_radius = 0.1;
    ghosts.see(slab, all.box, depth, columns, state);
    ghosts.find_places(state.disks);
    for (std::size_t i = 0; i < state.disks.size(); ++i) state.disks.y[i] = all.now[state.disks.id[i]];
    ghosts.look_beyond(state.disks, approach);
  }

  bool is_own(DiskId id) const { return cut.rank_at(heights.before[id]) == ranks.rank(); }
  bool is_here(DiskId id) const {
    return std::find(state.disks.id.begin(), state.disks.id.end(), id) != state.disks.id.end();
  }
  // Does a neighbour have the disk?
  bool is_of_neighbour(DiskId id) const {
    const int owner = cut.rank_at(heights.before[id]);
    return (slab.has_lower && owner == ranks.below()) || (slab.has_upper && owner == ranks.above());
  }
  // The distance of the disk beyond the slab.
  double beyond_slab(DiskId id) const {
    const Beyond b = beyond(slab, heights.box, heights.now[id]);
    return std::max(slab.has_lower ? b.lower : -HUGE_VAL, slab.has_upper ? b.upper : -HUGE_VAL);
  }

  Ranks& ranks;
  const Heights& heights;
  Slab slab;
  ExactGhosts ghosts;
  State state;
};

// Calls see() in boxes with walls and periodic ones; in some the disks have hardly moved, in others more.
void for_parts(const std::function<void(Part&, std::uint64_t)>& see) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    for (const double moved : {0.09, 0.3}) {
      const Heights heights(seed % 2 == 0, moved * depth, seed);
      run_on_local_ranks(cut.ranks(), [&](Ranks& ranks) {
        Part part(ranks, heights);
        see(part, seed);
      });
      if (testing::Test::HasFailure()) return;
    }
  }
}

// An unknown disk is outside the band by as much as it may approach in the window: a neighbour's disk, which that
// neighbour watches, by the approach assumed; a disk of another rank by the way of the fastest disk. This holds as long
// as no new ghosts are due.
TEST(ExactGhosts, KnowABandThatNoOtherDiskComesInto) {
  for_parts([](Part& part, std::uint64_t seed) {
    if (part.ranks.any(part.ghosts.are_few())) return;
    const double slice_flight = seed % 3 == 0 ? 0.1 : seed % 3 == 1 ? 1.1 : 9.0;
    const double taken = std::min(approach.furthest, std::max(approach.taken, 2.0 * slice_flight));
    const KnownBand band = part.ghosts.band(slice_flight);
    EXPECT_EQ(part.ghosts.slice_flight(), slice_flight);
    for (DiskId id = 0; id < disks; ++id) {
      if (part.is_here(id)) continue;
      const double nearer = (part.is_of_neighbour(id) ? taken : approach.furthest) - 1e-9;
      const double d = band.from_centre(part.heights.now[id]);
      EXPECT_TRUE(d <= band.below - nearer || d >= band.above + nearer) << d << " in " << band.below << band.above;
    }
  });
}

TEST(ExactGhosts, AreFewWhereDisksHaveComeNearOrLeft) {
  int few = 0, enough = 0;
  std::mutex mutex;
  for_parts([&](Part& part, std::uint64_t) {
    double nearest = HUGE_VAL, left = 0.0;
    for (DiskId id = 0; id < disks; ++id) {
      if (part.is_own(id)) left = std::max(left, part.beyond_slab(id));
      if (!part.is_here(id) && part.is_of_neighbour(id)) nearest = std::min(nearest, part.beyond_slab(id));
    }
    EXPECT_EQ(part.ghosts.are_few(), left > part.ghosts.most_excursion() || nearest < 0.7 * depth);
    const std::lock_guard lock(mutex);
    ++(part.ghosts.are_few() ? few : enough);
  });
  EXPECT_GT(few, 40);
  EXPECT_GT(enough, 40);
}

// In a slice a disk unknown to a neighbour may come as near to it as its distance at the slice's start minus the way of
// the fastest disk. The neighbour assumes an approach of at most `taken` since the window's start.
TEST(ExactGhosts, SeeStrangersThatComeNear) {
  int near = 0, far = 0;
  std::mutex mutex;
  for_parts([&](Part& part, std::uint64_t seed) {
    test::Draws draws(100 * seed + static_cast<std::uint64_t>(part.ranks.rank()));
    const Disks& d = part.state.disks;
    part.ghosts.band(0.0);
    WindowState window;
    window.record.resize(d.size());
    window.length = 9.0;
    window.slice_start = 2.0;
    window.slice_end = 2.25;
    window.speed_bound = 1.0;
    double before_below = HUGE_VAL, before_above = HUGE_VAL, below = HUGE_VAL, above = HUGE_VAL;
    for (std::uint32_t i = 0; i < d.size(); ++i) {
      const double vy = draws.in(-1.0, 1.0) * 0.45 * approach.furthest;
      window.record[i].path = {0.0, d.x[i], d.y[i], 0.0, vy};
      if (!part.is_own(d.id[i])) continue;
      const double shown = part.heights.before[d.id[i]];
      const Beyond now = beyond(part.slab, part.heights.box, d.y[i]);
      if (!part.slab.has_lower || shown - part.slab.low >= depth) {
        before_below = std::min(before_below, -now.lower);
        below = std::min(below, -now.lower + 2.0 * vy);
      }
      if (!part.slab.has_upper || part.slab.high - shown >= depth) {
        before_above = std::min(before_above, -now.upper);
        above = std::min(above, -now.upper - 2.0 * vy);
      }
    }
    const bool expected = (part.slab.has_lower && below - 0.25 < before_below - approach.taken) ||
                          (part.slab.has_upper && above - 0.25 < before_above - approach.taken);
    EXPECT_EQ(part.ghosts.strangers_come_near(window), expected);
    const std::lock_guard lock(mutex);
    ++(expected ? near : far);
  });
  EXPECT_GT(near, 40);
  EXPECT_GT(far, 40);
}

// Ghosts get all that the owner knows of their path if it has begun further paths; and their speed, since a fast disk
// may meet images of others beyond the nearest ones.
TEST(ExactGhosts, LearnWhatHasBecomeOfThem) {
  const Heights heights(true, 0.0, 1);
  run_on_local_ranks(cut.ranks(), [&](Ranks& ranks) {
    Part part(ranks, heights);
    const Disks& d = part.state.disks;
    WindowState window;
    window.record.resize(d.size());
    window.thermal_hits.resize(d.size());
    window.last_contact.resize(d.size());
    window.spin.resize(d.size());
    std::vector<std::uint32_t> unknown;
    for (std::uint32_t i = 0; i < d.size(); ++i) {
      const DiskId id = d.id[i];
      const bool known = part.is_own(id);
      if (!known && id % 4 != 0) unknown.push_back(i);
      const double k = known ? 1.0 + id : 0.0;
      window.record[i].path = {k, 2.0 * k, 3.0 * k, 4.0 * k, 5.0 * k};
      window.record[i].version = known && id % 2 == 0 ? 7 : 1;
      window.thermal_hits[i] = known ? id : 0;
      window.last_contact[i] = 6.0 * k;
      window.spin[i] = 7.0 * k;
    }
    ASSERT_GT(unknown.size(), 9U);
    part.ghosts.learn(window, unknown);
    double fastest2 = 0.0;
    for (std::uint32_t i = 0; i < d.size(); ++i) {
      const DiskId id = d.id[i];
      const bool learnt = part.is_own(id) || (id % 4 != 0 && id % 2 == 0);
      const double k = learnt ? 1.0 + id : 0.0;
      EXPECT_EQ(window.record[i].version, learnt && id % 2 == 0 ? 7 : 1);
      EXPECT_EQ(window.record[i].path.start, k);
      EXPECT_EQ(window.record[i].path.y, 3.0 * k);
      EXPECT_EQ(window.record[i].path.vy, 5.0 * k);
      EXPECT_EQ(window.thermal_hits[i], learnt ? id : 0);
      EXPECT_EQ(window.last_contact[i], 6.0 * k);
      EXPECT_EQ(window.spin[i], 7.0 * k);
      if (learnt && !part.is_own(id)) fastest2 = std::max(fastest2, 41.0 * k * k);
    }
    EXPECT_EQ(window.fastest2, fastest2);
  });
}

// The worst outcome on any rank becomes that of all, and events are summed over all ranks.
TEST(ExactGhosts, AgreeOnTheWorstOutcome) {
  using enum SliceOutcome;
  for (const auto& [first, second, both] : {std::tuple{done, done, done},
                                            {done, ghosts_too_few, ghosts_too_few},
                                            {crowded, ghosts_too_few, crowded},
                                            {strangers_too_near, too_fast, too_fast},
                                            {given_up, crowded, given_up}}) {
    run_on_local_ranks(3, [&, a = first, b = second, c = both](Ranks& ranks) {
      ExactGhosts ghosts(ranks);
      Count events = 10 + static_cast<Count>(ranks.rank());
      EXPECT_EQ(ghosts.agree(ranks.rank() == 0 ? a : ranks.rank() == 1 ? b : done, events), c);
      EXPECT_EQ(events, 33U);
      EXPECT_EQ(ghosts.least_of_all(3.0 - ranks.rank()), 1.0);
    });
  }
}

}  // namespace
}  // namespace carom
