// Which figures of a step are kept and reported, given by hand, and when walls are watched.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/physics/contact_event.hpp"
#include "core/step/step_start.hpp"
#include "core/step/validity.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

// With pairwise late contacts of supports in a pile are harmless and not reported; in a frame of rollback they are.
TEST(StepFigures, OfAPileLateCollisionsAreSaidWithRollbackAlone) {
  Scene scene = test::scene_from(test::sound_scene, {{"physics.gravity", "1.0"}, {"physics.restitution", "0.5"}});
  for (const Method method : {Method::pairwise, Method::rollback}) {
    scene.run.method = method;
    State state;
    state.counters.collisions = 100;
    StepFigures figures;
    figures.inaccurate = 20;
    Validity validity;
    validity.note_step(scene, figures, state);
    EXPECT_EQ(validity.take_warnings().size(), method == Method::rollback ? 1U : 0U);
  }
}

// For two disks the overlap at the start of a step counts as well, although they are then pushed apart: it is kept, and
// reported if it is deep.
TEST(StepFigures, AnOverlapBeforeAStepIsKeptAndSaid) {
  const Scene scene = test::scene_from(test::sound_scene, {{"run.method", "pairwise"}});
  for (const double before : {0.9 * largest_overlap_before, 1.1 * largest_overlap_before}) {
    State state;
    StepFigures figures;
    figures.left = {0.5 * largest_overlap, 1, 2};
    figures.before = {before, 0, 2};
    Validity validity;
    validity.note_step(scene, figures, state);
    EXPECT_EQ(state.validity.disks.overlap.size, before);
    EXPECT_EQ(validity.take_warnings().size(), before > largest_overlap_before ? 1U : 0U);
    EXPECT_EQ(worst_moment_warnings(scene, state).size(), before > largest_overlap_before ? 1U : 0U);
  }
}

// In exact an overlap with a wall is a missed contact, reported when it is seen and at the end.
TEST(StepFigures, AnOverlapWithAWallByExactIsAMissedContact) {
  const Scene scene = test::scene_from(test::sound_scene, {{"run.method", "exact"}});
  State state;
  StepFigures figures;
  figures.wall = {0.1, 1, wall_partner(Side::left)};
  Validity validity;
  validity.note_step(scene, figures, state);
  const std::vector<std::string> said = validity.take_warnings();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("of its radius beyond the left wall: a contact was missed"), std::string::npos) << said[0];
  EXPECT_EQ(worst_moment_warnings(scene, state), said);
}

// Between moving walls, a disk deep in another one counts as crushed, like one deep in a wall.
TEST(StepFigures, TheDeeperOfAWallAndADiskIsCrushed) {
  Scene scene = test::scene_from(test::sound_scene, {{"run.method", "pairwise"}});
  for (const bool moves : {true, false}) {
    scene.box.motions[0].kind = moves ? SideMotion::Kind::steady : SideMotion::Kind::none;
    for (const double of_wall : {0.26, 0.5}) {
      State state;
      StepFigures figures;
      figures.left = {0.4, 1, 2};
      figures.wall = {of_wall, 3, wall_partner(Side::left)};
      Validity().note_step(scene, figures, state);
      EXPECT_EQ(state.validity.crushed.overlap.size, moves ? std::max(0.4, of_wall) : 0.0);
    }
  }
}

// Time stalls twice, and worse the second time: that moment is reported at the end.
TEST(StepFigures, TheWorstStallOfRollbackIsKept) {
  Scene scene = test::scene_from(test::sound_scene, {{"run.method", "rollback"}, {"physics.gravity", "0.0"}});
  scene.run.dt = 1.0;
  scene.run.t_end = 1e9;
  State state;
  Validity validity;
  for (const double share : {0.04, 0.02, 0.03}) {
    for (Count frame = 0; frame < frames_watched; ++frame) {
      state.time += share;
      validity.note_step(scene, {}, state);
    }
  }
  EXPECT_EQ(validity.take_warnings().size(), 1U);
  EXPECT_NEAR(state.validity.advance.figure, 0.02, 1e-9);
}

// Walls are watched if something presses disks into them, or may catch disks between two of them.
TEST(StepFigures, WallsAreWatchedWhereDisksMayBePressedIntoThem) {
  const Scene plain = test::scene_from(test::sound_scene, {{"physics.gravity", "0.0"}});
  EXPECT_FALSE(walls_are_watched(plain));
  EXPECT_TRUE(walls_are_watched(test::scene_from(test::sound_scene, {{"physics.gravity", "0.1"}})));
  Scene moving = plain;
  moving.box.motions[0].kind = SideMotion::Kind::steady;
  EXPECT_TRUE(walls_are_watched(moving));
  Scene peg = plain;
  State state;
  Obstacle disk;
  disk.x = disk.y = 5.0;
  disk.radius = 0.5;
  state.obstacles = {disk};
  const auto obstacles = place_run_obstacles(peg, state);
  EXPECT_TRUE(walls_are_watched(peg));
}

}  // namespace
}  // namespace carom
