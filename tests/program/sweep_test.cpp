// carom sweep: the grid, the table, continuation, scripts, errors.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "tests/support/scene_support.hpp"
#include "tests/support/small_gas.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::TestFolder;
using testing::HasSubstr;
using testing::Not;

class SweepTest : public testing::Test {
 protected:
  SweepTest() : folder_("sweep") { scene_ = folder_.write("gas.toml", test::small_gas); }

  std::pair<int, std::string> shell(const std::string& words) const {
    const std::string command = "cd " + folder_.path().string() + " && " + words + " 2>&1";
    std::FILE* const pipe = popen(command.c_str(), "r");
    std::string text;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
    const int status = pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
  }
  std::pair<int, std::string> carom(const std::string& words) const { return shell(CAROM_PROGRAM " " + words); }
  std::string read(const std::string& name) const { return test::text_of(folder_.path() / name); }
  std::vector<std::string> rows(const std::string& table) const {
    std::vector<std::string> lines;
    std::istringstream text(read(table));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
  // The number of commands in a script for GNU parallel.
  long commands_in(const std::string& script) const {
    const std::vector<std::string> lines = rows(script);
    return std::count_if(lines.begin(), lines.end(), [](const std::string& line) { return line.starts_with('\''); });
  }
  // A row without the seconds taken, which differ from run to run.
  static std::string without_time(const std::string& row) {
    const std::size_t hash = row.rfind(',');
    return row.substr(0, row.rfind(',', hash - 1)) + row.substr(hash);
  }

  TestFolder folder_;
  std::string scene_;
};

TEST_F(SweepTest, RunsTheGridAndGoesOnWhereItStopped) {
  const std::string words =
      "sweep gas.toml -o s --over physics.restitution=0.5:1.0:3 --over disks.0.count=10,20 --seeds 2";
  const auto [status, text] = carom(words + " --jobs 3");
  ASSERT_EQ(status, 0) << text;
  EXPECT_THAT(text, HasSubstr("12 of 12 runs are left, 3 at once"));
  EXPECT_FALSE(fs::exists(folder_.path() / "s/runs/0001.log")) << "only failed runs keep a log";
  const std::vector<std::string> table = rows("s/sweep.csv");
  ASSERT_EQ(table.size(), 13U);
  EXPECT_THAT(table[0], testing::StartsWith("run,physics.restitution,disks.0.count,seed,particles,steps,time"));
  EXPECT_THAT(table[1], testing::StartsWith("0001,0.5,10,3,10,"));
  EXPECT_THAT(table[6], testing::StartsWith("0006,0.75,10,4,10,"));
  EXPECT_THAT(table[12], testing::StartsWith("0012,1,20,4,20,"));
  // One of the runs, done by hand, has the same hash.
  EXPECT_EQ(carom("run gas.toml -o hand --quiet --seed 4 --set physics.restitution=0.75 --set disks.0.count=10").first,
            0);
  const std::string hash = table[6].substr(table[6].rfind(',') + 1);
  EXPECT_THAT(read("hand/summary.json"), HasSubstr(hash));

  fs::remove(folder_.path() / "s/runs/0005/summary.json");
  fs::remove(folder_.path() / "s/sweep.csv");
  folder_.write("s/runs/0002.log", "");  // as if the sweep had been killed and its run had outlived it
  const std::string kept = read("s/runs/0007/summary.json");
  EXPECT_THAT(carom(words).second, HasSubstr("1 of 12 runs are left"));
  EXPECT_EQ(read("s/runs/0007/summary.json"), kept) << "this run must not be repeated";
  EXPECT_FALSE(fs::exists(folder_.path() / "s/runs/0002.log"));
  const std::vector<std::string> again = rows("s/sweep.csv");
  ASSERT_EQ(again.size(), table.size());
  for (std::size_t k = 0; k < table.size(); ++k) EXPECT_EQ(without_time(again[k]), without_time(table[k]));

  const auto [other_status, other] = carom("sweep gas.toml -o s --seeds 3");
  EXPECT_EQ(other_status, 2);
  EXPECT_THAT(other, HasSubstr("holds another sweep"));
  EXPECT_EQ(rows("s/sweep.csv"), again) << "a refused sweep must change nothing";
  EXPECT_EQ(carom("sweep gas.toml -o s --seeds 3 --force --emit parallel").first, 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "s/sweep.csv")) << "the table of the replaced sweep must be gone";
  EXPECT_THAT(carom("sweep gas.toml -o s --seeds 3").second, HasSubstr("3 of 3 runs are left"));
  const std::vector<std::string> replaced = rows("s/sweep.csv");
  ASSERT_EQ(replaced.size(), 4U);
  EXPECT_THAT(replaced[1], testing::StartsWith("0001,3,20,"))
      << "twenty disks, not ten as in the earlier run of this name";
}

// A run whose energy changed much has no pressure; and a value in quotes keeps them in the table.
TEST_F(SweepTest, ItsTableIsOneForOtherPrograms) {
  const auto [status, text] = carom(
      "sweep gas.toml --over 'run.method=\"exact\",pairwise' --set run.dt=0.01 --set physics.restitution=0.5 "
      "--set run.t_end=20");
  ASSERT_EQ(status, 0) << text;
  const std::vector<std::string> table = rows("out/gas_sweep/sweep.csv");
  ASSERT_EQ(table.size(), 3U);
  EXPECT_THAT(table[1], testing::StartsWith("0001,\"\"\"exact\"\"\",3,20,"));
  std::istringstream names(table[0]), cells(table[1]);
  std::string name, cell;
  while (name != "pressure" && std::getline(names, name, ',')) std::getline(cells, cell, ',');
  EXPECT_EQ(name, "pressure");
  EXPECT_EQ(cell, "");
  EXPECT_THAT(read("out/gas_sweep/runs/0001/summary.json"), HasSubstr("\"pressure\": null"));
}

TEST_F(SweepTest, ASummaryThatIsNoneIsNamed) {
  ASSERT_EQ(carom("sweep gas.toml -o s --seeds 2").first, 0);
  for (const char* const other : {"", "{ \"particles\": 2", "[]"}) {
    folder_.write("s/runs/0002/summary.json", other);
    const auto [status, text] = carom("sweep gas.toml -o s --seeds 2");
    EXPECT_EQ(status, 2);
    EXPECT_THAT(text, HasSubstr("carom: error: s/runs/0002/summary.json: is not a JSON object; expected the summary of "
                                "a run; remove s/runs/0002 to run it again\n"));
  }
}

TEST_F(SweepTest, ListsAreValues) {
  const auto [status, text] = carom("sweep gas.toml -o s --over 'physics.gravity=[0.1,-0.5],0.25,[0,-1]'");
  ASSERT_EQ(status, 0) << text;
  const std::vector<std::string> table = rows("s/sweep.csv");
  ASSERT_EQ(table.size(), 4U);
  EXPECT_THAT(table[1], testing::StartsWith("0001,\"[0.1,-0.5]\",3,"));
  EXPECT_THAT(table[2], testing::StartsWith("0002,0.25,3,"));
  EXPECT_EQ(carom("run gas.toml -o hand --quiet --set 'physics.gravity=[0,-1]'").first, 0);
  EXPECT_THAT(read("hand/summary.json"), HasSubstr(table[3].substr(table[3].rfind(',') + 1)));
}

// With more seeds and values existing runs stay, under their names, and only new ones are run.
TEST_F(SweepTest, GrowsWithoutLosingWhatIsThere) {
  ASSERT_EQ(carom("sweep gas.toml -o s --over physics.restitution=0.5,1.0 --seeds 2").first, 0);
  const std::vector<std::string> before = rows("s/sweep.csv");
  const std::string kept = read("s/runs/0003/summary.json");
  const auto [status, text] = carom("sweep gas.toml -o s --over physics.restitution=0.5:1.0:3 --seeds 3");
  EXPECT_EQ(status, 0) << text;
  EXPECT_THAT(text, HasSubstr("5 of 9 runs are left"));
  EXPECT_EQ(read("s/runs/0003/summary.json"), kept);
  const std::vector<std::string> after = rows("s/sweep.csv");
  ASSERT_EQ(after.size(), 10U);
  for (const std::size_t k : {1U, 2U}) EXPECT_THAT(after, testing::Contains(before[k]));
  EXPECT_THAT(after[7], testing::StartsWith("0003,1,3,20,")) << "the value was 1.0 before, and is 1 now";
  EXPECT_THAT(after[3], testing::StartsWith("0005,0.5,5,20,"));
  EXPECT_THAT(after[9], testing::StartsWith("0009,1,5,20,"));
  EXPECT_THAT(carom("sweep gas.toml -o s --over physics.restitution=0.5:1.0:3 --seeds 3").second,
              HasSubstr("0 of 9 runs are left"));

  // With fewer values, or another scene, it is another sweep.
  const auto [less_status, less] = carom("sweep gas.toml -o s --over physics.restitution=0.5,1.0 --seeds 2");
  EXPECT_EQ(less_status, 2);
  EXPECT_THAT(less, HasSubstr("s: holds another sweep: this one lacks its run physics.restitution="));
  EXPECT_THAT(less,
              HasSubstr("give all its values and more, choose another folder with -o, or replace it with --force"));
  folder_.write("gas.toml", std::string(test::small_gas) + "# changed\n");
  EXPECT_THAT(carom("sweep gas.toml -o s --over physics.restitution=0.5:1.0:3 --seeds 3").second,
              HasSubstr("s: holds another sweep: the scene has changed since; "));
}

// A run may be stopped by a limit of processor time: the sweep once reported nothing, and ended as if all had run.
TEST_F(SweepTest, ARunThatIsStoppedByAnotherIsNamed) {
  const auto [status, text] = shell(
      "{ " CAROM_PROGRAM
      " sweep gas.toml -o s --seeds 1 --t-end 1e9 --set physics.restitution=1 --set "
      "output.checkpoint=1000 & P=$!; until [ -e s/runs/0001/carom-unfinished/checkpoint.carom ] || ! kill -0 $P; "
      "do sleep 0.01; done; kill -XCPU $(ps -o pid= --ppid $P); wait $P; }");
  EXPECT_EQ(status, 1) << text;
  EXPECT_THAT(text, HasSubstr("run 0001: was stopped from outside; the same command continues it"));
}

// A sweep that is killed stops its runs, which write checkpoints. Until then the folder stays locked.
TEST_F(SweepTest, ItsRunsEndWithIt) {
  const pid_t sweep = fork();
  if (sweep == 0) {
    if (chdir(folder_.path().c_str()) != 0) _exit(1);
    execl(CAROM_PROGRAM, "carom", "sweep", "gas.toml", "-o", "s", "--jobs", "2", "--over", "run.t_end=1e9,2e9", "--set",
          "physics.restitution=1", "--set", "output.checkpoint=1000", nullptr);
    _exit(1);
  }
  const auto checkpoint = [&](const char* run) { return folder_.path() / "s/runs" / run / "carom-unfinished"; };
  for (const char* const run : {"0001", "0002"}) {
    while (!fs::exists(checkpoint(run) / "checkpoint.carom")) usleep(1000);
  }
  const auto [status, text] = carom("sweep gas.toml -o s --seeds 2 --force");
  EXPECT_EQ(status, 2);
  EXPECT_THAT(text, HasSubstr("s: another sweep is running there; expected another folder (-o)"));
  // SIGUSR1 makes each run write a checkpoint and go on. The next checkpoint is another file, as the previous one is
  // kept.
  const auto file_of = [&](const char* run) {
    struct stat found {};
    return stat((checkpoint(run) / "checkpoint.carom").c_str(), &found) == 0 ? found.st_ino : 0;
  };
  for (int k = 0; k < 2; ++k) {
    const ino_t before1 = file_of("0001"), before2 = file_of("0002");
    kill(sweep, SIGUSR1);
    for (ino_t now1 = 0, now2 = 0; now1 == 0 || now2 == 0 || now1 == before1 || now2 == before2; usleep(1000)) {
      ASSERT_EQ(waitpid(sweep, nullptr, WNOHANG), 0);
      now1 = file_of("0001"), now2 = file_of("0002");
    }
  }
  kill(sweep, SIGKILL);
  waitpid(sweep, nullptr, 0);
  // The locks of the runs are released.
  for (const char* const run : {"0001", "0002"}) {
    const int lock = open((checkpoint(run) / "lock").c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_GE(lock, 0);
    struct flock other {};
    do {
      other.l_type = F_WRLCK;
      other.l_whence = SEEK_SET;
      ASSERT_EQ(fcntl(lock, F_GETLK, &other), 0);
      usleep(1000);
    } while (other.l_type != F_UNLCK);
    close(lock);
    EXPECT_EQ(carom(std::string("resume --quiet --max-walltime 1e-9 s/runs/") + run).first, 4);
  }
}

// As if started by a program that leaves the ends of its children to the system.
TEST_F(SweepTest, SeesItsRunsEndWhereverItWasStarted) {
  const pid_t sweep = fork();
  if (sweep == 0) {
    constexpr unsigned patience = 100;  // seconds; then SIGALRM ends it
    alarm(patience);
    std::signal(SIGCHLD, SIG_IGN);
    if (chdir(folder_.path().c_str()) == 0) {
      execl(CAROM_PROGRAM, CAROM_PROGRAM, "sweep", "gas.toml", "-o", "s", "--seeds", "2", nullptr);
    }
    _exit(127);
  }
  int status = 0;
  ASSERT_EQ(waitpid(sweep, &status, 0), sweep);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(rows("s/sweep.csv").size(), 3U);
}

TEST_F(SweepTest, ScriptsRunWhatIsLeft) {
  const std::string words = "sweep gas.toml -o 'a b' --over physics.restitution=0.8,0.9";
  EXPECT_EQ(carom(words + " --emit parallel").first, 0);
  EXPECT_EQ(commands_in("a b/sweep.sh"), 2);
  ASSERT_EQ(carom(words + " --emit slurm").first, 0);
  const std::string script = read("a b/sweep.sbatch");
  EXPECT_THAT(script, HasSubstr("#SBATCH --array=1-2\n"));
  const auto run_task = [&](int task) {
    const auto [status, text] = shell(fmt::format("SLURM_ARRAY_TASK_ID={} sh 'a b/sweep.sbatch'", task));
    EXPECT_EQ(status, 0) << text;
  };
  run_task(1);
  EXPECT_TRUE(fs::exists(folder_.path() / "a b/runs/0001/summary.json"));
  EXPECT_EQ(carom(words + " --emit parallel").first, 0);
  EXPECT_EQ(commands_in("a b/sweep.sh"), 1);
  ASSERT_EQ(carom(words + " --emit slurm").first, 0);
  EXPECT_THAT(read("a b/sweep.sbatch"), HasSubstr("#SBATCH --array=1-1\n"));
  run_task(1);
  EXPECT_THAT(carom(words + " --emit slurm").second, HasSubstr("0 of 2 runs are left"))
      << "there is no run for a script";
  EXPECT_EQ(rows("a b/sweep.csv").size(), 3U);
  EXPECT_THAT(carom(words).second, HasSubstr("0 of 2 runs are left"));
}

// A stand-in for GNU parallel gives each line to a shell.
TEST_F(SweepTest, AScriptForParallelRunsEachLine) {
  fs::create_directory(folder_.path() / "bin");
  folder_.write("bin/parallel", "#!/bin/sh\nwhile read -r line; do sh -c \"$line\" </dev/null || exit 1; done\n");
  fs::permissions(folder_.path() / "bin/parallel", fs::perms::owner_all);
  const std::string words = "sweep gas.toml -o \"it's\" --over 'physics.gravity=[0.1,-0.5],0.25'";
  EXPECT_EQ(carom(words + " --emit parallel").first, 0);
  EXPECT_THAT(read("it's/sweep.sh"), HasSubstr("--jobs 100% \"$@\""));
  const auto [status, text] = shell("PATH=$PWD/bin:$PATH sh \"it's/sweep.sh\"");
  EXPECT_EQ(status, 0) << text;
  EXPECT_THAT(read("it's/runs/0001/summary.json"), HasSubstr("\"threads\": 1")) << "there is another run on each core";
  EXPECT_THAT(carom(words).second, HasSubstr("0 of 2 runs are left"));
  EXPECT_EQ(carom(words + " --seeds 2 --emit parallel --ranks 2").first, 0);
  EXPECT_THAT(read("it's/sweep.sh"), HasSubstr("--jobs 50% \"$@\""));
  EXPECT_THAT(rows("it's/sweep.csv").at(1), testing::StartsWith("0001,\"[0.1,-0.5]\",3,20,"));
}

TEST_F(SweepTest, NothingRunsWhereAnythingIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"--over physics.restitutoin=0.5:1:3", "physics.restitutoin: unknown key; expected one of"},
      {"--over physics.restitution=0.5:1.5:3", "carom: error: --over physics.restitution: is 1.5"},
      {"--over run.t_end=1,2,1", "has the value 1 twice"},
      {"--over physics.restitution=0.5:1", "\"physics.restitution=0.5:1\" is not a range; expected KEY=FROM:TO:COUNT"},
      {"--over physics.restitution", "expected KEY=FROM:TO:COUNT"},
      {"--over physics.restitution=0:1:0", "is not a range"},
      {"--over run.method=exact,exakt", "unknown name \"exakt\""},
      {"--over seed=1,2", "expected --seeds N"},
      {"--over run.t_end=1 --over run.t_end=2", "run.t_end is given twice"},
      {"", "nothing to sweep over"},
      {"--seeds 3 --set seed=18446744073709551614", "--seeds: 3 seeds from 18446744073709551614 on exceed 2^64 - 1"},
      {"--seeds 18446744073709551616", "expected a whole number from 1 to 2147483647"},
      {"--seeds 2000000000", "2e+09 runs are too many; expected at most 1000000"},
      {"--seeds 2 --emit pbs", "expected one of slurm, parallel"}};
  for (const auto& [options, expected] : cases) {
    const auto [status, text] = carom("sweep gas.toml -o never " + options);
    EXPECT_EQ(status, 2) << options;
    EXPECT_THAT(text, HasSubstr(expected)) << options;
    EXPECT_FALSE(fs::exists(folder_.path() / "never")) << options;
  }
}

TEST_F(SweepTest, AFileIsNoFolder) {
  const auto [status, text] = carom("sweep gas.toml --seeds 2 -o gas.toml --force");
  EXPECT_EQ(status, 2);
  EXPECT_EQ(text, "carom: error: gas.toml: is a file; expected a folder for the sweep (-o)\n");
  EXPECT_EQ(read("gas.toml"), test::small_gas);
}

TEST_F(SweepTest, AFolderOfOtherFilesIsNotItsOwn) {
  fs::create_directory(folder_.path() / "notes");
  folder_.write("notes/thesis.tex", "years");
  for (const std::string force : {"", " --force"}) {
    const auto [status, text] = carom("sweep gas.toml --seeds 2 -o notes" + force);
    EXPECT_EQ(status, 2);
    EXPECT_EQ(text, "carom: error: notes: holds other files; expected a new folder for the sweep (-o)\n");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path() / "notes"), {}), 1);
  EXPECT_EQ(read("notes/thesis.tex"), "years");
}

TEST_F(SweepTest, AFullDiskCostsNoPlan) {
  // Not a single byte can be written.
  const std::string full = "ulimit -f 0; " CAROM_PROGRAM " sweep gas.toml -o grid --over ";
  const auto begun = shell(full + "physics.restitution=0.5,1");
  EXPECT_EQ(begun.first, 1);
  EXPECT_THAT(begun.second, HasSubstr("cannot write grid/sweep.txt.new: File too large"));
  ASSERT_EQ(carom("sweep gas.toml -o grid --over physics.restitution=0.5,1").first, 0) << "the folder must be usable";
  const std::string plan = read("grid/sweep.txt");
  EXPECT_EQ(shell(full + "physics.restitution=0.5,1,0.7").first, 1);
  EXPECT_EQ(read("grid/sweep.txt"), plan);
  EXPECT_THAT(carom("sweep gas.toml -o grid --over physics.restitution=0.5,1").second,
              HasSubstr("0 of 2 runs are left"));
}

TEST_F(SweepTest, AFailedRunIsNamedAndTriedAgain) {
  // There is no room for 250 of these disks.
  const auto [status, text] = carom("sweep gas.toml -o s --over disks.0.count=10,250");
  EXPECT_EQ(status, 1);
  EXPECT_THAT(text,
              HasSubstr("carom: warning: run 0002: " + scene_ + ":9: disks.0.positions: \"random\" finds no room"));
  EXPECT_EQ(rows("s/sweep.csv").size(), 2U);
  EXPECT_THAT(carom("sweep gas.toml -o s --over disks.0.count=10,250").second, HasSubstr("1 of 2 runs are left"));
}

// A run that wrote no message, as when the machine has no memory for it.
TEST_F(SweepTest, ARunThatIsKilledIsNamedByItsStatus) {
  const auto [status, text] =
      shell("{ " CAROM_PROGRAM
            " sweep gas.toml -o s --set physics.restitution=1 --over run.t_end=1,1e9 --jobs 1 & until [ -e "
            "s/runs/0002/carom-unfinished/scene.toml ]; do sleep 0.01; done; kill -KILL $(cat "
            "/proc/$!/task/$!/children); wait $!; }");
  EXPECT_EQ(status, 1);
  EXPECT_THAT(text, HasSubstr("carom: warning: run 0002: ended with status 137\n"));
}

// A sweep that is stopped stops its runs and starts no other; the run that was going on is later resumed from where it
// was. After SIGUSR1 that run writes a checkpoint, and the sweep goes on.
TEST_F(SweepTest, StoppedItTakesItsRunsWithItAndGoesOnFromTheirCheckpoints) {
  const std::string words = "sweep gas.toml -o s --set physics.restitution=1 --over run.t_end=1,1e9,2e9 --jobs 1";
  const auto [status, text] =
      shell("{ " CAROM_PROGRAM " " + words +
            " & until [ -e s/runs/0002/carom-unfinished/scene.toml ]; do "
            "sleep 0.01; done; kill -USR1 $!; until [ -e s/runs/0002/carom-unfinished/checkpoint.carom ]; do sleep "
            "0.01; done; kill -TERM $!; wait $!; }");
  EXPECT_EQ(status, 4) << text;
  EXPECT_THAT(text, HasSubstr("stopped by SIGTERM with 1 of 3 runs done; the same command continues the sweep"));
  EXPECT_EQ(rows("s/sweep.csv").size(), 2U);
  EXPECT_EQ(carom(words + " --emit parallel").first, 0);
  EXPECT_THAT(read("s/sweep.sh"), HasSubstr("'resume'"));
  EXPECT_FALSE(fs::exists(folder_.path() / "s/runs/0003"));
  // No process may be writing to the folder any more; otherwise resuming would be refused with status 2.
  EXPECT_EQ(carom("resume s/runs/0002 --quiet --max-walltime 0.01").first, 4);
}

// Warnings of runs are counted in the table.
TEST_F(SweepTest, WarningsAreCounted) {
  const auto [status, text] =
      carom("sweep gas.toml -o s --method pairwise --dt 0.05 --over disks.0.velocities.maxwell=1,1e4,2e4");
  EXPECT_EQ(status, 0) << text;
  EXPECT_THAT(text, HasSubstr("2 of 3 runs have warnings about their method; see the column warnings"));
  const std::vector<std::string> table = rows("s/sweep.csv");
  EXPECT_THAT(table.at(0), HasSubstr(",warnings,step_s,state_hash"));
  EXPECT_THAT(table.at(1), HasSubstr(",0,0,"));
  EXPECT_THAT(table.at(2), HasSubstr(",0,1,"));
}

}  // namespace
}  // namespace carom
