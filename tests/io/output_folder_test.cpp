// No output replaces another by accident, and nothing unfinished looks like a result.
#include "io/files/output_folder.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>

#include "core/base/check.hpp"
#include "io/files/output_file.hpp"
#include "tests/support/folder_refusal.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class OutputFolderTest : public ::testing::Test {
 protected:
  OutputFolderTest() { write_file(base_ / "input.toml", "scene"); }

  static std::string text(const fs::path& path) { return test::text_of(path); }
  std::string refusal(const fs::path& folder, bool force) const {
    return test::folder_refusal(folder, base_ / "input.toml", force);
  }
  void run(const fs::path& folder, const std::string& result, bool force) const {
    OutputFolder out(folder, base_ / "input.toml", force);
    write_file(out.path("summary.json"), result);
    out.finish();
  }
  const test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
  const fs::path base_ = folder_.path();
};

TEST_F(OutputFolderTest, ResultsAppearOnlyWhenFinished) {
  const fs::path folder = base_ / "a" / "b";
  OutputFolder out(folder, base_ / "input.toml", false);
  write_file(out.path("series.csv"), "t\n");
  write_file(out.path("summary.json"), "{}");
  EXPECT_FALSE(fs::exists(folder / "series.csv"));
  EXPECT_TRUE(fs::exists(folder / "carom-unfinished" / "series.csv"));
  out.finish();
  EXPECT_EQ(text(folder / "series.csv"), "t\n");
  EXPECT_EQ(text(folder / "summary.json"), "{}");
  EXPECT_FALSE(fs::exists(folder / "carom-unfinished"));
}

TEST_F(OutputFolderTest, AFailedRunLeavesNothing) {
  {
    OutputFolder out(base_ / "a" / "b", base_ / "input.toml", false);
    write_file(out.path("series.csv"), "t\n");
  }
  EXPECT_FALSE(fs::exists(base_ / "a"));
  {
    fs::create_directories(base_ / "mine");
    OutputFolder out(base_ / "mine/", base_ / "input.toml", false);
  }
  EXPECT_TRUE(fs::exists(base_ / "mine")) << "a folder that existed before stays";
  EXPECT_TRUE(fs::is_empty(base_ / "mine"));
}

TEST_F(OutputFolderTest, ResultsAreReplacedByForceOnly) {
  const fs::path folder = base_ / "out";
  run(folder, "first", false);
  write_file(folder / "series.csv", "of the first");
  write_file(folder / "notes.txt", "mine");
  EXPECT_THAT(refusal(folder, false), HasSubstr("out: holds series.csv of an earlier run; choose another folder"));
  EXPECT_THROW(run(folder, "second", false), InputError);
  EXPECT_EQ(text(folder / "summary.json"), "first");
  {
    OutputFolder failing(folder, base_ / "input.toml", true);
    write_file(failing.path("summary.json"), "half");
  }
  EXPECT_EQ(text(folder / "summary.json"), "first") << "after a failed run the earlier results are kept";
  run(folder, "second", true);
  EXPECT_EQ(text(folder / "summary.json"), "second");
  EXPECT_FALSE(fs::exists(folder / "series.csv")) << "no file of the earlier run may remain";
  EXPECT_EQ(text(folder / "notes.txt"), "mine");
  fs::create_directories(folder / unfinished_name);
  write_file(folder / unfinished_name / "trajectory.xyz", "of one that was stopped");
  run(folder, "third", true);
  EXPECT_FALSE(fs::exists(folder / "trajectory.xyz"));
}

// Noticed only at the end of a run, this would cost both the old and the new results.
TEST_F(OutputFolderTest, AFolderWhereAFileWouldGoIsForeseen) {
  const fs::path folder = base_ / "out";
  run(folder, "first", false);
  fs::create_directories(folder / "movie.mp4");
  write_file(folder / "movie.mp4" / "keep", "mine");
  for (const bool force : {false, true}) {
    EXPECT_THAT(
        refusal(folder, force),
        HasSubstr("out/movie.mp4: is a folder, but the run writes its movie.mp4 there; choose another folder with -o"));
  }
  EXPECT_THROW(run(folder, "second", true), InputError);
  EXPECT_EQ(text(folder / "summary.json"), "first");
  EXPECT_EQ(text(folder / "movie.mp4" / "keep"), "mine");
  EXPECT_EQ(free_output_folder(folder, base_ / "input.toml"), base_ / "out-2");
}

TEST_F(OutputFolderTest, AnUnfinishedRunIsSeen) {
  fs::create_directories(base_ / "out" / "carom-unfinished");
  EXPECT_THAT(refusal(base_ / "out", false), HasSubstr("another run is writing there, or stopped"));
  EXPECT_EQ(refusal(base_ / "out", true), "");
}

TEST_F(OutputFolderTest, WhatIsNotOursIsNeverTouched) {
  EXPECT_THAT(refusal(base_ / "input.toml", true), HasSubstr("is a file; expected a folder"));
  EXPECT_THAT(refusal("/dev/full", true), HasSubstr("is a file; expected a folder"));
  fs::create_directories(base_ / "pictures" / "frames");
  write_file(base_ / "pictures" / "frames" / "holiday.png", "");
  EXPECT_THAT(refusal(base_ / "pictures", true), HasSubstr("'frames' with other files"));
  fs::rename(base_ / "pictures" / "frames" / "holiday.png", base_ / "pictures" / "frames" / "frame_notes.txt");
  EXPECT_THAT(refusal(base_ / "pictures", true), HasSubstr("'frames' with other files"));
  fs::rename(base_ / "input.toml", base_ / "scene.toml");
  try {
    check_output_folder(base_, base_ / "scene.toml", true);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("would replace the scene file itself"));
  }
}

TEST_F(OutputFolderTest, ALinkToADiskThatIsAwayIsLeft) {
  fs::create_symlink("away", base_ / "out");
  for (const fs::path& folder : {base_ / "out", base_ / "out" / "gas"}) {
    EXPECT_EQ(refusal(folder, false), folder.string() + ": cannot be made: " + (base_ / "out").string() +
                                          " is a link to away, which is not there; expected a folder for the results "
                                          "(-o)");
    EXPECT_THROW(OutputFolder(folder, base_ / "input.toml", true), InputError);
    EXPECT_TRUE(fs::is_symlink(base_ / "out"));
  }
  fs::create_directory(base_ / "away");
  run(base_ / "out" / "gas", "1", false);
  EXPECT_EQ(text(base_ / "away" / "gas" / "summary.json"), "1");
}

TEST_F(OutputFolderTest, KeptOnRequest) {
  OutputFolder(base_ / "out", base_ / "input.toml", false).keep_unfinished();
  EXPECT_TRUE(fs::exists(base_ / "out" / "carom-unfinished"));
}

TEST_F(OutputFolderTest, WhereNoFolderCanBe) {
  for (const fs::path& folder : {base_ / "input.toml" / "out", fs::path("/proc/nothing/out")}) {
    EXPECT_THROW(OutputFolder(folder, base_ / "input.toml", false), InputError) << folder;
  }
}

// If a file cannot be replaced no temporary file is left.
TEST_F(OutputFolderTest, AFileReplacesAFileOnly) {
  const std::string file = base_ / "table.csv";
  write_file(file, "old");
  replace_file(file, "new");
  EXPECT_EQ(text(file), "new");
  fs::create_directories(base_ / "folder.csv" / "full");
  ASSERT_EQ(mkfifo((base_ / "pipe.csv").c_str(), 0600), 0);
  for (const char* const name : {"folder.csv", "pipe.csv"}) {
    EXPECT_THROW(replace_file(base_ / name, "new"), RunError) << name;
    EXPECT_FALSE(fs::exists(base_ / (std::string(name) + ".new"))) << name;
  }
  EXPECT_TRUE(fs::is_fifo(base_ / "pipe.csv"));
}

TEST_F(OutputFolderTest, AStoppedRunIsGoneOnWithWhereItCanBe) {
  const fs::path unfinished = base_ / "out" / unfinished_name;
  fs::create_directories(unfinished);
  EXPECT_THAT(refusal(base_ / "out", false), ::testing::Not(HasSubstr("carom resume")));
  write_file(unfinished / "checkpoint.carom", "");
  EXPECT_THAT(refusal(base_ / "out", false), HasSubstr("); resume it with carom resume "));
}

// Resuming a stopped run. If the test may write anywhere, a process of another user is used.
TEST_F(OutputFolderTest, WhereNoFileCanBeWrittenNoRunGoesOn) {
  constexpr auto open = fs::perms::all, closed = fs::perms::all & ~fs::perms(0222);
  const fs::path out = base_ / "out", unfinished = out / unfinished_name;
  fs::create_directories(unfinished);
  const auto go_on = [&] {
    constexpr uid_t nobody = 65534;
    if (geteuid() == 0 && seteuid(nobody) != 0) std::_Exit(1);
    try {
      const OutputFolder folder(out);
    } catch (const InputError& e) {
      std::fputs(e.what(), stderr);
      std::_Exit(2);
    }
    std::_Exit(0);
  };
  fs::permissions(base_, closed);
  fs::permissions(out, open);
  fs::permissions(unfinished, open);
  EXPECT_EXIT(go_on(), ::testing::ExitedWithCode(0), "");
  for (const fs::path& place : {unfinished, out}) {
    fs::permissions(place, closed);
    EXPECT_EXIT(go_on(), ::testing::ExitedWithCode(2),
                "out: cannot be written to: Permission denied; resume in another folder with -o");
    EXPECT_EQ(std::distance(fs::directory_iterator(unfinished), {}), 1) << "only the lock";
    fs::permissions(place, open);
  }
  fs::permissions(base_, open);
}

TEST_F(OutputFolderTest, TheRootAndTheCurrentFolderAreKnown) {
  for (const char* const root : {"/", "//", "/tmp/.."}) {
    EXPECT_THAT(refusal(root, true), HasSubstr(": is the root of all folders; expected a folder for this run")) << root;
  }
  const fs::path here = fs::current_path();
  fs::create_directories(base_ / "here");
  fs::current_path(base_ / "here");
  { OutputFolder("", base_ / "input.toml", false).finish(); }
  run("", "1", false);
  EXPECT_EQ(text(base_ / "here" / "summary.json"), "1");
  fs::current_path(here);
}

// A run that goes on gets back the files that it continues, and if it was finished all its results; files that are
// already in the unfinished part are newer.
TEST_F(OutputFolderTest, WhatARunGoesOnWithIsTakenBack) {
  const fs::path folder = base_ / "out";
  run(folder, "first", false);
  for (const char* const name : {"series.csv", "trajectory.xyz", "energy.svg"}) write_file(folder / name, "old");
  fs::create_directories(folder / unfinished_name);
  write_file(folder / unfinished_name / "series.csv", "new");
  {
    OutputFolder going_on{folder};
    going_on.take_back(false, {"series.csv", "trajectory.xyz", "none.csv"});
    EXPECT_EQ(text(folder / unfinished_name / "series.csv"), "new");
    EXPECT_EQ(text(folder / unfinished_name / "trajectory.xyz"), "old");
    EXPECT_TRUE(fs::exists(folder / "energy.svg") && fs::exists(folder / "summary.json"));
    EXPECT_EQ(present_path(folder, "series.csv"), folder / unfinished_name / "series.csv") << "the newer of both";
    EXPECT_EQ(present_path(folder, "energy.svg"), folder / "energy.svg");
    EXPECT_EQ(present_path(folder, "none.csv"), folder / unfinished_name / "none.csv")
        << "a run that goes on writes there";
    going_on.take_back(true, {});
    for (const char* const name : {"energy.svg", "summary.json"}) {
      EXPECT_FALSE(fs::exists(folder / name)) << name;
      EXPECT_TRUE(fs::exists(folder / unfinished_name / name)) << name;
    }
  }
  EXPECT_TRUE(fs::exists(folder / unfinished_name / "energy.svg")) << "no file of a run that goes on is removed";
}

// carom view and carom render put their files into the folder of a run that is going on or has stopped.
TEST_F(OutputFolderTest, PicturesThatOthersMadeOfTheRunStay) {
  const fs::path folder = base_ / "out";
  const auto make_pictures = [&](const std::string& of) {
    write_file(folder / "view.html", of);
    write_file(folder / "movie.mp4", of);
    fs::create_directories(folder / "frames");
    write_file(folder / "frames" / "frame_000001.png", of);
  };
  OutputFolder(folder, base_ / "input.toml", false).keep_unfinished();
  make_pictures("a part");
  {
    OutputFolder going_on{folder};
    write_file(going_on.path("movie.mp4"), "all of it");
    write_file(going_on.path("summary.json"), "1");
    going_on.finish();
  }
  EXPECT_EQ(text(folder / "view.html"), "a part");
  EXPECT_EQ(text(folder / "frames" / "frame_000001.png"), "a part");
  EXPECT_EQ(text(folder / "movie.mp4"), "all of it") << "the run's own file";
  // Those made for an earlier run are removed with it, even if the run that replaces it is stopped.
  OutputFolder(folder, base_ / "input.toml", true).keep_unfinished();
  EXPECT_EQ(text(folder / "view.html"), "a part");
  {
    OutputFolder going_on{folder};
    write_file(going_on.path("summary.json"), "2");
    going_on.finish();
  }
  for (const char* const name : {"view.html", "movie.mp4", "frames"}) EXPECT_FALSE(fs::exists(folder / name)) << name;
}

TEST_F(OutputFolderTest, CheckpointsStayWhereTheyAreAskedFor) {
  for (const bool keep : {false, true}) {
    OutputFolder out(base_ / "out", base_ / "input.toml", true);
    for (const char* const name : {"checkpoint.carom", "checkpoint.previous.carom", "summary.json"}) {
      write_file(out.path(name), name);
    }
    out.finish(keep);
    EXPECT_EQ(fs::exists(base_ / "out" / "checkpoint.carom"), keep);
    EXPECT_EQ(fs::exists(base_ / "out" / "checkpoint.previous.carom"), keep);
  }
}

TEST_F(OutputFolderTest, TheNextFreeFolderIsTaken) {
  const fs::path input = base_ / "input.toml";
  EXPECT_EQ(free_output_folder(base_ / "out", input), base_ / "out");
  run(base_ / "out", "1", false);
  run(base_ / "out-2", "2", false);
  write_file(base_ / "out-3", "a file");
  EXPECT_EQ(free_output_folder(base_ / "out", input), base_ / "out-4");
  EXPECT_THROW(free_output_folder(base_ / "out-3", input), InputError) << "a file is no folder of an earlier run";
}

}  // namespace
}  // namespace carom
