// A run on several ranks as rank 0 starts and steps it, and the messages between the ranks.
#include "parallel/slabs/leading_engine.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "parallel/slabs/moving_disks.hpp"
#include "tests/support/leading_support.hpp"

namespace carom {
namespace {

using test::expect_same;
using test::gas;
using test::on_ranks;
using test::the_start;

// Three disks far apart on three ranks: the messages of a step can be counted by hand.
TEST(LeadingEngine, CountsWhatRanksSayInAStep) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 20.0\nheight = 60.0\n[[disks]]\ncount = 3\npositions = [[5.0, 5.0], [5.0, 30.0], [5.0, 55.0]]\n"
      "velocities = [[1.0, 0.0], [0.0, 0.0], [1.0, 0.0]]\nradius = 0.5\nmass = 1.0\n"
      "[run]\nmethod = \"pairwise\"\ndt = 0.1\nt_end = 1.0\n",
      "scene", "");
  const State start = initial_state(scene);
  on_ranks(3, scene, start, [&](RankLead& lead) {
    const auto engine = lead.make_engine(scene, start, {1, 512}, the_start);
    engine->step();
    const RankReport first = lead.report();
    for (int k = 0; k < 4; ++k) engine->step();
    const RankReport then = lead.report();
    EXPECT_EQ(first.steps, 1U);
    EXPECT_EQ(then.steps, 5U);
    ASSERT_EQ(then.ranks.size(), 3U);
    EXPECT_EQ(then.imbalance(), 1.0);
    for (std::size_t r = 0; r < 3; ++r) {
      EXPECT_EQ(then.ranks[r].disks, 1U);
      const Traffic a = first.ranks[r].in_steps;
      const Traffic later = traffic_since(a, then.ranks[r].in_steps);
      // Ghosts and clusters: to each neighbour one list and two lists, each with its length. A slab ends at the first
      // disk of the next one, which is therefore a ghost.
      const Count ghost = r > 0 ? sizeof(Disk) : 0;
      EXPECT_EQ(then.ranks[r].ghosts, r < 2 ? 1U : 0U);
      EXPECT_EQ(later.exchange.messages, 4U * 4U);
      EXPECT_EQ(later.exchange.bytes, 4U * (2U * (8U + 16U) + ghost));
      // The start of a step, excursion, whether clusters span slabs, one pass of impacts, one sweep, sums, and the
      // largest speed.
      EXPECT_EQ(later.all_reduce.messages, 4U * 7U);
      EXPECT_EQ(later.gather.messages, 4U);  // the deepest overlaps
      // The first step sorts: the ranks ask whether one has too many disks, send two empty lists of disks and of loads,
      // and check that all disks are where they belong; and all speeds are looked at.
      EXPECT_EQ(a.exchange.messages, 4U + 2U);
      EXPECT_EQ(a.exchange.bytes, 2U * (8U + 16U) + ghost + 32U);
      EXPECT_EQ(a.all_reduce.messages, 7U + 3U);
      EXPECT_EQ(a.gather.messages, 1U);
    }
  });
}

TEST(LeadingEngine, CountsTheSameInEqualRuns) {
  const Scene scene = gas("pairwise");
  const State start = initial_state(scene);
  for (const int count : {1, 2, 4}) {
    std::vector<RankReport> reports;
    for (int run = 0; run < 2; ++run) {
      on_ranks(count, scene, start, [&](RankLead& lead) {
        const auto engine = lead.make_engine(scene, start, {1 + run, 512}, the_start);
        while (engine->progress().time < scene.run.t_end) engine->step();
        reports.push_back(lead.report());
      });
    }
    for (std::size_t r = 0; r < reports[0].ranks.size(); ++r) {
      const Traffic& a = reports[0].ranks[r].in_steps;
      const Traffic& b = reports[1].ranks[r].in_steps;
      EXPECT_EQ(a.all().messages, b.all().messages);
      EXPECT_EQ(a.exchange.bytes, b.exchange.bytes);
      EXPECT_EQ(a.all_reduce.bytes, b.all_reduce.bytes);
      EXPECT_EQ(a.gather.bytes, b.gather.bytes);
      EXPECT_EQ(a.all().messages > 0, count > 1);
    }
  }
}

// A start that every rank makes for its slab, a refused one, and one made by rank 0, one after the other.
TEST(LeadingEngine, BeginsWhereDisksLive) {
  // For exact slabs have to be high.
  const auto lattice = [](const std::string& method, int count) {
    return parse_scene(
        fmt::format("[box]\nwidth = 12.0\nheight = 300.0\nleft = \"periodic\"\nright = \"periodic\"\n"
                    "[[disks]]\ncount = {}\npositions = \"hexagonal\"\nradius = {{ uniform = [0.4, 0.6] }}\n"
                    "mass = 1.0\nvelocities = {{ maxwell = 1.0 }}\n"
                    "[run]\nmethod = \"{}\"\ndt = 0.02\nt_end = 0.8\n",
                    count, method),
        "scene", "");
  };
  for (const char* method : {"pairwise", "exact"}) {
    const Scene scene = lattice(method, 1200);
    const State start = initial_state(scene);
    for (const int count : {1, 2, 4}) {
      on_ranks(count, scene, start, [&](RankLead& lead) {
        const auto expected = make_parallel_engine(scene, start, {1});
        const auto engine = lead.make_engine_at_start(scene, {1, 512}, the_start);
        ASSERT_NE(engine, nullptr);
        expect_same(lead.sums(), sums_of(start, scene));
        while (engine->progress().time < scene.run.t_end) {
          engine->step();
          expected->step();
          ASSERT_EQ(lead.sums().hash, state_hash(expected->state().disks));
        }
        EXPECT_EQ(engine->state().counters.collisions, expected->state().counters.collisions);
        EXPECT_EQ(engine->state().next_id, start.next_id);
      });
    }
  }
  const Scene full = lattice("exact", 8000);
  on_ranks(3, full, {}, [&](RankLead& lead) {
    EXPECT_EQ(lead.make_engine_at_start(full, {1}, the_start), nullptr);
    EXPECT_FALSE(lead.lost());
  });
  Scene grown = gas("pairwise");
  for (DiskGroup& group : grown.groups) group.positions.kind = PositionLaw::Kind::growth;
  on_ranks(2, grown, {}, [&](RankLead& lead) { EXPECT_EQ(lead.make_engine_at_start(grown, {1}, the_start), nullptr); });
}

// Disks come in pieces, as from a checkpoint; the slabs then have other borders, which must not change any bit.
TEST(LeadingEngine, BeginsFromDisksThatComeSomeAtATime) {
  for (const char* method : {"pairwise", "exact"}) {
    for (const char* radius : {"0.5", "{ uniform = [0.2, 0.6] }"}) {
      const Scene scene =
          parse_scene(fmt::format("[box]\nwidth = 12.0\nheight = 300.0\n[[disks]]\ncount = 1000\npositions = "
                                  "\"random\"\nradius = {}\nmass = 1.0\n"
                                  "velocities = {{ maxwell = 1.0 }}\n[run]\nmethod = \"{}\"\ndt = 0.02\nt_end = 0.8\n",
                                  radius, method),
                      "scene", "");
      const State start = initial_state(scene);
      for (const int count : {1, 2, 4}) {
        on_ranks(count, scene, start, [&](RankLead& lead) {
          State none = start;
          auto disks = std::make_unique<HeldDisks>(std::exchange(none.disks, no_disks_like(start.disks)));
          const auto expected = make_parallel_engine(scene, start, {1});
          const auto engine = lead.make_engine(scene, std::move(none), std::move(disks), {1, 512}, the_start);
          while (engine->progress().time < scene.run.t_end) {
            engine->step();
            expected->step();
            ASSERT_EQ(lead.sums().hash, state_hash(expected->state().disks));
          }
          EXPECT_EQ(engine->state().counters.collisions, expected->state().counters.collisions);
        });
      }
    }
  }
}

// Several engines after each other, as a program may make them; and after a refusal the ranks must still be in step.
TEST(LeadingEngine, ScenesThatRanksDoNotKnowAreRefusedAndOthersFollow) {
  const Scene rollback = gas("rollback");
  const State start = initial_state(rollback);
  on_ranks(3, rollback, start, [&](RankLead& lead) {
    try {
      lead.make_engine(rollback, start, {1}, the_start);
      ADD_FAILURE() << "rollback was accepted";
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(),
                   "method rollback cannot run on several ranks, as its frames need the whole box: use one rank, or "
                   "--method exact");
    }
  });
  const Scene scene = gas("pairwise");
  on_ranks(2, scene, start, [&](RankLead& lead) {
    for (int k = 0; k < 2; ++k) {
      const auto engine = lead.make_engine(scene, start, {1}, the_start);
      engine->step();
      EXPECT_EQ(engine->state().disks.size(), start.disks.size());
    }
  });
}

}  // namespace
}  // namespace carom
