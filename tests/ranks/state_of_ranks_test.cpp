// What rank 0 gets of all disks of a run on several ranks, as a whole and in pieces, is that of a single machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "parallel/simulation.hpp"
#include "parallel/slabs/whole_state.hpp"
#include "tests/support/leading_support.hpp"
#include "tests/support/same_counters.hpp"

namespace carom {
namespace {

using test::expect_same;
using test::gas;
using test::on_ranks;
using test::the_start;

// The entries of a list, piece by piece; no piece may be large.
std::vector<std::byte> entries_of(const StatePieces& pieces, StateList list, std::size_t largest) {
  std::vector<std::byte> all;
  pieces.visit(list, [&](std::span<const std::byte> some) {
    EXPECT_LE(some.size(), largest);
    all.insert(all.end(), some.begin(), some.end());
  });
  EXPECT_EQ(all.size(), pieces.entries(list) * entry_bytes(list));
  return all;
}

// The state in pieces is the whole state, byte for byte and in the same order.
void expect_whole_in_pieces(const Engine& engine) {
  const auto pieces = engine.pieces();
  std::vector<std::vector<std::byte>> lists;
  for (const StateList list : all_state_lists) lists.push_back(entries_of(*pieces, list, std::size_t{1} << 20));
  const WholeState whole(engine.state());
  for (std::size_t k = 0; k < lists.size(); ++k) {
    EXPECT_TRUE(lists[k] == entries_of(whole, all_state_lists[k], SIZE_MAX)) << k;
  }
  EXPECT_EQ(pieces->part().time, whole.part().time);
  test::expect_same_counters(whole.part().counters, pieces->part().counters);
  EXPECT_EQ(whole.part().taken, pieces->part().taken);
  EXPECT_EQ(pieces->part().next_id, whole.part().next_id);
}

// The disks of a moment in pieces are those of a single machine, in order of ids, whatever other moments were looked at
// in between. Returns whether their overlap is known without having all disks.
bool expect_moment_in_pieces(const Engine& engine, const Engine& expected, double t, const Scene& scene) {
  Disks there;
  Disks room;
  Disks other_room;
  const double time = expected.disks_at(t, there);
  const auto pieces = engine.pieces_at(t, room);
  EXPECT_EQ(engine.pieces_at(engine.progress().time, other_room)->size(), expected.state().disks.size());
  EXPECT_EQ(pieces->time(), time);
  EXPECT_EQ(pieces->size(), there.size());
  std::uint64_t hashes = 0;
  std::size_t next = 0;
  pieces->visit([&](const Disks& some) {
    EXPECT_LE(some.size(), std::size_t{1} << 15);
    hashes += sum_of_hashes(some);
    for (const DiskId id : some.id) {
      EXPECT_GE(id, next);
      next = std::size_t{id} + 1;
    }
  });
  EXPECT_EQ(hashes, sum_of_hashes(there));
  const std::optional<double> overlap = pieces->max_overlap();
  EXPECT_EQ(overlap.value_or(0.0), overlap ? max_overlap(there, box_at(scene.box, time)) : 0.0);
  EXPECT_EQ(state_hash(pieces->whole()), state_hash(there));
  return overlap.has_value();
}

TEST(StateOfRanks, HasAllDisksWheneverItIsAsked) {
  const Scene scene = gas("pairwise");
  const State start = initial_state(scene);
  for (const int count : {1, 2, 3, 4}) {
    on_ranks(count, scene, start, [&](RankLead& lead) {
      const auto expected = make_parallel_engine(scene, start, {1});
      const auto engine = lead.make_engine(scene, start, {1, 512}, the_start);
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
        expect_whole_in_pieces(*engine);
        EXPECT_TRUE(expect_moment_in_pieces(*engine, *expected, 0.0, scene));
      }
      EXPECT_EQ(engine->take_warnings(), expected->take_warnings());
    });
  }
}

std::vector<Scene> scenes_of_all_sums() {
  std::vector<Scene> scenes;
  for (const char* sides : {"periodic", "wall", "moving"}) {
    test::Features features;
    features.method = "pairwise";
    features.sides = sides;
    features.radii = "mixed";
    features.own_masses = features.gravity = std::string(sides) == "wall";
    features.obstacles = !features.gravity;
    features.restitution = 1.0;
    scenes.push_back(test::feature_scene(features, 12));
    if (features.gravity) scenes.back().box.restitutions = {1.0, 1.0, 1.0, 1.0};
  }
  test::Features sheared;
  sheared.method = "pairwise";
  sheared.sides = "periodic";
  sheared.shear = 0.4;
  sheared.rough = "sticking";
  scenes.push_back(test::feature_scene(sheared, 12));
  return scenes;
}

// Sums and overlaps while rank 0 does not have all disks; and the run goes on after memory was freed.
TEST(StateOfRanks, SaysOfAllDisksWhatOneMachineSays) {
  double deepest = 0.0;
  for (const Scene& scene : scenes_of_all_sums()) {
    SCOPED_TRACE(scene.title);
    const State start = initial_state(scene);
    for (const int count : {1, 2, 3, 4}) {
      on_ranks(count, scene, start, [&](RankLead& lead) {
        const auto expected = make_parallel_engine(scene, start, {1});
        const auto engine = lead.make_engine(scene, start, {1, 512}, the_start);
        for (int step = 0; step < 12; ++step) {
          expect_same(lead.sums(), sums_of(expected->state(), scene));
          const DeepestOverlaps overlaps = overlaps_of(expected->state(), scene);
          expect_same(lead.overlaps().disks, overlaps.disks);
          expect_same(lead.overlaps().wall, overlaps.wall);
          deepest = std::max(deepest, overlaps.disks.size);
          EXPECT_TRUE(expect_moment_in_pieces(*engine, *expected, 0.0, scene));
          engine->step();
          expected->step();
          if (step % 3 == 0) engine->release_memory();
          EXPECT_EQ(engine->contacts().size(), expected->contacts().size());
        }
        EXPECT_EQ(state_hash(engine->state().disks), state_hash(expected->state().disks));
        expect_same(lead.sums(), sums_of(expected->state(), scene));
      });
    }
  }
  EXPECT_GT(deepest, 0.0);
}

// Sums are formed block by block in order of ids; here over several pieces from the ranks, with missing ids.
TEST(LongStateOfRanks, SumsManyDisksInOrderOfId) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 300.0\nheight = 300.0\nright = \"sink\"\n[[disks]]\ncount = 70000\npositions = \"random\"\n"
      "radius = { uniform = [0.2, 0.4] }\nmass = { uniform = [1.0, 3.0] }\nvelocities = { maxwell = 9.0 }\n"
      "[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 0.05\n",
      "scene", "");
  const State start = initial_state(scene);
  on_ranks(3, scene, start, [&](RankLead& lead) {
    const auto expected = make_parallel_engine(scene, start, {1});
    const auto engine = lead.make_engine(scene, start, {1}, the_start);
    while (engine->progress().time < scene.run.t_end) {
      engine->step();
      expected->step();
    }
    EXPECT_LT(expected->state().disks.size(), start.disks.size());
    expect_same(lead.sums(), sums_of(expected->state(), scene));
    const State& state = expected->state();
    const Energy energy = energy_of(state.disks, scene.physics.gravity);
    const Momentum momentum = momentum_of(state.disks);
    const StateSums sums = lead.sums();
    EXPECT_EQ(sums.at.energy.kinetic, energy.kinetic);
    EXPECT_EQ(sums.at.momentum.x, momentum.x);
    EXPECT_EQ(sums.at.momentum.y, momentum.y);
    EXPECT_EQ(sums.at.momentum.magnitude, momentum.magnitude);
    EXPECT_EQ(sums.hash, state_hash(state.disks));
    expect_whole_in_pieces(*engine);
    EXPECT_TRUE(expect_moment_in_pieces(*engine, *expected, scene.run.t_end, scene));
  });
}

// At times within a window, too, on slabs and when one rank runs all disks.
TEST(StateOfRanks, HasAllDisksOfExactWithinWindows) {
  const Scene slabs = parse_scene(
      "[box]\nwidth = 12.0\nheight = 300.0\nleft = \"periodic\"\nright = \"periodic\"\n[[disks]]\ncount = 1200\n"
      "positions = \"random\"\nradius = { uniform = [0.4, 0.6] }\nmass = 1.0\nvelocities = { maxwell = 1.0 }\n"
      "[run]\nmethod = \"exact\"\nt_end = 5.0\n",
      "scene", "");
  Scene sinks = slabs;
  sinks.box.sides[static_cast<std::size_t>(Side::top)] = SideKind::sink;
  sinks.box.sides[static_cast<std::size_t>(Side::bottom)] = SideKind::sink;
  int overlaps = 0;
  for (const Scene& scene : {slabs, sinks, gas("exact")}) {
    const State start = initial_state(scene);
    for (const int count : {1, 2, 3}) {
      on_ranks(count, scene, start, [&](RankLead& lead) {
        const auto expected = make_parallel_engine(scene, start, {1});
        const auto engine = lead.make_engine(scene, start, {1, 512}, the_start);
        while (engine->progress().time < scene.run.t_end) {
          const double before = engine->progress().time;
          engine->step();
          expected->step();
          ASSERT_EQ(engine->progress().time, expected->state().time);
          EXPECT_EQ(engine->contacts().size(), expected->contacts().size());
          for (const double share : {0.0, 0.3, 0.9, 1.0}) {
            const double t = before + share * (engine->progress().time - before);
            Disks here;
            Disks there;
            EXPECT_EQ(engine->disks_at(t, here), expected->disks_at(t, there));
            ASSERT_EQ(state_hash(here), state_hash(there)) << t;
            overlaps += expect_moment_in_pieces(*engine, *expected, t, scene) ? 1 : 0;
          }
          expect_same(lead.sums(), sums_of(expected->state(), scene));
          expect_same(lead.overlaps().disks, overlaps_of(expected->state(), scene).disks);
          expect_same(lead.overlaps().wall, overlaps_of(expected->state(), scene).wall);
          if (expected->state().counters.steps % 8 == 0) engine->release_memory();
          expect_whole_in_pieces(*engine);
        }
        EXPECT_EQ(lead.report().steps, expected->state().counters.steps);
        engine->forget_paths();
      });
    }
  }
  EXPECT_GT(overlaps, 100);
}

// Values by id in a state are those of the rank that has the disk.
TEST(StateOfRanks, HasTheReflectionsOfAllDisks) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 12.0\nheight = 24.0\nbottom = { temperature = 9.0 }\ntop = { temperature = 0.5 }\n"
      "[[disks]]\ncount = 40\npositions = \"random\"\nregion = [0.0, 18.0, 12.0, 24.0]\n"
      "radius = { uniform = [0.3, 0.5] }\nmass = 1.0\nvelocities = { maxwell = 4.0 }\n"
      "[run]\nmethod = \"pairwise\"\ndt = 0.02\nt_end = 8.0\n",
      "scene", "");
  const State start = initial_state(scene);
  on_ranks(3, scene, start, [&](RankLead& lead) {
    const auto expected = make_parallel_engine(scene, start, {1});
    const auto engine = lead.make_engine(scene, start, {1, 512}, the_start);
    EXPECT_EQ(state_hash(engine->state().disks), state_hash(start.disks));
    while (engine->progress().time < scene.run.t_end) {
      engine->step();
      expected->step();
    }
    expect_whole_in_pieces(*engine);
    EXPECT_EQ(engine->state().thermal_hits, expected->state().thermal_hits);
    EXPECT_EQ(state_hash(engine->state().disks), state_hash(expected->state().disks));
    EXPECT_EQ(engine->state().disks.radius.size(), start.disks.size());
  });
}

// The same for the times of the TC model: a checkpoint has them, and other times would give other bits.
TEST(StateOfRanks, HasTheContactTimesOfAllDisks) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 20.0\nheight = 60.0\nleft = \"periodic\"\nright = \"periodic\"\n"
      "[physics]\nrestitution = 0.6\ncollapse = { model = \"tc\", contact_time = 0.02 }\n"
      "[[disks]]\ncount = 700\npositions = \"random\"\nradius = 0.5\nmass = 1.0\nvelocities = { maxwell = 1.0 }\n"
      "[run]\nmethod = \"exact\"\nt_end = 2.0\n",
      "scene", "");
  const State start = initial_state(scene);
  on_ranks(2, scene, start, [&](RankLead& lead) {
    const auto expected = make_parallel_engine(scene, start, {1});
    const auto engine = lead.make_engine(scene, start, {1, 512}, the_start);
    while (engine->progress().time < scene.run.t_end) {
      engine->step();
      expected->step();
    }
    EXPECT_LT(engine->progress().disks.size(), start.disks.size()) << "one rank runs all disks";
    EXPECT_GT(lead.report().ranks[1].ghosts, 0U);
    expect_whole_in_pieces(*engine);
    EXPECT_EQ(engine->state().last_contact, expected->state().last_contact);
    EXPECT_EQ(state_hash(engine->state().disks), state_hash(expected->state().disks));
  });
}

// The loads of a pile come from the ranks that have the disks, at a border from both; the run goes on from them.
TEST(StateOfRanks, HasTheLoadsOfAllDisksAndGoesOnFromThem) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 12.0\nheight = 14.0\n[physics]\ngravity = 4.0\nrestitution = 0.5\n[[disks]]\ncount = 110\n"
      "positions = \"random\"\nradius = { uniform = [0.3, 0.5] }\nmass = { uniform = [1, 3] }\n"
      "[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 3.0\n",
      "scene", "");
  const auto loads_of = [](const State& state) {
    std::vector<std::tuple<DiskId, DiskId, double>> loads;
    for (const ContactLoad& load : state.loads) loads.emplace_back(load.id1, load.id2, load.force);
    return loads;
  };
  State start = initial_state(scene);
  const auto expected = make_parallel_engine(scene, start, {1});
  for (const int count : {3, 2, 1, 4}) {
    State end;
    on_ranks(count, scene, start, [&](RankLead& lead) {
      const auto engine = lead.make_engine(scene, start, {1, 512}, the_start);
      EXPECT_EQ(loads_of(engine->state()), loads_of(start));
      for (int k = 0; k < 60; ++k) {
        engine->step();
        expected->step();
      }
      end = engine->state();
      EXPECT_EQ(loads_of(end), loads_of(expected->state()));
      expect_whole_in_pieces(*engine);
      ASSERT_EQ(state_hash(end.disks), state_hash(expected->state().disks));
    });
    start = std::move(end);
  }
  EXPECT_GT(start.loads.size(), 100U);
}

// If a writer gives up, as on a full disk, the ranks go on.
TEST(StateOfRanks, GoesOnAfterAWriterGaveUp) {
  const Scene scene = gas("pairwise");
  const State start = initial_state(scene);
  on_ranks(3, scene, start, [&](RankLead& lead) {
    const auto expected = make_parallel_engine(scene, start, {1});
    const auto engine = lead.make_engine(scene, start, {1, 512}, the_start);
    for (const StateList list : {StateList::x, StateList::radius}) {
      const auto give_up = [](std::span<const std::byte> /*some*/) { throw RunError("the disk is full"); };
      EXPECT_THROW(engine->pieces()->visit(list, give_up), RunError);
      Disks room;
      const auto throw_at_once = [](const Disks& /*some*/) { throw RunError("the disk is full"); };
      EXPECT_THROW(engine->pieces_at(0.0, room)->visit(throw_at_once), RunError);
      EXPECT_FALSE(lead.lost());
      engine->step();
      expected->step();
      EXPECT_EQ(lead.sums().hash, state_hash(expected->state().disks));
      expect_whole_in_pieces(*engine);
    }
  });
}

// Two disks on two ranks, one of which is larger than any disk of the other rank, or has left its slab.
TEST(OverlapOverRanks, IsOfALargeDiskAndOfOneThatHasLeftItsSlab) {
  Domain box;
  box.width = 20.0;
  box.height = 100.0;
  const SlabCut cut{{0.0, 50.0, 100.0}};
  struct Case {
    double low, radius, high;
  };
  for (const Case& c : {Case{46.0, 5.0, 51.2}, Case{53.0, 0.5, 53.8}}) {
    for (const bool turned : {false, true}) {
      run_on_local_ranks(2, [&](Ranks& ranks) {
        Disks own;
        own.radius = {ranks.rank() == (turned ? 1 : 0) ? c.radius : 0.5};
        const double y = ranks.rank() == (turned ? 1 : 0) ? c.low : c.high;
        own.x = {10.0};
        own.y = {turned ? box.height - y : y};
        own.vx = own.vy = {0.0};
        own.id = {static_cast<DiskId>(ranks.rank())};
        const double expected = 1.0 - (c.high - c.low) / (c.radius + 0.5);
        EXPECT_NEAR(overlap_over_ranks(ranks, box, own, cut).size, expected, 1e-12);
      });
    }
  }
}

}  // namespace
}  // namespace carom
