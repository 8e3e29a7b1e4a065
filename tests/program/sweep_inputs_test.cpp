// carom sweep and the files that its scene reads: a run counts as done while these files give what it began with.
#include <filesystem>

#include "tests/support/program_support.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* from_files = R"([box]
width = 12.0
height = 12.0
[[disks]]
count = 3
positions = { file = "p.csv" }
velocities = { file = "v.csv" }
radius = 0.4
mass = 1.0
[run]
method = "exact"
t_end = 1.0
[output]
every = 0.5
trajectory = "xyz"
)";
constexpr const char* three = "1,2\n5,5\n8,8\n";
constexpr const char* others = "1,2\n5,6\n8,8\n";

class SweepInputs : public test::ProgramTest {
 protected:
  SweepInputs() {
    write("scene.toml", from_files);
    write("p.csv", three);
    write("v.csv", three);
  }
  Outcome sweep(const std::string& words = "") const {
    return carom("sweep scene.toml -o s --over physics.restitution=0.5,1 " + words);
  }
  std::string table() const { return text_of(at("s/sweep.csv")); }
};
using LongSweepInputs = SweepInputs;

TEST_F(SweepInputs, AFileThatHasChangedMakesAnotherSweep) {
  ASSERT_EQ(sweep().status, 0);
  const std::string before = table();
  write("p.csv", std::string("# the same disks\n") + three);
  EXPECT_THAT(sweep().err, HasSubstr("0 of 2 runs are left"));

  write("p.csv", others);
  const Outcome o = sweep();
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(
      o.err,
      "carom: error: s: holds another sweep: p.csv has changed since run 0001 began; remove s/runs/0001 to run it "
      "again, choose another folder with -o, or replace it with --force\n");
  EXPECT_EQ(table(), before) << "a refused sweep must change nothing";
  write("v.csv", others);
  EXPECT_THAT(sweep("--seeds 2").err, HasSubstr("p.csv and v.csv have changed since run 0001 began"));
  EXPECT_EQ(sweep("--emit parallel").status, 2);
  write("p.csv", three);
  write("v.csv", three);
  EXPECT_THAT(sweep("--seeds 2").err, HasSubstr("2 of 4 runs are left")) << "with the old files";

  write("p.csv", others);
  EXPECT_THAT(sweep("--force").err, HasSubstr("2 of 2 runs are left"));
  EXPECT_NE(table(), before);
}

TEST_F(SweepInputs, AFrameThatHasChangedMakesAnotherSweep) {
  ASSERT_EQ(carom("run scene.toml -o melt --quiet").status, 0);
  std::string frames = from_files;
  for (const char* const key : {"positions", "velocities", "radius", "mass"}) {
    const std::size_t begin = frames.find(std::string(key) + " = ");
    frames.replace(begin, frames.find('\n', begin) - begin, std::string(key) + " = { frame = \"melt\", index = 3 }");
  }
  write("frames.toml", frames);
  const std::string words = "sweep frames.toml -o s --over physics.restitution=0.5,1";
  ASSERT_EQ(carom(words).status, 0);
  EXPECT_THAT(carom(words).err, HasSubstr("0 of 2 runs are left"));
  for (const char* const change : {"disks.0.radius=0.3", "disks.0.mass=2"}) {
    ASSERT_EQ(carom(std::string("run scene.toml -o melt --quiet --force --set ") + change).status, 0);
    EXPECT_THAT(carom(words).err, HasSubstr("s: holds another sweep: melt has changed since run 0001 began")) << change;
  }
  ASSERT_EQ(carom("run scene.toml -o melt --quiet --force --t-end 1.5").status, 0);
  EXPECT_THAT(carom(words).err, HasSubstr("0 of 2 runs are left")) << "the third frame is unchanged";
}

// A stopped run would go on from what it began with, so it must be checked.
TEST_F(SweepInputs, ARunThatWasStoppedIsLookedAtToo) {
  const std::string words = "sweep scene.toml -o s --jobs 1 --over run.t_end=1e9,2e9";
  const Outcome o = shell("{ $C " + words +
                          " & until [ -e s/runs/0001/carom-unfinished/scene.toml ]; do sleep 0.01; done; kill -TERM "
                          "$!; wait $!; }");
  EXPECT_EQ(o.status, 4) << o.err;
  write("v.csv", others);
  EXPECT_THAT(carom(words).err, HasSubstr("v.csv has changed since run 0001 began"));
}

// Here not a file has changed, but the run itself.
TEST_F(SweepInputs, ARunThatIsNotWhatItWasIsNamed) {
  ASSERT_EQ(sweep("--set output.checkpoint=600").status, 0);
  ASSERT_EQ(carom("resume s/runs/0002 --t-end 2 --quiet").status, 0);
  EXPECT_THAT(sweep("--set output.checkpoint=600").err,
              HasSubstr("s: holds another sweep: its run 0002 has another scene; remove s/runs/0002 to run it again"));
  fs::remove_all(at("s/runs/0002"));
  EXPECT_THAT(sweep("--set output.checkpoint=600").err, HasSubstr("1 of 2 runs are left"));
  fs::remove(at("s/runs/0001/scene.toml"));
  EXPECT_THAT(sweep("--set output.checkpoint=600").err,
              HasSubstr("the scene of its run 0001 is unknown: s/runs/0001/scene.toml: cannot be opened"));
}

// Another version of Carom may write a scene in other words, and without keys that did not exist yet.
TEST_F(SweepInputs, TheSameSceneInOtherWordsIsTheSame) {
  ASSERT_EQ(sweep().status, 0);
  const std::string written = text_of(at("s/runs/0001/scene.toml"));
  write("s/runs/0001/scene.toml", "# of another version\n" + test::replaced(written, "wall_restitution = 1.0\n", ""));
  EXPECT_THAT(sweep().err, HasSubstr("0 of 2 runs are left"));
  write("s/runs/0001/scene.toml", test::replaced(written, "radius = 0.4", "radius = 0.3"));
  EXPECT_THAT(sweep().err, HasSubstr("its run 0001 has another scene"));
}

TEST_F(SweepInputs, RunsOfSeveralVersionsAreToldOf) {
  const auto runs = sweep();
  EXPECT_THAT(runs.err, Not(HasSubstr("version")));
  const std::string summary = text_of(at("s/runs/0001/summary.json"));
  const std::size_t begin = summary.find("\"version\": \"") + 12;
  const std::string version = summary.substr(begin, summary.find('"', begin) - begin);
  write("s/runs/0001/summary.json", test::replaced(summary, "\"" + version + "\"", "\"0.0.9\""));
  EXPECT_THAT(sweep().err, HasSubstr("warning: the runs are of several versions of Carom, which may differ in the last "
                                     "bits: \"0.0.9\", \"" +
                                     version + "\"\n"));
}

// While the first run is at work the file is replaced; then that run is killed, and the second is about to start.
TEST_F(SweepInputs, AChangeWhileTheSweepGoesOnIsSeen) {
  for (const std::string change : {"printf '1,2\\n5,6\\n8,8\\n' > p.csv", "printf '[box' > scene.toml"}) {
    const Outcome o = shell(
        "{ $C sweep scene.toml -o s --force --jobs 1 --over run.t_end=1e9,2e9 & until [ -e "
        "s/runs/0001/carom-unfinished/scene.toml ]; do sleep 0.01; done; " +
        change + "; kill -KILL $(cat /proc/$!/task/$!/children); wait $!; }");
    EXPECT_EQ(o.status, 1);
    EXPECT_THAT(o.err, HasSubstr("run 0002: the scene, or a file that it reads, has changed since the sweep began\n"));
    EXPECT_THAT(table(), Not(HasSubstr("\n0002,")));
    fs::remove_all(at("s"));
  }
}

// There must be no moment between the check and the reading of the files in which a change would go unnoticed.
TEST_F(LongSweepInputs, EveryRowIsOfTheFileAsItWas) {
  write("a.csv", three);
  write("b.csv", others);
  const Outcome o = shell(
      "{ touch going; $C sweep scene.toml -o s --seeds 300 & sweep=$!; until [ -e s/runs ]; do :; done; { while [ -e "
      "going ]; do cp b.csv n; mv n p.csv; cp a.csv n; mv n p.csv; done; } & wait $sweep; rm going; wait; }");
  ASSERT_EQ(carom("run scene.toml -o alone --quiet").status, 0);
  const std::string hash = summary("alone")["state_hash"].get<std::string>();
  std::istringstream rows(table());
  std::string row;
  std::getline(rows, row);
  while (std::getline(rows, row)) EXPECT_THAT(row, ::testing::EndsWith(hash));
  EXPECT_THAT(o.err, HasSubstr("has changed since the sweep began"));
}

// Not even the superuser may write there: that right is taken away here.
TEST_F(SweepInputs, AFolderThatCannotBeWrittenIsRefused) {
  ASSERT_EQ(carom("sweep scene.toml -o s --seeds 1").status, 0);
  const Outcome o = shell(
      "chmod a-w s; as=; [ $(id -u) != 0 ] || as='setpriv --bounding-set=-dac_override'; $as $C sweep scene.toml -o s "
      "--seeds 1; status=$?; chmod u+w s; exit $status");
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(o.err, "carom: error: s: cannot be written to: Permission denied; expected a folder for the sweep (-o)\n");
}

}  // namespace
}  // namespace carom
