// Signals to carom run --ranks while mpiexec starts the ranks: none is lost, and none ends a rank.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "tests/support/program_support.hpp"

namespace carom {
namespace {

class SignalsToRanks : public test::ProgramTest {
 protected:
  SignalsToRanks() {
    write("scene.toml", R"([box]
width = 20.0
height = 40.0
[[disks]]
count = 200
positions = "random"
velocities = { maxwell = 1.0 }
radius = 0.5
mass = 1.0
[run]
method = "pairwise"
dt = 0.01
t_end = 1e6
[output]
every = 0.0
series = true
)");
  }

  // Starts a run, and waits until its mpiexec has been started.
  pid_t start_ranks(const std::string& folder) const {
    const pid_t run = start({"run", "scene.toml", "--quiet", "--ranks", "2", "-o", folder});
    const std::string children = fmt::format("/proc/{0}/task/{0}/children", run);
    for (pid_t child = 0; !(std::ifstream(children) >> child); usleep(100)) {
      EXPECT_EQ(waitpid(run, nullptr, WNOHANG), 0) << said();
      if (HasFailure()) break;
    }
    return run;
  }

  // The exit status of a run, or none if it does not end soon; then it is killed.
  static int status_soon(pid_t run) {
    constexpr int patience_ms = 60'000;
    for (int k = 0; k < patience_ms; ++k, usleep(1000)) {
      int status = 0;
      if (waitpid(run, &status, WNOHANG) == run) return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    kill(run, SIGKILL);
    return wait_for(run);
  }
};

// Rank 0 gets the signal as soon as it listens; by then there may or may not be a checkpoint.
TEST_F(SignalsToRanks, AreKeptUntilTheRanksListen) {
  for (const useconds_t delay : {0U, 20'000U, 60'000U, 150'000U, 400'000U}) {
    SCOPED_TRACE(fmt::format("after {} us", delay));
    const pid_t run = start_ranks(fmt::format("stopped{}", delay));
    usleep(delay);
    kill(run, SIGTERM);
    EXPECT_EQ(status_soon(run), 4) << said();
  }
  EXPECT_NE(said().find("stopped by SIGTERM"), std::string::npos) << said();
}

// A request for a checkpoint must not end the run.
TEST_F(SignalsToRanks, AWishForACheckpointLetsTheRanksStart) {
  for (const useconds_t delay : {0U, 20'000U, 60'000U, 150'000U}) {
    SCOPED_TRACE(fmt::format("after {} us", delay));
    const std::string folder = fmt::format("out{}", delay);
    const pid_t run = start_ranks(folder);
    usleep(delay);
    kill(run, SIGUSR1);
    while (!std::filesystem::exists(at(folder) / "carom-unfinished/series.csv")) {
      ASSERT_EQ(waitpid(run, nullptr, WNOHANG), 0) << said();
      usleep(1000);
    }
    kill(run, SIGTERM);
    EXPECT_EQ(status_soon(run), 4) << said();
  }
}

}  // namespace
}  // namespace carom
