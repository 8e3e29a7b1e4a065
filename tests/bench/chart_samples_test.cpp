// The quantities measured for the chart, in runs so small that the results are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "app/chart/chart_own.hpp"
#include "app/chart/chart_result.hpp"
#include "app/chart/chart_sample.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"

namespace carom::chart {
namespace {

// A chart scene with few disks and short times.
ChartScene small_fluid() {
  ChartScene scene = fluid_of(64);
  scene.flight = 0.28;
  return scene;
}

// Among corners, between closing walls and in a shear flow exact has only rounding errors, when the work of walls and
// images is subtracted, and short steps come closer to it than long ones.
TEST(ChartSamples, WallsThatMoveAndShearAreScenesToo) {
  int seen = 0;
  for (ChartScene scene : chart_scenes()) {
    if (scene.name != "corners" && scene.name != "closing" && scene.name != "shear") continue;
    SCOPED_TRACE(scene.name);
    scene.melting *= 0.05;
    scene.flight *= 0.5;
    scene.length *= 0.3;
    const std::vector<Sample> samples =
        measure_seed(scene, 2, {{Method::exact, 0.0, 2}, {Method::pairwise, 0.032, 2}, {Method::pairwise, 0.001, 2}});
    ASSERT_EQ(samples.size(), 3U);
    EXPECT_LT(samples[0][Measure::path], 1e-9);
    EXPECT_LT(samples[0][Measure::overlap], 1e-12);
    EXPECT_GT(samples[0][Measure::rate], 0.1);
    EXPECT_LT(samples[0][Measure::energy], 1e-12);
    EXPECT_LT(samples[1][Measure::energy], 1e-12) << "to rounding, in time stepping, too";
    if (scene.keeps_momentum) {
      EXPECT_LT(samples[0][Measure::momentum], 1e-12);
    }
    EXPECT_LT(samples[2][Measure::path], 0.3 * samples[1][Measure::path]);
    ++seen;
  }
  EXPECT_EQ(seen, 3);
}

// With a step of half a diameter disks between the closing walls are pressed through one of them.
TEST(ChartSamples, AStepAtWhichTheMethodStopsHasNoPoint) {
  const auto& scenes = chart_scenes();
  ChartScene scene = *std::ranges::find(scenes, "closing", &ChartScene::name);
  scene.melting *= 0.05;
  const std::vector<Sample> samples =
      measure_seed(scene, 1, {{Method::exact, 0.0, 1}, {Method::pairwise, 0.5, 1}, {Method::pairwise, 0.008, 1}});
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_EQ(samples[0].stopped, "");
  EXPECT_NE(samples[1].stopped.find("leaves no room"), std::string::npos) << samples[1].stopped;
  EXPECT_EQ(samples[2].stopped, "");
  const SceneResult result = summed_up(scene, {samples});
  ASSERT_EQ(result.stops.size(), 1U);
  EXPECT_EQ(result.stops[0].dt, 0.5);
  ASSERT_EQ(result.curves[1].points.size(), 1U);
  EXPECT_EQ(result.curves[1].points[0].dt, 0.008);
}

TEST(ChartSamples, ExactAgreesWithItselfAndShortStepsComeCloser) {
  const std::vector<Setting> settings{{Method::exact, 0.0, 1},
                                      {Method::pairwise, 0.032, 1},
                                      {Method::pairwise, 0.0005, 1},
                                      {Method::rollback, 0.032, 1}};
  const std::vector<Sample> samples = measure_seed(small_fluid(), 1, settings);
  ASSERT_EQ(samples.size(), 4U);
  EXPECT_LT(samples[0][Measure::path], 1e-10);
  EXPECT_GT(samples[0][Measure::path], 0.0) << "the paths differ by a rounding";
  EXPECT_EQ(samples[0][Measure::missed], 0.0);
  EXPECT_EQ(samples[0][Measure::spurious], 0.0);
  EXPECT_EQ(samples[0][Measure::overlap], 0.0);
  EXPECT_LT(samples[2][Measure::path], 0.1 * samples[1][Measure::path]);
  EXPECT_GT(samples[3][Measure::path], samples[1][Measure::path]);
  EXPECT_GT(samples[3][Measure::spurious], 0.0) << "rollback collides at a distance";
  for (const Sample& s : samples) {
    EXPECT_GT(s[Measure::cost], 0.0);
    EXPECT_LT(s[Measure::energy], 1e-12);
    EXPECT_LT(s[Measure::momentum], 1e-12);
  }
}

// The final positions in the reference, by id, and the pairs that have collided, sorted.
struct Ended {
  std::vector<Vec2> places;
  CollisionLog pairs;
};

Ended run_of(const ChartScene& scene, Method method, double dt) {
  const Scene s = scene_of(scene, 1, method, dt, scene.flight);
  Ended run;
  const auto engine = make_reference_engine(s, initial_state(s), &run.pairs);
  while (engine->state().time < scene.flight) engine->step();
  const Disks& d = engine->state().disks;
  run.places.resize(d.size());
  for (std::size_t i = 0; i < d.size(); ++i) run.places[d.id[i]] = {d.x[i], d.y[i]};
  std::sort(run.pairs.begin(), run.pairs.end());
  return run;
}

// The mean distance to the nearest image.
double mean_way(const Domain& box, const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    sum += std::hypot(nearest_image(a[k].x - b[k].x, box.width), nearest_image(a[k].y - b[k].y, box.height));
  }
  return sum / static_cast<double>(a.size());
}

// The number of pairs of a that are not in b; a pair that occurs twice in a has to occur twice in b.
double lacking(const CollisionLog& a, const CollisionLog& b) {
  std::vector<std::pair<DiskId, DiskId>> rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
  return static_cast<double>(rest.size());
}

// Long enough for disks to leave the box on one side and come in on the other.
TEST(ChartSamples, PathsAndPairsAreThoseOfTwoRuns) {
  ChartScene scene = fluid_of(64);
  scene.melting = 0.0;
  scene.flight = 1.5;
  scene.length = 1.0;  // sixteen steps, with a look at each
  double largest = 0.0;
  const Ended exact = run_of(scene, Method::exact, 0.0);
  const Scene s = scene_of(scene, 1, Method::exact, 0.0, 0.0);
  const State start = initial_state(s);
  std::vector<Vec2> begin(start.disks.size());
  for (std::size_t i = 0; i < begin.size(); ++i) begin[start.disks.id[i]] = {start.disks.x[i], start.disks.y[i]};
  for (const Method method : {Method::pairwise, Method::rollback}) {
    const Ended other = run_of(scene, method, 0.064);
    const Sample sample = measure_seed(scene, 1, {{method, 0.064, 1}}).at(0);
    const auto all = static_cast<double>(exact.pairs.size());
    EXPECT_EQ(sample[Measure::missed], lacking(exact.pairs, other.pairs) / all);
    EXPECT_EQ(sample[Measure::spurious], lacking(other.pairs, exact.pairs) / all);
    EXPECT_NE(sample[Measure::missed], sample[Measure::spurious]);
    const double way = mean_way(s.box, exact.places, other.places) / mean_way(s.box, exact.places, begin);
    EXPECT_NEAR(sample[Measure::path], way, 1e-12);
    const auto engine = make_reference_engine(scene_of(scene, 1, method, 0.064, scene.length), start);
    double overlap = 0.0;
    while (engine->state().time < scene.length) {
      engine->step();
      overlap = std::max(overlap, max_overlap(engine->state().disks, s.box));
    }
    EXPECT_DOUBLE_EQ(sample[Measure::overlap], overlap);
    largest = std::max(largest, overlap);
  }
  EXPECT_GT(largest, 0.0);
}

// Walls take momentum: this is noticed if a scene is declared to conserve it.
TEST(ChartSamples, MomentumThatIsLostIsSeen) {
  const auto& scenes = chart_scenes();
  ChartScene scene = *std::ranges::find(scenes, "gravity", &ChartScene::name);
  scene.melting = 0.0;
  scene.flight = scene.length = 0.1;
  EXPECT_TRUE(std::isnan(measure_seed(scene, 1, {{Method::exact, 0.0, 1}}).at(0)[Measure::momentum]));
  scene.keeps_momentum = true;
  EXPECT_GT(measure_seed(scene, 1, {{Method::exact, 0.0, 1}}).at(0)[Measure::momentum], 1e-3);
}

// A sample of this scene of the chart by exact, from one start.
Sample by_exact(const std::string& name, double melting, double length, double dt = 0.0) {
  const auto& scenes = chart_scenes();
  ChartScene scene = *std::ranges::find(scenes, name, &ChartScene::name);
  scene.melting = melting;
  scene.flight = 0.02;
  scene.length = length;
  return measure_seed(scene, 1, {{Method::exact, dt, 1}}).at(0);
}

// Enskog's rate for the compressibility Z of docs/reference_values.md, at temperature 1 and diameter 1.
double rate_of(double z) {
  return 4.0 * (z - 1.0) / std::sqrt(std::numbers::pi);
}

// The energies of a thousand disks from a single start are within a few per cent of temperature 1.
TEST(ChartSamples, FiguresAreThoseThatAreKnown) {
  constexpr double z_of_dilute = 1.236, z_of_cooling = 2.063, z_of_shear = 4.105;
  const auto compressibility = [](const Sample& sample, double packing_fraction) {
    return sample[Measure::figure] * (0.25 * std::numbers::pi) / packing_fraction;  // P V / N
  };
  const Sample dilute = by_exact("dilute", 5.0, 12.0);
  EXPECT_NEAR(compressibility(dilute, 0.1), z_of_dilute, 0.08 * z_of_dilute);
  EXPECT_NEAR(dilute[Measure::rate], rate_of(z_of_dilute), 0.08 * rate_of(z_of_dilute));
  const Sample shear = by_exact("shear", 3.0, 1.0);
  EXPECT_NEAR(compressibility(shear, 0.5), z_of_shear, 0.1 * z_of_shear) << "with velocities relative to the flow";
  EXPECT_NEAR(shear[Measure::rate], rate_of(z_of_shear), 0.1 * rate_of(z_of_shear));
  // Haff's law: 1 / sqrt(T) rises by (1 - e^2) / 4 for each collision of a disk. The start is melted without loss.
  const Sample cooling = by_exact("cooling", 6.0, 2.0);
  const double haff = (1.0 - 0.9 * 0.9) / 4.0 * rate_of(z_of_cooling);
  EXPECT_NEAR(cooling[Measure::figure], haff, 0.1 * haff);
  EXPECT_TRUE(std::isnan(cooling[Measure::energy])) << "which is not conserved";
  // Other disks obstruct a Brownian disk: the ratio is below 1, that of a free disk, and above 1 - 2 phi, that of long
  // times.
  const Sample brownian = by_exact("brownian", 3.0, 0.128, 0.0016);
  EXPECT_GT(brownian[Measure::figure], 0.45);
  EXPECT_LT(brownian[Measure::figure], 0.85);
}

// The chart of a user's own scene has the drifts of what its physics conserves, and the figure that belongs to it.
TEST(ChartSamples, ASceneOfOnesOwnHasTheDriftsOfWhatItKeeps) {
  struct Case {
    const char* sides;  // lines of the box, and its walls
    const char* more;
    bool keeps_energy, keeps_momentum;
    Figure figure;
  };
  const std::string periodic = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";
  const char* const round = periodic.c_str();
  const char* const thermostat =
      "[physics]\nthermostat = { kind = \"langevin\", temperature = 1.0, rate = 0.5, dt = 0.1 }\n";
  for (const Case& c :
       {Case{round, "", true, true, Figure::pressure}, Case{"", "", true, false, Figure::pressure},
        Case{round, "[physics]\nrestitution = 0.9\n", false, true, Figure::cooling},
        Case{"", "[physics]\nrestitution = 0.9\n", false, false, Figure::pressure},
        Case{"wall_restitution = 0.9\n", "", false, false, Figure::pressure},
        Case{"left = { temperature = 2.0 }\n", "", false, false, Figure::pressure},
        Case{"left = { motion = { vibrate = [0.1, 0.0], period = 1.0 } }\n", "", true, false, Figure::pressure},
        Case{round, thermostat, false, false, Figure::pressure},
        Case{"", "[physics]\ngravity = 0.5\n", true, false, Figure::pressure},
        Case{round, "[physics]\ngravity = 0.5\n", false, false, Figure::pressure},
        Case{"left = \"periodic\"\nright = \"periodic\"\n", "[physics]\ngravity = [0.5, 0.5]\n", false, false,
             Figure::pressure},
        Case{round, "[[walls]]\nfrom = [2, 2]\nto = [6, 2]\n", true, false, Figure::pressure},
        Case{round, "[[walls]]\nfrom = [2, 2]\nto = [6, 2]\nrestitution = 0.5\n", false, false, Figure::pressure},
        Case{round, "[[walls]]\nfrom = [2, 2]\nto = [6, 2]\nmotion = { vibrate = [0.0, 0.1], period = 1.0 }\n", false,
             false, Figure::pressure},
        Case{round, "[[disks]]\nfixed = true\ncount = 1\npositions = [[6, 6]]\nradius = 0.4\n", true, false,
             Figure::pressure}}) {
    SCOPED_TRACE(std::string(c.sides) + c.more);
    const ChartScene own = own_scene(parse_scene(
        std::string("[box]\nwidth = 12\nheight = 12\n") + c.sides + c.more +
            "[[disks]]\ncount = 40\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1\n"
            "[run]\nmethod = \"exact\"\nt_end = 3\n",
        "own.toml", ""));
    EXPECT_EQ(own.keeps_energy, c.keeps_energy);
    EXPECT_EQ(own.keeps_momentum, c.keeps_momentum);
    EXPECT_EQ(own.figure, c.figure);
    if (!own.keeps_energy && !own.keeps_momentum) continue;
    const Sample sample = measure_seed(own, 1, {{Method::exact, 0.0, 1}}).at(0);
    if (own.keeps_energy) {
      EXPECT_LT(sample[Measure::energy], 1e-11);
    }
    if (own.keeps_momentum) {
      EXPECT_LT(sample[Measure::momentum], 1e-11);
    }
  }
}

TEST(ChartSamples, ASeedUsesTheSettingsThatWantIt) {
  ChartScene scene = small_fluid();
  scene.flight = scene.length = 0.02;
  EXPECT_EQ(measure_seed(scene, 3, {{Method::exact, 0.0, 3}, {Method::pairwise, 0.01, 2}}).size(), 1U);
}

// The log of each reference has as many entries as its counter counts, and logging changes no bit.
TEST(CollisionLog, HoldsWhatIsCounted) {
  for (const Method method : {Method::rollback, Method::pairwise, Method::exact}) {
    const Scene scene = scene_of(small_fluid(), 1, method, 0.01, 0.3);
    CollisionLog log;
    const auto logged = make_reference_engine(scene, initial_state(scene), &log);
    const auto plain = make_reference_engine(scene, initial_state(scene));
    while (logged->state().time < 0.3) logged->step();
    while (plain->state().time < 0.3) plain->step();
    EXPECT_GT(log.size(), 20U);
    EXPECT_EQ(log.size(), logged->state().counters.collisions);
    EXPECT_TRUE(std::all_of(log.begin(), log.end(), [](const auto& pair) { return pair.first < pair.second; }));
    EXPECT_EQ(state_hash(logged->state().disks), state_hash(plain->state().disks));
  }
}

}  // namespace
}  // namespace carom::chart
