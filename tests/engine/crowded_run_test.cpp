// A run with crowded windows reacts to signals and to its wall time, resumes with the same bits, and says why time
// stands still.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/program_support.hpp"

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class CrowdedRun : public ProgramTest {
 protected:
  // A light disk between a wall and a heavy disk: pi / 2 sqrt(ratio) collisions, nearly all of them around t = 15.
  void write_burst(const std::string& name, const std::string& light) const {
    write(name,
          "[box]\nwidth = 40\nheight = 20\n[[disks]]\ncount = 2\npositions = [[5, 10], [20, 10]]\n"
          "velocities = [[0, 0], [-1, 0]]\nradius = 1\nmass = [" +
              light + ", 1.0]\n[run]\nt_end = 30\n[output]\nevery = 5\nseries = true\n");
  }
  // Waits for a file. A run that never writes it fails the test by the test's time limit.
  static void await(const std::filesystem::path& file) {
    while (!std::filesystem::exists(file)) usleep(1000);
  }
  static std::string hash_of(const Outcome& o) { return nlohmann::json::parse(o.out)["state_hash"]; }
};
using LongCrowdedRun = CrowdedRun;

TEST_F(CrowdedRun, ASignalStopsItWithACheckpoint) {
  write_burst("burst.toml", "1e-16");
  for (const std::string engine : {"parallel", "reference"}) {
    const pid_t run = start({"run", "burst.toml", "-o", engine, "--quiet", "--engine", engine});
    await(at(engine + "/carom-unfinished/series.csv"));
    kill(run, SIGTERM);
    EXPECT_EQ(wait_for(run), 4) << engine;
    EXPECT_TRUE(std::filesystem::exists(at(engine + "/carom-unfinished/checkpoint.carom")));
  }
}

TEST_F(LongCrowdedRun, ItsWallTimeStopsIt) {
  write_burst("burst.toml", "1e-16");
  for (const std::string engine : {"parallel", "reference"}) {
    const Outcome o = carom("run burst.toml --max-walltime 0.3 -o " + engine + " --engine " + engine);
    EXPECT_EQ(o.status, 4) << o.err;
    EXPECT_THAT(o.err, HasSubstr("stopped by --max-walltime"));
  }
}

TEST_F(LongCrowdedRun, StoppedAgainAndAgainItHasTheSameBits) {
  write_burst("burst.toml", "1e-12");
  const Outcome whole = carom("run burst.toml -o whole --json --quiet");
  ASSERT_EQ(whole.status, 0) << whole.err;
  const Resumed resumed =
      resume_to_the_end("parts", carom("run burst.toml -o parts --json --quiet --max-walltime 1e-9"), "--json --quiet");
  ASSERT_EQ(resumed.last.status, 0) << resumed.last.err;
  EXPECT_GE(resumed.parts, 3);
  EXPECT_EQ(hash_of(resumed.last), hash_of(whole));
  expect_same_results("whole", "parts");
}

TEST_F(CrowdedRun, ABoxWithoutRoomIsReported) {
  write("full.toml",
        "[box]\nwidth = 8\nheight = 8\n[[disks]]\ncount = 16\npositions = \"square\"\nradius = 1\nmass = 1\n"
        "velocities = { maxwell = 1.0 }\n[run]\nt_end = 1\n");
  for (const std::string engine : {"parallel", "reference"}) {
    const Outcome o = carom("run full.toml --quiet --engine " + engine);
    EXPECT_EQ(o.status, 3);
    EXPECT_THAT(o.err, AllOf(HasSubstr("time stands still at t = 0"), HasSubstr("no room to move"),
                             Not(HasSubstr("collapse"))));
  }
  EXPECT_THAT(carom("check full.toml").out, AllOf(HasSubstr("stops early"), HasSubstr("no room to move")));
}

}  // namespace
}  // namespace carom::test
