// A small scene, and calls of the program with it, for tests of the command line.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/program_support.hpp"

namespace carom::test {

inline constexpr const char* small_scene = R"(title = "small"
[box]
width = 10.0
height = 10.0
[[disks]]
count = 5
positions = "random"
velocities = { uniform = 1.0 }
radius = 0.5
mass = 1.0
[run]
method = "pairwise"
dt = 0.01
t_end = 1.0
[output]
every = 0.1
trajectory = "xyz"
series = true
)";

class CommandTest : public ProgramTest {
 protected:
  CommandTest() { write("small.toml", small_scene); }

  // Expects one line on standard error with this text, and nothing on standard output.
  void expect_error(const std::string& line, int status, const std::string& what) const {
    const Outcome o = shell(line);
    EXPECT_EQ(o.status, status) << line << "\n" << o.err;
    EXPECT_THAT(o.out, ::testing::IsEmpty()) << line;
    EXPECT_THAT(o.err, ::testing::StartsWith("carom: error: ")) << line;
    EXPECT_THAT(o.err, ::testing::HasSubstr(what)) << line;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << line << "\n" << o.err;
  }

  std::vector<std::string> files_in(const std::string& name) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(at(name))) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

}  // namespace carom::test
