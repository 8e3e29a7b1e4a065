// Programs that run beside us: which one is found, what it is fed, and how it ended. Words for the shell.
#include "io/files/child_process.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "core/base/check.hpp"
#include "io/files/shell_word.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;

// PATH as it was, once this goes.
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
  ChildProcess shell(const std::string& command) const {
    return {{"/bin/sh", "-c", command}, folder_.path().string(), at("log")};
  }
  const test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
};

// Folders and files that cannot be run have the name, too.
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

TEST_F(Child, IsFedAndItsEndIsTold) {
  ChildProcess counting = shell("wc -c > counted; pwd; exit 7");
  const std::string text(1'000'000, 'x');
  EXPECT_TRUE(counting.write(text.data(), text.size()));
  EXPECT_EQ(counting.wait(), 7);
  EXPECT_THAT(test::text_of(at("counted")), testing::HasSubstr("1000000"));
  EXPECT_EQ(last_line(at("log")), fs::canonical(folder_.path()).string()) << "it runs in the folder";
  EXPECT_EQ(shell("kill -KILL $$").wait(), 128 + SIGKILL);
  EXPECT_THROW(ChildProcess({at("none")}, at("."), at("log")), RunError);
}

TEST_F(Child, OneThatIsGoneTakesNothingMore) {
  ChildProcess gone = shell("exec 0<&-; echo closed");
  const std::string text(1'000'000, 'x');
  EXPECT_FALSE(gone.write(text.data(), text.size()));
  EXPECT_EQ(gone.wait(), 0);
}

TEST_F(Child, ItsLastWordIsTheLastLineThatSaysAnything) {
  EXPECT_EQ(last_line(folder_.write("log", "one\ntwo\n\n\n")), "two");
  EXPECT_EQ(last_line(folder_.write("log", "one\ntwo")), "two");
  EXPECT_EQ(last_line(folder_.write("log", "")), "");
  EXPECT_EQ(last_line(at("none")), "");
}

// As the shell itself reads them.
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
