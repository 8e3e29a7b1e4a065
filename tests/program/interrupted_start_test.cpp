// Signals, and a limit of wall time, while the initial state is made: there is no checkpoint yet, and no file may be
// left behind.
#include <csignal>
#include <fstream>

#include "tests/support/program_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using ::testing::HasSubstr;

// A state whose growth takes minutes.
constexpr const char* slow_growth = R"([box]
packing_fraction = 0.84
[[disks]]
count = 20000
positions = "growth"
radius = { uniform = [1.0, 3.0] }
mass = 1.0
velocities = { uniform = 1.0 }
[growth]
slowness = 100.0
[run]
t_end = 1.0
[output]
checkpoint = 1
)";

class InterruptedStart : public test::ProgramTest {
 protected:
  InterruptedStart() { write("slow.toml", slow_growth); }

  // Does the process already catch the signal?
  static bool catches(pid_t pid, int signal) {
    std::ifstream status("/proc/" + std::to_string(pid) + "/status");
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with("SigCgt:")) return ((std::stoull(line.substr(7), nullptr, 16) >> (signal - 1)) & 1U) != 0;
    }
    return false;
  }
};
using LongInterruptedStart = InterruptedStart;

TEST_F(InterruptedStart, SignalsDoNotWaitForIt) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    const pid_t run = start({"run", "slow.toml", "-o", "out"});
    while (!catches(run, signal) || !catches(run, SIGUSR1)) usleep(1000);
    kill(run, SIGUSR1);
    kill(run, signal);
    EXPECT_EQ(wait_for(run), 4);
    EXPECT_THAT(
        said(),
        HasSubstr(signal == SIGINT
                      ? "stopped by SIGINT while the initial state was made; there is no checkpoint to resume from\n"
                      : "stopped by SIG"));
    EXPECT_FALSE(fs::exists(at("out")));
  }
}

TEST_F(InterruptedStart, ACheckpointThatIsWishedForEarlyDoesNoHarm) {
  const pid_t run = start({"run", "slow.toml", "-o", "out"});
  while (!catches(run, SIGUSR1)) usleep(1000);
  kill(run, SIGUSR1);
  while (said().find("no checkpoint yet: the initial state is still being made\n") == std::string::npos) usleep(1000);
  kill(run, SIGTERM);
  EXPECT_EQ(wait_for(run), 4);
}

TEST_F(LongInterruptedStart, TheWallTimeEndsItToo) {
  const Outcome o = carom("run slow.toml --quiet -o out --max-walltime 0.5");
  EXPECT_EQ(o.status, 4);
  EXPECT_EQ(
      o.err,
      "carom: stopped by --max-walltime while the initial state was made; there is no checkpoint to resume from\n");
}

}  // namespace
}  // namespace carom
