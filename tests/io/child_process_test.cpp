// Child processes: which program is found, its input, and how it ended; and quoting for the shell.
#include "io/files/child_process.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>
#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "core/base/check.hpp"
#include "core/base/wall_clock.hpp"
#include "io/files/shell_word.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;

// Restores PATH at the end of its life.
class SearchPath {
 public:
  explicit SearchPath(const std::string& path) { setenv("PATH", path.c_str(), 1); }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;
  ~SearchPath() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_ = getenv("PATH");
};

class Child : public ::testing::Test {
 protected:
  std::string at(const std::string& name) const { return (folder_.path() / name).string(); }
  void make_program(const std::string& name) const {
    fs::create_directories(fs::path(at(name)).parent_path());
    folder_.write(name, "#!/bin/sh\n");
    fs::permissions(at(name), fs::perms::owner_all);
  }
  ChildProcess shell(const std::string& command, ChildSignals signals = ChildSignals::held_back) const {
    return {{"/bin/sh", "-c", command}, folder_.path().string(), at("log"), signals};
  }
  const test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
};

// Folders, and files that cannot be executed, with the same name must be skipped.
TEST_F(Child, TheFirstThatCanBeRunIsFound) {
  fs::create_directories(at("a/tool"));
  fs::create_directories(at("b"));
  folder_.write("b/tool", "text");
  make_program("c/tool");
  make_program("d/tool");
  const SearchPath path(at("none") + ":" + at("a") + ":" + at("b") + ":" + at("c") + ":" + at("d"));
  EXPECT_EQ(find_program("tool"), at("c/tool"));
  EXPECT_EQ(find_program("another"), "");
}

// The child starts in another folder than the one to which a relative entry of PATH refers.
TEST_F(Child, OneInARelativeFolderOfThePathIsStartedFromAnywhere) {
  make_program("bin/tool");
  const SearchPath path(fs::relative(at("bin")).string());
  fs::create_directories(at("elsewhere"));
  const std::string tool = find_program("tool");
  EXPECT_EQ(fs::canonical(tool), fs::canonical(at("bin/tool")));
  EXPECT_EQ(ChildProcess({tool}, at("elsewhere"), at("log")).wait(), 0);
}

// One error covers both the program and the log: it must name the one that cannot be opened.
TEST_F(Child, WhatDoesNotLetItStartIsNamed) {
  const auto said = [&](const std::string& program, const std::string& log) -> std::string {
    try {
      const ChildProcess child({program}, folder_.path().string(), log);
    } catch (const RunError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(said("/bin/true", at("none/log")), "cannot write " + at("none/log") + ": No such file or directory");
  EXPECT_EQ(said(at("none"), at("log")), "cannot start " + at("none") + ": No such file or directory");
}

TEST_F(Child, IsFedAndItsEndIsTold) {
  ChildProcess counting = shell("wc -c > counted; pwd; exit 7");
  const std::string text(1'000'000, 'x');
  EXPECT_TRUE(counting.write(text.data(), text.size()));
  EXPECT_EQ(counting.wait(), 7);
  EXPECT_THAT(test::text_of(at("counted")), testing::HasSubstr("1000000"));
  EXPECT_EQ(last_line(at("log")), fs::canonical(folder_.path()).string()) << "it must run in the folder";
  EXPECT_EQ(shell("kill -KILL $$").wait(), 128 + SIGKILL);
  EXPECT_THROW(ChildProcess({at("none")}, at("."), at("log")), RunError);
}

TEST_F(Child, OneThatIsGoneTakesNothingMore) {
  ChildProcess gone = shell("exec 0<&-; echo closed");
  const std::string text(1'000'000, 'x');
  EXPECT_FALSE(gone.write(text.data(), text.size()));
  EXPECT_EQ(gone.wait(), 0);
}

// If a signal comes in between, a pipe accepts only a part of what is written.
TEST_F(Child, WhatASignalInterruptsIsWrittenInFull) {
  std::string text(4'000'000, ' ');
  for (std::size_t k = 0; k < text.size(); ++k) text[k] = static_cast<char>('a' + k % 23);
  struct sigaction interrupts {};
  interrupts.sa_handler = [](int) {};
  struct sigaction before {};
  sigaction(SIGALRM, &interrupts, &before);  // without SA_RESTART
  const itimerval often{{0, 500}, {0, 500}}, never{};
  ChildProcess slow = shell("sleep 0.1; cat >copy");
  setitimer(ITIMER_REAL, &often, nullptr);
  EXPECT_TRUE(slow.write(text.data(), text.size()));
  setitimer(ITIMER_REAL, &never, nullptr);
  sigaction(SIGALRM, &before, nullptr);
  EXPECT_EQ(slow.wait(), 0);
  EXPECT_TRUE(test::text_of(at("copy")) == text);
}

TEST_F(Child, OneThatIsNotWantedAnyMoreIsKilled) {
  const auto start = WallClock::now();
  { const ChildProcess idle = shell("exec sleep 30"); }
  EXPECT_LT(seconds_since(start), 20.0);
}

// A terminal sends its signals to the whole process group, and a batch system to each process of a job.
TEST_F(Child, SignalsForUsDoNotReachIt) {
  EXPECT_EQ(shell("kill -TERM $$; echo alive").wait(), 0);
  EXPECT_EQ(last_line(at("log")), "alive");
  EXPECT_EQ(shell("kill -TERM $$; echo alive", ChildSignals::reach_it).wait(), 128 + SIGTERM);
  ASSERT_EQ(shell("echo $$ $(ps -o pgid= -p $$)").wait(), 0);
  std::istringstream said(last_line(at("log")));
  pid_t process = 0, group = -1;
  said >> process >> group;
  EXPECT_EQ(group, process);
}

// Processes that a run of a sweep starts do not inherit the sweep as their parent.
TEST_F(Child, AParentIsThatOfTheChildAlone) {
  const auto begin = [](const std::string& parent) {
    setenv("CAROM_PARENT", parent.c_str(), 1);
    end_with_parent();
    std::_Exit(getenv("CAROM_PARENT") == nullptr ? 0 : 1);
  };
  EXPECT_EXIT(begin(std::to_string(getppid())), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(begin("1234567890"), testing::KilledBySignal(SIGTERM), "") << "the parent has died before";
}

TEST_F(Child, ItsLastWordIsTheLastLineThatSaysAnything) {
  EXPECT_EQ(last_line(folder_.write("log", "one\ntwo\n\n\n")), "two");
  EXPECT_EQ(last_line(folder_.write("log", "one\ntwo")), "two");
  EXPECT_EQ(last_line(folder_.write("log", "")), "");
  EXPECT_EQ(last_line(at("none")), "");
}

// Compared with how the shell reads them.
TEST(ShellWord, IsOneWordToTheShell) {
  EXPECT_EQ(shell_word("out/gas-1.5_b,c:d+e@f%g=h"), "out/gas-1.5_b,c:d+e@f%g=h");
  EXPECT_EQ(shell_word("\xc3\xa9"), "\xc3\xa9");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  const test::TestFolder folder("shell_word");
  const std::string out = (folder.path() / "out").string();
  for (const std::string text : {"a b",    "$HOME", "`id`", "a;b", "a&b", "*",  "?",   "[a]",   "a\\b", "a\"b",
                                 "a'b''c", "~",     "#a",   "a|b", "a>b", "!a", "(a)", "{a,b}", "a\tb", "a\nb"}) {
    EXPECT_NE(shell_word(text), text);
    ASSERT_EQ(::system(("printf %s " + shell_word(text) + " > " + out).c_str()), 0);
    EXPECT_EQ(test::text_of(out), text);
  }
}

}  // namespace
}  // namespace carom
