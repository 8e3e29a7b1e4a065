// Runs on several ranks that are stopped, killed and resumed, for tests over MPI.
#pragma once

#include "tests/support/program_support.hpp"

namespace carom::test {

// On a busy machine ranks wait for each other at every message: so there are only some hundred disks and a few steps.
inline const std::string ranks_scene = R"([box]
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

// Later than any run gets before it is stopped.
inline const std::string far_end = "--t-end 200";

// For exact, a box so tall that slabs depend only on the disks of their neighbours; frames are within windows.
inline const std::string exact_tall =
    " --method exact --set box.width=12 --set box.height=480 --set disks.0.count=1600 ";

class RanksRun : public ProgramTest {
 protected:
  RanksRun() { write("scene.toml", ranks_scene); }

  // Starts a run that goes on until it is stopped or killed, and waits for its first checkpoint.
  pid_t start_long(const std::string& folder, const std::string& ranks, const std::string& more = "") const {
    std::vector<std::string> words{"run",
                                   "scene.toml",
                                   "--quiet",
                                   "--t-end",
                                   "1e4",
                                   "--ranks",
                                   ranks,
                                   "--set",
                                   "output.checkpoint=\"0.05 s\"",
                                   "--set",
                                   "output.every=1e3"};
    std::istringstream list(more);
    words.insert(words.end(), std::istream_iterator<std::string>(list), {});
    words.insert(words.end(), {"-o", folder});
    const pid_t run = start(words);
    while (!std::filesystem::exists(checkpoint_of(folder)) && is_running(run)) usleep(1000);
    return run;
  }

  // Resumes the killed run in a folder on this number of ranks, and waits for a checkpoint of its own; the caller then
  // kills it again.
  pid_t resume_long(const std::string& folder, const std::string& ranks) const {
    const std::filesystem::file_time_type last = checkpoint_time(folder);
    const pid_t run = start({"resume", folder, "--quiet", "--ranks", ranks});
    await_checkpoint_after(last, folder, run);
    return run;
  }

  // Waits until the run in a folder has written a checkpoint later than this time.
  void await_checkpoint_after(std::filesystem::file_time_type last, const std::string& folder, pid_t run) const {
    const auto none = std::filesystem::file_time_type::min();
    for (auto now = last; (now == last || now == none) && is_running(run); usleep(1000)) now = checkpoint_time(folder);
  }

  // The time of the last checkpoint; the earliest possible one while a new checkpoint replaces it.
  std::filesystem::file_time_type checkpoint_time(const std::string& folder) const {
    std::error_code ignored;
    return std::filesystem::last_write_time(checkpoint_of(folder), ignored);
  }

  std::filesystem::path checkpoint_of(const std::string& folder) const {
    return at(folder) / "carom-unfinished/checkpoint.carom";
  }

  bool is_running(pid_t run) const {
    EXPECT_EQ(waitpid(run, nullptr, WNOHANG), 0) << said();
    return !HasFailure();
  }

  // The run in a folder has a checkpoint, from which it must come to the end of the run `one`: it makes some steps on
  // this number of ranks, and goes on alone, which is faster than more ranks than cores.
  void expect_undisturbed(const std::string& folder, std::size_t ranks) const {
    const Outcome some =
        carom(fmt::format("resume {} --quiet --ranks {} --max-walltime 1e-9 ", folder, ranks) + far_end);
    ASSERT_EQ(some.status, 4) << some.err;
    ASSERT_EQ(carom("resume " + folder + " --quiet " + far_end).status, 0);
    EXPECT_EQ(summary(folder)["state_hash"], summary("one")["state_hash"]);
    EXPECT_EQ(summary(folder)["collisions"], summary("one")["collisions"]);
  }

  // The process ids of the ranks of the run in a folder.
  std::vector<pid_t> ranks_of(const std::string& folder) const {
    std::istringstream list(shell("pgrep -f '^[^ ]*carom-mpi (run scene.toml.* -o|resume) " + folder + "( |$)'").out);
    return {std::istream_iterator<pid_t>(list), {}};
  }
};

}  // namespace carom::test
