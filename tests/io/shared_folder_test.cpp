// Two runs that want the same folder: one gets it, and the other gets an error.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/base/check.hpp"
#include "io/files/output_file.hpp"
#include "io/files/output_folder.hpp"
#include "tests/support/folder_refusal.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class SharedFolder : public ::testing::Test {
 protected:
  SharedFolder() { write_file(input_, "scene"); }

  std::string refusal(const fs::path& folder, bool force) const { return test::folder_refusal(folder, input_, force); }
  const test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
  const fs::path base_ = folder_.path();
  const fs::path input_ = base_ / "input.toml";
};

// A program may run scenes side by side: each folder stays locked for one of them, whatever the others begin and end.
TEST_F(SharedFolder, ThreadsHaveFoldersOfTheirOwn) {
  std::atomic<int> refused = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&, t] {
        for (int k = 0; k < 50; ++k) {
          const fs::path folder = base_ / std::to_string(t) / std::to_string(k);
          const OutputFolder out(folder, input_, false);
          try {
            const OutputFolder again(folder);
          } catch (const InputError&) {
            ++refused;
          }
        }
      });
    }
  }
  EXPECT_EQ(refused, 200);
}

// A run is killed just after it has forked a child that has not yet reached its exec: the child has all file
// descriptors of the run, but must not keep its lock.
TEST_F(SharedFolder, TheLockGoesWithTheProcess) {
  std::array<int, 2> held{};
  std::array<int, 2> child_may_end{};
  ASSERT_EQ(pipe(held.data()), 0);
  ASSERT_EQ(pipe(child_may_end.data()), 0);
  const fs::path folder = base_ / "out";
  const pid_t run = fork();
  if (run == 0) {
    OutputFolder out(folder, input_, false);
    out.keep_unfinished();
    char byte = 0;
    if (fork() == 0) {
      close(child_may_end[1]);
      _exit(read(child_may_end[0], &byte, 1) == 0 ? 0 : 1);
    }
    if (write(held[1], &byte, 1) != 1) _exit(1);
    pause();
  }
  close(child_may_end[0]);
  char byte = 0;
  ASSERT_EQ(read(held[0], &byte, 1), 1);
  EXPECT_THAT(refusal(folder, true), HasSubstr("another run is writing there"));
  EXPECT_THROW(OutputFolder{folder}, InputError);
  ASSERT_EQ(kill(run, SIGKILL), 0);
  ASSERT_EQ(waitpid(run, nullptr, 0), run);
  EXPECT_EQ(refusal(folder, true), "");
  EXPECT_NO_THROW(OutputFolder{folder});
  for (const int end : {held[0], held[1], child_may_end[1]}) close(end);
}

TEST_F(SharedFolder, OneProcessLocksAFolderOnce) {
  const fs::path folder = base_ / "out";
  {
    const OutputFolder first(folder, input_, false);
    EXPECT_THAT(refusal(folder, true), HasSubstr("another run is writing there"));
    EXPECT_THROW(OutputFolder{folder}, InputError);
  }
  OutputFolder(folder, input_, false).finish();
  EXPECT_FALSE(fs::exists(folder / "carom-unfinished"));
}

// Another run makes the folder and removes it again, just when this run tests it or is about to make a folder in it.
TEST_F(SharedFolder, AnotherRunFindsOutWhetherItMayWriteThere) {
  const fs::path folder = base_ / "shared" / "run";
  std::atomic<bool> done{false};
  std::thread other([&] {
    for (std::error_code error; !done;) {
      fs::create_directories(folder, error);
      fs::remove(folder, error) && fs::remove(folder.parent_path(), error);
    }
  });
  std::string said;
  for (int k = 0; k < 100 && said.empty(); ++k) said = refusal(folder, false);
  for (int k = 0; k < 20 && said.empty(); ++k) {
    try {
      OutputFolder out(folder, input_, true);
      write_file(out.path("summary.json"), "{}");
      out.finish();
    } catch (const std::exception& e) {
      said = e.what();
    }
    std::error_code error;
    fs::remove_all(folder, error);
  }
  done = true;
  other.join();
  EXPECT_EQ(said, "");
}

// Both runs find no folder. Once the second removed what the first had made and locked meanwhile.
TEST_F(SharedFolder, OfTwoThatBeginAtOnceOneWrites) {
  const fs::path folder = base_ / "out";
  for (int k = 0; k < 150; ++k) {
    std::array<std::unique_ptr<OutputFolder>, 2> runs;
    std::atomic<int> ready{0};
    const auto begin = [&](std::unique_ptr<OutputFolder>& run) {
      for (++ready; ready < 2;) std::this_thread::yield();
      try {
        run = std::make_unique<OutputFolder>(folder, input_, true);
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("another run is writing there"));
      }
    };
    std::thread other(begin, std::ref(runs[0]));
    begin(runs[1]);
    other.join();
    ASSERT_NE(runs[0] == nullptr, runs[1] == nullptr) << k;
  }
}

// The folder of a run that is still writing: a second run removes nothing; and a run that has ended gives up its lock.
TEST_F(SharedFolder, WhoComesSecondTakesNothingAway) {
  const fs::path folder = base_ / "out";
  {
    OutputFolder first(folder, input_, false);
    write_file(first.path("series.csv"), "t\n");
    EXPECT_TRUE(is_being_written(folder));
    EXPECT_THROW(OutputFolder{folder}, InputError);
    EXPECT_EQ(test::text_of(folder / unfinished_name / "series.csv"), "t\n");
    first.keep_unfinished();
  }
  EXPECT_FALSE(is_being_written(folder));
  OutputFolder second{folder};
  EXPECT_TRUE(is_being_written(folder));
  second.finish();
  EXPECT_FALSE(is_being_written(folder));
}

// Runs of one scene that start at once all find the same folder free. Those that come later take the next names.
TEST_F(SharedFolder, OfSeveralThatBeginAtOnceEachHasAFolder) {
  const UsualFolder found{base_ / "out", base_ / "out"};
  std::array<std::unique_ptr<OutputFolder>, 4> runs;
  std::atomic<int> ready{0};
  {
    std::vector<std::jthread> threads;
    for (std::unique_ptr<OutputFolder>& run : runs) {
      threads.emplace_back([&] {
        for (++ready; ready < 4;) std::this_thread::yield();
        run = std::make_unique<OutputFolder>(found, input_);
      });
    }
  }
  std::vector<std::string> names;
  for (const auto& run : runs) names.push_back(fs::path(run->name()).filename().string());
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("out", "out-2", "out-3", "out-4"));
}

// Two runs that are shorter than the making of a folder: one may begin and end between the other's test of the folder
// and its lock, and its results must stay.
TEST_F(SharedFolder, OfTwoShortOnesTheFirstStays) {
  for (int k = 0; k < 150; ++k) {
    const fs::path folder = base_ / std::to_string(k);
    std::atomic<int> ready{0}, done{0};
    const auto make = [&] {
      for (++ready; ready < 2;) std::this_thread::yield();
      try {
        OutputFolder run(folder, input_, false);
        write_file(run.path("summary.json"), "{}");
        run.finish();
        ++done;
      } catch (const InputError&) {
      }
    };
    std::thread other(make);
    make();
    other.join();
    ASSERT_EQ(done, 1) << k;
  }
}

// A run that ends may remove the folder that another is about to lock.
TEST_F(SharedFolder, AFolderThatHasGoneIsNotLocked) {
  FolderLock lock;
  EXPECT_FALSE(lock.take(base_ / "gone"));
  fs::create_directory(base_ / "there");
  EXPECT_TRUE(lock.take(base_ / "there"));
}

}  // namespace
}  // namespace carom
