// The scale of a movie's colours covers the values to be expected in a run, and its list names all groups.
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "core/scene/disk_group.hpp"
#include "io/movie/frame.hpp"
#include "tests/support/picture.hpp"
#include "tests/support/source_by_hand.hpp"

namespace carom {
namespace {

using test::one_disk;

Scene square_scene() {
  Scene scene;
  scene.box = test::square_box(10.0);
  scene.run.t_end = 10.0;
  return scene;
}

FrameStyle predicted(const Scene& scene, const Disks& first) {
  return frame_style(scene, scene.output.look, foreseen_values(scene, first));
}

double speed_square(const Scene& scene, const Disks& first) {
  return foreseen_values(scene, first).speed_square;
}

Source point_source(double radius, double mass) {
  Source source = test::source_in({5.0, 9.0}, {5.0, 9.0}, 1.0, radius);
  source.mass.value = mass;
  return source;
}

SizeLaw between(double low, double high) {
  SizeLaw law;
  law.kind = SizeLaw::Kind::uniform;
  law.low = low;
  law.high = high;
  return law;
}

SizeLaw from_other(double density) {
  SizeLaw law;
  law.kind = SizeLaw::Kind::from_other;
  law.density = density;
  return law;
}

const Disks resting = one_disk(3.0, 5.0, 0.0, 1.0);

// Towards the left disks at 3 with radius 1 fall by 2, towards the right by 6, upwards and downwards by 4.
TEST(SpeedScale, FallingAddsTheWayToTheWall) {
  Scene scene = square_scene();
  scene.physics.gravity = {0.5, 0.0};
  EXPECT_DOUBLE_EQ(speed_square(scene, resting), 2.0 * 0.5 * 2.0);
  scene.physics.gravity = {-0.5, 0.0};
  EXPECT_DOUBLE_EQ(speed_square(scene, resting), 2.0 * 0.5 * 6.0);
  scene.physics.gravity = {-0.5, -0.25};
  EXPECT_DOUBLE_EQ(speed_square(scene, resting), 2.0 * (0.5 * 6.0 + 0.25 * 4.0));
  EXPECT_DOUBLE_EQ(speed_square(scene, one_disk(3.0, 5.0, 2.0, 1.0)), 4.0 + 2.0 * (0.5 * 6.0 + 0.25 * 4.0))
      << "in addition to its own speed";
}

// If collisions lose energy, they do not pass all of it to light disks.
TEST(SpeedScale, LightDisksDoNotGetFasterWhereEnergyIsLost) {
  Scene scene = square_scene();
  Disks mixed = one_disk(2.0, 5.0, 1.0, 1.0);
  append(mixed, {6.0, 5.0, 1.0, 0.0, 1.0, 100.0, 1});
  EXPECT_NEAR(speed_square(scene, mixed), 2.5 * 25.5025, 1e-9);
  scene.physics.restitution = 0.9;
  EXPECT_DOUBLE_EQ(speed_square(scene, mixed), 1.0);
}

TEST(SpeedScale, SourcesBringTheirOwnSpeeds) {
  Scene scene = square_scene();
  Source& source = scene.sources.emplace_back(point_source(1.0, 1.0));
  source.mass = between(2.0, 8.0);
  source.velocities.kind = VelocityLaw::Kind::uniform;
  source.velocities.limit = 3.0;
  EXPECT_DOUBLE_EQ(speed_square(scene, {}), 18.0) << "both components";
  source.velocities.kind = VelocityLaw::Kind::maxwell;
  source.velocities.temperature = 4.0;
  EXPECT_DOUBLE_EQ(speed_square(scene, {}), 2.5 * 2.0 * 4.0 / 2.0) << "the lightest disks are the fastest";
}

// Disks of radius 1 that enter touching a side fall away from it: they cannot fall to that side.
TEST(SpeedScale, FromASideDisksFallFromThere) {
  Scene scene = square_scene();
  scene.sources.push_back(point_source(1.0, 1.0));
  const auto from = [&](Side side) {
    scene.sources[0].side = side;
    return speed_square(scene, {});
  };
  scene.physics.gravity = 1.0;
  EXPECT_DOUBLE_EQ(from(Side::top), 18.0);
  EXPECT_DOUBLE_EQ(from(Side::bottom), 0.0);
  EXPECT_DOUBLE_EQ(from(Side::left), 8.0);
  scene.physics.gravity = {1.0, 0.0};
  EXPECT_DOUBLE_EQ(from(Side::right), 18.0);
  EXPECT_DOUBLE_EQ(from(Side::left), 0.0);
  EXPECT_DOUBLE_EQ(from(Side::top), 8.0);
}

// At a given temperature the fastest disk is the lightest that exists or will come.
TEST(SpeedScale, ATemperatureIsThatOfTheLightestDisk) {
  Scene scene = square_scene();
  scene.physics.thermostat = {Thermostat::Kind::langevin, 2.0, 1.0, 0.1};
  EXPECT_DOUBLE_EQ(speed_square(scene, resting), 2.5 * 2.0 * 2.0);
  scene.sources.push_back(point_source(1.0, 0.25));
  scene.sources[0].mass = between(0.25, 16.0);
  EXPECT_DOUBLE_EQ(speed_square(scene, resting), 2.5 * 2.0 * 2.0 / 0.25);
  EXPECT_DOUBLE_EQ(speed_square(scene, {}), 2.5 * 2.0 * 2.0 / 0.25);
}

TEST(SpeedScale, InnerWallsThatMovePushDisks) {
  Scene scene = square_scene();
  InnerWall& wall = scene.walls.emplace_back();
  wall.motion.pace.kind = SideMotion::Kind::steady;
  wall.motion.pace.speed = 1.0;
  wall.motion.along = {3.0, 4.0};
  scene.box.inner_walls_move = true;
  EXPECT_DOUBLE_EQ(speed_square(scene, resting), 100.0) << "a disk leaves twice as fast as the wall";
}

TEST(SpeedScale, BrownianStepsComeOnTopOfVelocitiesThatAreKept) {
  Scene scene = square_scene();
  scene.run.dt = 0.01;
  scene.physics.diffusion = 0.1;
  EXPECT_DOUBLE_EQ(speed_square(scene, one_disk(3.0, 5.0, 2.0, 1.0)), 2.5 * 40.0);
  scene.physics.accumulate = true;
  EXPECT_DOUBLE_EQ(speed_square(scene, one_disk(3.0, 5.0, 2.0, 1.0)), 4.0 + 40.0);
}

// The scale covers radii, masses and ids of disks that sources will emit, for any law.
TEST(ColourScale, CoversWhatSourcesBring) {
  Scene scene = square_scene();
  scene.sources.push_back(point_source(0.5, 3.0));
  SeenValues seen = foreseen_values(scene, Disks{});
  EXPECT_TRUE(seen.any);
  EXPECT_EQ(seen.radius.low, 0.5);
  EXPECT_EQ(seen.radius.high, 0.5);
  EXPECT_EQ(seen.last_id, 10U) << "one per unit of time, until 10";
  scene.sources.push_back(point_source(2.0, 1.0));
  scene.sources.back().limit = 3;
  seen = foreseen_values(scene, resting);
  EXPECT_EQ(seen.radius.low, 0.5);
  EXPECT_EQ(seen.radius.high, 2.0);
  EXPECT_EQ(seen.mass.low, 1.0);
  EXPECT_EQ(seen.mass.high, 3.0);
  EXPECT_EQ(seen.last_id, 13U);
  scene.sources = {point_source(0.5, 3.0)};
  scene.sources[0].radius = from_other(4.0 / std::numbers::pi);
  scene.sources[0].mass = between(1.0, 64.0);
  seen = foreseen_values(scene, Disks{});
  EXPECT_DOUBLE_EQ(seen.radius.low, 0.5);
  EXPECT_DOUBLE_EQ(seen.radius.high, 4.0);
  scene.sources[0].radius = between(1.0, 3.0);
  scene.sources[0].mass = from_other(1.0 / std::numbers::pi);
  seen = foreseen_values(scene, Disks{});
  EXPECT_DOUBLE_EQ(seen.mass.low, 1.0);
  EXPECT_DOUBLE_EQ(seen.mass.high, 9.0);
}

TEST(FrameStyle, ListsAllGroupsAndWhatStandsInTheBox) {
  Scene scene = square_scene();
  scene.groups.resize(2);
  scene.groups[0].name = "sand";
  FrameStyle style = predicted(scene, {});
  EXPECT_EQ(style.groups, 2U);
  EXPECT_EQ(style.group_names, (std::vector<std::string>{"sand", ""}));
  scene.sources.push_back(point_source(1.0, 1.0));
  InnerWall& wall = scene.walls.emplace_back();
  wall.points = {{1.0, 1.0}, {2.0, 3.0}};
  style = predicted(scene, {});
  EXPECT_EQ(style.groups, 3U);
  EXPECT_EQ(style.group_names, (std::vector<std::string>{"sand", "", std::string(sources_name)}));
  ASSERT_EQ(style.obstacles.size(), 1U);
  EXPECT_EQ(style.obstacles[0].dy, 2.0);
  EXPECT_TRUE(style.wall_motions.empty());
  scene.box.inner_walls_move = true;
  EXPECT_EQ(predicted(scene, {}).wall_motions.size(), 1U);
}

// As many decimals as are needed to distinguish frames, four at most; scientific notation if that is not enough, or if
// t is too long.
TEST(FrameStyle, DecimalsTellFramesApart) {
  Scene scene = square_scene();
  const auto decimals = [&](double every) {
    scene.output.every = every;
    return predicted(scene, {}).time_decimals;
  };
  EXPECT_EQ(decimals(1.0), 0);
  EXPECT_EQ(decimals(0.25), 2);
  EXPECT_EQ(decimals(0.0125), 4);
  EXPECT_EQ(decimals(1.0 / 3.0), 4);
  EXPECT_EQ(decimals(1e-4), 4);
  EXPECT_EQ(decimals(9e-5), -1);
  EXPECT_EQ(decimals(0.0), 0) << "with frames at every step, as many as the end needs";
  scene.run.t_end = 0.5;
  EXPECT_EQ(decimals(0.0), 1);
  scene.run.t_end = 1e7;
  EXPECT_EQ(decimals(1.0), -1);
}

}  // namespace
}  // namespace carom
