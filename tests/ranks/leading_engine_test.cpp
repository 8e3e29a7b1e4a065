// A run on several ranks as rank 0 sees it: one engine with all disks, and the bits of one machine.
#include "parallel/slabs/leading_engine.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/feature_scenes.hpp"

namespace carom {
namespace {

Scene gas(const std::string& method) {
  test::Features features;
  features.method = method;
  features.sides = "periodic";
  features.radii = "mixed";
  return test::feature_scene(features, 20);
}

// work(lead) on rank 0 of `count`, the others follow. What is sent is no more than a name: all have the scene at hand.
void on_ranks(int count, const Scene& scene, const State& start, const std::function<void(RankLead&)>& work) {
  run_on_local_ranks(count, [&](Ranks& ranks) {
    if (ranks.rank() > 0) {
      follow_lead(ranks, {2, 512}, [&](const std::string& text) {
        EXPECT_EQ(text, "the start");
        return std::pair(scene, start);
      });
      return;
    }
    RankLead lead(ranks);
    work(lead);
    lead.end();
  });
}

TEST(LeadingEngine, HasAllDisksWheneverItIsAsked) {
  const Scene scene = gas("pairwise");
  const State start = initial_state(scene);
  for (const int count : {1, 2, 3, 4}) {
    on_ranks(count, scene, start, [&](RankLead& lead) {
      const auto expected = make_parallel_engine(scene, start, {1});
      const auto engine = lead.make_engine(scene, start, {1, 512}, "the start");
      EXPECT_EQ(state_hash(engine->state().disks), state_hash(start.disks));
      for (int step = 1; engine->progress().time < scene.run.t_end; ++step) {
        engine->step();
        expected->step();
        EXPECT_EQ(engine->progress().time, expected->state().time);
        EXPECT_EQ(engine->progress().counters.collisions, expected->state().counters.collisions);
        EXPECT_EQ(engine->contacts().size(), expected->contacts().size());
        if (step % 3 != 0) continue;
        Disks disks;
        EXPECT_EQ(engine->disks_at(0.0, disks), expected->state().time);
        EXPECT_EQ(state_hash(disks), state_hash(expected->state().disks));
        EXPECT_EQ(state_hash(engine->state().disks), state_hash(disks)) << "asked again";
        EXPECT_EQ(engine->state().disks.radius.size(), start.disks.size());
      }
      EXPECT_EQ(engine->take_warnings(), expected->take_warnings());
    });
  }
}

// One engine after another, as a program may make them; and what is refused leaves the ranks together.
TEST(LeadingEngine, ScenesThatRanksDoNotKnowAreRefusedAndOthersFollow) {
  const Scene exact = gas("exact");
  const State start = initial_state(exact);
  on_ranks(3, exact, start, [&](RankLead& lead) {
    try {
      lead.make_engine(exact, start, {1}, "the start");
      ADD_FAILURE() << "exact was taken";
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(), "several ranks do not know the method exact yet: use one, or --method pairwise");
    }
  });
  const Scene scene = gas("pairwise");
  on_ranks(2, scene, start, [&](RankLead& lead) {
    for (int k = 0; k < 2; ++k) {
      const auto engine = lead.make_engine(scene, start, {1}, "the start");
      engine->step();
      EXPECT_EQ(engine->state().disks.size(), start.disks.size());
    }
  });
}

}  // namespace
}  // namespace carom
