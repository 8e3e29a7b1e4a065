// carom run and resume with --ranks write the files of one process for any number of ranks, also if a run is stopped
// and resumed.
#include "tests/ranks/ranks_run.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::exact_tall;
using test::Outcome;
using test::RanksRun;
using test::text_of;

TEST_F(RanksRun, LeavesTheFilesOfOneProcess) {
  ASSERT_EQ(carom("run scene.toml --quiet -o one").status, 0);
  for (const std::string ranks : {"1", "2", "3"}) {
    const Outcome o = carom("run scene.toml --threads 2 --ranks " + ranks + " -o r" + ranks);
    ASSERT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(o.out.find("2 threads on each of " + ranks + " ranks") != std::string::npos, ranks != "1") << o.out;
    for (const char* file : {"trajectory.xyz", "series.csv"}) {
      EXPECT_TRUE(text_of(at("one") / file) == text_of(at("r" + ranks) / file)) << ranks << file;
    }
    EXPECT_EQ(summary("one"), summary("r" + ranks));
    const auto all = nlohmann::json::parse(text_of(at("r" + ranks) / "summary.json"));
    ASSERT_EQ(all.contains("traffic"), ranks != "1");
    if (ranks == "1") continue;
    const auto& traffic = all["traffic"];
    EXPECT_EQ(std::to_string(traffic["disks"].size()), ranks);
    EXPECT_GT(traffic["exchange"]["bytes"], 0.0);
    EXPECT_GT(all["phase_s"]["communication"], 0.0);
    EXPECT_NE(o.out.find("messages with"), std::string::npos) << o.out;
  }
}

// mpiexec is not in PATH, for example because a cluster's module of Open MPI is not loaded; this build does have the
// program for several ranks.
TEST_F(RanksRun, SayWhereMpiexecIsMissing) {
  const Outcome o = shell("PATH=/nonexistent $C run scene.toml --ranks 2 -o out");
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(o.err,
            "carom: error: --ranks: there is no mpiexec in PATH; expected mpiexec of Open MPI, Debian's package "
            "openmpi-bin\n");
}

// Trajectories in the other format, of a selection of disks and of those in a part of the box, with columns of a named
// group, and with measurements of disks and of pairs.
TEST_F(RanksRun, LeavesTheTrajectoryOfOneProcess) {
  const std::string run =
      "run scene.toml --quiet --threads 1 --set output.trajectory=h5md --set disks.0.name=gas --set "
      "physics.gravity=1.0 "
      "--set 'box.right=\"sink\"' --set 'box.left=\"wall\"' --set 'box.bottom=\"periodic\"' --set "
      "'box.top=\"periodic\"' --set "
      "'analysis.what=[\"bond_order\",\"bond_correlation\",\"bond_autocorrelation\",\"pair_correlation\","
      "\"displacement\",\"speeds\","
      "\"density\",\"pressure\",\"profile\","
      "\"velocity_autocorrelation\",\"structure_factor\"]' ";
  for (const std::string select : {"", "--set 'output.select=\"every 3rd\"' ", "--set output.select=[2,2,15,30] "}) {
    fs::remove_all(at("one"));
    ASSERT_EQ(carom(run + select + "-o one").status, 0);
    for (const std::string ranks : {"2", "3"}) {
      fs::remove_all(at("several"));
      const Outcome o = carom(run + select + "-o several --ranks " + ranks);
      ASSERT_EQ(o.status, 0) << o.err;
      for (const char* file : {"trajectory.h5", "series.csv", "analysis.h5"}) {
        EXPECT_TRUE(text_of(at("one") / file) == text_of(at("several") / file)) << ranks << select << file;
      }
    }
  }
}

TEST_F(RanksRun, LeavesTheFilesOfOneProcessWithExact) {
  const std::string run = "run scene.toml --quiet --t-end 4" + exact_tall + "-o ";
  ASSERT_EQ(carom(run + "one").status, 0);
  for (const std::string ranks : {"2", "3"}) {
    const Outcome o = carom(run + "r" + ranks + " --threads 2 --ranks " + ranks);
    ASSERT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(o.err, "");
    for (const char* file : {"trajectory.xyz", "series.csv"}) {
      EXPECT_TRUE(text_of(at("one") / file) == text_of(at("r" + ranks) / file)) << ranks << file;
    }
    EXPECT_EQ(summary("one"), summary("r" + ranks));
    const auto all = nlohmann::json::parse(text_of(at("r" + ranks) / "summary.json"));
    for (const auto& disks : all["traffic"]["disks"]) EXPECT_LT(disks, 1000) << ranks;
  }
  ASSERT_EQ(carom(run + "parts --ranks 2 --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume parts --quiet --ranks 3 --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume parts --quiet --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume parts --quiet --ranks 2").status, 0);
  EXPECT_TRUE(text_of(at("one/trajectory.xyz")) == text_of(at("parts/trajectory.xyz")));
  EXPECT_EQ(summary("one"), summary("parts"));
}

// No rank is bound to one core, which its threads and ffmpeg would have to share. nproc is run in place of each rank.
TEST_F(RanksRun, EachMayUseAllCores) {
  write("mpiexec", "#!/bin/sh\nexec \"$MPIEXEC\" -q -n 2 --allow-run-as-root nproc\n");
  std::filesystem::permissions(at("mpiexec"), std::filesystem::perms::owner_all);
  const std::string cores = shell("nproc").out;
  EXPECT_EQ(shell("MPIEXEC=$(command -v mpiexec) PATH=.:$PATH $C run scene.toml -o out --ranks 2").out, cores + cores);
}

// A pile that lands, with pictures of it. The loads of its contacts continue from the checkpoint, too.
TEST_F(RanksRun, LeavesTheFilesOfOneProcessWithAPile) {
  const std::string run =
      "run scene.toml --quiet --threads 1 --set physics.gravity=40 --set physics.restitution=0.5 --set box.width=12 "
      "--set box.height=10 --set disks.0.count=60 --set 'output.checkpoint=\"1000 s\"' "
      "--set 'output.plots=[\"velocity\",\"energy\"]' --set 'output.movie={size=[320,320]}' -o ";
  ASSERT_EQ(carom(run + "one --t-end 0.5").status, 0);
  const Outcome o = carom(run + "r2 --ranks 2 --t-end 0.5");
  ASSERT_EQ(o.status, 0) << o.err;
  for (const char* file : {"trajectory.xyz", "series.csv", "velocity.svg", "energy.svg"}) {
    EXPECT_TRUE(text_of(at("one") / file) == text_of(at("r2") / file)) << file;
  }
  // The bytes of a movie depend on the number of threads of ffmpeg, so pixels are compared.
  const auto pixels = [&](const std::string& folder) {
    return shell("ffmpeg -loglevel error -i " + folder + "/movie.mp4 -f md5 -").out;
  };
  EXPECT_NE(pixels("one"), "");
  EXPECT_EQ(pixels("one"), pixels("r2"));
  EXPECT_EQ(summary("one"), summary("r2"));
  EXPECT_EQ(o.err.find("one rank runs"), std::string::npos) << o.err;
  ASSERT_EQ(carom("resume r2 --quiet --t-end 0.55 --ranks 3").status, 0);
  ASSERT_EQ(carom("resume r2 --quiet --t-end 0.6").status, 0);
  ASSERT_EQ(carom("resume one --quiet --t-end 0.6").status, 0);
  EXPECT_EQ(summary("one")["state_hash"], summary("r2")["state_hash"]);
}

// No rank has all disks of the lattice; errors in a lattice are reported as by one process.
TEST_F(RanksRun, ALatticeIsMadeByAllRanks) {
  const std::string lattice =
      " --quiet --set disks.0.positions=hexagonal --set disks.0.count=300 --set output.trajectory=none "
      "--set output.series=false --set 'output.checkpoint=\"1000 s\"'";
  ASSERT_EQ(carom("run scene.toml -o one" + lattice).status, 0);
  for (const std::string ranks : {"2", "3"}) {
    const Outcome o = carom("run scene.toml -o r" + ranks + " --ranks " + ranks + lattice);
    ASSERT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(summary("one"), summary("r" + ranks));
  }
  const std::string random = lattice + " --set disks.0.positions=random --set disks.0.radius=0.5";
  ASSERT_EQ(carom("run scene.toml -o one-random" + random).status, 0);
  ASSERT_EQ(carom("run scene.toml -o r-random --ranks 3" + random).status, 0);
  EXPECT_EQ(summary("one-random"), summary("r-random"));
  ASSERT_EQ(carom("resume r2 --quiet --t-end 0.5 --ranks 3").status, 0);
  ASSERT_EQ(carom("resume one --quiet --t-end 0.5").status, 0);
  EXPECT_EQ(summary("one")["state_hash"], summary("r2")["state_hash"]);
  const std::string full = "run scene.toml" + lattice + " --set disks.0.count=3000 -o full";
  const Outcome alone = carom(full);
  const Outcome several = carom(full + " --ranks 2");
  EXPECT_EQ(several.status, 2);
  EXPECT_EQ(several.err, alone.err);
}

TEST_F(RanksRun, AStoppedRunGoesOnWithAnyNumberOfRanks) {
  ASSERT_EQ(carom("run scene.toml --quiet -o one").status, 0);
  ASSERT_EQ(carom("run scene.toml --quiet -o parts --ranks 2 --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume parts --quiet --ranks 3 --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume parts --quiet --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume parts --quiet --ranks 2").status, 0);
  EXPECT_TRUE(text_of(at("one/trajectory.xyz")) == text_of(at("parts/trajectory.xyz")));
  EXPECT_EQ(summary("one"), summary("parts"));
}

TEST_F(RanksRun, ASignalStopsItWithACheckpoint) {
  for (const auto& [signal, name] : {std::pair{SIGTERM, "SIGTERM"}, {SIGINT, "SIGINT"}, {SIGHUP, "SIGHUP"}}) {
    const std::string folder = fmt::format("out{}", signal);
    const pid_t run = start_long(folder, "2");
    kill(run, signal);
    EXPECT_EQ(wait_for(run), 4);
    EXPECT_NE(said().find(fmt::format("stopped by {} at", name)), std::string::npos) << said();
    EXPECT_NE(said().find("carom resume " + folder), std::string::npos);
    EXPECT_EQ(carom("resume " + folder + " --quiet --ranks 3 --max-walltime 1e-9").status, 4);
  }
}

TEST_F(RanksRun, WhatRanksCannotDoIsSaidInOneLine) {
  const Outcome rollback = carom("run scene.toml --ranks 2 --quiet --method rollback -o out");
  EXPECT_EQ(rollback.status, 2);
  EXPECT_EQ(rollback.err,
            "carom: error: method rollback cannot run on several ranks, as its frames need the whole box: use one "
            "rank, or --method exact\n");
  const Outcome reference = carom("run scene.toml --ranks 2 --quiet --engine reference -o out");
  EXPECT_EQ(reference.status, 2);
  EXPECT_NE(reference.err.find("--ranks: the reference engine runs on one rank"), std::string::npos) << reference.err;
  EXPECT_FALSE(fs::exists(at("out")));
  const std::string flat = "run scene.toml --set box.height=5 --set disks.0.count=20 ";
  const Outcome many = carom(flat + "--ranks 3 -o out");
  EXPECT_EQ(many.status, 0);
  EXPECT_NE(many.err.find("one rank runs all disks: 3 slabs of a box of height 5 would be thinner"), std::string::npos)
      << many.err;
  ASSERT_EQ(carom(flat + "--quiet -o one").status, 0);
  EXPECT_EQ(summary("one")["state_hash"], summary("out")["state_hash"]);
}

// If mpirun has started three ranks, --ranks must not ask for two or for one.
TEST_F(RanksRun, AsManyRanksAsMpirunHasStartedOrNone) {
  const std::string mpirun =
      "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1 OMPI_ALLOW_RUN_AS_ROOT=1 "
      "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none mpirun -q -n ";
  for (const std::string wrong : {"2", "1"}) {
    const Outcome run = shell(mpirun + "3 $C-mpi run scene.toml --quiet -o out --ranks " + wrong);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(
        run.err,
        "carom: error: --ranks: " + wrong +
            " ranks are requested, but mpirun has started 3; expected the number given to mpirun -n, or no --ranks\n");
    EXPECT_FALSE(fs::exists(at("out")));
  }
  ASSERT_EQ(shell(mpirun + "2 $C-mpi run scene.toml --quiet --max-walltime 1e-9 -o out --ranks 2").status, 4);
  EXPECT_EQ(shell(mpirun + "3 $C-mpi resume out --quiet --ranks 2").status, 2);
  EXPECT_EQ(shell(mpirun + "3 $C-mpi resume out --quiet").status, 0);
}

// The memory and messages that carom check predicts for ranks are compared with those of the run.
TEST_F(RanksRun, CheckForeseesMemoryAndMessages) {
  const std::string size = " --set disks.0.count=60000 --set box.width=400 --set box.height=600 --t-end 0.5 ";
  for (const std::string ranks : {"2", "4"}) {
    const Outcome check = carom("check scene.toml --json --ranks " + ranks + size);
    ASSERT_EQ(check.status, 0) << check.err;
    const auto foreseen = nlohmann::json::parse(check.out)["ranks"];
    const Outcome run = carom("run scene.toml --json --ranks " + ranks + size + "-o r" + ranks);
    ASSERT_EQ(run.status, 0) << run.err;
    const auto all = nlohmann::json::parse(run.out)["traffic"];
    const auto sum = [&](const char* what) -> double {
      return all["exchange"][what].get<double>() + all["all_reduce"][what].get<double>() +
             all["gather"][what].get<double>();
    };
    const auto expect_near = [](double expected, double is, double factor) {
      EXPECT_LT(is, factor * expected);
      EXPECT_GT(is, expected / factor);
    };
    expect_near(foreseen["messages"], sum("messages"), 1.2);
    expect_near(foreseen["bytes"], sum("bytes"), 1.5);
    expect_near(foreseen["disks"], all["disks"][1], 1.1);
    expect_near(foreseen["memory_bytes"], all["peak_bytes"][1], 1.5);
    expect_near(foreseen["first_memory_bytes"], all["peak_bytes"][0], 1.5);
  }
}

// Rank 0 of four ranks, which share 10^6 disks, needs less than `more` bytes more than any other rank.
void expect_even_peaks(const Outcome& run, double more) {
  ASSERT_EQ(run.status, 0) << run.err;
  const auto peaks = nlohmann::json::parse(run.out)["traffic"]["peak_bytes"];
  for (std::size_t rank = 1; rank < 4; ++rank) EXPECT_LT(peaks[0], peaks[rank].get<double>() + more);
}

const std::string million_on_four =
    "run scene.toml --quiet --json --ranks 4 --threads 1 --set box.width=2000 --set box.height=1000 "
    "--set disks.0.count=1000000 --set disks.0.positions=square --set disks.0.radius=0.4 --t-end 0.06 -o out ";

// Checkpoints during a run and at its end are written while each disk stays on its rank, so rank 0 needs no more memory
// than another rank. All disks of this run take 36 MB.
TEST_F(RanksRun, NoRankHasAllDisksForACheckpoint) {
  expect_even_peaks(carom(million_on_four + "--set output.trajectory=none --set output.series=false "
                                            "--set 'output.checkpoint=\"0.02 s\"'"),
                    18e6);
  EXPECT_GT(fs::file_size(at("out/checkpoint.carom")), 36'000'000U);
}

// At packing fraction 0.5 most trials fail, and the ranks have to find out where there is room.
TEST_F(RanksRun, NoRankHasAllDisksWhileTheyArePlaced) {
  const std::string run =
      "run scene.toml --quiet --json --ranks 4 --threads 1 --set box.width=1000 --set box.height=1000 "
      "--set disks.0.count=1000000 --t-end 0.02 --set output.trajectory=none --set output.series=false ";
  expect_even_peaks(carom(run + "--set disks.0.radius=0.4 -o equal"), 12e6);
  expect_even_peaks(carom(run + "--set 'disks.0.radius={uniform=[0.2,0.5]}' -o mixed"), 12e6);
}

// The same for frames: of all disks rank 0 only has the counts of their rounds, 8 MB, and some megabytes of pieces;
// HDF5 and a movie's picture need memory, too. If it had all disks it would take 110 MB more than another rank.
TEST_F(RanksRun, NoRankHasAllDisksForAFrame) {
  expect_even_peaks(
      carom(million_on_four +
            "--set output.every=0.06 --set output.trajectory=h5md --set disks.0.name=gas --set output.movie=true "
            "--set 'output.plots=[\"velocity\",\"energy\"]' "
            "--set "
            "'analysis.what=[\"pair_correlation\",\"speeds\",\"density\",\"pressure\",\"profile\",\"structure_factor\"]"
            "'"),
      45e6);
}

// Each run of a sweep has several ranks, started by the sweep itself or by the script that it writes for Slurm.
TEST_F(RanksRun, ASweepOfThemLeavesTheTableOfOneProcess) {
  const std::string sweep = "sweep scene.toml --over run.t_end=0.1,0.2 ";
  ASSERT_EQ(carom(sweep + "-o one").status, 0);
  ASSERT_EQ(carom(sweep + "--ranks 2 -o two").status, 0);
  ASSERT_EQ(carom(sweep + "--ranks 2 --emit slurm -o script").status, 0);
  const std::string script = text_of(at("script/sweep.sbatch"));
  EXPECT_NE(script.find("#SBATCH --array=1-2\n#SBATCH --ntasks=2\n"), std::string::npos) << script;
  EXPECT_NE(script.find("exec mpirun -n 2 --bind-to none '"), std::string::npos) << script;
  for (const char* const task : {"1", "2"}) {
    const Outcome o = shell(fmt::format(
        "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1 OMPI_ALLOW_RUN_AS_ROOT=1 "
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none SLURM_ARRAY_TASK_ID={} sh "
        "script/sweep.sbatch </dev/null",
        task));
    EXPECT_EQ(o.status, 0) << o.err;
  }
  ASSERT_EQ(carom(sweep + "--ranks 2 -o script").status, 0);
  for (const char* const run : {"0001", "0002"}) {
    for (const char* const folder : {"two", "script"}) {
      EXPECT_EQ(summary(fmt::format("one/runs/{}", run)), summary(fmt::format("{}/runs/{}", folder, run))) << folder;
      const auto all = nlohmann::json::parse(text_of(at(folder) / "runs" / run / "summary.json"));
      EXPECT_EQ(all["ranks"], 2);
    }
  }
}

TEST_F(RanksRun, WithoutMpiItSaysWhichPackagesAreMissing) {
  const Outcome o = shell("cp $C alone && ./alone run scene.toml --ranks 2");
  EXPECT_EQ(o.status, 2);
  EXPECT_NE(o.err.find("openmpi-bin"), std::string::npos) << o.err;
}

}  // namespace
}  // namespace carom
