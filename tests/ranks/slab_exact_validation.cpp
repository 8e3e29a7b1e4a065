// `exact` on slabs: random tall boxes with all features that slabs handle, on 2 to 4 ranks, with the bits of a single
// machine after every window, both in each rank's own disks and in its ghosts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "tests/support/same_counters.hpp"
#include "tests/support/slab_support.hpp"

namespace carom {
namespace {

constexpr int shards = 4, scenes_a_shard = 50;

// The environment may name a seed for other scenes.
std::uint64_t first_seed() {
  const char* const named = std::getenv("CAROM_TALL_SEED");
  return named != nullptr ? std::strtoull(named, nullptr, 10) : 1900;
}

class TallBoxes {
 public:
  explicit TallBoxes(std::uint64_t seed) : random_(seed) {}

  Scene next() {
    test::Features f;
    f.sides = one_of({"periodic", "periodic", "wall", "hot", "sink", "periodic_x"});
    f.rough = one_of({"", "", "sticking", "sliding"});
    f.law = one_of({"", "", "viscoelastic"});
    f.restitution = f.law.empty() && chance(0.3) ? 0.8 : 1.0;
    f.thermostat = one_of({"", "", "", "langevin", "andersen"});
    f.gravity = f.sides != "periodic" && chance(0.2);
    f.tilted = chance(0.5);
    f.seed = static_cast<int>(1 + random_() % 100);
    const bool loses = !f.law.empty() || f.restitution < 1.0 || !f.rough.empty();
    const double width = uniform(8.0, 40.0);
    const double height = uniform(300.0, 800.0);
    const double packing_fraction = uniform(0.02, 0.5);
    const std::string radius = one_of({"0.5", "{ uniform = [0.3, 0.9] }", "{ uniform = [0.1, 0.6] }"});
    const double mean2 = radius == "0.5" ? 0.25 : radius.find("0.9") < 99 ? 0.39 : 0.143;
    const int disks = std::clamp(static_cast<int>(packing_fraction * width * height / (3.14159 * mean2)), 40, 3000);
    const std::string mass = one_of({"1.0", "{ uniform = [1, 4] }", "{ uniform = [1, 50] }"});
    return parse_scene(fmt::format("seed = {}\n[box]\n", random_() % 1000) + test::sides_text(f.sides, f.seed) +
                           fmt::format("width = {}\nheight = {}\n", width, height) + test::physics_text(f) +
                           (loses ? "[physics.collapse]\nmodel = \"tc\"\ncontact_time = 1e-3\n" : "") +
                           fmt::format("[[disks]]\ncount = {}\npositions = \"random\"\nradius = {}\nmass = {}\n", disks,
                                       radius, mass) +
                           fmt::format("velocities = {{ maxwell = {} }}\n", uniform(0.1, 10.0)) +
                           things(width, height) + "[run]\nmethod = \"exact\"\nt_end = 1e3\n",
                       "scene", "");
  }

  int ranks() { return static_cast<int>(2 + random_() % 3); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  std::string one_of(const std::vector<std::string>& all) { return all[random_() % all.size()]; }

  // Fixed disks, sources, and inner walls, some of which are sinks.
  std::string things(double width, double height) {
    std::string text;
    if (chance(0.3)) {
      text += fmt::format("[[disks]]\nfixed = true\ncount = {}\npositions = \"random\"\nradius = 0.3\n",
                          3 + random_() % 60);
    }
    if (chance(0.2)) {
      text += fmt::format(
          "[[sources]]\nregion = [0.0, 0.0, {}, {}]\nrate = {}\nradius = {{ uniform = [0.2, 0.5] }}\n"
          "mass = 1.0\nvelocities = {{ maxwell = 1.0 }}\n",
          width, height, uniform(1.0, 30.0));
    }
    if (chance(0.2)) {
      text += fmt::format("[[walls]]\nkind = \"sink\"\nfrom = [{}, {}]\nto = [{}, {}]\n", uniform(0.0, 0.4) * width,
                          uniform(0.1, 0.5) * height, uniform(0.6, 1.0) * width, uniform(0.5, 0.9) * height);
    }
    if (chance(0.3)) {
      text += fmt::format("[[walls]]\nfrom = [{}, {}]\nto = [{}, {}]\n", uniform(0.0, 0.4) * width,
                          uniform(0.1, 0.5) * height, uniform(0.6, 1.0) * width, uniform(0.5, 0.9) * height);
    }
    return text;
  }

  std::mt19937_64 random_;
};

// The disks by id.
std::vector<Disk> in_order(const Disks& disks) {
  std::vector<Disk> all;
  for (const std::size_t i : by_id(disks)) all.push_back(disk_at(disks, i));
  return all;
}

bool is_same(const Disk& a, const Disk& b) {
  return a.x == b.x && a.y == b.y && a.vx == b.vx && a.vy == b.vy && a.spin == b.spin;
}

bool is_among(const std::vector<Disk>& all, const Disk& disk) {
  const auto at =
      std::lower_bound(all.begin(), all.end(), disk.id, [](const Disk& a, DiskId wanted) { return a.id < wanted; });
  return at != all.end() && at->id == disk.id && is_same(*at, disk);
}

// The states of a single machine after each of some windows.
struct Truth {
  std::vector<std::vector<Disk>> disks;
  State end;
};

Truth truth_of(const Scene& scene, const State& start, int windows) {
  Truth truth;
  const auto engine = make_parallel_engine(scene, start, {1});
  for (int w = 0; w < windows; ++w) {
    engine->step();
    truth.disks.push_back(in_order(engine->state().disks));
  }
  truth.end = engine->state();
  return truth;
}

// Compares own disks and ghosts. Does the rank have fewer than all disks?
bool expect_truth(const Scene& scene, const State& start, const Truth& truth, const Threads& threads, Ranks& ranks) {
  const auto engine = make_slab_exact(scene, start, threads, ranks);
  bool on_slabs = false;
  for (const std::vector<Disk>& expected : truth.disks) {
    engine->step();
    std::size_t wrong = 0;
    const Disks& here = engine->progress().disks;
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (!is_among(expected, disk_at(here, i))) ++wrong;
    }
    EXPECT_EQ(wrong, 0U) << "rank " << ranks.rank() << " at " << engine->progress().time;
    auto all = static_cast<std::int64_t>(engine->state().disks.size());
    on_slabs = on_slabs || (all > 0 && all < static_cast<std::int64_t>(expected.size()));
    ranks.sum({&all, 1});
    EXPECT_EQ(static_cast<std::size_t>(all), expected.size());
    if (ranks.any(wrong > 0)) break;
  }
  EXPECT_EQ(engine->state().time, truth.end.time);
  test::expect_same_counters(truth.end.counters, engine->state().counters);
  EXPECT_EQ(truth.end.taken, engine->state().taken);
  return on_slabs;
}

class SlabExactScenes : public ::testing::TestWithParam<int> {};

TEST_P(SlabExactScenes, HaveTheBitsOfOneMachine) {
  TallBoxes boxes(first_seed() + static_cast<std::uint64_t>(GetParam()));
  int on_slabs = 0;
  int made = 0;
  for (int k = 0; k < scenes_a_shard; ++k) {
    const Scene scene = boxes.next();
    const int count = boxes.ranks();
    const Threads threads{boxes.chance(0.5) ? 1 : 2, boxes.chance(0.7) ? std::size_t{512} : std::size_t{1}};
    SCOPED_TRACE(fmt::format("scene {}, {} ranks", k, count));
    State start;
    Truth truth;
    try {
      start = initial_state(scene);
      truth = truth_of(scene, start, 25);
    } catch (const std::runtime_error&) {
      continue;  // no room for the disks, or a collapse
    }
    ++made;
    std::atomic<int> slabs{0};
    run_on_local_ranks(count,
                       [&](Ranks& ranks) { slabs += expect_truth(scene, start, truth, threads, ranks) ? 1 : 0; });
    on_slabs += slabs > 0 ? 1 : 0;
    if (HasFailure()) return;
  }
  EXPECT_GT(made, scenes_a_shard / 2);
  EXPECT_GT(on_slabs, made / 2);
}

INSTANTIATE_TEST_SUITE_P(Shards, SlabExactScenes, ::testing::Range(0, shards));

}  // namespace
}  // namespace carom
