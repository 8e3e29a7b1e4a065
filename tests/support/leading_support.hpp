// Runs rank 0 of several ranks, which are threads of this process, with the others following it.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>

#include "core/measure/state_sums.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "parallel/slabs/leading_engine.hpp"
#include "tests/support/feature_scenes.hpp"

namespace carom::test {

inline Scene gas(const std::string& method) {
  Features features;
  features.method = method;
  features.sides = "periodic";
  features.radii = "mixed";
  return feature_scene(features, 20);
}

inline std::string the_start(const State& state) {
  EXPECT_TRUE(state.disks.empty());
  return "the start";
}

// Calls work(lead) on rank 0 of `count` ranks; the others follow. Only a name is sent, since all ranks have the scene.
inline void on_ranks(int count, const Scene& scene, const State& start, const std::function<void(RankLead&)>& work) {
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

inline void expect_same(const StateSums& a, const StateSums& b) {
  EXPECT_EQ(a.at.particles, b.at.particles);
  EXPECT_EQ(a.at.time, b.at.time);
  EXPECT_EQ(a.at.energy.kinetic, b.at.energy.kinetic);
  EXPECT_EQ(a.at.energy.potential, b.at.energy.potential);
  EXPECT_EQ(a.at.energy.rotational, b.at.energy.rotational);
  EXPECT_EQ(a.at.momentum.x, b.at.momentum.x);
  EXPECT_EQ(a.at.momentum.y, b.at.momentum.y);
  EXPECT_EQ(a.at.momentum.magnitude, b.at.momentum.magnitude);
  EXPECT_EQ(a.at.relative, b.at.relative);
  EXPECT_EQ(a.smallest_radius, b.smallest_radius);
  EXPECT_EQ(a.fastest, b.fastest);
  EXPECT_EQ(a.hash, b.hash);
}

inline void expect_same(const Overlap& a, const Overlap& b) {
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.id1, b.id1);
  EXPECT_EQ(a.id2, b.id2);
}

}  // namespace carom::test
