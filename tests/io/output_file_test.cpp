// Files of results: after closing, what was written is in the file, or there is an error.
#include "io/files/output_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/check.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;

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

// What is reserved and not written is no part of the file.
TEST(OutputFile, RoomIsReservedBehindTheText) {
  const test::TestFolder folder("carom_file_reserved");
  const std::string path = folder.path() / "trajectory.xyz";
  {
    OutputFile file(path);
    file.write("12");
    file.reserve(1'000'000);
    file.write("345");
    file.flush();
    EXPECT_EQ(fs::file_size(path), 5U);
  }
  EXPECT_EQ(test::text_of(path), "12345");
  OutputFile pipe("/dev/null");
  EXPECT_NO_THROW(pipe.reserve(1'000'000)) << "no room can be reserved there";
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
