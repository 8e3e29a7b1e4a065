// Runs that are stopped by the physics: the results that they leave, and how the user can go on from there.
#include "tests/support/command_support.hpp"

namespace carom {
namespace {

using test::Outcome;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using StoppedByPhysics = test::CommandTest;

TEST_F(StoppedByPhysics, TheLastGoodStateOfACollapseIsKept) {
  write("pile.toml", R"([box]
width = 10.0
height = 10.0
wall_restitution = 0.5
[physics]
gravity = 1.0
restitution = 0.1
[[disks]]
count = 20
positions = "random"
velocities = { maxwell = 1.0 }
radius = 0.5
mass = 1.0
[run]
t_end = 100.0
[output]
every = 0.1
series = true
)");
  const Outcome o = carom("run pile.toml --quiet -o out");
  EXPECT_EQ(o.status, 3);
  EXPECT_THAT(o.err, HasSubstr("the results up to there are kept in out/carom-unfinished, its last good state in "
                               "checkpoint.carom; carom resume out --t-end "));
  const Outcome again = carom("resume out --quiet");
  EXPECT_EQ(again.status, 3);
  EXPECT_EQ(again.err, o.err) << "the same collapse must come again, from the state before it";
}

// The settings of a resumed run cannot be changed, so it fails again; but it can end with what it has, as the message
// says.
TEST_F(StoppedByPhysics, ARunThatCrushedItsDisksCanEndThere) {
  write("press.toml", R"([box]
width = 10.0
height = 10.0
right = { place = 10.0, motion = { velocity = [-1.0, 0.0] } }
[[disks]]
count = 15
positions = "random"
velocities = { uniform = 1.0 }
radius = 1.0
mass = 1.0
[run]
method = "pairwise"
dt = 0.01
t_end = 7.5
[output]
every = 0.1
series = true
)");
  const Outcome o = carom("run press.toml --quiet -o out");
  EXPECT_EQ(o.status, 3);
  EXPECT_THAT(o.err, HasSubstr("a moving wall leaves no room at t = "));
  EXPECT_THAT(o.err, HasSubstr("kept in out/carom-unfinished, its last state in checkpoint.carom; "));
  EXPECT_EQ(carom("resume out --quiet").err, o.err);
  const std::size_t begin = o.err.find("carom resume out");
  ASSERT_NE(begin, std::string::npos) << o.err;
  const std::string command = o.err.substr(begin + 6, o.err.find(" ends it there", begin) - begin - 6);
  EXPECT_EQ(carom(command + " --quiet").status, 0) << command;
  EXPECT_THAT(files_in("out"), ElementsAre("scene.toml", "series.csv", "summary.json"));
}

}  // namespace
}  // namespace carom
