// Features of the exact method beyond elastic collisions: scaling, windows, frames, sinks, sources, Brownian motion,
// the TC model, inelastic collapse, and hostile input.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

const std::string gas =
    "[[disks]]\ncount = 60\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1.0\n";

// Other units of length, time and mass, in powers of two: every bit must correspond.
struct Units {
  double length, time, mass;
};

Scene in_units(Scene s, const Units& u) {
  s.box.width *= u.length;
  s.box.height *= u.length;
  const double acceleration = u.length / (u.time * u.time);
  s.physics.gravity = {s.physics.gravity.left * acceleration, s.physics.gravity.down * acceleration};
  s.physics.diffusion *= u.length * u.length / u.time;
  if (s.physics.collapse_contact_time) *s.physics.collapse_contact_time *= u.time;
  s.run.t_end *= u.time;
  s.run.dt *= u.time;
  return s;
}

State in_units(State s, const Units& u) {
  Disks& d = s.disks;
  for (std::size_t i = 0; i < d.size(); ++i) {
    d.x[i] *= u.length;
    d.y[i] *= u.length;
    d.vx[i] *= u.length / u.time;
    d.vy[i] *= u.length / u.time;
  }
  for (double& r : d.radius) r *= u.length;
  for (double& m : d.mass) m *= u.mass;
  d.common_radius *= u.length;
  d.common_mass *= u.mass;
  s.time *= u.time;
  s.counters.virial *= u.mass * u.length * u.length / u.time;
  return s;
}

TEST(ExactScale, UnitsChangeNoBit) {
  const Scene scenes[] = {
      make_scene({12, 12, "periodic", "", gas, 3.0, ""}),
      make_scene({12, 12, "wall_restitution = 0.8",
                  "gravity = 0.5\nrestitution = 0.7\ncollapse = { model = \"tc\", contact_time = 0.001 }", gas, 6.0,
                  ""}),
  };
  for (const Scene& scene : scenes) {
    const State initial = initial_state(scene);
    const State plain = run_reference(scene, initial);
    for (const Units& u :
         {Units{0x1p20, 1, 1}, Units{0x1p-20, 1, 1}, Units{1, 0x1p20, 0x1p-20}, Units{0x1p20, 0x1p-20, 0x1p20}}) {
      const State expected = in_units(plain, u);
      const State scaled = run_reference(in_units(scene, u), in_units(initial, u));
      EXPECT_EQ(state_hash(scaled.disks), state_hash(expected.disks));
      EXPECT_EQ(scaled.time, expected.time);
      EXPECT_EQ(scaled.counters.virial, expected.counters.virial);
      EXPECT_EQ(scaled.counters.wall_collisions, expected.counters.wall_collisions);
      const auto parallel = make_parallel_engine(in_units(scene, u), in_units(initial, u), {2, 64});
      run_to_end(*parallel, in_units(scene, u));
      EXPECT_EQ(state_hash(parallel->state().disks), state_hash(expected.disks));
    }
  }
}

TEST(ExactWindows, LengthMattersOnlyByRounding) {
  const Scene scene = make_scene({12, 12, "wall", "gravity = 0.3", gas, 2.0, ""});
  const State initial = initial_state(scene);
  const State usual = run_reference(scene, initial);
  for (const double scale : {0.1, 0.37, 5.0}) {
    const State other = run_reference(scene, initial, scale);
    EXPECT_NE(other.counters.steps, usual.counters.steps);
    EXPECT_EQ(other.counters.collisions, usual.counters.collisions);
    for (std::size_t i = 0; i < usual.disks.size(); ++i) {
      EXPECT_NEAR(other.disks.x[i], usual.disks.x[i], 1e-8);
      EXPECT_NEAR(other.disks.vy[i], usual.disks.vy[i], 1e-7);
    }
  }
}

TEST(ExactFrames, FramesChangeNothingAndLieOnThePath) {
  Domain box;
  box.width = box.height = 10.0;
  const Scene scene = plain_scene(box, 200.0, 0.0);
  const State initial = state_of({{5, 5, 1.0, 0.5, 0.5, 1, 0}, {2, 8, -0.3, 0.25, 0.5, 1, 0}});
  const auto quiet = make_reference_exact(scene, initial);
  const auto watched = make_reference_exact(scene, initial);
  Disks frame;
  Disks late;
  while (quiet->state().time < scene.run.t_end) {
    const double start = quiet->state().time;
    quiet->step();
    watched->step();
    for (int k = 0; k < 50; ++k) {
      const double t = start + (quiet->state().time - start) * k / 50.0;
      EXPECT_EQ(watched->disks_at(t, frame), t);
      EXPECT_EQ(max_overlap(frame, box), 0.0);
      EXPECT_LT(wall_overlap(frame, box), 1e-13);
      // Paths are continuous: shortly afterwards each disk is where its velocity carries it.
      const double dt = 1e-6;
      watched->disks_at(t + dt, late);
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_LT(std::hypot(late.x[i] - frame.x[i], late.y[i] - frame.y[i]), 3.0 * dt);
    }
  }
  EXPECT_EQ(state_hash(quiet->state().disks), state_hash(watched->state().disks));
  EXPECT_GT(quiet->state().counters.collisions, 2U);
}

// Paths of earlier windows are not kept: for an earlier time one gets the disks at the start of the last window, and
// that time.
TEST(ExactFrames, BeforeTheLastWindowAreOfItsStart) {
  const Scene scene = make_scene({12, 12, "periodic", "", gas, 30.0, ""});
  const State initial = initial_state(scene);
  for (const auto& engine : {make_reference_exact(scene, initial), make_parallel_engine(scene, initial, {1})}) {
    for (int k = 0; k < 2; ++k) engine->step();
    const double start = engine->state().time;
    const std::uint64_t at_start = state_hash(engine->state().disks);
    engine->step();
    ASSERT_GT(engine->state().time, start);
    Disks frame;
    EXPECT_EQ(engine->disks_at(0.5 * start, frame), start);
    EXPECT_EQ(state_hash(frame), at_start);
  }
}

TEST(ExactSinks, TakeADiskAtItsContact) {
  Domain box;
  box.width = box.height = 10.0;
  box.sides.fill(SideKind::sink);
  const Scene scene = plain_scene(box, 20.0);
  // Disk 0 would hit disk 1 beyond the side, but it leaves at t = 4.5.
  const State initial = state_of({{5, 5, 1, 0, 0.5, 1, 0}, {8, 9.0, 0.0, -0.7, 0.5, 1, 0}, {2, 2, 0, 0, 0.5, 1, 0}});
  const auto engine = make_reference_exact(scene, initial);
  Disks frame;
  bool seen_before = false;
  bool seen_after = false;
  while (engine->state().time < scene.run.t_end) {
    const double start = engine->state().time;
    engine->step();
    for (int k = 0; k < 100; ++k) {
      const double t = start + (engine->state().time - start) * k / 100.0;
      engine->disks_at(t, frame);
      seen_before = seen_before || (t > 4.0 && t < 4.5 && frame.size() == 3);
      seen_after = seen_after || (t > 4.5 && t < 11.0 && frame.size() == 2);
      EXPECT_EQ(wall_overlap(frame, box), 0.0);
      EXPECT_TRUE(t > 4.5 || frame.size() == 3) << t;
      EXPECT_TRUE(t < 4.5 || frame.size() <= 2) << t;
    }
  }
  EXPECT_TRUE(seen_before && seen_after);
  EXPECT_EQ(engine->state().counters.removed, 2U);
  EXPECT_EQ(engine->state().counters.wall_collisions, 0U);
  EXPECT_EQ(engine->state().disks.id, std::vector<DiskId>{2});
}

TEST(ExactSources, EmitAtTheirTimesNeverIntoOthers) {
  const Scene scene = make_scene({10, 10, "left = \"wall\"\nright = \"sink\"", "",
                                  "[[sources]]\nside = \"left\"\nrate = 4.0\nradius = 0.4\nmass = 1.0\nvelocities = { "
                                  "uniform = 2.0 }\nlimit = 60\n",
                                  12.0, ""});
  const auto engine = make_reference_exact(scene, initial_state(scene));
  while (engine->state().time < scene.run.t_end) {
    engine->step();
    EXPECT_LT(max_overlap(engine->state().disks, scene.box), 1e-13);
    const auto due = static_cast<Count>(engine->state().time * 4.0);
    EXPECT_LE(engine->state().counters.emitted, due);
  }
  const Counters& c = engine->state().counters;
  EXPECT_EQ(c.emitted + c.waiting, 47U);  // the 48th disk is due at t_end itself
  EXPECT_EQ(engine->state().disks.size(), c.emitted - c.removed);
  EXPECT_GT(c.removed, 0U);
}

TEST(ExactBrownian, FreeDisksSpreadAsFourDT) {
  const Scene scene =
      make_scene({4000, 4000, "wall", "diffusion = 0.7",
                  "[[disks]]\ncount = 2000\npositions = \"square\"\nradius = 0.01\nmass = 1.0\n", 3.0, "dt = 0.1"});
  const State initial = initial_state(scene);
  const auto engine = make_parallel_engine(scene, initial, {2, 8});
  run_to_end(*engine, scene);
  const Disks& d = engine->state().disks;
  double sum = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const std::size_t k = index_of(initial.disks, d.id[i]);
    sum += std::pow(d.x[i] - initial.disks.x[k], 2) + std::pow(d.y[i] - initial.disks.y[k], 2);
  }
  const double expected = 4.0 * 0.7 * 3.0;
  EXPECT_NEAR(sum / 2000.0, expected, 3.0 * expected / std::sqrt(2000.0));
}

// In each interval disks fly like a gas with kT / m = 2 D / dt, from positions that are those of equilibrium for any
// dt.
TEST(ExactBrownian, CollisionsGrowAsOneOverTheRootOfDt) {
  constexpr double z = 2.06326, side = 28.025;  // docs/reference_values.md, packing fraction 0.3
  const std::string disks = "[[disks]]\ncount = 300\npositions = \"random\"\nradius = 0.5\nmass = 1.0\n";
  for (const char* const dt : {"0.004", "0.001"}) {
    const Scene scene = make_scene({side, side, "periodic", "diffusion = 1.0", disks, 4.0, "dt = " + std::string(dt)});
    const auto engine = make_parallel_engine(scene, initial_state(scene), {1});
    while (engine->state().time < 1.5) engine->step();
    const double begin = engine->state().time;
    const Count before = engine->state().counters.collisions;
    run_to_end(*engine, scene);
    const State& end = engine->state();
    const double rate = 2.0 * static_cast<double>(end.counters.collisions - before) / (300.0 * (end.time - begin));
    EXPECT_NEAR(rate / (4.0 * (z - 1.0) * std::sqrt(2.0 / (std::numbers::pi * scene.run.dt))), 1.0, 0.05) << dt;
  }
}

TEST(ExactCollapse, IsReportedAndTheStateBeforeIsKept) {
  // Three disks in a row collapse for e below 7 - 4 sqrt(3).
  Domain box;
  box.width = 40.0;
  box.height = 10.0;
  const State initial = state_of({{5, 5, 1, 0, 0.5, 1, 0}, {10, 5, 0, 0, 0.5, 1, 0}, {15, 5, -1, 0, 0.5, 1, 0}});
  for (const bool parallel : {false, true}) {
    const Scene scene = plain_scene(box, 100.0, 0.0, 0.05);
    const auto engine = parallel ? make_parallel_engine(scene, initial, {1, 1}) : make_reference_exact(scene, initial);
    try {
      run_to_end(*engine, scene);
      FAIL() << "no collapse was reported";
    } catch (const PhysicsError& e) {
      const std::string what = e.what();
      EXPECT_NE(what.find("inelastic collapse at t = "), std::string::npos) << what;
      EXPECT_NE(what.find("model = \"tc\", contact_time"), std::string::npos) << what;
      EXPECT_NE(what.find("disk "), std::string::npos) << what;
    }
    EXPECT_EQ(engine->state().disks.size(), 3U);
    EXPECT_EQ(max_overlap(engine->state().disks, box), 0.0);
  }
  // Above this value they do not collapse.
  EXPECT_NO_THROW(run_reference(plain_scene(box, 100.0, 0.0, 0.08), initial));
  // With the TC model the disks go on and separate.
  Scene tc = plain_scene(box, 100.0, 0.0, 0.05);
  tc.physics.collapse_contact_time = 1e-6;
  const State after = run_reference(tc, initial);
  EXPECT_EQ(after.time, 100.0);
  EXPECT_LT(max_overlap(after.disks, box), 1e-13);
}

TEST(ExactCollapse, TcLeavesRareCollisionsAlone) {
  Scene scene = make_scene({14, 14, "periodic", "restitution = 0.9", gas, 4.0, ""});
  const State initial = initial_state(scene);
  const State without = run_reference(scene, initial);
  scene.physics.collapse_contact_time = 0.0;
  EXPECT_EQ(state_hash(run_reference(scene, initial).disks), state_hash(without.disks));
  scene.physics.collapse_contact_time = 1e9;
  // Only the first collision of each disk dissipates.
  EXPECT_GT(energy_of(run_reference(scene, initial).disks, 0.0).kinetic, energy_of(without.disks, 0.0).kinetic);
}

// Bad input must give the right answer or one clear line, and never hang.
TEST(ExactHostile, NothingMovesNoDisksNoTime) {
  Domain box;
  box.width = box.height = 10.0;
  for (const auto kind : {SideKind::wall, SideKind::periodic, SideKind::sink}) {
    box.sides.fill(kind);
    const State none = run_reference(plain_scene(box, 5.0), State{});
    EXPECT_EQ(none.time, 5.0);
    const State still = run_reference(plain_scene(box, 5.0), state_of({{5, 5, 0, 0, 1, 1, 0}, {7, 5, 0, 0, 1, 1, 0}}));
    EXPECT_EQ(still.time, 5.0);
    EXPECT_EQ(still.disks.x[0], 5.0);
    EXPECT_EQ(still.counters.collisions, 0U);
    const auto parallel = make_parallel_engine(plain_scene(box, 5.0), State{}, {2, 1});
    run_to_end(*parallel, plain_scene(box, 5.0));
    EXPECT_EQ(parallel->state().time, 5.0);
    const auto no_time = make_parallel_engine(plain_scene(box, 0.0), state_of({{5, 5, 1, 0, 1, 1, 0}}), {1, 1});
    no_time->step();
    EXPECT_EQ(no_time->state().disks.x[0], 5.0);
    EXPECT_EQ(no_time->state().counters.steps, 0U);
  }
}

TEST(ExactHostile, SpeedsThatDifferByATrillion) {
  Domain box;
  box.width = box.height = 10.0;
  const State initial =
      state_of({{2, 5, 1e6, 0, 0.5, 1, 0}, {8, 5, -1e-6, 1e-6, 0.5, 1, 0}, {5, 9, 0, 1e-6, 0.5, 1, 0}});
  const Scene scene = plain_scene(box, 1e-4);
  const State s = run_reference(scene, initial);
  EXPECT_GE(s.counters.collisions, 1U);
  EXPECT_LT(max_overlap(s.disks, box), 1e-13);
  EXPECT_NEAR(energy_of(s.disks, 0.0).kinetic, 0.5e12, 1.0);
  const auto parallel = make_parallel_engine(scene, initial, {2, 1});
  run_to_end(*parallel, scene);
  EXPECT_EQ(state_hash(parallel->state().disks), state_hash(s.disks));
}

TEST(ExactHostile, OneFastDiskAmongManySlowOnes) {
  Scene scene = make_scene(
      {40, 40, "periodic", "", "[[disks]]\ncount = 400\npositions = \"square\"\nradius = 0.5\nmass = 1.0\n", 1e-3, ""});
  State initial = initial_state(scene);
  initial.disks.vx[17] = 1e4;
  const State s = run_reference(scene, initial);
  EXPECT_GT(s.counters.collisions, 5U);
  const auto parallel = make_parallel_engine(scene, initial, {2, 16});
  run_to_end(*parallel, scene);
  EXPECT_EQ(state_hash(parallel->state().disks), state_hash(s.disks));
}

TEST(ExactHostile, ADiskAtRestOnTheFloor) {
  Domain box;
  box.width = box.height = 10.0;
  const State initial = state_of({{5, 1, 0, 0, 1, 1, 0}});
  Scene scene = plain_scene(box, 1.0, 1.0);
  EXPECT_THROW(run_reference(scene, initial), PhysicsError);
  scene.physics.collapse_contact_time = 0.01;
  EXPECT_THROW(run_reference(scene, initial), PhysicsError) << "nothing dissipates, so the TC model must not act";
  scene.box.restitutions.fill(0.5);
  const State s = run_reference(scene, initial);
  EXPECT_EQ(s.time, 1.0);
  EXPECT_NEAR(s.disks.y[0], 1.0, 1e-4);
}

TEST(ExactHostile, TimeTooFineToAdvance) {
  Domain box;
  box.width = box.height = 10.0;
  State initial = state_of({{5, 5, 1e200, 0, 1, 1, 0}});
  EXPECT_THROW(run_reference(plain_scene(box, 1.0), initial), PhysicsError);
  State late = state_of({{5, 5, 1e9, 0, 1, 1, 0}});
  late.time = 1e12;
  EXPECT_THROW(run_reference(plain_scene(box, 2e12), late), PhysicsError);
}

// With e = 0 two disks meet once and then separate, whatever rounding leaves of their relative velocity; in these cases
// it left an approach.
TEST(ExactCollapse, IsNotWhereTwoThatStickMeetOnce) {
  const std::string group = "[[disks]]\nname = \"a\"\ncount = 2\nradius = [0.5, 1.0]\nmass = 1.0\n";
  for (const std::string& disks :
       {std::string("positions = [[5.485034627930945, 9.570918669300385], [12.00045171488507, 10.0]]\nvelocities = "
                    "[[1.6628185628837677, -0.011898297174222], [-0.7597306350978931, -0.05073585117046339]]\n"),
        std::string("positions = [[5.417993654979519, 9.852454144828021], [12.281257007115338, 10.0]]\nvelocities = "
                    "[[1.8432785884739036, 0.19588849482725074], [-0.4746472523201577, 0.1852860138191469]]\n")}) {
    for (const char* physics : {"restitution = 0.0", "[[physics.pairs]]\ngroups = [\"a\", \"a\"]\nrestitution = 0.0"}) {
      const Scene scene = make_scene({20, 20, "wall", physics, group + disks, 6.0, ""});
      const State initial = initial_state(scene);
      State end;
      ASSERT_NO_THROW(end = run_reference(scene, initial)) << physics << disks;
      EXPECT_EQ(end.counters.collisions, 1U);
      const auto engine = make_parallel_engine(scene, initial, {1});
      run_to_end(*engine, scene);
      EXPECT_EQ(state_hash(engine->state().disks), state_hash(end.disks));
    }
  }
}

// Disks that fill the box exactly: a square lattice in which all touch and some move.
TEST(ExactHostile, FullBox) {
  Domain box;
  box.width = box.height = 8.0;
  std::vector<Disk> disks;
  for (int k = 0; k < 64; ++k) disks.push_back({0.5 + k % 8, 0.5 + k / 8, 0, 0, 0.5, 1, 0});
  disks[0].vx = 1.0;
  disks[0].vy = 0.5;
  const Scene scene = plain_scene(box, 0.01);
  try {
    const State s = run_reference(scene, state_of(disks));
    EXPECT_LT(max_overlap(s.disks, box), 1e-9);
    EXPECT_NEAR(energy_of(s.disks, 0.0).kinetic, 0.625, 1e-9);
  } catch (const PhysicsError& e) {
    EXPECT_NE(std::string(e.what()).find("exact: "), std::string::npos);
  }
}

}  // namespace
}  // namespace carom::exact_tests
