// The exact method compared with the oracle, which tests all pairs in long double, for as long as chaos allows.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/event_oracle.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

struct OracleCase {
  const char* name;
  SceneText scene;
};

void PrintTo(const OracleCase& c, std::ostream* out) {
  *out << c.name;
}

class ExactOracle : public testing::TestWithParam<OracleCase> {};

double distance(const Domain& box, double ax, double ay, double bx, double by) {
  double dx = ax - bx;
  double dy = ay - by;
  if (box.periodic_x()) dx -= std::round(dx / box.width) * box.width;
  if (box.periodic_y()) dy -= std::round(dy / box.height) * box.height;
  return std::hypot(dx, dy);
}

TEST_P(ExactOracle, SamePlacesAndCounts) {
  const Scene scene = make_scene(GetParam().scene);
  const State initial = initial_state(scene);
  oracle::System system = oracle::make_system(scene, initial);
  EXPECT_TRUE(oracle::run(system, scene.run.t_end));
  const State state = run_reference(scene, initial);

  EXPECT_EQ(state.counters.collisions, system.collisions);
  EXPECT_EQ(state.counters.wall_collisions, system.wall_collisions);
  const std::size_t with_obstacles = initial.obstacles.empty() ? 0 : system.wall_collisions;
  EXPECT_GT(system.collisions + with_obstacles, 20U) << "too few collisions for a test of them";
  const Disks& d = state.disks;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const oracle::Ball& b = system.balls[d.id[i]];
    EXPECT_LT(distance(scene.box, d.x[i], d.y[i], static_cast<double>(b.x), static_cast<double>(b.y)), 1e-9)
        << "disk " << d.id[i];
    EXPECT_NEAR(d.vx[i], static_cast<double>(b.vx), 1e-8);
    EXPECT_NEAR(d.vy[i], static_cast<double>(b.vy), 1e-8);
    if (!d.spin.empty()) {
      EXPECT_NEAR(d.spin[i], static_cast<double>(b.spin), 1e-7);
    }
  }
}

const std::string gas =
    "[[disks]]\ncount = 40\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1.0\n";
const std::string crystal =
    "[[disks]]\ncount = 36\npositions = \"square\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1.0\n";
const std::string mixed =
    "[[disks]]\ncount = 30\npositions = \"random\"\nvelocities = { uniform = 1.5 }\nradius = { uniform = [0.2, 0.8] }\n"
    "mass = { uniform = [1.0, 50.0] }\n";
const std::string giant =
    "[[disks]]\ncount = 1\npositions = [[1.0, 5.0]]\nradius = 3.0\nmass = 50.0\n"
    "[[disks]]\ncount = 80\npositions = \"random\"\nvelocities = { uniform = 1.0 }\nradius = 0.1\nmass = 0.01\n";
// Fixed disks come after the others, so that the ids of the latter start from 0.
const std::string pegs =
    "[[disks]]\nfixed = true\ncount = 8\npositions = \"random\"\nradius = { uniform = [0.05, 0.6] }\n"
    "[[disks]]\nfixed = true\ncount = 2\npositions = [[0.0, 3.0], [5.0, 0.1]]\nradius = 0.4\n";
const std::string few =
    "[[disks]]\ncount = 16\npositions = \"random\"\nvelocities = { uniform = 1.5 }\n"
    "radius = { uniform = [0.2, 0.5] }\nmass = 1.0\n";
const std::string shelves =
    "[[walls]]\npoints = [[1.0, 2.0], [3.0, 2.5], [3.5, 5.0]]\n[[walls]]\nfrom = [8.0, 3.0]\nto = [6.0, 7.0]\n"
    "[[walls]]\nfrom = [2.0, 7.0]\nto = [4.0, 6.5]\nrestitution = 0.7\n";
// The first wall goes around a periodic box.
const std::string sweeper =
    "[[walls]]\nfrom = [1.0, 2.0]\nto = [1.2, 5.0]\nrestitution = 0.9\nmotion = { velocity = [1.5, 0.4] }\n";
const std::string paddles =
    "[[walls]]\npoints = [[3.0, 2.0], [4.0, 2.5], [5.0, 2.0]]\n"
    "motion = { vibrate = [0.3, 0.8], period = 1.1, shape = \"sine\" }\n"
    "[[walls]]\nfrom = [2.0, 6.0]\nto = [5.0, 6.2]\nmotion = { vibrate = [0.0, -0.5], period = 0.8 }\n";
// Two groups and fixed pegs. Each pair of groups has its own restitution, except light with light.
const std::string named =
    "[[disks]]\nname = \"light\"\ncount = 14\npositions = \"random\"\nvelocities = { uniform = 1.5 }\n"
    "radius = { uniform = [0.2, 0.5] }\nmass = 1.0\n"
    "[[disks]]\nname = \"heavy\"\ncount = 14\npositions = \"random\"\nvelocities = { uniform = 1.0 }\nradius = 0.5\n"
    "mass = 4.0\n"
    "[[disks]]\nname = \"pegs\"\nfixed = true\ncount = 6\npositions = \"random\"\nradius = 0.3\n";
const std::string pairs =
    "[[physics.pairs]]\ngroups = [\"heavy\", \"light\"]\nrestitution = 0.7\n"
    "[[physics.pairs]]\ngroups = [\"heavy\", \"heavy\"]\nrestitution = { viscoelastic = 0.2, least = 0.3 }\n"
    "[[physics.pairs]]\ngroups = [\"pegs\", \"light\"]\nrestitution = 0.5\n";
const std::string viscoelastic = "restitution = { viscoelastic = 0.15, least = 0.4 }";
const std::string walls_of_salt = "wall_restitution = 0.9";
const std::string all_periodic =
    "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";
const std::string pistons =
    "left = { motion = { velocity = [0.5, 0] } }\nright = { place = 8, motion = { velocity = [0.3, 0] } }";
const std::string shaken =
    "bottom = { restitution = 0.9, motion = { vibrate = [0, 0.3], period = 0.7 } }\n"
    "top = { motion = { vibrate = [0, -0.2], period = 0.3 } }";
const std::string swinging =
    "left = { motion = { vibrate = [0.2, 0], period = 0.9, shape = \"sine\" } }\n"
    "bottom = { restitution = 0.9, motion = { vibrate = [0, 0.3], period = 0.7, shape = \"sine\" } }\n"
    "top = { motion = { vibrate = [0, -0.2], period = 0.3, shape = \"sine\" } }";
const std::string four_restitutions =
    "left = { restitution = 0.5 }\nright = { restitution = 0.8 }\ntop = { restitution = 0.3 }\nwall_restitution = 0.9";
const std::string spinning = mixed + "spin_temperature = 5.0\n";
const std::string rough = "restitution = 0.9\nroughness = { tangential_restitution = 0.4, friction = 0.2 }\n";
const std::string ever_rough = "roughness = { tangential_restitution = -0.3, inertia = 0.7 }\n";
const std::string rough_walls = "wall_roughness = { tangential_restitution = 0.7, friction = 0.3 }\n";
const std::string lasting = "restitution = 0.8\ncollapse = { model = \"tc\", contact_time = 0.03 }\n";

INSTANTIATE_TEST_SUITE_P(
    Scenes, ExactOracle,
    testing::Values(
        OracleCase{"walls", {8, 8, "wall", "", gas, 2.0, ""}},
        OracleCase{"periodic", {8, 8, "periodic", "", gas, 2.0, ""}},
        OracleCase{"dense", {6.9, 6.9, "periodic", "", crystal, 1.0, ""}},
        OracleCase{"narrow", {2.2, 60, "left = \"periodic\"\nright = \"periodic\"", "", gas, 2.0, ""}},
        OracleCase{"channel", {10, 8, "left = \"periodic\"\nright = \"periodic\"", "", gas, 2.0, ""}},
        OracleCase{"gravity", {8, 12, "wall", "gravity = 0.8", gas, 2.0, ""}},
        OracleCase{"fall", {8, 12, "left = \"periodic\"\nright = \"periodic\"", "gravity = 3.0", gas, 1.2, ""}},
        OracleCase{"tilted", {8, 12, "wall", "gravity = [0.7, -0.4]", gas, 2.0, ""}},
        OracleCase{"sideways",
                   {12, 8, "bottom = \"periodic\"\ntop = \"periodic\"", "gravity = [-3.0, 0]", gas, 1.2, ""}},
        OracleCase{"tilted_fall", {8, 8, "periodic", "gravity = [0.8, 0.3]", gas, 1.5, ""}},
        OracleCase{"unequal", {9, 9, "wall", "", mixed, 3.0, ""}},
        OracleCase{"unequal_periodic", {9, 9, "periodic", "", mixed, 2.0, ""}},
        OracleCase{"giant", {12.5, 12.5, "periodic", "", giant, 3.0, ""}},
        OracleCase{"four_restitutions", {8, 8, four_restitutions, "restitution = 0.95\ngravity = 0.1", gas, 3.0, ""}},
        OracleCase{"pegs", {8, 8, "wall", "", few + pegs, 4.0, ""}},
        OracleCase{"pegs_periodic", {8, 8, "periodic", "", few + pegs, 4.0, ""}},
        OracleCase{"pegs_gravity", {8, 12, "wall", "gravity = 1.5", few + pegs, 4.0, ""}},
        OracleCase{"pegs_fall", {8, 12, "periodic", "gravity = 0.5", few + pegs, 4.0, ""}},
        OracleCase{"pegs_tilted", {8, 12, "wall", "gravity = [-1.2, -0.9]", few + pegs, 4.0, ""}},
        OracleCase{"pegs_upwards", {8, 12, "wall", "gravity = [0.0, 1.5]", few + pegs, 3.0, ""}},
        OracleCase{"pegs_inelastic", {8, 12, walls_of_salt, "gravity = 0.8\nrestitution = 0.9", few + pegs, 4.0, ""}},
        OracleCase{"shear", {8, 8, all_periodic + "shear_rate = 0.3", "", gas, 1.5, ""}},
        OracleCase{"shear_backwards", {12, 6, all_periodic + "shear_rate = -1.0", "", gas, 1.2, ""}},
        OracleCase{"shear_unequal", {7, 14, all_periodic + "shear_rate = 0.4", "restitution = 0.8", mixed, 2.0, ""}},
        OracleCase{"pistons", {9, 9, pistons, "", gas, 2.0, ""}},
        OracleCase{"shaken", {9, 9, shaken, "", gas, 0.7, ""}},
        OracleCase{"shaken_in_gravity", {9, 12, shaken, "gravity = 0.8\nrestitution = 0.9", mixed, 1.0, ""}},
        OracleCase{"shaken_tilted", {9, 12, shaken, "gravity = [0.5, -0.6]\nrestitution = 0.9", mixed, 1.0, ""}},
        OracleCase{"swinging", {9, 9, swinging, "", gas, 0.7, ""}},
        OracleCase{"swinging_in_gravity", {9, 12, swinging, "gravity = 0.8\nrestitution = 0.9", mixed, 1.0, ""}},
        OracleCase{"swinging_tilted", {9, 12, swinging, "gravity = [0.5, -0.6]\nrestitution = 0.9", mixed, 1.0, ""}},
        OracleCase{"shelves", {8, 8, "wall", "", few + shelves, 4.0, ""}},
        OracleCase{"shelves_periodic", {8, 8, "periodic", "", few + shelves, 4.0, ""}},
        OracleCase{"shelves_gravity", {8, 12, "wall", "gravity = 1.5", few + shelves, 4.0, ""}},
        OracleCase{"shelves_tilted", {8, 12, "wall", "gravity = [1.2, -0.9]", few + shelves, 4.0, ""}},
        OracleCase{"shelves_sideways", {8, 12, "periodic", "gravity = [0.5, 0]", few + shelves + pegs, 3.0, ""}},
        OracleCase{"shelves_fall", {8, 12, "periodic", "gravity = 0.5", few + shelves + pegs, 3.0, ""}},
        OracleCase{"sweeper", {8, 8, "periodic", "", few + sweeper, 3.0, ""}},
        OracleCase{"sweeper_fall", {8, 8, "periodic", "gravity = [0.3, -0.5]", few + sweeper + pegs, 2.0, ""}},
        OracleCase{"paddles", {8, 8, "wall", "", few + paddles, 1.5, ""}},
        OracleCase{"paddles_gravity", {8, 12, "wall", "gravity = 1.0", few + paddles, 2.0, ""}},
        OracleCase{"viscoelastic", {8, 8, walls_of_salt, viscoelastic, gas, 5.0, ""}},
        OracleCase{"viscoelastic_pegs", {8, 12, "wall", viscoelastic + "\ngravity = 0.8", few + pegs, 4.0, ""}},
        OracleCase{"pairs", {9, 9, "periodic", "restitution = 0.95", named + pairs, 4.0, ""}},
        OracleCase{"pairs_gravity", {9, 12, "wall", "gravity = 0.5", named + pairs + shelves, 3.0, ""}},
        OracleCase{"rough", {9, 9, "periodic", rough, spinning, 2.0, ""}},
        OracleCase{"rough_sides", {9, 9, rough_walls, ever_rough, spinning, 3.0, ""}},
        OracleCase{"rough_pegs_and_shelves",
                   {9, 12, rough_walls, ever_rough + "gravity = 0.5\n", spinning + pegs + shelves, 2.0, ""}},
        OracleCase{"rough_paddles", {8, 12, rough_walls, rough + "gravity = 1.0\n", few + paddles, 2.0, ""}},
        OracleCase{"rough_shaken", {9, 12, rough_walls + shaken, rough + "gravity = 0.8\n", spinning, 1.0, ""}},
        OracleCase{"rough_shear", {7, 14, all_periodic + "shear_rate = 0.4", rough, spinning, 2.0, ""}},
        OracleCase{"lasting_contacts", {8, 8, walls_of_salt, lasting, gas, 3.0, ""}},
        OracleCase{"rough_lasting_contacts", {9, 9, rough_walls, lasting + ever_rough, spinning + pegs, 3.0, ""}},
        OracleCase{"inelastic", {8, 8, walls_of_salt, "restitution = 0.8", gas, 5.0, ""}},
        OracleCase{"inelastic_gravity", {8, 12, walls_of_salt, "restitution = 0.7\ngravity = 0.5", mixed, 4.0, ""}}),
    [](const auto& p) { return std::string(p.param.name); });

// In a large periodic box few disks fly around it many times between two collisions. Each collision amplifies errors by
// flight over diameter, here 300, so only the first collisions can be compared.
TEST(ExactOracleFewDisks, FlyRoundThePeriodicBox) {
  Domain box;
  box.width = 4.5;
  box.height = 31.0;
  box.sides.fill(SideKind::periodic);
  const Scene scene = plain_scene(box, 66.0);
  const State initial = state_of({{1.0, 1.0, 7.3, 0.41, 0.5, 1.0, 0}, {3.0, 15.0, -0.2, 0.73, 0.3, 2.0, 0}});
  oracle::System system = oracle::make_system(initial.disks, box, 0.0, 1.0);
  EXPECT_TRUE(oracle::run(system, scene.run.t_end));
  const State state = run_reference(scene, initial);
  EXPECT_EQ(system.collisions, 2U);
  EXPECT_EQ(state.counters.collisions, system.collisions);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(state.disks.vx[i], static_cast<double>(system.balls[i].vx), 1e-6);
    EXPECT_NEAR(state.disks.vy[i], static_cast<double>(system.balls[i].vy), 1e-6);
  }
}

}  // namespace
}  // namespace carom::exact_tests
