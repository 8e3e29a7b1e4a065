// Inner walls: contacts with a segment and with its ends, sinks, funnels, and the messages for bad walls. The agreement
// of both engines, and resumed runs, are tested in obstacles_test.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

Scene scene_with(const std::string& method, const std::string& physics, const std::string& rest, double t_end) {
  return parse_scene("[box]\nwidth = 20.0\nheight = 20.0\n[physics]\n" + physics + "\n" + rest + "[run]\nmethod = \"" +
                         method + "\"\ndt = 0.001\nt_end = " + std::to_string(t_end) + "\n",
                     "walls.toml", "");
}

State run_to_end(const Scene& scene) {
  const auto engine = make_parallel_engine(scene, initial_state(scene), {2, 1});
  while (engine->state().time < scene.run.t_end) engine->step();
  return engine->state();
}

std::string one_disk(double x, double y, double vx, double vy, double radius) {
  return fmt::format("[[disks]]\ncount = 1\npositions = [[{}, {}]]\nvelocities = [[{}, {}]]\nradius = {}\nmass = 2.0\n",
                     x, y, vx, vy, radius);
}

constexpr const char* methods[] = {"exact", "pairwise", "rollback"};

// A wall at 45 degrees: a disk that flies to the right is sent upwards; on the other side a disk that flies to the left
// is sent downwards.
TEST(InnerWall, ReflectsOnBothSides) {
  const std::string wall = "[[walls]]\nfrom = [8.0, 8.0]\nto = [12.0, 12.0]\n";
  for (const char* method : methods) {
    const State up = run_to_end(scene_with(method, "", wall + one_disk(4.0, 10.0, 2.0, 0.0, 0.5), 4.0));
    EXPECT_NEAR(up.disks.vx[0], 0.0, 1e-12) << method;
    EXPECT_NEAR(up.disks.vy[0], 2.0, 1e-12) << method;
    EXPECT_EQ(up.counters.wall_collisions, 1U);
    const State down = run_to_end(scene_with(method, "", wall + one_disk(16.0, 10.0, -2.0, 0.0, 0.5), 4.0));
    EXPECT_NEAR(down.disks.vx[0], 0.0, 1e-12) << method;
    EXPECT_NEAR(down.disks.vy[0], -2.0, 1e-12) << method;
    // The centre turns at a distance of a radius from the line.
    const double turn = 10.0 + 0.5 * std::numbers::sqrt2;
    EXPECT_NEAR(down.disks.x[0], turn, 1e-9) << method;
  }
}

// If a disk touches two walls at once, the one listed first in the file is met first, not the one in the first cell. So
// the scene with x and y exchanged has the exchanged bits.
TEST(InnerWall, OfTwoTouchedInOneFrameTheFirstOfTheListIsMetFirst) {
  const auto after_two_frames = [](const std::string& walls) {
    const Scene scene = parse_scene("[box]\nwidth = 20.0\nheight = 20.0\n" + walls + one_disk(10, 10, 1, 1, 0.5) +
                                        "[run]\nmethod = \"rollback\"\ndt = 0.02\nt_end = 0.04\n",
                                    "walls.toml", "");
    return run_to_end(scene);
  };
  const State one = after_two_frames(
      "[[walls]]\nfrom = [9.9, 10.5]\nto = [9.8, 11.0]\n[[walls]]\nfrom = [10.5, 9.9]\nto = [11.0, 9.8]\n");
  const State exchanged = after_two_frames(
      "[[walls]]\nfrom = [10.5, 9.9]\nto = [11.0, 9.8]\n[[walls]]\nfrom = [9.9, 10.5]\nto = [9.8, 11.0]\n");
  EXPECT_GE(one.counters.wall_collisions, 2U);
  EXPECT_EQ(one.disks.vx[0], exchanged.disks.vy[0]);
  EXPECT_EQ(one.disks.vy[0], exchanged.disks.vx[0]);
  EXPECT_EQ(one.disks.x[0], exchanged.disks.y[0]);
  EXPECT_EQ(one.disks.y[0], exchanged.disks.x[0]);
}

// At a joint of segments a disk makes one contact, not two, also in scenes where dissipation could bring disks to rest:
// it bounces as from one segment, with a speed that a disk squeezed between two walls would not keep.
TEST(InnerWall, AJointBouncesAsOneSegmentDoes) {
  const auto after_bounce = [](const std::string& walls) {
    const Scene scene =
        parse_scene("[box]\nwidth = 20.0\nheight = 20.0\n[physics]\ngravity = 0.5\nrestitution = 0.5\n" + walls +
                        one_disk(5.0, 1.52, 0.0, 0.0, 0.5) + "[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 0.4\n",
                    "walls.toml", "");
    return run_to_end(scene);
  };
  const State flat = after_bounce("[[walls]]\npoints = [[2.0, 1.0], [8.0, 1.0]]\n");
  EXPECT_NEAR(flat.disks.vy[0], 0.0828, 0.005);  // sqrt(0.02) - 0.5 (0.4 - sqrt(0.08)), to first order in dt
  const std::string joints[] = {
      "[[walls]]\npoints = [[2.0, 1.0], [5.0, 1.0], [8.0, 1.0]]\n",              // a joint of a straight wall
      "[[walls]]\npoints = [[2.0, 1.0], [4.99, 1.0], [8.0, 1.0]]\n",             // a joint beside the disk
      "[[walls]]\npoints = [[2.0, 0.5], [5.0, 1.0], [8.0, 0.5]]\n",              // a joint at a peak
      "[[walls]]\npoints = [[5.0, 1.0], [8.0, 0.5], [2.0, 0.5], [5.0, 1.0]]\n",  // the joint of the last segment with
                                                                                 // the first
      "[[walls]]\nfrom = [2.0, 1.0]\nto = [8.0, 1.0]\n[[walls]]\nfrom = [5.0, 0.2]\nto = [5.0, 1.0]\n",  // a support
                                                                                                         // below the
                                                                                                         // wall
      "[[walls]]\nfrom = [2.0, 0.7]\nto = [5.0, 1.0]\n[[walls]]\nfrom = [8.0, 0.7]\nto = [5.0, 1.0]\n",  // a joint of
                                                                                                         // two walls
  };
  for (const std::string& joint : joints) {
    const State state = after_bounce(joint);
    EXPECT_NEAR(state.disks.vy[0], flat.disks.vy[0], 1e-12) << joint;
    EXPECT_NEAR(state.disks.y[0], flat.disks.y[0], 1e-12) << joint;
    EXPECT_EQ(state.counters.wall_collisions, 1U) << joint;
  }
}

// The same for a disk that a step takes into a straight wall beside a joint: it bounces off the side of one segment,
// not off the end of the other, whichever is listed first. Rollback once sent it back obliquely.
TEST(InnerWall, ABounceBesideAJointIsThatOfTheStraightWall) {
  for (const char* method : {"pairwise", "rollback"}) {
    const auto after_bounce = [&](const std::string& points) {
      const Scene scene = parse_scene("[box]\nwidth = 20.0\nheight = 20.0\n[[walls]]\npoints = [" + points + "]\n" +
                                          one_disk(3.0, 3.51, 2.0, -2.0, 0.5) + "[run]\nmethod = \"" + method +
                                          "\"\ndt = 0.04\nt_end = 2.0\n",
                                      "walls.toml", "");
      return run_to_end(scene);
    };
    const State straight = after_bounce("[1.0, 1.0], [19.0, 1.0]");
    EXPECT_EQ(straight.counters.wall_collisions, 1U);
    EXPECT_NEAR(straight.disks.vy[0], 2.0, 1e-12);
    for (int k = 0; k <= 20; ++k) {
      const double at = 4.5 + 0.05 * k;
      if (at > 5.0 && at < 5.09) continue;  // the centre is at 5.01 at the contact and at 5.08 at the end of the step
      const std::string joint = fmt::format("[{}, 1.0]", at);
      for (const std::string& points :
           {"[1.0, 1.0], " + joint + ", [19.0, 1.0]", "[19.0, 1.0], " + joint + ", [1.0, 1.0]"}) {
        const State state = after_bounce(points);
        EXPECT_NEAR(state.disks.vx[0], straight.disks.vx[0], 1e-9) << method << ": " << points;
        EXPECT_NEAR(state.disks.vy[0], straight.disks.vy[0], 1e-9) << method << ": " << points;
        EXPECT_EQ(state.counters.wall_collisions, 1U) << method << ": " << points;
      }
    }
  }
}

// In an inner corner a disk does touch two walls, and both bear it.
TEST(InnerWall, AnInnerCornerBearsOnBothSides) {
  const std::string corner = "[[walls]]\npoints = [[2.0, 8.0], [10.0, 4.0], [18.0, 8.0]]\nrestitution = 0.5\n";
  const Scene scene = scene_with("pairwise", "gravity = 0.5", corner + one_disk(10.0, 4.7, 0.0, 0.0, 0.5), 20.0);
  const State state = run_to_end(scene);
  ASSERT_EQ(state.loads.size(), 2U);
  EXPECT_NEAR(state.loads[0].force, state.loads[1].force, 1e-9);
}

TEST(InnerWall, HasARestitutionOfItsOwn) {
  const std::string wall = "[[walls]]\nfrom = [10.0, 2.0]\nto = [10.0, 18.0]\nrestitution = 0.5\n";
  for (const char* method : methods) {
    const State state = run_to_end(scene_with(method, "", wall + one_disk(5.0, 10.0, 2.0, 1.0, 0.5), 3.0));
    EXPECT_NEAR(state.disks.vx[0], -1.0, 1e-12) << method;
    EXPECT_NEAR(state.disks.vy[0], 1.0, 1e-12) << method;
  }
}

// The end of a wall acts as a disk of radius 0: at half a radius beside it the normal makes an angle of 30 degrees with
// the path.
TEST(InnerWall, EndsAreRound) {
  const std::string wall = "[[walls]]\nfrom = [10.0, 10.0]\nto = [10.0, 2.0]\n";
  for (const char* method : methods) {
    const State state = run_to_end(scene_with(method, "", wall + one_disk(5.0, 10.5, 2.0, 0.0, 1.0), 3.5));
    EXPECT_NEAR(state.disks.vx[0], -1.0, 1e-12) << method;
    EXPECT_NEAR(state.disks.vy[0], std::sqrt(3.0), 1e-12) << method;
  }
}

// A disk passes through a slit wider than itself by a hundredth, and not through one narrower by as much.
TEST(InnerWall, SlitsLetThroughWhatFits) {
  for (const double width : {2.01, 1.99}) {
    const std::string walls = fmt::format(
        "[[walls]]\nfrom = [10.0, 0.0]\nto = [10.0, {}]\n[[walls]]\nfrom = [10.0, {}]\nto = "
        "[10.0, 20.0]\n",
        10.0 - 0.5 * width, 10.0 + 0.5 * width);
    for (const char* method : methods) {
      const State state = run_to_end(scene_with(method, "", walls + one_disk(5.0, 10.0, 2.0, 0.0, 1.0), 4.0));
      EXPECT_EQ(state.disks.x[0] > 10.0, width > 2.0) << method;
    }
  }
}

// A disk falls from rest onto a slope of 45 degrees: after the bounce it flies horizontally, as fast as it fell.
TEST(InnerWall, SlopesTurnFallIntoFlight) {
  const std::string slope = "[[walls]]\nfrom = [2.0, 14.0]\nto = [12.0, 4.0]\n";
  const Scene scene = scene_with("exact", "gravity = 1.0", slope + one_disk(5.0, 15.0, 0.0, 0.0, 0.5), 3.0);
  const double fall = 15.0 - (11.0 + 0.5 * std::numbers::sqrt2);
  const State state = run_to_end(scene);
  EXPECT_EQ(state.counters.wall_collisions, 1U);
  EXPECT_NEAR(state.disks.vx[0], std::sqrt(2.0 * fall), 1e-12);
  EXPECT_NEAR(energy_of(state.disks, 1.0).total(), 30.0, 1e-12);
}

// An elastic acute wedge under gravity: thousands of contacts, none with a noticeable gap or overlap.
TEST(InnerWall, AnAcuteWedgeHoldsADisk) {
  const std::string wedge = "[[walls]]\npoints = [[9.0, 19.0], [10.0, 1.0], [11.0, 19.0]]\n";
  const Scene scene = scene_with("exact", "gravity = 5.0", wedge + one_disk(10.1, 14.0, 0.3, 0.0, 0.2), 400.0);
  const State start = initial_state(scene);
  const State state = run_to_end(scene);
  EXPECT_GT(state.counters.wall_collisions, 2000U);
  Domain box = scene.box;
  const auto cells = place_obstacles(state.obstacles, box);
  EXPECT_LT(wall_overlap(state.disks, box), 1e-12);
  EXPECT_NEAR(energy_of(state.disks, 5.0).total(), energy_of(start.disks, 5.0).total(), 1e-9);
  EXPECT_GT(state.disks.y[0], 1.0);
  EXPECT_LT(std::abs(state.disks.x[0] - 10.0), 1.0);
}

// In a right angle of any orientation two bounces turn a path into its mirror image in a point: the corner, moved in by
// a radius along both walls.
TEST(InnerWall, ARightAngleTurnsAPathBack) {
  for (const double angle : {0.1, 0.7, 1.3}) {
    const Vec2 along{std::cos(angle), std::sin(angle)};
    const Vec2 across{-along.y, along.x};
    const auto at = [&](double s, double t) {
      return Vec2{10.0 + s * along.x + t * across.x, 5.0 + s * along.y + t * across.y};
    };
    const Vec2 ends[2] = {at(8.0, 0.0), at(0.0, 8.0)};
    const Vec2 start = at(4.0, 3.0);
    const Vec2 centre = at(0.5, 0.5);
    const Vec2 v{-1.7 * along.x - 1.0 * across.x, -1.7 * along.y - 1.0 * across.y};
    const std::string corner = fmt::format("[[walls]]\npoints = [[{}, {}], [10.0, 5.0], [{}, {}]]\n", ends[0].x,
                                           ends[0].y, ends[1].x, ends[1].y);
    const Scene scene = scene_with("exact", "", corner + one_disk(start.x, start.y, v.x, v.y, 0.5), 4.0);
    const State end = run_to_end(scene);
    EXPECT_EQ(end.counters.wall_collisions, 2U) << angle;
    EXPECT_NEAR(end.disks.x[0], 2.0 * centre.x - (start.x + 4.0 * v.x), 1e-12) << angle;
    EXPECT_NEAR(end.disks.y[0], 2.0 * centre.y - (start.y + 4.0 * v.y), 1e-12) << angle;
  }
}

// Counts the crossings of a ray with the polygon.
bool is_inside(const std::vector<Vec2>& polygon, double x, double y) {
  bool inside = false;
  for (std::size_t k = 1; k < polygon.size(); ++k) {
    const Vec2 a = polygon[k - 1];
    const Vec2 b = polygon[k];
    if ((a.y > y) != (b.y > y) && x < a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

// Disks inside and outside a closed line with an acute and an obtuse corner.
TEST(InnerWall, NoDiskCrossesAClosedLine) {
  const std::string wall = "[[walls]]\npoints = [[3, 3], [17, 5], [12, 9], [16, 17], [5, 14], [3, 3]]\n";
  const std::string gas =
      "[[disks]]\ncount = 150\npositions = \"random\"\nvelocities = { maxwell = 4.0 }\n"
      "radius = { uniform = [0.1, 0.5] }\nmass = 1.0\n";
  for (const char* method : methods) {
    const Scene scene = scene_with(method, "", wall + gas, method == methods[0] ? 20.0 : 2.0);
    const State start = initial_state(scene);
    const State end = run_to_end(scene);
    const auto& polygon = scene.walls[0].points;
    std::vector<bool> inside(start.next_id);
    for (std::size_t i = 0; i < start.disks.size(); ++i) {
      inside[start.disks.id[i]] = is_inside(polygon, start.disks.x[i], start.disks.y[i]);
    }
    EXPECT_THAT(inside, testing::AllOf(testing::Contains(true), testing::Contains(false)));
    for (std::size_t i = 0; i < end.disks.size(); ++i) {
      EXPECT_EQ(is_inside(polygon, end.disks.x[i], end.disks.y[i]), inside[end.disks.id[i]])
          << method << ", disk " << end.disks.id[i];
    }
    const double before = energy_of(start.disks, 0.0).total();
    EXPECT_NEAR(energy_of(end.disks, 0.0).total(), before, 1e-11 * before) << method;
  }
}

TEST(BilliardsBreak, PocketsTakeDisks) {
  const State end = run_to_end(load_scene(CAROM_SOURCE_DIR "/scenes/billiards_break.toml"));
  EXPECT_GE(end.counters.removed, 3U);
  EXPECT_EQ(end.disks.size() + end.counters.removed, 16U);
}

TEST(InnerSink, TakesADiskWhenItTouches) {
  const std::string pocket = "[[walls]]\nfrom = [10.0, 5.0]\nto = [10.0, 15.0]\nkind = \"sink\"\n";
  for (const char* method : methods) {
    // The disk touches the sink at t = 2.25.
    const std::string rest = pocket + one_disk(5.0, 10.0, 2.0, 0.0, 0.5);
    EXPECT_EQ(run_to_end(scene_with(method, "", rest, 2.24)).counters.removed, 0U) << method;
    const State gone = run_to_end(scene_with(method, "", rest, 2.26));
    EXPECT_EQ(gone.counters.removed, 1U) << method;
    EXPECT_TRUE(gone.disks.empty()) << method;
  }
}

// Small disks above an opening from x = 8 to 12, each in a column of its own.
std::string falling_disks(int disks) {
  std::string places, velocities;
  for (int k = 0; k < disks; ++k) {
    const double column = 8.1 + 3.8 * k / disks;
    places += fmt::format("[{}, {}], ", column, 9.0 + std::fmod(7.3 * k, 10.0));
    velocities += fmt::format("[0.0, {}], ", -3.0 - std::fmod(0.37 * k, 2.0));
  }
  return fmt::format("[[disks]]\ncount = {}\npositions = [{}]\nvelocities = [{}]\nradius = 0.01\nmass = 1.0\n", disks,
                     places, velocities);
}

// A sink that lies along a wall or side is touched together with it, and takes the disk, whichever comes first by
// rounding or in the file.
TEST(InnerSink, IsAnOpeningInAWall) {
  constexpr int disks = 60;
  const auto line = [](double x) { return fmt::format("[{}, {}]", x, 3.0 + 4.4 / 18.0 * (x - 1.0)); };
  const std::string wall = fmt::format("[[walls]]\nfrom = {}\nto = {}\n", line(1.0), line(19.0));
  const std::string hole = fmt::format("[[walls]]\nfrom = {}\nto = {}\nkind = \"sink\"\n", line(8.0), line(12.0));
  const std::string floor = "[[walls]]\nfrom = [8.0, 0.0]\nto = [12.0, 0.0]\nkind = \"sink\"\n";
  for (const char* method : methods) {
    for (const std::string& walls : {floor, wall + hole, hole + wall}) {
      for (const char* physics : {"", "gravity = [0.0, -0.7]"}) {
        const State end = run_to_end(scene_with(method, physics, walls + falling_disks(disks), 8.0));
        EXPECT_EQ(end.counters.removed, static_cast<Count>(disks)) << method << ", " << physics << "\n" << walls;
        EXPECT_EQ(end.counters.wall_collisions, 0U) << method << ", " << physics << "\n" << walls;
        EXPECT_EQ(end.validity.wall.overlap.size, 0.0) << "a disk in an opening must not count as overlapping a wall";
      }
    }
  }
}

// A wall in front of a sink, however thin, keeps disks from it; so does the rim beside it.
TEST(InnerSink, IsNotReachedThroughAWall) {
  const std::string hidden =
      "[[walls]]\nfrom = [5.0, 3.0]\nto = [15.0, 3.0]\n[[walls]]\nfrom = [5.0, 2.9999]\nto = [15.0, "
      "2.9999]\nkind = \"sink\"\n";
  const std::string beside = "[[walls]]\nfrom = [8.0, 0.0]\nto = [9.9999, 0.0]\nkind = \"sink\"\n";
  for (const char* method : methods) {
    for (const std::string& walls : {hidden, beside}) {
      const State end = run_to_end(scene_with(method, "", walls + one_disk(10.0, 8.0, 0.0, -3.0, 0.01), 8.0));
      EXPECT_EQ(end.counters.removed, 0U) << method << "\n" << walls;
      EXPECT_GE(end.counters.wall_collisions, 1U) << method << "\n" << walls;
    }
  }
}

// A disk moves by 8 radii in dt, from 8 to 12 across the sink: steps are split, and sinks are tested after each part.
TEST(InnerSink, IsNotCrossedInAStepThatIsSplit) {
  const std::string pocket = "[[walls]]\nfrom = [10.0, 5.0]\nto = [10.0, 15.0]\nkind = \"sink\"\n";
  for (const char* method : methods) {
    const State end = run_to_end(scene_with(method, "", pocket + one_disk(4.0, 10.0, 4000.0, 0.0, 0.5), 0.004));
    EXPECT_EQ(end.counters.removed, 1U) << method;
  }
}

// A sink along a part of a side: a source at that side must emit no disk there, however the side's place is rounded.
TEST(InnerSink, LetsNoDiskInThroughASide) {
  for (const char* method : methods) {
    Count emitted[2] = {};
    for (const bool right : {false, true}) {
      const Scene scene = scene_with(
          method, "",
          fmt::format("[[walls]]\nfrom = [{0}, 4.0]\nto = [{0}, 16.0]\nkind = \"sink\"\n[[sources]]\nside = \"{1}\"\n"
                      "rate = 10.0\nradius = 0.3\nmass = 1.0\n",
                      right ? 20.0 : 0.0, right ? "right" : "left"),
          6.0);
      const State end = run_to_end(scene);
      EXPECT_EQ(end.counters.removed, 0U) << method;
      for (const double y : end.disks.y) EXPECT_TRUE(y < 4.0 || y > 16.0) << method << ' ' << y;
      emitted[right ? 1 : 0] = end.counters.emitted;
    }
    EXPECT_GT(emitted[0], 5U) << method;
    EXPECT_EQ(emitted[0], emitted[1]) << method;
  }
}

// Disks come to rest in a closed funnel, and its walls bear them.
TEST(InnerWall, BearsAPile) {
  const std::string funnel =
      "[[walls]]\npoints = [[0.0, 10.0], [9.8, 4.0], [10.2, 4.0], [20.0, 10.0]]\nrestitution = 0.4\n";
  const std::string disks =
      "[[disks]]\ncount = 45\npositions = \"random\"\nregion = [0.0, 10.5, 20.0, 20.0]\nradius = { uniform = [0.4, "
      "0.6] }\nmass = 1.0\n";
  Scene scene = scene_with("pairwise", "gravity = 1.0\nrestitution = 0.4", funnel + disks, 40.0);
  scene.run.dt = 0.01;
  const State end = run_to_end(scene);
  EXPECT_LT(energy_of(end.disks, 1.0).kinetic, 1e-8 * energy_of(initial_state(scene).disks, 1.0).total());
  Domain box = scene.box;
  const auto cells = place_obstacles(end.obstacles, box);
  EXPECT_LT(wall_overlap(end.disks, box), 0.02);
}

std::string with_wall(std::string_view lines) {
  return test::complaint(test::replaced(test::sound_scene, "[run]", "[[walls]]\n" + std::string(lines) + "\n[run]"));
}

TEST(BadWall, OneLineEach) {
  using testing::HasSubstr;
  using testing::StartsWith;
  EXPECT_EQ(with_wall("from = [1, 8]\nto = [8, 8]"), "");
  EXPECT_THAT(with_wall("from = [1, 8]"), HasSubstr("walls.0.to: missing; expected from = [x, y] and to = [x, y]"));
  EXPECT_THAT(with_wall("from = [1, 8, 2]\nto = [8, 8]"), HasSubstr("walls.0.from: has 3 numbers; expected [x, y]"));
  EXPECT_THAT(with_wall("points = [[1, 8]]"), HasSubstr("walls.0.points: is a list of 1; expected two points or more"));
  EXPECT_THAT(with_wall("points = [[1, 8], [2, 8]]\nto = [8, 8]"), HasSubstr("walls.0.to: cannot be used with points"));
  EXPECT_THAT(with_wall("from = [1, 8]\nto = [1, 8]"), HasSubstr("walls.0.to: has the point [1, 8] twice in a row"));
  EXPECT_THAT(with_wall("from = [1, 8]\nto = [25, 8]"), HasSubstr("the point [25, 8] lies outside the box of 20 x 10"));
  EXPECT_THAT(with_wall("from = [1, 8]\nto = [8, 8]\nkind = \"snik\""), HasSubstr("(nearest: sink)"));
  EXPECT_THAT(with_wall("from = [1, 8]\nto = [8, 8]\nkind = \"sink\"\nrestitution = 0.5"),
              HasSubstr("walls.0.restitution: cannot be used with kind = \"sink\""));
  EXPECT_THAT(with_wall("from = [1, 8]\nto = [8, 8]\nrestitution = 1.5"), HasSubstr("walls.0.restitution: is 1.5"));
  EXPECT_THAT(with_wall("from = [2, 1.5]\nto = [8, 8]"), HasSubstr("disk 0 overlaps the wall walls.0 by"));
  const std::string brownian = test::replaced(test::sound_scene, "restitution = 0.5", "diffusion = 0.1");
  EXPECT_THAT(test::complaint(
                  test::replaced(brownian, "[run]", "[[walls]]\nfrom = [1, 8]\nto = [8, 8]\nkind = \"sink\"\n[run]")),
              HasSubstr("walls.0.kind: a sink inside the box cannot be used with Brownian motion"));
}

}  // namespace
}  // namespace carom
