// The contacts of the last step: complete, and the same from every engine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/load/scene_file.hpp"
#include "run/simulation/simulation.hpp"

namespace carom {
namespace {

std::string gas(const std::string& method, const std::string& sides, int disks = 150) {
  return "[box]\npacking_fraction = 0.3\n" + sides + "[[disks]]\ncount = " + std::to_string(disks) +
         "\nvelocities = { maxwell = 1.0 }\nradius = { uniform = [0.2, 0.5] }\nmass = 1.0\npositions = \"random\"\n"
         "[run]\ndt = 0.02\nt_end = 20.0\nmethod = \"" +
         method + "\"\n";
}

const std::string around = "left = \"periodic\"\nright = \"periodic\"\n";
const std::string sink = "bottom = \"sink\"\n";
const std::string inner_sink = "[[walls]]\nfrom = [4.0, 6.0]\nto = [9.0, 6.5]\nkind = \"sink\"\n";

Simulation of(const std::string& text, const std::string& engine = "parallel", int threads = 1) {
  return Simulation(parse_scene(text, "gas.toml", ""), choose_engine(engine, engine == "parallel" ? threads : 1));
}

using Pairs = std::vector<std::pair<DiskId, DiskId>>;

Pairs pairs_of(const std::vector<DiskContact>& contacts) {
  Pairs pairs;
  for (const DiskContact& c : contacts) pairs.emplace_back(c.id1, c.id2);
  return pairs;
}

// The contacts of pairwise: all pairs that touch when every disk has moved on by dt.
Pairs touching_after(const Disks& d, const Domain& box, double dt) {
  Pairs pairs;
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (std::size_t j = i + 1; j < d.size(); ++j) {
      const double dx = (d.x[j] + d.vx[j] * dt) - (d.x[i] + d.vx[i] * dt);
      const double dy = (d.y[j] + d.vy[j] * dt) - (d.y[i] + d.vy[i] * dt);
      const double contact_distance = d.radius_of(i) + d.radius_of(j);
      if (nearest_distance2({dx, dy}, box) <= contact_distance * contact_distance) pairs.emplace_back(d.id[i], d.id[j]);
    }
  }
  return pairs;
}

TEST(Contacts, PairwiseHasAllPairsThatTouchedAfterTheDrift) {
  Simulation s = of(gas("pairwise", around));
  std::size_t met = 0;
  for (int k = 0; k < 100; ++k) {
    const Disks before = s.disks();
    s.step();
    const Pairs found = pairs_of(s.contacts());
    ASSERT_THAT(found, testing::UnorderedElementsAreArray(touching_after(before, s.scene().box, 0.02)));
    met += found.size();
  }
  EXPECT_GE(met, s.state().counters.collisions);
  EXPECT_GT(met, 50U);
}

double gap_of(const Disks& d, const Domain& box, const DiskContact& c) {
  const auto at = [&](DiskId id) {
    return static_cast<std::size_t>(std::find(d.id.begin(), d.id.end(), id) - d.id.begin());
  };
  const std::size_t i = at(c.id1), j = at(c.id2);
  return std::sqrt(nearest_distance2({d.x[j] - d.x[i], d.y[j] - d.y[i]}, box)) - d.radius_of(i) - d.radius_of(j);
}

// The disks of a contact touch at its time, and there are as many contacts as the engine counts, so none is missing.
TEST(Contacts, ExactHasEveryCollisionOfTheWindow) {
  Simulation s = of(gas("exact", around, 60));
  for (int k = 0; k < 20; ++k) {
    const Count before = s.state().counters.collisions;
    const double start = s.time();
    s.step();
    const std::vector<DiskContact> contacts = s.contacts();
    ASSERT_EQ(contacts.size(), s.state().counters.collisions - before);
    for (const DiskContact& c : contacts) {
      ASSERT_LT(c.id1, c.id2);
      ASSERT_TRUE(c.time >= start && c.time <= s.time());
      Disks then;
      s.disks_at(c.time, then);
      EXPECT_NEAR(gap_of(then, s.scene().box, c), 0.0, 1e-9);
    }
  }
  EXPECT_GT(s.state().counters.collisions, 50U);
}

// Sinks take disks at the end of the step in which they have met others.
TEST(Contacts, AreThoseOfTheReference) {
  for (const std::string method : {"exact", "pairwise", "rollback"}) {
    for (const std::string& sides : {std::string(), around, sink, inner_sink}) {
      Simulation reference = of(gas(method, sides), "reference");
      Simulation one = of(gas(method, sides)), two = of(gas(method, sides), "parallel", 2);
      std::size_t met = 0;
      for (int k = 0; k < (method == "exact" ? 4 : 80); ++k) {
        for (Simulation* s : {&reference, &one, &two}) s->step();
        const std::vector<DiskContact> contacts = reference.contacts();
        met += contacts.size();
        ASSERT_EQ(one.contacts(), contacts) << method << ", step " << k << "\n" << sides;
        ASSERT_EQ(two.contacts(), contacts) << method << ", step " << k << "\n" << sides;
        for (const DiskContact& c : contacts) EXPECT_TRUE(one.find(c.id1) && one.find(c.id2));
      }
      EXPECT_GT(met, 20U) << method;
      EXPECT_EQ(sides == sink || sides == inner_sink, one.state().counters.removed > 0);
    }
  }
}

TEST(Contacts, NoneBeforeAStepAndAfterAChange) {
  for (const std::string method : {"exact", "pairwise", "rollback"}) {
    for (const std::string engine : {"parallel", "reference"}) {
      Simulation s = of(gas(method, around), engine);
      EXPECT_TRUE(s.contacts().empty());
      const auto step_until_some_meet = [&] {
        while (s.contacts().empty()) s.step();
      };
      step_until_some_meet();
      const std::string saved = s.save();
      s.remove(0);
      EXPECT_TRUE(s.contacts().empty());
      step_until_some_meet();
      s.load(saved);
      EXPECT_TRUE(s.contacts().empty());
    }
  }
}

}  // namespace
}  // namespace carom
