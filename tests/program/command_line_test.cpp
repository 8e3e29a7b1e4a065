// The real program as called by a user or another program: exit statuses, errors of one line, and the output of each
// command.
#include <algorithm>
#include <csignal>
#include <thread>

#include "core/base/wall_clock.hpp"
#include "tests/support/command_support.hpp"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;
using test::Outcome;
using test::text_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;

using CommandLine = test::CommandTest;
using LongCommandLine = CommandLine;

using Usages = std::vector<std::pair<std::string, std::string>>;

TEST_F(CommandLine, BadUsageIsOneLineWithStatusTwo) {
  const Usages cases{
      {"", "no command given; expected one of run, check, resume, compare, render, view, sweep, chart, docs"},
      {"rnu small.toml",
       "there is no command \"rnu\"; expected one of run, check, resume, compare, render, view, sweep, chart, docs "
       "(nearest: "
       "run)"},
      {"run", "run: no scene file given"},
      {"run --methd pairwise small.toml", "run: there is no option \"--methd\""},
      {"run small.toml --dt abc", "--dt: \"abc\" is not a number"},
      {"run small.toml --threads two", "--threads: is \"two\""},
      {"run small.toml --set run.dtt=1", "--set run.dtt: unknown key"},
      {"run small.toml --set =1", "--set: is \"=1\"; expected KEY=VALUE"},
      {"run missing.toml", "missing.toml: "},
      {"resume", "resume: no checkpoint given"},
      {"check", "check: no scene file given"},
      {"compare small.toml", "compare: two outputs are needed"},
      {"render", "render: no folder given"},
      {"view", "view: no folder given; expected carom view DIR"},
  };
  for (const auto& [arguments, what] : cases) expect_error("$C " + arguments, 2, what);
  EXPECT_THAT(files_in(""), ElementsAre("small.toml")) << "no file may be left behind";
}

// Each process would do the whole run in a folder of its own.
TEST_F(CommandLine, SeveralProcessesOfAProgramThatRunsAloneAreWarnedOf) {
  const std::string run = "$C run small.toml --threads 1 --set run.t_end=0.1 ";
  const std::string warning =
      " = 4: each of these processes does the whole run by itself; expected carom-mpi instead of carom";
  EXPECT_THAT(shell("OMPI_COMM_WORLD_SIZE=4 OMPI_COMM_WORLD_RANK=0 " + run + "-o a").err,
              HasSubstr("warning: OMPI_COMM_WORLD_SIZE" + warning));
  EXPECT_THAT(shell("PMI_SIZE=4 " + run + "-o b").err, HasSubstr("warning: PMI_SIZE" + warning));
  EXPECT_THAT(shell("PMI_SIZE=4 PMI_RANK=1 " + run + "-o c").err, Not(HasSubstr(warning)));
  EXPECT_THAT(shell("PMI_SIZE=1 " + run + "-o d").err, Not(HasSubstr("does the whole run by itself")));
  EXPECT_THAT(shell("PMI_SIZE=4 $C resume a --t-end 0.2 --threads 1").err, HasSubstr("PMI_SIZE" + warning));
}

TEST_F(LongCommandLine, OtherBadUsageOfRunIsOneLineWithStatusTwo) {
  const Usages cases{
      {"run --methd pairwise small.toml", "(nearest: --method)"},
      {"run -- small.toml --quiet", "run: one argument too many, \"--quiet\""},
      {"run small.toml -- other.toml", "one argument too many, \"other.toml\""},
      {"run --", "run: no scene file given"},
      {"run small.toml other.toml", "one argument too many, \"other.toml\""},
      {"run small.toml --dt", "--dt: its value is missing"},
      {"run small.toml --strict=0", "--strict: takes no value; expected the option alone"},
      {"check small.toml --json=none", "--json: takes no value; expected the option alone"},
      {"run small.toml --dt 0.1x", "--dt: \"0.1x\" is not a number"},
      {"run small.toml --dt nan", "--dt: \"nan\" is not a number"},
      {"run small.toml --dt 1e-400", "--dt: is 1e-400, beyond the range of a double; expected a number such as 0.01"},
      {"run small.toml --dt -1", "--dt: is -1; expected a number above 0"},
      {"run small.toml --t-end -1", "--t-end: is -1"},
      {"run small.toml --seed -3", "--seed: is \"-3\""},
      {"run small.toml --seed 18446744073709551616", "--seed: is \"18446744073709551616\""},
      {"run small.toml --method pairwize", "--method: there is no method \"pairwize\""},
      {"run small.toml --method pairwize", "(nearest: pairwise)"},
      {"run small.toml --engine fast", "--engine: there is no engine \"fast\""},
      {"run small.toml --threads 0", "--threads: is \"0\"; expected a whole number of 1 or more"},
      {"run small.toml --threads 4097", "--threads: is \"4097\"; expected a whole number from 1 to 4096"},
      {"run small.toml --ranks 0", "--ranks: is \"0\"; expected a whole number of 1 or more"},
      {"run small.toml --set dt", "--set: is \"dt\"; expected KEY=VALUE"},
      {"run small.toml --set run.dt=-1", "--set run.dt: is -1"},
      {"run small.toml -o --json", "-o: \"--json\" is an option"},
      {"run small.toml -o small.toml", "small.toml: is a file; expected a folder"},
      {"run small.toml -o small.toml/out", "cannot be made: Not a directory"},
      {"run small.toml -o /dev/full", "/dev/full: is a file"},
      {"run small.toml --max-walltime soon",
       "--max-walltime: is \"soon\"; expected a time such as 30 s, 10 min or 2 h"},
      {"run small.toml --set output.checkpoint=0", "--set output.checkpoint: is 0; expected a number above 0"},
      {"run small.toml --set output.checkpoint='\"2 days\"'",
       "--set output.checkpoint: is \"2 days\"; expected a time"},
      {"run .", ".: is a directory; expected a scene file"},
      {"run small.toml --dt \"$UNSET\"", "--dt: is followed by an empty argument; expected a value; is a variable"},
  };
  for (const auto& [arguments, what] : cases) expect_error("$C " + arguments, 2, what);
  EXPECT_THAT(files_in(""), ElementsAre("small.toml")) << "no file may be left behind";
}

TEST_F(LongCommandLine, BadUsageOfOtherCommandsIsOneLineWithStatusTwo) {
  const Usages cases{
      {"--jsn", "no option \"--jsn\" before the command"},
      {"resume missing", "missing: does not exist; expected a checkpoint"},
      {"resume .", ".: holds no checkpoint"},
      {"resume small.toml", "small.toml: is not a checkpoint of Carom"},
      {"resume small.toml --dt 1", "resume: there is no option \"--dt\""},
      {"check small.toml --json --dt x", "--dt: \"x\" is not a number"},
      {"compare missing small.toml", "missing: does not exist"},
      {"compare a b --tolerance x", "--tolerance: \"x\" is not a number"},
      {"compare a b --tolerance -1", "--tolerance: is -1; expected a number of 0 or more"},
      {"compare a b --fields x,speed", "--fields: there is no field \"speed\"; expected one of x, y, vx, vy"},
      {"compare a b --times 3", "--times: is \"3\"; expected FROM:TO"},
      {"compare a b --times 3:2", "--times: is \"3:2\"; expected the earlier time first"},
      {"compare a b --times 0:1 --at 2", "--at: cannot be used with --times"},
      {"render .", ".: holds no trajectory.xyz"},
      {"render small.toml", "small.toml:1: "},
      {"render small.toml",
       "is not a number of disks; expected trajectory.xyz or trajectory.h5 of a run, or its folder"},
      {"view .", ".: holds no trajectory.xyz"},
      {"view missing", "missing: does not exist"},
      {"view small.toml", "small.toml:1: "},
      {"view small.toml -o page.txt", "-o: \"page.txt\" ends in \".txt\"; expected .html"},
      {"view small.toml --max-size 64XB", "--max-size: is \"64XB\"; expected a size, as in 64MB"},
      {"view small.toml --max-size 0", "--max-size: is \"0\""},
      {"view small.toml --max-size -3MB", "--max-size: is \"-3MB\""},
      {"view small.toml --maxsize 1MB", "view: there is no option \"--maxsize\""},
      {"chart small.toml", "one argument too many, \"small.toml\"; expected carom chart --scene small.toml"},
      {"render small.toml --frame 0", "--frame: is \"0\""},
  };
  for (const auto& [arguments, what] : cases) expect_error("$C " + arguments, 2, what);
  EXPECT_THAT(files_in(""), ElementsAre("small.toml")) << "no file may be left behind";
}

TEST_F(CommandLine, WhatFollowsTwoDashesIsNoOption) {
  write("-gas.toml", text_of(at("small.toml")));
  EXPECT_EQ(carom("check small.toml --").status, 0);
  const Outcome o = carom("check --json -- -gas.toml");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("\"scene\": \"-gas.toml\""));
  expect_error("$C check small.toml -- -more", 2, "one argument too many, \"-more\"");
}

// If the reader of its output ends first (head -1), the program ends by the signal, without a message, like cat and
// git, once all files are complete. If the caller ignores the signal it is an error, as with these.
TEST_F(CommandLine, AReaderThatGoesAwayEndsTheProgramBySIGPIPE) {
  std::signal(SIGPIPE, SIG_DFL);  // the shell that runs this test may ignore it, which child processes inherit
  const auto say_to_no_reader = [&](const std::string& before, const std::string& arguments) {
    shell(
        fmt::format("rm -f gone; {{ {} until [ -e gone ]; do sleep 0.01; done; $C {} 2>said; echo $? >status; }} | "
                    "{{ exec <&-; : >gone; }}; true",
                    before, arguments));
    return text_of(at("status")) + text_of(at("said"));
  };
  for (const std::string arguments :
       {"docs scene", "--help", "--version", "run --help", "check small.toml", "run small.toml -o out",
        "compare out out", "render out", "view out", "sweep small.toml --seeds 2 -o swept"}) {
    EXPECT_THAT(say_to_no_reader("", arguments),
                AllOf(StartsWith(fmt::format("{}\n", 128 + SIGPIPE)), Not(HasSubstr("error"))));
  }
  EXPECT_THAT(files_in("out"), IsSupersetOf({"scene.toml", "summary.json", "trajectory.xyz", "view.html"}));
  EXPECT_EQ(say_to_no_reader("trap '' PIPE;", "docs scene"),
            "1\ncarom: error: cannot write to standard output: Broken pipe\n");
}

TEST_F(CommandLine, KernelsThatThereAreNotAreRefusedByEveryCommand) {
  expect_error("CAROM_KERNELS=wide $C docs scene", 2, "CAROM_KERNELS: there are no kernels \"wide\"");
}

// The address sanitizer needs more address space than the limit allows.
TEST_F(CommandLine, AFileThatFindsNoMemoryIsAnError) {
#ifdef CAROM_ADDRESS_SANITIZER
  GTEST_SKIP() << "the address sanitizer needs terabytes of address space";
#endif
  expect_error("truncate -s 1G large.toml; ulimit -v 400000; $C check large.toml", 1, "error: out of memory");
}

TEST_F(LongCommandLine, TheWallTimeIsInSeconds) {
  const auto start = WallClock::now();
  EXPECT_EQ(carom("run small.toml --quiet --t-end 1e6 --max-walltime 0.3").status, 4);
  const double seconds = seconds_since(start);
  EXPECT_TRUE(seconds > 0.3 && seconds < 12.0) << seconds;
}

// Thousands of ranks would bring the machine down. PATH contains no mpiexec, so none can be started.
TEST_F(CommandLine, MoreRanksThanTheMachineCanBearAreRefused) {
  for (const std::string command : {"run small.toml -o out", "resume out", "sweep small.toml --seeds 2 -o out"}) {
    const Outcome o = shell("PATH=/nonexistent $C " + command + " --ranks 100000");
    EXPECT_EQ(o.status, 2) << command;
    EXPECT_THAT(
        o.err,
        MatchesRegex("carom: error: --ranks: 100000 processes are too many for this machine's [0-9]+ cores?; expected "
                     "at most [0-9]+, 8 for each core; on several machines start carom-mpi with mpirun\n"))
        << command;
  }
  const unsigned most = 8 * std::max(1U, std::thread::hardware_concurrency());
  EXPECT_THAT(shell(fmt::format("PATH=/nonexistent $C run small.toml -o out --ranks {}", most)).err,
              Not(HasSubstr("too many")));
  EXPECT_FALSE(std::filesystem::exists(at("out")));
  EXPECT_EQ(carom("sweep small.toml --seeds 2 -o out --ranks 100000 --emit slurm").status, 0)
      << "this script is for another machine";
}

// Scripts take the place of mpiexec.
TEST_F(CommandLine, ARankThatDiesEndsTheRunWithALine) {
  if (!std::filesystem::exists(std::filesystem::path(CAROM_PROGRAM).replace_filename("carom-mpi"))) {
    GTEST_SKIP() << "a build without MPI";
  }
  const auto run_with = [&](const std::string& mpiexec) {
    write("mpiexec", "#!/bin/sh\n" + mpiexec + "\n");
    std::filesystem::permissions(at("mpiexec"), std::filesystem::perms::owner_all);
    return shell("PATH=.:$PATH $C run small.toml -o out --ranks 2");
  };
  const Outcome killed = run_with("kill -9 $$");
  EXPECT_EQ(killed.status, 1);
  EXPECT_THAT(killed.err, StartsWith("carom: error: one of the ranks was killed by signal 9; the last checkpoint, if"));
  const Outcome missing = run_with("exit 127");
  EXPECT_EQ(missing.status, 1);
  EXPECT_THAT(missing.err, StartsWith("carom: error: one of the ranks could not be started; "));
  EXPECT_EQ(run_with("exit 3").status, 3) << "rank 0 has already printed the error";
}

TEST_F(CommandLine, HelpAndVersion) {
  // The version includes the commit if the sources are in git.
  EXPECT_THAT(carom("--version").out, MatchesRegex("carom [0-9]+[.][0-9]+[.][0-9]+([+]g[0-9a-f]+([.]dirty)?)?\n"));
  for (const char* const command : {"", "run", "check", "resume", "compare", "render", "view"}) {
    const Outcome o = carom(std::string(command) + " --help");
    EXPECT_EQ(o.status, 0);
    EXPECT_THAT(o.out, HasSubstr("Usage: carom")) << command;
    EXPECT_THAT(o.err, IsEmpty());
  }
  for (const char* const command : {"run", "resume"}) {
    EXPECT_THAT(carom(std::string(command) + " --help").out, HasSubstr("over MPI; for methods pairwise and exact\n"));
  }
  EXPECT_THAT(carom("run --help").out, HasSubstr("--engine parallel|reference default parallel; both"));
  EXPECT_THAT(carom("resume --help").out,
              HasSubstr("--engine parallel|reference default that of the run before; both"));
}

TEST_F(CommandLine, ThreadsThatTheReferenceDoesNotUseAreTold) {
  const std::string note = "carom: --threads 2: the reference engine uses one thread\n";
  EXPECT_THAT(carom("run small.toml -o a --threads 2 --engine reference").err, HasSubstr(note));
  EXPECT_THAT(carom("run small.toml -o b --threads 2").err, Not(HasSubstr(note)));
}

TEST_F(CommandLine, HelpIsAWordToo) {
  EXPECT_EQ(carom("help").out, carom("--help").out);
  EXPECT_EQ(carom("help run").out, carom("run --help").out);
  EXPECT_EQ(carom("help").status, 0);
  expect_error("$C help rnu", 2, "there is no command \"rnu\"");
}

TEST_F(CommandLine, FoldersAreRecognisedByTheirContents) {
  ASSERT_EQ(carom("run small.toml --quiet -o out").status, 0);
  expect_error("$C run out", 2, "out: is a directory; expected a scene file, such as the out/scene.toml of the run");
  std::filesystem::create_directories(at("half/carom-unfinished"));
  expect_error("$C compare out half", 2,
               "half: holds a run that is not finished; expected a finished run (carom resume half), or a trajectory "
               "in half/carom-unfinished");
}

TEST_F(LongCommandLine, ChartWritesAllItsFilesOrNone) {
  ASSERT_EQ(carom("chart --tiny --quiet -o chart").status, 0);
  const std::vector<std::string> names = files_in("chart");
  EXPECT_THAT(names,
              ElementsAre("chart.csv", "chart.json", "chart.png", "chart.svg", "chart_all.png", "chart_all.svg"));
  EXPECT_EQ(Json::parse(text_of(at("chart/chart.json")))["scenes"].size(), 10U);
  expect_error("$C chart --tiny --quiet -o chart", 2, "chart/chart.svg: exists already");
  const Outcome again = carom("chart --tiny --force -o chart"), quiet = carom("chart --tiny --quiet --force -o chart");
  EXPECT_THAT(again.out, StartsWith("chart/chart.svg after "));
  EXPECT_EQ(quiet.status, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
  expect_error("$C chart --tiny -o small.toml", 2, "small.toml: is a file");
  expect_error("$C chart --quik", 2, "chart: there is no option \"--quik\"; expected one of");
  expect_error("$C chart now", 2, "chart: one argument too many, \"now\"");
  // Ctrl-C after a second of processor time, long before the end.
  const pid_t stopped = start({"chart", "--quiet", "-o", "stopped/here"});
  shell(fmt::format("until [ \"$(ps -o cputimes= -p {})\" -ge 1 ]; do sleep 0.01; done", stopped));
  kill(stopped, SIGINT);
  EXPECT_EQ(wait_for(stopped), -SIGINT) << said();
  EXPECT_THAT(files_in(""), ElementsAre("chart", "small.toml"));
}

TEST_F(CommandLine, CheckSaysWhatAnAccuracyNeeds) {
  const Outcome plain = carom("check small.toml");
  EXPECT_THAT(plain.out, HasSubstr("--accuracy 1e-3 finds"));
  const Outcome o = carom("check small.toml --accuracy 1e-4");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("for an error of 0.0001 in averages"));
  EXPECT_THAT(o.out, HasSubstr("use it with --method "));
  EXPECT_THAT(o.out, Not(HasSubstr("--accuracy 1e-3 finds")));
  const Json j = Json::parse(carom("check small.toml --accuracy 1e-4 --json").out);
  EXPECT_EQ(j["choice"]["offers"].size(), 2U);
  EXPECT_EQ(j["choice"]["method"], "exact");
  expect_error("$C check small.toml --accuracy x", 2, "--accuracy: \"x\" is not a number");
  expect_error("$C check small.toml --accuracy 0", 2, "--accuracy: is 0; expected a relative error above 0");
  expect_error("$C check small.toml --accuracy 0.5", 2, "--accuracy: is 0.5; expected a relative error");
}

TEST_F(CommandLine, MethodAutoIsReportedAndKept) {
  const Outcome o = carom("run small.toml -o out --method auto --set run.accuracy=1e-4 --json");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, StartsWith("carom: method auto, accuracy 0.0001: exact ("));
  EXPECT_EQ(Json::parse(o.out)["method"], "exact");
  EXPECT_THAT(text_of(at("out/scene.toml")), HasSubstr("# chosen by method = \"auto\", accuracy = 0.0001: "));
  const Outcome again = carom("run out/scene.toml -o again --json");
  EXPECT_THAT(again.err, IsEmpty());
  EXPECT_EQ(Json::parse(again.out)["state_hash"], Json::parse(o.out)["state_hash"]);
  expect_error("$C run small.toml --method auto", 2, "run.accuracy: missing; expected the relative error");
  expect_error("$C run small.toml --method aut", 2, "(nearest: auto)");
  EXPECT_THAT(carom("check small.toml --set run.accuracy=1e-3").err, HasSubstr("only method \"auto\" uses it"));
}

TEST_F(CommandLine, CompareFindsTheFirstBit) {
  ASSERT_EQ(carom("run small.toml --quiet -o a").status, 0);
  ASSERT_EQ(carom("run small.toml --quiet -o b").status, 0);
  Outcome o = carom("compare a b");
  EXPECT_EQ(o.status, 0) << o.out;
  EXPECT_EQ(o.out, "same bits in all 11 frames\n");

  // One more digit in y of disk 3, in the fourth frame only.
  std::string text = text_of(at("b/trajectory.xyz"));
  std::istringstream lines(text);
  std::string changed, line;
  for (int n = 1; std::getline(lines, line); ++n) {
    if (n == 3 * 7 + 2 + 4) line.insert(line.find(' ', 2) + 1, 1, '1');
    changed += line + '\n';
  }
  write("changed.xyz", changed);
  o = carom("compare a/trajectory.xyz changed.xyz");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.out, HasSubstr("different: first in frame 4 (t = 0.3"));
  EXPECT_THAT(o.out, HasSubstr("disk 3, y: "));
  const Json j = Json::parse(carom("compare a/trajectory.xyz changed.xyz --json").out);
  EXPECT_EQ(j["same"], false);
  EXPECT_EQ(j["first"]["quantity"], "y");
  EXPECT_EQ(j["largest"].size(), 1U);

  ASSERT_EQ(carom("run small.toml --quiet -o longer --t-end 1.5").status, 0);
  o = carom("compare a longer");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.out, HasSubstr("11 frames against 16"));
  EXPECT_THAT(o.out, HasSubstr("steps           100 against 150"));
}

TEST_F(LongCommandLine, RenderMakesAPictureAndAMovie) {
  ASSERT_EQ(carom("run small.toml --quiet -o out --set output.every=0.5").status, 0);
  EXPECT_EQ(carom("render out --frame 2").out, "out/frame_2.png\n");
  EXPECT_THAT(text_of(at("out/frame_2.png")), StartsWith("\x89PNG"));
  EXPECT_EQ(carom("render out").out, "out/movie.mp4\n");
  expect_error("$C render out", 2, "out/movie.mp4: exists already");
  expect_error("$C render out --frame 4", 2, "there is no frame 4; expected 1 to 3");
  EXPECT_EQ(carom("render out/trajectory.xyz -o elsewhere.png --frame 1 --quiet").status, 0);
  EXPECT_THAT(files_in(""), ElementsAre("elsewhere.png", "out", "small.toml"));
}

TEST_F(CommandLine, CheckSaysWhatItWouldModel) {
  Outcome o = carom("check small.toml --set physics.gravity=0.5");
  EXPECT_EQ(o.status, 0) << o.err;
  for (const char* const part :
       {"5, radius 0.5, mass 1", "10 x 10, packing fraction 0.03927", "left wall", "gravity 0.5",
        "pairwise, dt = 0.01, 100 steps", "dt is safe", "11 frames", "memory", "cost"}) {
    EXPECT_THAT(o.out, HasSubstr(part));
  }
  EXPECT_THAT(files_in(""), ElementsAre("small.toml")) << "check writes nothing";
  o = carom("check small.toml --json");
  EXPECT_EQ(Json::parse(o.out)["particles"], 5);
}

// Control codes that would colour a terminal, ring its bell, or start a new line, in a title and in file names.
TEST_F(CommandLine, TitlesAndNamesSendNoCodesToTheTerminal) {
  const std::string name = "\x1b[31m.toml";
  const std::string small = text_of(at("small.toml"));
  write(name, R"(title = "a\u001b[31mred\u0007 \u009b31m\nb")" + small.substr(small.find('\n')));
  const std::string scene =
      " '" + name + "' --set physics.collapse.model=tc --set physics.collapse.contact_time=1 --method pairwise";
  for (const std::string command : {"check", "run -o 'out\x1b[31m'"}) {
    const Outcome o = carom(command + scene);
    EXPECT_EQ(o.status, 0) << o.err;
    EXPECT_THAT(o.out, HasSubstr("a?[31mred? ??31m?b"));
    EXPECT_THAT(o.err, HasSubstr("warning: ?[31m.toml: physics.collapse"));
    EXPECT_THAT(o.out + o.err, Not(HasSubstr("\x1b")));
  }
}

// A scene that fits into the machine, but not into this process: the error is one of the scene, in a run and in check.
// The address sanitizer needs more address space than the limit allows.
TEST_F(LongCommandLine, DisksThatFindNoMemory) {
#ifdef CAROM_ADDRESS_SANITIZER
  GTEST_SKIP() << "the address sanitizer needs terabytes of address space";
#endif
  for (const char* const command : {"run --quiet", "check"}) {
    expect_error(std::string("ulimit -v 600000; $C ") + command +
                     " small.toml --set disks.0.count=20000000 --set disks.0.radius=1e-5",
                 2, "small.toml: disks: 20000000 disks do not fit into the memory that this process may use");
  }
  EXPECT_THAT(files_in(""), ElementsAre("small.toml"));
}

TEST_F(CommandLine, CollapseWithoutTheExactMethodIsWarnedOf) {
  const std::string collapse = " --set 'physics.collapse={ model = \"tc\", contact_time = 1e-3 }'";
  for (const std::string command : {"run small.toml -o out --json", "check small.toml"}) {
    const Outcome o = carom(command + collapse);
    EXPECT_EQ(o.status, 0);
    EXPECT_EQ(o.err,
              "carom: warning: small.toml: physics.collapse: only the exact method uses it, method pairwise does "
              "not\n");
  }
  EXPECT_THAT(carom("check small.toml --method exact --set physics.restitution=0.9" + collapse).err, IsEmpty());
}

TEST_F(CommandLine, ProgressOnATerminalOnly) {
  // script(1) provides a terminal. Without ffmpeg the run makes pictures, which take long enough for a line of
  // progress.
  const Outcome o = shell(
      "script -qec \"PATH=/nonexistent $C run small.toml -o out --set output.movie=true --set output.every=0.02\" "
      "/dev/null");
  EXPECT_EQ(o.status, 0) << o.out;
  EXPECT_THAT(o.out, HasSubstr(" of 1  "));
  EXPECT_THAT(o.out, HasSubstr(" steps/s  "));
  EXPECT_THAT(o.out, HasSubstr(" left"));
}

}  // namespace
}  // namespace carom
