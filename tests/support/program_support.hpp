// Runs the real program in a folder of its own, for tests of interruptions.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/test_folder.hpp"

namespace carom::test {

struct Outcome {
  int status = -1;
  std::string out, err;
};

class ProgramTest : public ::testing::Test {
 protected:
  ProgramTest() : folder_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::create_directories(at(""));
  }
  std::filesystem::path at(const std::string& name) const { return folder_.path() / "work" / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(at(name)) << text; }

  // Runs a line of shell in the test's folder, in which $C is the program.
  Outcome shell(const std::string& line) const {
    const std::string out = (folder_.path() / "out").string();
    const std::string err = (folder_.path() / "err").string();
    const std::string command = "cd '" + at("").string() + "' && C='" CAROM_PROGRAM "' && { " + line + "; } >'" + out +
                                "' 2>'" + err + "' </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
  }
  Outcome carom(const std::string& arguments) const { return shell("$C " + arguments); }

  // Starts the program in the test's folder and returns its process id. Its output is appended to the file `said`.
  pid_t start(const std::vector<std::string>& arguments) const {
    std::vector<std::string> words{CAROM_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, at("").c_str());
    const std::string said = (folder_.path() / "said").string();
    for (const int stream : {1, 2}) {
      posix_spawn_file_actions_addopen(&actions, stream, said.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    }
    // Resets signals that are ignored where the tests run, as in background jobs of a shell.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t all;
    sigfillset(&all);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    pid_t pid = -1;
    EXPECT_EQ(posix_spawn(&pid, CAROM_PROGRAM, &actions, &attributes, argv.data(), environ), 0);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return pid;
  }
  std::string said() const { return text_of(folder_.path() / "said"); }

  // Waits for the process; returns its exit status, or -signal.
  static int wait_for(pid_t pid) {
    int status = 0;
    waitpid(pid, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  // Resumes a stopped run, by either engine in turn, until it ends. The first part stops at once, even on a fast
  // machine; each later part gets more time than the one before, since on a busy machine the first ones may only read
  // the checkpoint.
  struct Resumed {
    Outcome last;
    int parts = 1;
    std::string said;  // standard error of all parts
  };
  Resumed resume_to_the_end(const std::string& folder, Outcome stopped, const std::string& options = "--quiet") const {
    Resumed resumed{std::move(stopped), 1, ""};
    resumed.said = resumed.last.err;
    double seconds = 1e-9;
    while (resumed.last.status == 4) {
      const char* const engine = resumed.parts % 3 == 0 ? "reference" : "parallel --threads 3";
      resumed.last = carom("resume " + folder + " " + options + " --engine " + engine + " --max-walltime " +
                           fmt::format("{}", seconds));
      seconds = std::max(0.001, 1.3 * seconds);
      resumed.said += resumed.last.err;
      ++resumed.parts;
    }
    return resumed;
  }

  // The summary without the entries that differ from run to run: times, and the number of resumptions.
  nlohmann::ordered_json summary(const std::string& folder) const {
    auto json = nlohmann::ordered_json::parse(text_of(at(folder) / "summary.json"));
    for (const char* key : {"wall_s", "cpu_s", "step_s", "phase_s", "resumed", "threads", "engine", "ranks", "traffic"})
      json.erase(key);
    return json;
  }

  // Number of frames of a movie, as ffprobe counts them, and the time of the last.
  std::string movie_frames(const std::string& file) const {
    return shell("ffprobe -v error -count_frames -show_entries stream=nb_read_frames,duration -of default=nk=1:nw=1 " +
                 file)
        .out;
  }

  // Expects that all results of two runs are the same.
  void expect_same_results(const std::string& a, const std::string& b) const {
    for (const char* name : {"trajectory.xyz", "series.csv", "velocity.svg", "energy.svg", "scene.toml"}) {
      ASSERT_EQ(std::filesystem::exists(at(a) / name), std::filesystem::exists(at(b) / name)) << name;
      EXPECT_TRUE(text_of(at(a) / name) == text_of(at(b) / name)) << name << " differs";
    }
    EXPECT_EQ(summary(a), summary(b));
    if (std::filesystem::exists(at(a) / "trajectory.h5")) {
      EXPECT_EQ(carom("compare " + a + "/trajectory.h5 " + b + "/trajectory.h5").status, 0);
    }
    EXPECT_FALSE(std::filesystem::exists(at(b) / "carom-unfinished"));
    if (std::filesystem::exists(at(a) / "movie.mp4")) {
      EXPECT_EQ(movie_frames(a + "/movie.mp4"), movie_frames(b + "/movie.mp4"));
    }
  }

  TestFolder folder_;
};

// A box of falling disks with a sink and a source; method and further lines of [output] are the caller's.
inline std::string busy_scene(const std::string& method, const std::string& output,
                              const std::string& trajectory = "xyz") {
  return R"(title = "busy"
seed = 3
[box]
width = 30.0
height = 20.0
right = "sink"
wall_restitution = 0.9
[physics]
gravity = 0.3
restitution = 0.9
collapse = { model = "tc", contact_time = 1e-4 }
[[disks]]
count = 150
positions = "random"
velocities = { maxwell = 1.0 }
radius = { uniform = [0.3, 0.6] }
mass = 1.0
[[sources]]
side = "left"
rate = 3.0
radius = 0.3
mass = 1.0
velocities = { maxwell = 1.0 }
[run]
method = ")" +
         method +
         R"("
dt = 0.002
t_end = 20.0
[output]
every = 0.1
series = true
trajectory = ")" +
         trajectory + "\"\n" + output;
}

}  // namespace carom::test
