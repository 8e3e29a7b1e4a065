// HDF5 files as Carom writes them: their first bytes, their texts, and the packing of chunks.
#include "io/hdf5/hdf5_output.hpp"

#include <gmock/gmock.h>
#include <hdf5.h>

#include <cmath>
#include <filesystem>
#include <numeric>

#include "core/base/random.hpp"
#include "io/files/output_file.hpp"
#include "io/hdf5/hdf5_superblock.hpp"
#include "io/hdf5/shuffled_deflate.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;

class Superblock : public ::testing::Test {
 protected:
  Superblock() { Hdf5Output(path_, false).close(); }
  const test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
  const std::string path_ = (folder_.path() / "file.h5").string();
};

// The length is stored in 64 bits; the file is sparse.
TEST_F(Superblock, TheEndOfAFileMayLieBeyondFourGigabytes) {
  constexpr std::uint64_t room = std::uint64_t{5} << 30;
  const std::uint64_t before = fs::file_size(path_);
  ASSERT_TRUE(make_readable(path_, room));
  EXPECT_EQ(fs::file_size(path_), before + room);
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_GE(file, 0) << "its checksum must match";
  H5Fclose(file);
  fs::resize_file(path_, before + 2 * room);
  EXPECT_TRUE(cut_at_end(path_));
  EXPECT_EQ(fs::file_size(path_), before + room);
}

// A damaged file, or another kind of file, must not be changed to look whole.
TEST_F(Superblock, OfAnotherFileNothingIsChanged) {
  const std::string whole = test::text_of(path_);
  for (const std::size_t at : {0U, 7U, 8U, 11U, 28U, 35U, 44U}) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    write_file(path_, flipped);
    make_readable(path_, 100);
    clear_writing_mark(path_);
    cut_at_end(path_);
    EXPECT_EQ(test::text_of(path_), flipped) << at;
  }
  write_file(path_, "short");
  EXPECT_FALSE(make_readable(path_, 100));
  EXPECT_EQ(test::text_of(path_), "short");
  EXPECT_FALSE(clear_writing_mark((folder_.path() / "none").string()));
}

// Titles and names are UTF-8 and are marked as such; a text may be empty.
TEST(Hdf5Text, IsUtf8) {
  const test::TestFolder folder("hdf5_text");
  const std::string path = (folder.path() / "file.h5").string();
  Hdf5Output output(path, false);
  output.text("/empty", "");
  output.text("/title", "caf\xc3\xa9");
  output.attribute("/", "unit", std::string());
  const Hdf5Handle set = output.open_dataset("/title");
  const Hdf5Handle type{H5Dget_type(set.get()), H5Tclose};
  EXPECT_EQ(H5Tget_cset(type.get()), H5T_CSET_UTF8);
  EXPECT_EQ(H5Tget_size(type.get()), 5U);
}

// Noise is stored as it is, and all else is packed: in coordinates the low bytes are noise.
TEST(ShuffledDeflate, PacksWhatIsNoNoise) {
  constexpr std::size_t count = 4096, bytes = count * sizeof(double);
  ShuffledDeflate deflate;
  for (const Repetition repetition : {Repetition::runs, Repetition::patterns}) {
    const auto packed_size = [&](const std::vector<double>& values) {
      return deflate.pack(values.data(), bytes, sizeof(double), repetition).size();
    };
    std::vector<double> values(count, 0.5);
    EXPECT_LT(packed_size(values), bytes / 50);
    for (std::uint32_t i = 0; i < count; ++i) values[i] = uniforms(1, Stream::position, i, 0).a;
    const std::size_t noise = packed_size(values);
    EXPECT_LT(noise, bytes * 95 / 100) << "there are few different exponents";
    EXPECT_GT(noise, bytes * 80 / 100);
    for (std::uint32_t i = 0; i < count; ++i) values[i] = std::floor(100.0 * values[i]);
    EXPECT_LT(packed_size(values), bytes / 4);
  }
}

TEST(ShuffledDeflate, FindsPatternsWhereTheyMayBe) {
  std::vector<std::uint32_t> ids(16384);
  std::iota(ids.begin(), ids.end(), 0U);
  const std::size_t bytes = ids.size() * sizeof ids[0];
  ShuffledDeflate deflate;
  const std::size_t as_runs = deflate.pack(ids.data(), bytes, sizeof ids[0], Repetition::runs).size();
  EXPECT_LT(deflate.pack(ids.data(), bytes, sizeof ids[0], Repetition::patterns).size(), as_runs / 10);
}

}  // namespace
}  // namespace carom
