// carom::Simulation: the bits are those of a run, however it is stepped, saved and looked at.
#include "run/simulation/simulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "run/scene/run_scene.hpp"
#include "run/simulation/disk_maps.hpp"
#include "tests/support/simulation_support.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using test::choice;
using test::gas;
using test::methods;

const std::string scenes = CAROM_SOURCE_DIR "/scenes/";

TEST(Simulation, HasTheBitsOfARun) {
  for (const std::string file : {"two_disks.toml", "production_a.toml", "brownian_sink.toml"}) {
    const Scene scene = load_scene(scenes + file, {{"run.t_end", "2.0"}});
    RunSettings settings;
    settings.engine = choice("parallel", 2);
    const RunOutcome outcome = run(scene, settings);
    Simulation simulation(scene, choice());
    while (!simulation.done()) {
      simulation.run_until(simulation.time() + 0.3);
      simulation.step();
      simulation.disks();
    }
    EXPECT_EQ(hash_text(simulation.hash()), outcome.summary.state_hash) << file;
    EXPECT_EQ(simulation.summary().counters.collisions, outcome.summary.counters.collisions) << file;
  }
}

// Two runs of a scene find the same folder free before their starts are computed.
TEST(Run, TakesTheNextFolderWhereAnotherRunHasTakenItsOwn) {
  const test::TestFolder folder("next_folder");
  const std::filesystem::path usual = folder.path() / "two_disks";
  const Scene scene = load_scene(scenes + "two_disks.toml", {});
  RunSettings settings;
  settings.engine = choice("reference", 1);
  settings.usual = UsualFolder{usual, usual};
  settings.folder = usual;
  std::optional<OutputFolder> other;
  settings.listener.ready = [&] { other.emplace(usual, scene.file, false); };
  std::string said;
  settings.listener.note = [&](std::string_view note) { said = note; };
  const RunOutcome outcome = run(scene, settings);
  EXPECT_EQ(outcome.folder, usual.string() + "-2");
  EXPECT_EQ(said, "another run has taken " + usual.string() + " meanwhile: results go to " + outcome.folder);
  EXPECT_TRUE(std::filesystem::exists(outcome.folder + "/summary.json"));
}

TEST(Simulation, WritesNoFilesAndStopsWhereAsked) {
  Simulation simulation(gas("pairwise"), choice());
  simulation.run_until(1.0);
  EXPECT_DOUBLE_EQ(simulation.time(), 1.0);
  int asked = 0;
  simulation.run_until(2.0, [&] { return ++asked <= 7; });
  EXPECT_DOUBLE_EQ(simulation.time(), 1.07);
  simulation.step(1'000'000);
  EXPECT_TRUE(simulation.done());
  EXPECT_EQ(simulation.time(), 3.0);
}

// Looks at the disks before each step; before some steps it removes a disk, or loads a state of this scene or another.
// Returns false after so many steps that a run making no progress would be noticed.
bool look_and_change(Simulation& s, Count k, const std::string& before, const std::string& elsewhere) {
  std::vector<DiskId> ids;
  for (const std::size_t i : s.order()) ids.push_back(s.state().disks.id[i]);
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end())) << "before step " << k;
  if (k == 1) s.load(before);
  if (k == 2) s.load(elsewhere);
  if (k == 3) s.remove(17);
  return k < 500;
}

TEST(Simulation, AFunctionThatIsAskedBetweenStepsMayLookAndChange) {
  for (const std::string method : methods) {
    for (const EngineChoice& engine : {choice("reference"), choice("parallel", 2)}) {
      SCOPED_TRACE(method + " " + engine.name);
      Simulation run(gas(method), engine), stepped(gas(method), engine);
      Simulation other(gas(method == "exact" ? "pairwise" : "exact"), engine);
      other.step();
      const std::string before = run.save(), elsewhere = other.save();
      Count asked = 0;
      run.run_until(1.0, [&] { return look_and_change(run, asked++, before, elsewhere); });
      EXPECT_GE(run.time(), 1.0);
      for (Count k = 0; stepped.time() < 1.0 && look_and_change(stepped, k, before, elsewhere); ++k) stepped.step();
      EXPECT_EQ(run.hash(), stepped.hash());
      EXPECT_EQ(run.time(), stepped.time());
    }
  }
}

TEST(Simulation, GivesDisksInOrderOfId) {
  Simulation simulation(gas("exact"), choice());
  simulation.run_until(1.0);
  const Disks d = simulation.disks();
  EXPECT_EQ(state_hash(d), simulation.hash());
  for (std::size_t k = 0; k < d.size(); ++k) EXPECT_EQ(d.id[k], k);
  Disks earlier;
  const double at = simulation.disks_at(1.0, earlier);
  EXPECT_DOUBLE_EQ(at, 1.0);
  EXPECT_THROW(simulation.disks_at(simulation.time() + 1.0, earlier), InputError);
}

// In time stepping, and after loading a state, only the end of the last step is available; earlier times are still
// refused.
TEST(Simulation, RefusesTimesBeforeTheLastStep) {
  for (const char* method : methods) {
    Simulation s(gas(method), choice());
    s.step(3);
    const double start = s.time();
    s.step();
    Disks then;
    EXPECT_THROW(s.disks_at(std::nextafter(start, 0.0), then), InputError) << method;
    EXPECT_GE(s.disks_at(start, then), start) << method;
    const std::string saved = s.save();
    s.step();
    s.load(saved);
    Simulation other = Simulation::from_bytes(saved, choice());
    for (Simulation* taken_up : {&s, &other}) {
      EXPECT_THROW(taken_up->disks_at(start, then), InputError) << method;
      EXPECT_EQ(taken_up->disks_at(taken_up->time(), then), taken_up->time()) << method;
    }
  }
}

// Only the paths of the last window are kept: its start is the earliest time for which disks are available.
TEST(Simulation, HasNoDisksOfBeforeTheLastStep) {
  for (const char* engine : {"parallel", "reference"}) {
    Simulation s(gas("exact"), choice(engine));
    s.step(3);
    const Disks before = s.disks();
    const double start = s.time();
    s.step();
    Disks then;
    EXPECT_EQ(s.disks_at(start, then), start);
    for (std::size_t k = 0; k < before.size(); ++k) EXPECT_DOUBLE_EQ(then.x[k], before.x[k]);
    for (const double t : {std::nextafter(start, 0.0), 0.0, -1.0, -HUGE_VAL}) {
      EXPECT_THROW(s.disks_at(t, then), InputError) << t;
    }
  }
}

TEST(Simulation, ASummaryMovesNoDisk) {
  for (const char* method : methods) {
    Simulation simulation(gas(method), choice());
    simulation.step(3);
    const auto expect_still = [&] {
      const double* const place = simulation.state().disks.x.data();
      const std::vector<DiskId> ids = simulation.state().disks.id;
      EXPECT_EQ(simulation.summary().state_hash, hash_text(simulation.hash())) << method;
      EXPECT_EQ(simulation.state().disks.x.data(), place) << method;
      EXPECT_EQ(simulation.state().disks.id, ids) << method;
    };
    expect_still();
    simulation.load(simulation.save());
    expect_still();
  }
}

// If the disk becomes full, here by a limit on the size of files, an earlier saved state is not lost.
TEST(Simulation, ASaveThatFailsLeavesTheOneBefore) {
  const test::TestFolder folder("failing_save");
  const std::string file = (folder.path() / "saved").string();
  Simulation simulation(gas("exact"), choice());
  simulation.save(file);
  const std::uint64_t saved = simulation.hash();
  simulation.step(3);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit little{1000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &little);
  EXPECT_THROW(simulation.save(file), RunError);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(Simulation::resume(file, choice()).hash(), saved);
  EXPECT_THROW(simulation.save(folder.path().string()), RunError);
  EXPECT_FALSE(std::filesystem::exists(folder.path().string() + ".new"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  simulation.save(file);
  EXPECT_EQ(Simulation::resume(file, choice()).hash(), simulation.hash());
}

// Warnings raised before a state was loaded are still reported, though after those of later steps.
TEST(Simulation, WarningsOutliveALoad) {
  Scene hasty = gas("pairwise");
  hasty.run.dt = 0.2;
  const auto warned = [&](bool goes_back) {
    Simulation simulation(hasty, choice());
    const std::string saved = simulation.save();
    simulation.step(20);
    if (goes_back) {
      simulation.load(saved);
      simulation.step();
    }
    return simulation.take_warnings();
  };
  const std::vector<std::string> expected = warned(false);
  ASSERT_GE(expected.size(), 2U);
  EXPECT_EQ(warned(true), expected) << "and the first warning, which comes again in the first step, once";
}

// For root a state saved to /dev/null would replace it.
TEST(Simulation, ASaveReplacesNoPipe) {
  const test::TestFolder folder("simulation_pipe");
  const std::filesystem::path pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const Simulation simulation(gas("pairwise"), choice());
  try {
    simulation.save(pipe.string());
    FAIL();
  } catch (const RunError& error) {
    EXPECT_EQ(error.what(), "cannot write " + pipe.string() + ": it is a device or a pipe");
  }
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_FALSE(std::filesystem::exists(pipe.string() + ".new"));
}

TEST(Simulation, SavedAndLoadedGoesOnBitForBit) {
  for (const char* method : methods) {
    Simulation simulation(gas(method), choice());
    simulation.step(40);
    const std::string saved = simulation.save();
    simulation.step(40);
    const std::uint64_t then = simulation.hash();
    simulation.load(saved);
    simulation.step(40);
    EXPECT_EQ(simulation.hash(), then) << method;
    Simulation other = Simulation::from_bytes(saved, choice("reference"));
    other.step(40);
    EXPECT_EQ(other.hash(), then) << method;
    std::string damaged = saved;
    damaged[damaged.size() / 2] ^= 1;
    EXPECT_THROW(simulation.load(damaged), InputError);
    EXPECT_THROW(simulation.load(saved.substr(0, saved.size() - 8)), InputError);
    EXPECT_THROW(simulation.load(""), InputError);
    EXPECT_EQ(simulation.hash(), then) << method;
  }
}

// The mean pressure refers to the area halfway through the run: here of one disk that meets only the opposite wall.
TEST(Simulation, SummaryHasThePressureInTheRoomThatASideLeaves) {
  Simulation simulation(
      parse_scene(
          "[box]\nwidth = 20.0\nheight = 10.0\nleft = { motion = { velocity = [1.0, 0.0] } }\n"
          "[[disks]]\ncount = 1\npositions = [[18.0, 5.0]]\nvelocities = [[1.0, 0.0]]\nradius = 0.5\nmass = 2.0\n"
          "[run]\nmethod = \"exact\"\nt_end = 4.0\n",
          "piston.toml", ""),
      choice());
  simulation.run_until(4.0);
  EXPECT_DOUBLE_EQ(simulation.summary().pressure, 1.0 / (18.0 * 10.0));
}

TEST(Simulation, ColumnsAsEigenMapsAreNoCopies) {
  Simulation s(gas("pairwise"), choice());
  s.step(10);
  const Disks& d = s.state().disks;
  const DiskMaps maps(d);
  EXPECT_EQ(maps.x.data(), d.x.data());
  EXPECT_EQ(maps.vy.data(), d.vy.data());
  ASSERT_EQ(static_cast<std::size_t>(maps.id.size()), d.size());
  EXPECT_EQ(maps.id[3], d.id[3]);
  EXPECT_EQ(maps.y.maxCoeff(), *std::max_element(d.y.begin(), d.y.end()));
  EXPECT_EQ(static_cast<std::size_t>(maps.radius.size()), d.radius.size());
}

TEST(Simulation, TwoInTwoThreadsDoNotMeet) {
  const auto hash = [](int threads) {
    Simulation s(gas("exact", 500), choice("parallel", threads));
    s.run_until(1.0);
    return s.hash();
  };
  const std::uint64_t alone = hash(1);
  std::uint64_t first = 0, second = 0;
  std::jthread one([&] { first = hash(2); });
  second = hash(1);
  one.join();
  EXPECT_EQ(first, alone);
  EXPECT_EQ(second, alone);
}

}  // namespace
}  // namespace carom
