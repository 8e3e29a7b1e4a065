// The launcher ./carom with stand-ins for its tools, which print their arguments: what it builds, tests and prints.
#include <filesystem>
#include <string>
#include <utility>

#include "tests/support/program_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Launcher : public test::ProgramTest {
 protected:
  Launcher() {
    for (const char* const folder : {"core", "parallel", "io", "run", "app", "viewer", "cmake"}) {
      fs::create_directories(at("root") / folder);
    }
    write("root/CMakeLists.txt", "");
    fs::create_directories(at("root/build/release"));
    fs::create_directories(at("tools"));
    fs::copy_file(CAROM_SOURCE_DIR "/carom", at("root/carom"));
    write("root/cmake/packages.txt", "[build]\ncompiler\n");
    write("root/CMakePresets.json", "{}");
    tool("dpkg-query", "echo compiler installed");
    tool("apt-get", "exit 1");
    tool("cmake",
         "echo CMAKE_HOME_DIRECTORY:INTERNAL=$ROOT >$ROOT/build/release/CMakeCache.txt; "
         "touch -d '1 minute' $ROOT/build/release/build.ninja");
    // A stand-in for ninja: it overwrites its line only on a terminal, and has nothing to do the second time.
    tool("ninja", R"(case "$*" in *-n*) [ -e $ROOT/built ] && echo 'ninja: no work to do.'; exit 0;; esac
[ -t 1 ] && [ "$1" != --quiet ] && echo "status: $NINJA_STATUS"
echo 'a word of the compiler'
touch $ROOT/built)");
  }

  void tool(const std::string& name, const std::string& script) const {
    write("tools/" + name, "#!/bin/sh\n" + script + "\n");
    fs::permissions(at("tools/" + name), fs::perms::owner_all);
  }

  Outcome launch(const std::string& arguments) const {
    return shell("export ROOT=$(realpath root) PATH=\"$(realpath tools):$PATH\"; " + arguments);
  }
};
using LongLauncher = Launcher;

constexpr const char* four_tests = R"(cat <<'END'
Test project /somewhere
      Start  1: A.One
      Start  2: A.Two
 1/4 Test  #1: A.One ............................   Passed    0.01 sec
      Start  3: A.Three
 2/4 Test  #2: A.Two ............................***Failed    0.02 sec
what A.Two said

      Start  4: A.Four
 3/4 Test  #3: A.Three ..........................***Exception: SegFault  0.00 sec

 4/4 Test  #4: A.Four ...........................   Passed   12.34 sec

50% tests passed, 2 tests failed out of 4

Total Test time (real) =  12.35 sec
END
echo "$*" >$ROOT/asked
exit 8)";

TEST_F(Launcher, TestSaysHowFarItIsAndWhatFails) {
  tool("ctest", four_tests);
  const Outcome o = launch("root/carom test -R 'A B'");
  EXPECT_EQ(o.status, 8) << "ctest's";
  EXPECT_EQ(o.out, R"(Test project /somewhere
 2/4 Test  #2: A.Two ............................***Failed    0.02 sec
what A.Two said

 3/4 Test  #3: A.Three ..........................***Exception: SegFault  0.00 sec


50% tests passed, 2 tests failed out of 4

Total Test time (real) =  12.35 sec
)");
  EXPECT_THAT(o.err, EndsWith("carom: 1 of 4 tests, 0 failed\ncarom: 2 of 4 tests, 1 failed\n"
                              "carom: 3 of 4 tests, 2 failed\ncarom: 4 of 4 tests, 2 failed\n"));
  EXPECT_THAT(test::text_of(at("root/asked")), AllOf(HasSubstr("--output-on-failure"), EndsWith(" -R A B\n")));
}

TEST_F(Launcher, TestOfHundredsIsTenLines) {
  tool("ctest", R"(for k in $(seq 300); do echo "      Start $k: T.$k"
echo "$k/300 Test #$k: T.$k ...   Passed    0.01 sec"; done
echo; echo '100% tests passed, 0 tests failed out of 300')");
  const Outcome o = launch("root/carom test");
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.out, "\n100% tests passed, 0 tests failed out of 300\n");
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 11) << "a line for every tenth, and one for configuring\n"
                                                              << o.err;
  EXPECT_THAT(o.err, EndsWith("carom: 300 of 300 tests, 0 failed\n"));
}

TEST_F(Launcher, TestListsAndPrintsAllWhereAsked) {
  tool("ctest", four_tests);
  EXPECT_THAT(launch("root/carom test -V").out, HasSubstr("Start  1: A.One"));
  EXPECT_THAT(launch("root/carom test -N").out, HasSubstr("Start  1: A.One"));
}

TEST_F(LongLauncher, BuildingShowsNinjasLineOnATerminalOnly) {
  tool("ctest", "true");
  EXPECT_THAT(launch("root/carom test").err, Not(HasSubstr("compiler")));
  launch("rm root/built");
  const std::string shown = launch("script -qec 'root/carom test' /dev/null").out;
  EXPECT_THAT(shown, HasSubstr("status: carom: building, %f of %t"));
  EXPECT_THAT(launch("script -qec 'root/carom test' /dev/null").out, IsEmpty())
      << "with nothing to build there must be no output";
}

TEST_F(Launcher, ABuildThatFailsSaysWhy) {
  tool("ninja", "echo 'error: no such thing'; exit 1");
  for (const char* const command : {"root/carom test", "script -qec 'root/carom test' /dev/null"}) {
    const Outcome o = launch(command);
    EXPECT_EQ(o.status, 1) << command;
    EXPECT_THAT(o.out + o.err, AllOf(HasSubstr("error: no such thing"), HasSubstr("carom: the build failed")))
        << command;
  }
}

TEST_F(LongLauncher, CountsAreOfTheProgramBuiltNow) {
  tool("ninja", "echo \"$*\" >>$ROOT/ninja_asked");
  fs::create_directories(at("root/bench"));
  write("root/bench/counts.sh", "echo \"$*\"; exit 3");
  write("root/cmake/packages.txt", "[build]\ncompiler\n[counts]\nvalgrind\n");
  EXPECT_THAT(launch("root/carom bench counts --check").err, HasSubstr("could not install: valgrind"));
  tool("dpkg-query", "echo compiler installed; echo valgrind installed");
  const Outcome o = launch("root/carom bench counts --check");
  EXPECT_EQ(o.status, 3) << "the status of the script";
  EXPECT_THAT(o.out, EndsWith("/bench/carom_counts " + fs::canonical(at("root")).string() +
                              "/bench/results/counts.csv --check\n"));
  EXPECT_THAT(test::text_of(at("root/ninja_asked")), HasSubstr(" carom carom_counts\n"));
}

// Otherwise all benchmarks would be run, and their results replaced.
TEST_F(Launcher, AMisspeltBenchmarkRunsNone) {
  for (const char* const words : {"count", "--check", "count --check"}) {
    const Outcome o = launch("root/carom bench " + std::string(words));
    EXPECT_EQ(o.status, 2) << words;
    EXPECT_THAT(o.err, HasSubstr("carom: error: there is no bench \"")) << words;
    EXPECT_FALSE(fs::exists(at("root/built"))) << words;
  }
}

TEST_F(LongLauncher, PythonHasTheModuleOnItsPathAndItsPackagesOnlyThen) {
  write("root/cmake/packages.txt", "[build]\ncompiler\n[python]\nheaders\n");
  const std::string line = "root/carom python -c 'import os; print(os.environ[\"PYTHONPATH\"])'";
  EXPECT_THAT(launch(line).err, HasSubstr("could not install: headers"));
  tool("dpkg-query", "echo compiler installed; echo headers installed");
  const Outcome o = launch(line);
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.out, EndsWith("/root/build/release/python\n"));
}

TEST_F(LongLauncher, ThePaperIsBuiltForOnlyWhereItsResultsAreMadeAnew) {
  fs::create_directories(at("root/docs/paper"));
  write("root/docs/paper/make_paper.py", "import sys\nprint(sys.argv[1:])\n");
  write("root/cmake/packages.txt", "[build]\ncompiler\n[paper]\nlatex\n");
  EXPECT_THAT(launch("root/carom paper").err, HasSubstr("could not install: latex"));
  tool("dpkg-query", "echo compiler installed; echo latex installed");
  EXPECT_EQ(launch("root/carom paper --quick").out, "['--quick']\n");
  EXPECT_FALSE(fs::exists(at("root/built")));
  const std::pair<std::string, std::string> anew[] = {{"--full counts", "['--full', 'counts']\n"},
                                                      {"--full=counts", "['--full=counts']\n"}};
  for (const auto& [words, told] : anew) {
    fs::remove(at("root/built"));
    EXPECT_EQ(launch("root/carom paper " + words).out, told);
    EXPECT_TRUE(fs::exists(at("root/built"))) << words;
  }
}

TEST_F(Launcher, ItsOwnCommandsHaveHelp) {
  for (const char* const command : {"bench", "packages"}) {
    const Outcome o = launch(std::string("root/carom ") + command + " --help");
    EXPECT_EQ(o.status, 0);
    EXPECT_THAT(o.out, HasSubstr(std::string("./carom ") + command));
    EXPECT_FALSE(fs::exists(at("root/built"))) << "this must build nothing";
  }
  const std::string help = carom("--help").out;
  for (const char* const command : {"./carom", "test", "bench", "python", "paper", "packages"})
    EXPECT_THAT(help, HasSubstr(command));
  const Outcome o = carom("test");
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.err, HasSubstr("\"test\" is a command of the launcher ./carom"));
}

TEST_F(LongLauncher, BuildsAgainAfterAChangeInAnyFolderOfTheProgram) {
  write("root/build/release/carom", "#!/bin/sh\necho the program\n");
  fs::permissions(at("root/build/release/carom"), fs::perms::owner_all);
  const auto builds = [&] {
    fs::remove(at("root/built"));
    EXPECT_EQ(launch("root/carom check").out, "the program\n");
    return fs::exists(at("root/built"));
  };
  EXPECT_TRUE(builds());
  EXPECT_FALSE(builds());
  for (const std::string folder : {"core", "parallel", "io", "run", "app", "viewer", "cmake"}) {
    write("root/" + folder + "/new.hpp", "");
    EXPECT_TRUE(builds()) << folder;
    EXPECT_FALSE(builds()) << folder;
    fs::remove(at("root/" + folder + "/new.hpp"));
    EXPECT_TRUE(builds()) << folder;
  }
}

// A user without the right to write there can still use what is built; and a build of the program alone leaves the
// build for ranks as it was.
TEST_F(Launcher, RanksAreBuiltForOnceAndAgainAfterAChange) {
  for (const char* const program : {"root/build/release/carom", "root/build/release/carom-mpi"}) {
    write(program, "#!/bin/sh\necho the program\n");
    fs::permissions(at(program), fs::perms::owner_all);
  }
  const auto builds = [&](const std::string& command) {
    fs::remove(at("root/built"));
    EXPECT_EQ(launch("root/carom " + command).out, "the program\n");
    return fs::exists(at("root/built"));
  };
  EXPECT_TRUE(builds("run --ranks 2"));
  EXPECT_FALSE(builds("run --ranks 2"));
  EXPECT_FALSE(builds("check"));
  write("root/core/new.hpp", "");
  EXPECT_TRUE(builds("check"));
  EXPECT_TRUE(builds("run --ranks 2"));
  EXPECT_FALSE(builds("run --ranks 2"));
}

// Completion asks the program that is built, and neither installs nor builds anything.
TEST_F(Launcher, CompletionBuildsNothing) {
  const std::string complete =
      "bash -c 'source " CAROM_SOURCE_DIR
      "/cmake/carom.bash; COMP_WORDS=(root/carom re) COMP_CWORD=1; _carom; echo \"${COMPREPLY[@]}\"'";
  EXPECT_EQ(launch(complete).out, "\n");
  fs::create_symlink(CAROM_PROGRAM, at("root/build/release/carom"));
  EXPECT_EQ(launch(complete).out, "resume render\n");
  EXPECT_FALSE(fs::exists(at("root/built")));
}

}  // namespace
}  // namespace carom
