// Trajectories read by programs for molecules, ASE and MDAnalysis, each with its own reader.
#include <fmt/format.h>

#include "tests/support/program_support.hpp"

namespace carom {
namespace {

using test::Outcome;
using test::text_of;
using testing::HasSubstr;

// Two groups and a periodic side, which gives all possible columns.
constexpr const char* periodic_scene = R"(title = "round and round"
seed = 5
[box]
width = 20.0
height = 12.0
left = "periodic"
right = "periodic"
[[disks]]
count = 20
positions = "random"
velocities = { uniform = 5.0 }
radius = { uniform = [0.2, 0.6] }
mass = { from_radius = 1.0 }
[[disks]]
count = 3
positions = "random"
radius = 0.5
mass = 2.0
[run]
method = "exact"
t_end = 8.0
[output]
every = 0.25
trajectory = "xyz"
)";

class TrajectoryPrograms : public test::ProgramTest {
 protected:
  TrajectoryPrograms() { write("scene.toml", periodic_scene); }

  // Runs the scene in the folder `name`, and returns the text of its trajectory.
  std::string run_scene(const std::string& name, const std::string& options = "") {
    const Outcome o = carom("run scene.toml --quiet --force -o " + name + " " + options);
    EXPECT_EQ(o.status, 0) << o.err;
    return text_of(at(name + "/trajectory.xyz"));
  }

  // What the two programs read from these files.
  std::string read_as_molecules(const std::string& files) {
    const Outcome o = shell("/usr/bin/python3 " CAROM_SOURCE_DIR "/tests/io/read_as_molecules.py " + files);
    EXPECT_EQ(o.status, 0) << o.out << o.err;
    return o.out;
  }
};
using LongTrajectoryPrograms = TrajectoryPrograms;

TEST_F(LongTrajectoryPrograms, AseAndMdanalysisReadTheText) {
  run_scene("out");
  EXPECT_THAT(read_as_molecules("out/trajectory.xyz"), HasSubstr("cell 20.0 12.0 1.0 pbc True False False"));
  const std::string walls = "--set box.left=wall --set box.right=wall --method pairwise --dt 0.01";
  run_scene("out", walls);
  EXPECT_THAT(read_as_molecules("out/trajectory.xyz"), HasSubstr("cell 20.0 12.0 1.0 pbc False False False"));
}

TEST_F(LongTrajectoryPrograms, MdanalysisReadsTheThreeDimensionsOfH5md) {
  run_scene("xyz");
  run_scene("h5", "--set output.trajectory=h5md --set output.dimensions=3");
  const std::string said = read_as_molecules("xyz/trajectory.xyz h5/trajectory.h5");
  EXPECT_THAT(said, HasSubstr("dimensions [20. 12.  1. 90. 90. 90.]"));
  EXPECT_THAT(carom("compare xyz h5").out, HasSubstr("same bits in all 33 frames"));
  EXPECT_EQ(carom("render h5 --frame 3").status, 0);
}

// Unwrapped, a disk moves between two frames no further than it can have flown.
TEST_F(TrajectoryPrograms, RoundsMakePathsContinuous) {
  std::istringstream file(run_scene("out", "--set output.every=0.05"));
  std::vector<double> before;
  long crossings = 0;
  std::string line;
  while (std::getline(file, line)) {
    const int count = std::stoi(line);
    std::getline(file, line);
    std::vector<double> unwrapped;
    for (int i = 0; i < count; ++i) {
      std::getline(file, line);
      std::istringstream words(line);
      std::string species;
      double x = 0.0, skipped = 0.0, shift = 0.0;
      words >> species >> x;
      for (int k = 0; k < 9; ++k) words >> skipped;
      words >> shift;
      unwrapped.push_back(x + 20.0 * shift);
      crossings += std::abs(static_cast<long>(shift));
    }
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(unwrapped[i], before[i], 0.05 * 20.0) << line;
    before = unwrapped;
  }
  EXPECT_GT(crossings, 100);
}

// The counts of rounds do not depend on the engine, the number of frames, or interruptions.
TEST_F(TrajectoryPrograms, RoundsDoNotDependOnHowTheRunWasMade) {
  const auto last_frame = [&](const std::string& name, const std::string& options) {
    const std::string all = run_scene(name, options);
    return all.substr(all.rfind("Time="));
  };
  const std::string expected = last_frame("parallel", "");
  EXPECT_THAT(expected, HasSubstr(" 1 0 0\n"));
  EXPECT_EQ(last_frame("reference", "--engine reference"), expected);
  EXPECT_EQ(last_frame("rare", "--threads 2 --set output.every=8"), expected);
  EXPECT_EQ(last_frame("often", "--set output.every=0.01"), expected);
}

TEST_F(LongTrajectoryPrograms, AStoppedAndResumedRunCountsOn) {
  const std::string longer = "--t-end 400 --set output.every=4 ";
  const std::string whole = run_scene("whole", longer);
  Outcome o = carom("run scene.toml --quiet -o parts --max-walltime 1e-6 " + longer);
  ASSERT_EQ(o.status, 4) << o.err;
  o = resume_to_the_end("parts", o).last;
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(text_of(at("parts/trajectory.xyz")), whole);
  const std::string h5md = " --set output.trajectory=h5md --set output.dimensions=3 --force";
  o = carom("run scene.toml --quiet -o parts --max-walltime 1e-6 " + longer + h5md);
  o = resume_to_the_end("parts", o).last;
  ASSERT_EQ(o.status, 0) << o.err;
  const Outcome read = shell("/usr/bin/python3 " CAROM_SOURCE_DIR
                             "/tests/io/read_as_molecules.py whole/trajectory.xyz parts/trajectory.h5");
  EXPECT_EQ(read.status, 0) << read.err;
}

}  // namespace
}  // namespace carom
