// Files of results: after closing, what was written is in the file, or there is an error.
#include "io/files/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/check.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;

// What a file takes of the disk, with the room that is reserved for it.
std::uint64_t bytes_on_disk(const std::string& path) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0);
  return static_cast<std::uint64_t>(status.st_blocks) * 512;
}

TEST(OutputFile, IsGoneOnWithToTheByte) {
  const test::TestFolder folder("carom_file_gone_on_with");
  const fs::path& base = folder.path();
  const std::string file = base / "series.csv";
  write_file(file, "12345");
  { OutputFile(file, 3).write("x"); }
  EXPECT_EQ(test::text_of(file), "123x");
  { OutputFile whole(file, 4); }
  EXPECT_EQ(test::text_of(file), "123x");
  try {
    const OutputFile longer(file, 5);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), (file + ": has 4 bytes; expected 5 or more, as when the checkpoint was made").c_str());
  }
  EXPECT_EQ(test::text_of(file), "123x") << "nothing may be changed";
  for (const std::uint64_t bytes : {0U, 5U}) EXPECT_THROW(OutputFile(base / "none.csv", bytes), InputError) << bytes;
  EXPECT_FALSE(fs::exists(base / "none.csv"));
  EXPECT_NO_THROW(check_at_least(base, 0)) << "a folder, such as that of a movie's frames";
}

class ReservedRoom : public ::testing::Test {
 protected:
  const test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
  const std::string path_ = folder_.path() / "trajectory.xyz";
};

// What is reserved and not written is no part of the file.
TEST_F(ReservedRoom, IsNoPartOfTheFile) {
  {
    OutputFile file(path_);
    file.write("12");
    file.reserve(4'000'000);
    file.write("345");
    file.flush();
    EXPECT_EQ(fs::file_size(path_), 5U);
  }
  EXPECT_EQ(test::text_of(path_), "12345");
  OutputFile pipe("/dev/null");
  EXPECT_NO_THROW(pipe.reserve(4'000'000)) << "no room can be reserved there";
}

TEST_F(ReservedRoom, IsForTextToCome) {
  constexpr std::size_t some = 3'000'000;
  OutputFile file(path_);
  file.reserve(some);
  if (bytes_on_disk(path_) < some) GTEST_SKIP() << "no room can be reserved on this file system";
  file.write(std::string(some, 'a'));
  file.reserve(some);
  EXPECT_GE(bytes_on_disk(path_), 2 * some);
}

// A run that goes on cuts off the room behind what it keeps, too, which is all that a kill may have left.
TEST_F(ReservedRoom, ThatAKillLeftIsGivenBack) {
  OutputFile killed(path_);
  killed.write("12345");
  killed.reserve(4'000'000);
  killed.flush();
  { OutputFile whole(path_, 5); }
  EXPECT_LT(bytes_on_disk(path_), 1'000'000U);
}

// Else the frames of a few disks would be as many pieces of the file.
TEST_F(ReservedRoom, IsNoneForALittleText) {
  OutputFile file(path_);
  file.write("12345");
  file.reserve(500'000);
  file.flush();
  EXPECT_LT(bytes_on_disk(path_), 400'000U);
}

// Data that fit into the buffer are written when the file is closed.
TEST(OutputFile, AFullDiskIsSeenWhenItIsClosed) {
  EXPECT_THROW(write_file("/dev/full", "a"), RunError);
  OutputFile file("/dev/full");
  file.write("a");
  EXPECT_THROW(file.flush(), RunError);
  OutputFile large("/dev/full");
  EXPECT_THROW(large.write(std::string(1'000'000, 'a')), RunError) << "more than the buffer holds";
}

}  // namespace
}  // namespace carom
