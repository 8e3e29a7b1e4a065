// A box that is empty for a while: there are frames for that time, the same from both engines of the exact method.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"
#include "tests/support/program_support.hpp"

namespace carom::exact_tests {
namespace {

// The time and disks of every frame that is due, as in a run.
std::vector<std::string> frames_of(Engine& engine, const Scene& scene, double every) {
  std::vector<std::string> frames;
  Disks disks;
  for (double k = 0.0; engine.state().time < scene.run.t_end;) {
    engine.step();
    for (; k * every <= engine.state().time; ++k) {
      const double time = engine.disks_at(k * every, disks);
      frames.push_back(std::to_string(time) + " " + std::to_string(disks.size()) + " " + hash_text(state_hash(disks)));
    }
  }
  return frames;
}

void expect_same_frames(const Scene& scene, double every, std::size_t count) {
  const State initial = initial_state(scene);
  const std::vector<std::string> plain = frames_of(*make_reference_exact(scene, initial), scene, every);
  EXPECT_EQ(frames_of(*make_parallel_engine(scene, initial, {2}), scene, every), plain);
  ASSERT_EQ(plain.size(), count);
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_EQ(plain[k].rfind(std::to_string(every * static_cast<double>(k)) + " ", 0), 0U) << plain[k];
  }
}

const std::string two_leave =
    "[box]\nwidth = 10\nheight = 10\nbottom = \"sink\"\ntop = \"sink\"\n[[disks]]\ncount = 2\n"
    "positions = [[3, 3], [6, 6]]\nvelocities = [[0, 1], [0, -1]]\nradius = 0.5\nmass = 1\n[run]\nt_end = 100\n";
const std::string source_fills =
    "[box]\nwidth = 10\nheight = 10\nright = \"sink\"\n[[sources]]\nside = \"left\"\nrate = 0.5\nradius = 0.5\n"
    "mass = 1\nvelocities = { uniform = 3.0 }\n[run]\nt_end = 10\n";

TEST(EmptyBox, FramesWhenAllDisksHaveLeft) {
  expect_same_frames(parse_scene(two_leave, "test", "."), 10.0, 11);
}

TEST(EmptyBox, FramesBeforeASourceEmits) {
  expect_same_frames(parse_scene(source_fills, "test", "."), 0.5, 21);
}

using EmptyBoxRun = test::ProgramTest;

TEST_F(EmptyBoxRun, BothEnginesWriteTheSameFilesToTheEnd) {
  const std::string output =
      "[output]\nevery = 0.5\nseries = true\ntrajectory = \"xyz\"\n"
      "[analysis]\nwhat = [\"density\"]\nevery = 0.5\n";
  write("box.toml", source_fills + output);
  for (const std::string engine : {"parallel", "reference"}) {
    const test::Outcome run = carom("run box.toml -o " + engine + " --json --engine " + engine);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out)["frames"], 21) << engine;
  }
  for (const char* file : {"series.csv", "trajectory.xyz"}) {
    EXPECT_EQ(test::text_of(at("parallel") / file), test::text_of(at("reference") / file)) << file;
    EXPECT_FALSE(test::text_of(at("parallel") / file).empty());
  }
}

}  // namespace
}  // namespace carom::exact_tests
