// Runs with [analysis]: analysis.h5 as another reader sees it, plots, no effect on the physics, and resuming.
#include "tests/support/program_support.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of;

const std::string analysis = R"([analysis]
what = ["pair_correlation", "displacement", "speeds", "density", "pressure", "collision_rate", "profile",
        "velocity_autocorrelation", "bond_correlation", "bond_order", "bond_autocorrelation"]
density = { every = 0.5 }
profile = { every = 0.7 }
)";
const std::vector<std::string> plots{"pair_correlation.svg",
                                     "displacement.svg",
                                     "speeds.svg",
                                     "density.svg",
                                     "pressure.svg",
                                     "collision_rate.svg",
                                     "profile.svg",
                                     "velocity_autocorrelation.svg",
                                     "bond_order.svg",
                                     "bond_correlation.svg",
                                     "bond_autocorrelation.svg"};

class AnalysisRun : public test::ProgramTest {
 protected:
  // Samples in the file, read by h5py.
  Outcome read(const std::string& folder, const std::string& series) const {
    return shell("/usr/bin/python3 " CAROM_SOURCE_DIR "/tests/io/read_analysis.py " + folder + "/analysis.h5 '" +
                 series + "'");
  }
};
using LongAnalysisRun = AnalysisRun;

TEST_F(LongAnalysisRun, FilesArePlainToOthersAndTheStateIsUntouched) {
  for (const std::string method : {"pairwise", "rollback", "exact"}) {
    write("plain.toml", test::busy_scene(method, "", "none"));
    write("analysed.toml", test::busy_scene(method, analysis, "none"));
    const std::string options = " --quiet --force --t-end 2";
    ASSERT_EQ(carom("run plain.toml -o plain" + options).status, 0);
    const Outcome o = carom("run analysed.toml -o analysed" + options);
    ASSERT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(summary("plain")["state_hash"], summary("analysed")["state_hash"]) << method;
    EXPECT_FALSE(fs::exists(at("plain/analysis.h5")));
    const Outcome python = read("analysed", "analysed/series.csv");
    EXPECT_EQ(python.out, "21\n") << python.err;
    for (const std::string& plot : plots) EXPECT_TRUE(fs::exists(at("analysed") / plot)) << plot;
    const Outcome other = carom("run analysed.toml -o other --engine reference" + options);
    ASSERT_EQ(other.status, 0) << other.err;
    EXPECT_TRUE(text_of(at("analysed/analysis.h5")) == text_of(at("other/analysis.h5"))) << method;
  }
}

TEST_F(LongAnalysisRun, ResumedItGivesTheSameFiles) {
  for (const std::string method : {"pairwise", "exact"}) {
    write("scene.toml", test::replaced(test::replaced(test::busy_scene(method, analysis, "none"), "right = \"sink\"",
                                                      "left = \"periodic\"\nright = \"periodic\""),
                                       "side = \"left\"", "side = \"top\""));
    shell("sed -i 's/\"bond_order\"/\"bond_order\", \"structure_factor\"/' scene.toml");
    const std::string run =
        "run scene.toml --quiet --force --t-end 6 --set analysis.start=1.05 --set analysis.every=0.15 ";
    ASSERT_EQ(carom(run + "-o whole").status, 0);
    const Resumed resumed = resume_to_the_end("parts", carom(run + "-o parts --max-walltime 1e-9"));
    EXPECT_EQ(resumed.last.status, 0) << resumed.last.err;
    EXPECT_GE(resumed.parts, 3);
    expect_same_results("whole", "parts");
    EXPECT_TRUE(text_of(at("whole/analysis.h5")) == text_of(at("parts/analysis.h5"))) << method;
    for (const std::string& plot : plots)
      EXPECT_TRUE(text_of(at("whole") / plot) == text_of(at("parts") / plot)) << plot;
    EXPECT_TRUE(fs::exists(at("parts/structure_factor.svg")));
    EXPECT_EQ(read("parts", "").out, "34\n") << "samples from 1.05 on, and at the end";
  }
}

// All quantities in a shear flow, with resuming.
TEST_F(LongAnalysisRun, InAShearFlowToo) {
  for (const std::string method : {"pairwise", "exact"}) {
    write("flow.toml",
          "[box]\nwidth = 24\nheight = 18\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
          "top = \"periodic\"\nshear_rate = 0.3\n[[disks]]\nname = \"small\"\ncount = 100\npositions = \"random\"\n"
          "radius = 0.3\nmass = 1\nvelocities = { maxwell = 1.0 }\n[[disks]]\nname = \"large\"\ncount = 40\n"
          "positions = \"random\"\nradius = 0.5\nmass = 2\nvelocities = { maxwell = 1.0 }\n[run]\nmethod = \"" +
              method + "\"\ndt = 0.005\nt_end = 4\n[output]\nevery = 0.2\nseries = true\n" + analysis +
              "pair_correlation = { groups = [\"small\", \"large\"] }\n");
    shell("sed -i 's/\"bond_order\"/\"bond_order\", \"structure_factor\"/' flow.toml");
    ASSERT_EQ(carom("run flow.toml --quiet --force -o whole").status, 0);
    EXPECT_EQ(read("whole", "").out, "21\n") << read("whole", "").err;
    const Outcome other = carom("run flow.toml --quiet --force -o other --engine reference");
    ASSERT_EQ(other.status, 0) << other.err;
    EXPECT_TRUE(text_of(at("whole/analysis.h5")) == text_of(at("other/analysis.h5"))) << method;
    const Resumed resumed =
        resume_to_the_end("parts", carom("run flow.toml --quiet --force -o parts --max-walltime 1e-9"));
    EXPECT_EQ(resumed.last.status, 0) << resumed.last.err;
    EXPECT_GE(resumed.parts, 3);
    expect_same_results("whole", "parts");
    EXPECT_TRUE(text_of(at("whole/analysis.h5")) == text_of(at("parts/analysis.h5"))) << method;
  }
}

// Disks that come after the first sample are not followed, so a number for each time would mean nothing.
TEST_F(AnalysisRun, AFirstSampleWithoutDisksIsWarnedOf) {
  write("source.toml",
        "[box]\nwidth = 10.0\nheight = 10.0\n[[sources]]\nside = \"left\"\nrate = 5.0\nradius = 0.1\nmass = 1.0\n"
        "velocities = { maxwell = 1.0 }\n[run]\nt_end = 2.0\n[analysis]\n"
        "what = [\"displacement\", \"density\", \"velocity_autocorrelation\"]\n");
  const std::string said =
      "analysis: displacement, velocity_autocorrelation are measured on the disks of the first sample, but at t = 0 "
      "there are none; use a later analysis.start\n";
  EXPECT_THAT(carom("run source.toml -o a").err, ::testing::HasSubstr(said));
  const auto begin = [&](const char* options) {
    return carom(std::string("run source.toml -o b --force ") + options).err;
  };
  EXPECT_THAT(begin("--set analysis.start=1.0"), ::testing::Not(::testing::HasSubstr("first sample")));
  EXPECT_THAT(begin("--set 'analysis.what=[\"density\"]'"), ::testing::Not(::testing::HasSubstr("first sample")));
}

TEST_F(AnalysisRun, AKilledRunLeavesAFileThatOpens) {
  write("long.toml", test::busy_scene("pairwise", analysis, "none"));
  const pid_t run = start({"run", "long.toml", "--t-end", "1e6", "--set", "analysis.every=0.1", "--set",
                           "analysis.density.every=1e3", "--set", "analysis.profile.every=1e3", "-o", "out"});
  while (!fs::exists(at("out/carom-unfinished/analysis.h5"))) {
    ASSERT_EQ(waitpid(run, nullptr, WNOHANG), 0) << "the run ended before it measured";
    usleep(1000);
  }
  kill(run, SIGKILL);
  EXPECT_EQ(wait_for(run), -SIGKILL);
  const Outcome o = shell(
      "/usr/bin/python3 -c 'import h5py; print(h5py.File(\"out/carom-unfinished/analysis.h5\")"
      "[\"samples/time\"][0])'");
  EXPECT_EQ(o.out, "0.0\n") << o.err;
}

TEST_F(LongAnalysisRun, AloneItHasAFolderAndAFullDiskIsAnError) {
  write("alone.toml", test::busy_scene("pairwise", "movie = false\n" + analysis, "none"));
  const std::string run = "run alone.toml --quiet --t-end 0.5 --set output.series=false ";
  ASSERT_EQ(carom(run).status, 0);
  EXPECT_TRUE(fs::exists(at("out/alone/analysis.h5")));
  EXPECT_FALSE(fs::exists(at("out/alone/series.csv")));
  const Outcome o = shell("ulimit -f 8; $C " + run + "-o full");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.err, ::testing::HasSubstr("cannot write full/carom-unfinished/analysis.h5.new: File too large"));
}

}  // namespace
}  // namespace carom
