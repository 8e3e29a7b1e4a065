// carom run and resume with --ranks: the files of one process, whatever the number of ranks, stopped, killed and taken
// up again.
#include "tests/support/program_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of;

// Ranks on a busy machine wait for each other at every message: some hundred disks and a few steps.
const std::string scene = R"([box]
width = 20.0
height = 40.0
left = "periodic"
right = "periodic"
[[disks]]
count = 200
positions = "random"
velocities = { maxwell = 1.0 }
radius = { uniform = [0.3, 0.5] }
mass = 1.0
[run]
method = "pairwise"
dt = 0.01
t_end = 0.4
[output]
every = 0.1
trajectory = "xyz"
series = true
)";

class RanksRun : public test::ProgramTest {
 protected:
  RanksRun() { write("scene.toml", scene); }

  // A run that goes on until it is stopped or killed, once it has written a checkpoint.
  pid_t start_long(const std::string& folder, const std::string& ranks) const {
    const pid_t run = start({"run", "scene.toml", "--quiet", "--t-end", "1e4", "--ranks", ranks, "--set",
                             "output.checkpoint=\"0.05 s\"", "--set", "output.every=1e3", "-o", folder});
    while (!fs::exists(at(folder) / "carom-unfinished/checkpoint.carom")) {
      EXPECT_EQ(waitpid(run, nullptr, WNOHANG), 0) << said();
      if (HasFailure()) break;
      usleep(1000);
    }
    return run;
  }

  // Process ids of the ranks of the run of a folder.
  std::vector<pid_t> ranks_of(const std::string& folder) const {
    std::istringstream list(shell("pgrep -f '^[^ ]*carom-mpi run scene.toml.* -o " + folder + "$'").out);
    return {std::istream_iterator<pid_t>(list), {}};
  }
};

TEST_F(RanksRun, LeavesTheFilesOfOneProcess) {
  ASSERT_EQ(carom("run scene.toml --quiet -o one").status, 0);
  for (const std::string ranks : {"1", "2", "3"}) {
    const Outcome o = carom("run scene.toml --threads 2 --ranks " + ranks + " -o r" + ranks);
    ASSERT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(o.out.find("2 threads on each of " + ranks + " ranks") != std::string::npos, ranks != "1") << o.out;
    for (const char* file : {"trajectory.xyz", "series.csv"}) {
      EXPECT_TRUE(text_of(at("one") / file) == text_of(at("r" + ranks) / file)) << ranks << file;
    }
    EXPECT_EQ(summary("one"), summary("r" + ranks));
    const auto all = nlohmann::json::parse(text_of(at("r" + ranks) / "summary.json"));
    ASSERT_EQ(all.contains("traffic"), ranks != "1");
    if (ranks == "1") continue;
    const auto& traffic = all["traffic"];
    EXPECT_EQ(std::to_string(traffic["disks"].size()), ranks);
    EXPECT_GT(traffic["exchange"]["bytes"], 0.0);
    EXPECT_GT(all["phase_s"]["communication"], 0.0);
    EXPECT_NE(o.out.find("messages with"), std::string::npos) << o.out;
  }
}

TEST_F(RanksRun, AStoppedRunGoesOnWithAnyNumberOfRanks) {
  ASSERT_EQ(carom("run scene.toml --quiet -o one").status, 0);
  ASSERT_EQ(carom("run scene.toml --quiet -o parts --ranks 2 --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume parts --quiet --ranks 3 --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume parts --quiet --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume parts --quiet --ranks 2").status, 0);
  EXPECT_TRUE(text_of(at("one/trajectory.xyz")) == text_of(at("parts/trajectory.xyz")));
  EXPECT_EQ(summary("one"), summary("parts"));
}

TEST_F(RanksRun, ASignalStopsItWithACheckpoint) {
  const pid_t run = start_long("out", "2");
  kill(run, SIGTERM);
  EXPECT_EQ(wait_for(run), 4);
  EXPECT_NE(said().find("stopped by SIGTERM"), std::string::npos) << said();
  EXPECT_NE(said().find("carom resume out"), std::string::npos);
  EXPECT_EQ(carom("resume out --quiet --ranks 3 --max-walltime 1e-9").status, 4);
}

// Whichever rank dies: the others end, one line says so, and the last checkpoint goes on as if nothing had been.
TEST_F(RanksRun, AKilledRankEndsAllAndNothingIsLost) {
  for (const std::size_t victim : {0U, 1U, 2U}) {
    const std::string folder = fmt::format("killed{}", victim);
    const pid_t run = start_long(folder, "3");
    const std::vector<pid_t> ranks = ranks_of(folder);
    ASSERT_EQ(ranks.size(), 3U);
    const std::size_t before = said().size();
    kill(ranks[victim], SIGKILL);
    EXPECT_EQ(wait_for(run), 1);
    EXPECT_EQ(said().substr(before),
              "carom: error: one of the ranks was killed by signal 9; the last checkpoint, if the run has written any, "
              "is whole: carom resume with its folder\n");
    EXPECT_TRUE(ranks_of(folder).empty());
    ASSERT_EQ(carom("resume " + folder + " --quiet --ranks 2 --max-walltime 1e-9").status, 4);
  }
}

TEST_F(RanksRun, WhatRanksCannotDoIsSaidInOneLine) {
  const Outcome exact = carom("run scene.toml --ranks 2 --quiet --method exact -o out");
  EXPECT_EQ(exact.status, 2);
  EXPECT_EQ(exact.err, "carom: error: several ranks do not know the method exact yet: use one, or --method pairwise\n");
  const Outcome many = carom("run scene.toml --ranks 3 --quiet --set box.height=5 --set disks.0.count=20 -o out");
  EXPECT_EQ(many.status, 2);
  EXPECT_NE(many.err.find("3 ranks: slabs of a box 5 high"), std::string::npos) << many.err;
  const Outcome reference = carom("run scene.toml --ranks 2 --quiet --engine reference -o out");
  EXPECT_EQ(reference.status, 2);
  EXPECT_NE(reference.err.find("--ranks: the reference runs on one"), std::string::npos) << reference.err;
  EXPECT_FALSE(fs::exists(at("out")));
}

TEST_F(RanksRun, WithoutMpiItSaysWhichPackagesAreMissing) {
  const Outcome o = shell("cp $C alone && ./alone run scene.toml --ranks 2");
  EXPECT_EQ(o.status, 2);
  EXPECT_NE(o.err.find("openmpi-bin"), std::string::npos) << o.err;
}

}  // namespace
}  // namespace carom
