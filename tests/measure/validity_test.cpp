// A run that exceeds the limits of its method says so: once, with a figure and a remedy, in both engines alike.
#include "core/step/validity.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "core/base/check.hpp"
#include "core/measure/invariants.hpp"
#include "core/physics/contact_event.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string folder = CAROM_SOURCE_DIR "/scenes/stability/";

// All warnings of a run; if the physics stops the run, the error is the last entry.
std::vector<std::string> warnings_of(Engine& engine, const Scene& scene) {
  try {
    while (engine.state().time < scene.run.t_end) engine.step();
  } catch (const PhysicsError& error) {
    std::vector<std::string> warnings = engine.take_warnings();
    warnings.emplace_back(error.what());
    return warnings;
  }
  return engine.take_warnings();
}

std::vector<std::string> warnings_of(const Scene& scene) {
  const State start = initial_state(scene);
  std::vector<std::string> plain = warnings_of(*make_reference_engine(scene, start), scene);
  EXPECT_EQ(plain, warnings_of(*make_parallel_engine(scene, start, {3, 512}), scene));
  return plain;
}

Scene stability_scene(const std::string& name, const std::vector<Override>& changes) {
  return load_scene(folder + name + ".toml", changes);
}

TEST(Validity, PairwiseSaysThatCollisionsAreSeenLate) {
  const auto gas = [](const char* dt) {
    return stability_scene("f02_bounce_at_a_distance", {{"disks.0.count", "300"},
                                                        {"box.packing_fraction", "0.5"},
                                                        {"run.t_end", "2"},
                                                        {"run.method", "pairwise"},
                                                        {"run.dt", dt}});
  };
  EXPECT_THAT(warnings_of(gas("0.005")), IsEmpty());
  EXPECT_THAT(warnings_of(gas("0.05")),
              ::testing::Contains(AllOf(HasSubstr("collisions were seen a step late: dt = 0.05 is long"),
                                        HasSubstr("use a smaller dt or run.method = \"exact\""))));
}

// The only step is cut to end at t_end: the warning in the step is the same as that in the summary, in any units.
TEST(Validity, AStepThatIsSplitIsNamedWithItsLength) {
  for (const double unit : {1.0, 0x1p-30}) {
    const auto in_units = [unit](double value) { return fmt::format("{}", value * unit); };
    const Scene scene = test::scene_from(test::sound_scene,
                                         {{"run.method", "pairwise"},
                                          {"physics.gravity", "0.0"},
                                          {"disks.0.velocities", fmt::format("[[{}, 0], [0, 0], [0, 0]]", 1.0 / unit)},
                                          {"run.t_end", in_units(2.0)},
                                          {"run.dt", in_units(16.0)}});
    const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 512});
    const std::vector<std::string> warnings = warnings_of(*engine, scene);
    EXPECT_EQ(warnings, worst_moment_warnings(scene, engine->state()));
    EXPECT_THAT(warnings,
                ElementsAre(HasSubstr(fmt::format("at time 0 the fastest disk moves more than half its radius "
                                                  "in dt = {:g}: the step is split into 4 parts",
                                                  2.0 * unit))));
  }
}

TEST(Validity, RollbackSaysThatDisksBounceBeforeTheyTouch) {
  const auto gas = [](const char* dt) {
    return stability_scene("f02_bounce_at_a_distance",
                           {{"disks.0.count", "300"}, {"run.t_end", "5"}, {"run.method", "rollback"}, {"run.dt", dt}});
  };
  EXPECT_THAT(warnings_of(gas("0.005")), IsEmpty());
  EXPECT_THAT(warnings_of(gas("0.05")),
              ElementsAre(HasSubstr("treated as simultaneous with another one of the same disk")));
}

// Disks pressed from both sides collide until their speeds are the smallest numbers. By rounding this ends or goes on
// for ever, and with this restitution it goes on.
TEST(Validity, RollbackSaysThatTimeStallsBeforeItStops) {
  const Scene scene = stability_scene("f16_collapse_three", {{"physics.restitution", "0.03"},
                                                             {"disks.0.velocities", "[[1, 0], [0, 0], [-1, 0]]"},
                                                             {"run.method", "rollback"}});
  const std::vector<std::string> warnings = warnings_of(scene);
  ASSERT_FALSE(warnings.empty());
  EXPECT_THAT(warnings, ::testing::Contains(HasSubstr("a frame advances time by 0 dt, with 3 disks: time stalls; use "
                                                      "run.method = \"pairwise\"")));
  EXPECT_THAT(warnings.back(), HasSubstr("rollback: time stands still at t = "));
}

// The piston leaves the disk less room than it moves in dt: it bounces two or more times in a step.
TEST(LongValidity, TimeSteppingSaysThatWallsAreMetLate) {
  for (const char* method : {"pairwise", "rollback"}) {
    const auto closing = [&](const char* end) {
      return stability_scene("closing_walls", {{"run.method", method}, {"run.dt", "0.001"}, {"run.t_end", end}});
    };
    EXPECT_THAT(warnings_of(closing("69")), IsEmpty()) << method;
    EXPECT_THAT(warnings_of(closing("69.6")),
                ElementsAre(AllOf(HasSubstr("bounces off walls and obstacles were seen a step late: dt = 0.001 is"),
                                  HasSubstr("use a smaller dt or run.method = \"exact\""))))
        << method;
  }
}

// A side that hardly moves is not what presses a disk of a gas into another wall: the step may as well be the reason.
TEST(Validity, WhereAWallMovesTheStepMayBeTooLongAsWell) {
  const Scene gas =
      stability_scene("f02_bounce_at_a_distance", {{"disks.0.count", "300"},
                                                   {"box.packing_fraction", "0.5"},
                                                   {"box.left", "\"wall\""},
                                                   {"box.right", "{ motion = { velocity = [-1e-6, 0] } }"},
                                                   {"run.t_end", "2"},
                                                   {"run.method", "pairwise"},
                                                   {"run.dt", "0.5"}});
  EXPECT_THAT(warnings_of(gas).back(),
              AllOf(HasSubstr("a moving wall leaves no room at t = "), HasSubstr(", or dt = 0.5 is too long: disk "),
                    HasSubstr("; use a smaller dt, move the wall less far, or use fewer or smaller disks")));
}

TEST(Validity, BrownianMotionIsNotSentToExact) {
  Scene gas = stability_scene("f02_bounce_at_a_distance", {{"disks.0.count", "300"},
                                                           {"box.packing_fraction", "0.5"},
                                                           {"run.t_end", "20"},
                                                           {"run.method", "pairwise"},
                                                           {"run.dt", "0.5"}});
  gas.physics.diffusion = 0.05;
  const std::vector<std::string> warnings = warnings_of(gas);
  EXPECT_THAT(warnings, ::testing::Contains(HasSubstr("use a smaller dt")));
  for (const std::string& warning : warnings) EXPECT_THAT(warning, ::testing::Not(HasSubstr("exact")));
}

// A heavy disk presses a light one against the wall.
TEST(Validity, PairwiseSaysHowFarDisksOverlap) {
  const Scene pressed = stability_scene("mass_ratio_1e6", {{"run.method", "pairwise"}, {"run.dt", "0.05"}});
  EXPECT_THAT(warnings_of(pressed), ::testing::Contains(AllOf(HasSubstr("two disks overlap by"),
                                                              HasSubstr("more than 2 %: dt = 0.05 is too long"))));
}

// The deepest overlaps of the states after each step of a run.
struct Deepest {
  WorstOverlap disks, wall;
  explicit Deepest(Engine& engine, const Scene& scene) {
    while (engine.state().time < scene.run.t_end) {
      engine.step();
      const State& state = engine.state();
      const Overlap of_disks = deepest_overlap(state.disks, scene.box);
      const Overlap of_wall = deepest_wall_overlap(state.disks, scene.box);
      if (of_disks.size > disks.overlap.size) disks = {of_disks, state.time};
      if (of_wall.size > wall.overlap.size) wall = {of_wall, state.time};
    }
  }
};

void expect_same(const WorstOverlap& a, const WorstOverlap& b) {
  EXPECT_EQ(a.overlap.size, b.overlap.size);
  EXPECT_EQ(a.overlap.id1, b.overlap.id1);
  EXPECT_EQ(a.overlap.id2, b.overlap.id2);
  EXPECT_EQ(a.time, b.time);
}

// The validity counts at the end of the run, which must be the same in both engines.
ValidityCounts kept_by_both(const Scene& scene, const State& start, Engine& reference) {
  const auto parallel = make_parallel_engine(scene, start, {3, 512});
  while (parallel->state().time < scene.run.t_end) parallel->step();
  const ValidityCounts& kept = reference.state().validity;
  expect_same(parallel->state().validity.disks, kept.disks);
  expect_same(parallel->state().validity.wall, kept.wall);
  EXPECT_EQ(validity_warnings_so_far(scene, parallel->state()), validity_warnings_so_far(scene, reference.state()));
  return kept;
}

TEST(Validity, TheDeepestOverlapsOfARunAreKeptWithTimeAndIds) {
  const Scene pile = stability_scene("wedge", {{"run.method", "pairwise"}, {"run.dt", "0.02"}, {"run.t_end", "10"}});
  const State start = initial_state(pile);
  const auto engine = make_reference_engine(pile, start);
  const Deepest seen(*engine, pile);
  const ValidityCounts kept = kept_by_both(pile, start, *engine);
  EXPECT_GT(seen.disks.overlap.size, 0.0);
  EXPECT_GT(seen.wall.overlap.size, 0.0);
  expect_same(kept.disks, seen.disks);
  expect_same(kept.wall, seen.wall);
}

// A heavy disk presses a light one against the wall, ever deeper, and then moves away long before the end: there is a
// warning of the first overlap when it occurs, and of the worst one at the end. Steps are split, so overlaps within a
// step count, too.
TEST(Validity, TheWorstIsReportedAtTheEnd) {
  const Scene scene = stability_scene("mass_ratio_1e6", {{"run.method", "pairwise"}, {"run.dt", "0.02"}});
  const State start = initial_state(scene);
  const auto engine = make_reference_engine(scene, start);
  const Deepest seen(*engine, scene);
  const ValidityCounts kept = kept_by_both(scene, start, *engine);
  EXPECT_EQ(max_overlap(engine->state().disks, scene.box), 0.0);
  EXPECT_GE(kept.disks.overlap.size, seen.disks.overlap.size);
  EXPECT_GE(kept.wall.overlap.size, seen.wall.overlap.size);
  const std::string worst = fmt::format("at time {:g} disk {} reaches {:.2g} % of its radius beyond the left wall",
                                        kept.wall.time, kept.wall.overlap.id1, 100.0 * kept.wall.overlap.size);
  EXPECT_THAT(engine->take_warnings(), ::testing::Not(::testing::Contains(HasSubstr(worst))));
  EXPECT_THAT(validity_warnings_so_far(scene, engine->state()), ::testing::Contains(HasSubstr(worst)));
}

TEST(Validity, ExactSaysThatTheCollapseModelTakesOver) {
  const auto cooling = [](const char* contact_time) {
    return stability_scene("f16_cooling_gas", {{"physics.restitution", "0.9"},
                                               {"physics.collapse",
                                                std::string("{ model = \"tc\", contact_time = ") + contact_time + " }"},
                                               {"disks.0.count", "100"},
                                               {"run.t_end", "2"}});
  };
  EXPECT_THAT(warnings_of(cooling("1e-6")), IsEmpty());
  EXPECT_THAT(warnings_of(cooling("0.1")), ElementsAre(AllOf(HasSubstr("were made elastic by the TC model"),
                                                             HasSubstr("contact_time = 0.1 is long"))));
}

// A disk is put into a peg, as if a contact had been missed, and leaves it. Above the peg nothing is reported.
TEST(Validity, ExactSaysWhereADiskIsInAPeg) {
  const Scene scene = test::scene_from(R"(
[box]
width = 10
height = 10
[physics]
gravity = 1
[[disks]]
fixed = true
count = 1
positions = [[5, 5]]
radius = 1
[[disks]]
count = 2
positions = [[5, 6.5], [2, 2]]
velocities = [[0, 1], [0, 0]]
radius = 0.5
mass = 1
[run]
method = "exact"
t_end = 0.01
[output]
every = 0.01
)");
  State start = initial_state(scene);
  const auto said = [&](const State& state) {
    const auto reference = make_reference_engine(scene, state);
    const auto parallel = make_parallel_engine(scene, state, {3, 512});
    const std::vector<std::string> warnings = warnings_of(*reference, scene);
    EXPECT_EQ(warnings_of(*parallel, scene), warnings);
    expect_same(parallel->state().validity.wall, reference->state().validity.wall);
    EXPECT_EQ(validity_warnings_so_far(scene, parallel->state()).size(), warnings.size());
    return warnings;
  };
  for (std::size_t i = 0; i < start.disks.size(); ++i) {
    if (start.disks.y[i] > 5.0) start.disks.y[i] += 0.05;
  }
  EXPECT_THAT(said(start), IsEmpty());
  for (std::size_t i = 0; i < start.disks.size(); ++i) {
    if (start.disks.y[i] > 5.0) start.disks.y[i] -= 0.1;
  }
  EXPECT_THAT(said(start), ElementsAre(AllOf(HasSubstr("reaches 8 % of its radius beyond"),
                                             HasSubstr("a contact was missed"), HasSubstr("please report"))));
}

TEST(Validity, ExactKeepsTheDeepestOfWallsThatMove) {
  const Scene scene =
      load_scene(CAROM_SOURCE_DIR "/scenes/shaken_bed.toml", {{"run.method", "exact"}, {"run.t_end", "0.2"}});
  const State start = initial_state(scene);
  const auto engine = make_reference_engine(scene, start);
  while (engine->state().time < scene.run.t_end) engine->step();
  EXPECT_LT(kept_by_both(scene, start, *engine).wall.overlap.size, 1e-9);
}

TEST(Validity, ScenesThatNoMethodServesWarnBeforeTheFirstStep) {
  Scene scene = test::scene_from(test::sound_scene);
  EXPECT_THAT(validity_warnings_at_start(scene, 1.0), IsEmpty());
  EXPECT_THAT(validity_warnings_at_start(scene, 0.0), IsEmpty());
  EXPECT_THAT(validity_warnings_at_start(scene, 1e-9),
              ElementsAre(HasSubstr("in a box of length 20 positions are rounded to 2.2e-06 of the")));
  EXPECT_THAT(validity_warnings_at_start(scene, 1.0, 3.0), IsEmpty());
  scene.run.dt = 1e-16;
  EXPECT_THAT(validity_warnings_at_start(scene, 1.0, 3.0),
              ElementsAre(AllOf(
                  HasSubstr("the fastest disk moves by 3e-16 in dt = 1e-16, but in a box of length 20 positions are"),
                  HasSubstr("motion is lost in rounding; use a longer dt"))));
  EXPECT_THAT(validity_warnings_at_start(scene, 1.0, 0.0), IsEmpty()) << "nothing moves";
  scene.physics.diffusion = 2.0;
  scene.run.dt = 1.0;
  EXPECT_THAT(
      validity_warnings_at_start(scene, 1.0),
      ElementsAre(AllOf(HasSubstr("a Brownian disk moves by 2 of the smallest radius"), HasSubstr("use dt <= 0.062"))));
}

// In half a period a wall returns to where it was: with its mean speed it would be at rest, and a gas would keep its
// energy, which is wrong.
TEST(Validity, AStepThatIsLongAgainstAVibrationIsToldBeforeTheFirst) {
  const auto shaken = [](const std::string& where, const char* method, double dt) {
    const std::string motion = "motion = { vibrate = [0.0, 0.005], period = 0.05 }";
    const bool inner = where == "inner wall";
    return test::scene_from("[box]\nwidth = 10.0\nheight = 10.0\n" + (inner ? "" : where + " = { " + motion + " }\n") +
                                (inner ? "[[walls]]\nfrom = [1.0, 1.0]\nto = [9.0, 1.0]\n" + motion + "\n" : "") +
                                "[[disks]]\ncount = 10\npositions = \"random\"\nregion = [0.0, 1.5, 10.0, 9.5]\n"
                                "velocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1.0\n[run]\nt_end = 5.0\n",
                            {{"run.method", method}, {"run.dt", fmt::format("{}", dt)}});
  };
  for (const char* where : {"bottom", "top", "inner wall"}) {
    SCOPED_TRACE(where);
    for (const char* method : {"pairwise", "rollback"}) {
      EXPECT_THAT(
          validity_warnings_at_start(shaken(where, method, 0.025), 0.5, 3.0),
          ElementsAre(AllOf(
              HasSubstr("a wall vibrates with a period of 0.05, but moves at its mean speed during each dt = 0.025"),
              HasSubstr("use dt <= 0.005 or run.method = \"exact\""))));
      EXPECT_THAT(validity_warnings_at_start(shaken(where, method, 0.005), 0.5, 3.0), IsEmpty());
    }
    EXPECT_THAT(validity_warnings_at_start(shaken(where, "exact", 0.025), 0.5, 3.0), IsEmpty());
  }
  const auto work = [&](const char* method, double dt) {
    const Scene scene = shaken("bottom", method, dt);
    const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 512});
    while (engine->state().time < scene.run.t_end) engine->step();
    return engine->state().counters.side_energy[static_cast<std::size_t>(Side::bottom)];
  };
  EXPECT_NEAR(work("pairwise", 0.025), 0.0, 1e-12);
  EXPECT_GT(std::abs(work("exact", 0.025)), 1.0);
}

// Shares refer to the collisions that may be inaccurate: in exact these include bounces off walls; in a step bounces
// have a share of their own.
TEST(Validity, SharesAreOfTheCollisionsThatAreWatched) {
  Scene scene = test::scene_from(test::sound_scene, {{"physics.gravity", "0.0"}});
  const auto said = [&](Method method, Count inaccurate, Count at_walls, State& state) {
    scene.run.method = method;
    state.counters.collisions = 100;
    state.counters.wall_collisions = 1000;
    StepFigures figures;
    figures.inaccurate = inaccurate;
    figures.inaccurate_at_walls = at_walls;
    Validity validity;
    validity.note_step(scene, figures, state);
    return validity.take_warnings();
  };
  State a, b, c, d;
  EXPECT_THAT(said(Method::exact, 20, 0, a), IsEmpty()) << "2 %";
  EXPECT_THAT(said(Method::pairwise, 20, 0, b), ElementsAre(HasSubstr("20 of 100 collisions were seen a step late")));
  EXPECT_THAT(said(Method::pairwise, 0, 20, c), ElementsAre(HasSubstr("20 of 1000 bounces off walls and obstacles")));
  EXPECT_THAT(validity_warnings_so_far(scene, c), ElementsAre(HasSubstr("20 of 1000 bounces off walls and obstacles")));
  EXPECT_THAT(said(Method::pairwise, 0, 10, d), IsEmpty()) << "ten are too few";
}

// A disk deep in a wall at the end of a step is as bad as two disks that overlap as much at its start.
TEST(Validity, AnOverlapWithAWallIsNamedToo) {
  const Scene scene = test::scene_from(test::sound_scene, {{"run.method", "pairwise"}});
  for (const double overlap : {0.09, 0.11}) {
    State state;
    StepFigures figures;
    figures.wall = {overlap, 1, wall_partner(Side::left)};
    Validity validity;
    validity.note_step(scene, figures, state);
    if (overlap < largest_overlap_before) {
      EXPECT_THAT(validity.take_warnings(), IsEmpty());
    } else {
      EXPECT_THAT(validity.take_warnings(),
                  ElementsAre(HasSubstr("disk 1 reaches 11 % of its radius beyond the left")));
    }
  }
}

// A source may lag behind by one disk, unless it has had no room for any.
TEST(Validity, ASourceThatNeverHadRoomIsNamed) {
  Scene scene = test::scene_from(test::sound_scene);
  scene.sources.resize(1);
  scene.sources[0].rate = 1.0;
  State state;
  state.sources.resize(1);
  state.counters.waiting = 1;
  state.time = 1.5;
  EXPECT_THAT(waiting_warnings(scene, state), ElementsAre(HasSubstr("1 of the 1 disks due from sources.0 still wait")));
  state.time = 20.5;
  state.sources[0].emitted = 19;
  EXPECT_THAT(waiting_warnings(scene, state), IsEmpty());
}

// A disk that is due at the end of a run does not come, so it does not wait: 9 of 19 wait, as the counter says.
TEST(Validity, NoDiskOfASourceWaitsThatIsDueAtTheEnd) {
  Scene scene = test::scene_from(test::sound_scene);
  scene.sources.resize(1);
  State state;
  state.sources.resize(1);
  state.sources[0].emitted = 10;
  state.counters.waiting = 9;
  for (const double rate : {1.0, 1.1, 0.7}) {
    scene.sources[0].rate = rate;
    state.time = 20.0 / rate;
    EXPECT_THAT(waiting_warnings(scene, state), ElementsAre(HasSubstr(" 9 of the 19 disks due"))) << rate;
  }
}

}  // namespace
}  // namespace carom
