// Scenes that start from a frame of an earlier run.
#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "tests/support/program_support.hpp"
#include "tests/support/scene_support.hpp"
#include "tests/support/small_gas.hpp"

namespace carom {
namespace {

using test::text_of;
using ::testing::HasSubstr;

const std::string with_frames = std::string(test::small_gas) + "[output]\nevery = 0.25\ntrajectory = \"xyz\"\n";

class LongFrameStart : public test::ProgramTest {
 protected:
  LongFrameStart() { write("gas.toml", with_frames); }

  void run(const std::string& words) const {
    const test::Outcome o = carom("run --force --quiet " + words);
    ASSERT_EQ(o.status, 0) << o.err;
  }
  std::vector<std::string> lines_of(const std::string& file) const {
    std::vector<std::string> lines;
    std::istringstream text(text_of(at(file)));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
};

TEST_F(LongFrameStart, AFrameOfAnEarlierRunIsAStart) {
  run("gas.toml -o plain");
  for (const std::string format : {"xyz", "h5md"}) {
    run("gas.toml -o first --set output.trajectory=" + format);
    std::string second = with_frames;
    for (const char* const key : {"positions", "velocities", "radius", "mass"}) {
      const std::size_t begin = second.find(std::string(key) + " = ");
      second.replace(begin, second.find('\n', begin) - begin, std::string(key) + " = { frame = \"first\", index = 3 }");
    }
    write("second.toml", second);
    run("second.toml -o second --t-end 0.5");
    write("by_time.toml", test::replaced(second, "positions = { frame = \"first\", index = 3 }",
                                         "positions = { frame = \"first\", time = 0.5 }"));
    run("by_time.toml -o by_time --t-end 0.5");
    EXPECT_THAT(carom("compare second by_time").out, HasSubstr("same bits"));
    // Frame 3 is at t = 0.5. Frames 3, 4, 5 of the first run are frames 1, 2, 3 of the second: the first of them
    // exactly, the others up to rounding, as windows have other lengths.
    const std::vector<std::string> a = lines_of("plain/trajectory.xyz"), b = lines_of("second/trajectory.xyz");
    for (std::size_t k = 2; k < 22; ++k) EXPECT_EQ(a.at(2 * 22 + k), b.at(k));
  }
}

TEST_F(LongFrameStart, WhatIsNoFrameIsRefused) {
  run("gas.toml -o first");
  for (const auto& [law, expected] : std::vector<std::pair<std::string, std::string>>{
           {"{ frame = \"first\", index = 9 }", "there is no frame 9; expected 1 to 5"},
           {"{ frame = \"nowhere\" }", "does not exist"},
           {"{ frame = \"first\", index = 1, time = 2.0 }", "cannot be used with index"},
           {"{ frame = \"first\", indx = 1 }", "indx: unknown key"},
           {"{ frame = \"first\", index = 0 }", "index: is 0; expected a whole number, 1 or more"},
           {"{ frame = \"first\", index = -1 }", "index: is -1; expected a whole number, 1 or more"},
           {"{ frame = \"first\", index = 1.5 }", "index: is 1.5; expected a whole number, 1 or more"}}) {
    write("bad.toml", test::replaced(with_frames, "\"random\"", law));
    const test::Outcome o = carom("check bad.toml");
    EXPECT_EQ(o.status, 2) << law;
    EXPECT_THAT(o.err, HasSubstr("bad.toml:")) << law;
    EXPECT_THAT(o.err, HasSubstr(expected)) << law;
  }
}

// Disks of time stepping may overlap a little; smaller disks have room.
TEST_F(LongFrameStart, SmallerDisksOfAPileHaveRoom) {
  write(
      "pile.xyz",
      "2\nLattice=\"10 0 0 0 8 0 0 0 1\" pbc=\"F F F\" Properties=pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1 Time=0\n"
      "2 2 0 0 0.5 1 0\n2.9999 2 0 0 0.5 1 1\n");
  const auto check = [this](std::string_view radius) {
    write("on.toml", fmt::format("[box]\nwidth = 10\nheight = 8\n[[disks]]\ncount = 2\npositions = {{ frame = "
                                 "\"pile.xyz\" }}\nradius = {}\nmass = 1\n[run]\nt_end = 1\n",
                                 radius));
    return carom("check on.toml");
  };
  const test::Outcome refused = check("{ frame = \"pile.xyz\" }");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("disks 0 and 1 overlap by 0.0001 (0.01 % of r1 + r2); expected centres r1 + r2 or "
                                     "more apart; \"scale\" beside the frame of the radii makes room"));
  EXPECT_THAT(check("0.5").err, testing::EndsWith("expected centres r1 + r2 or more apart\n"));
  EXPECT_EQ(check("{ frame = \"pile.xyz\", scale = 0.9998 }").status, 0);
}

// Brownian velocities are u / dt of a step and grow as dt shrinks: used as velocities they would make a gas at a
// temperature of hundreds.
TEST_F(LongFrameStart, DisksDoNotFlyOnAsBrownianDisksHop) {
  write("brownian.toml", test::replaced(test::replaced(with_frames, "restitution = 0.9", "diffusion = 0.5"),
                                        "t_end = 1.0", "dt = 0.01\nt_end = 1.0"));
  run("brownian.toml -o first");
  for (const char* const brownian : {"", "diffusion = 0.5\n", "diffusion = 0.5\naccumulate = true\n"}) {
    std::string second = test::replaced(with_frames, "restitution = 0.9\n", brownian);
    second = test::replaced(second, "\"random\"", "{ frame = \"first\" }");
    second = test::replaced(second, "{ maxwell = 1.0 }", "{ frame = \"first\" }");
    write("second.toml", test::replaced(second, "t_end = 1.0", "dt = 0.01\nt_end = 1.0"));
    const test::Outcome o = carom("check second.toml");
    const bool fine = std::string_view(brownian) == "diffusion = 0.5\n";  // here velocities are forgotten in each step
    EXPECT_EQ(o.status, fine ? 0 : 2) << brownian << o.err;
    if (fine) continue;
    EXPECT_THAT(o.err, HasSubstr("velocities: are from first, whose Brownian disks have no velocities; expected"));
  }
}

// Velocities written by a run include the flow, while those of a scene are relative to it. The flow was once added
// twice.
TEST_F(LongFrameStart, AShearFlowIsNotAddedAgain) {
  std::string sheared = with_frames + "series = true\n";
  for (const char* const side : {"left", "right", "bottom", "top"}) {
    sheared = test::replaced(sheared, "[box]\n", fmt::format("[box]\n{} = \"periodic\"\n", side));
  }
  sheared = test::replaced(sheared, "[box]\n", "[box]\nshear_rate = 0.5\n");
  write("sheared.toml", sheared);
  run("sheared.toml -o first");
  std::string second = sheared;
  for (const char* const key : {"positions", "velocities", "radius", "mass"}) {
    const std::size_t begin = second.find(std::string(key) + " = ");
    second.replace(begin, second.find('\n', begin) - begin, std::string(key) + " = { frame = \"first\", index = 1 }");
  }
  write("second.toml", second);
  run("second.toml -o second");
  EXPECT_THAT(carom("compare first second --tolerance 1e-12 --at 0").out, HasSubstr("the same to 1e-12"));
  std::filesystem::remove(at("first/scene.toml"));
  const test::Outcome o = carom("check second.toml");
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.err, HasSubstr("velocities: are from first, which does not tell whether they include a shear flow; "
                               "expected the folder of a run, with its scene.toml"));
}

}  // namespace
}  // namespace carom
