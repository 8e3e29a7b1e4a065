// The bytes of checkpoints: data written are read back, and data that end too early or have wrong lengths are refused.
#include "io/files/byte_stream.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/files/block_hash.hpp"

namespace carom {
namespace {

template <class... Parts>
std::string written(const Parts&... parts) {
  std::string bytes;
  ByteWriter writer([&](const char* data, std::size_t count) { bytes.append(data, count); });
  writer(parts...);
  return bytes;
}

// Reads the parts; the reader is told that there are `left` bytes. Returns the error.
template <class... Parts>
std::string complaint(const std::string& bytes, std::size_t left, Parts&... parts) {
  std::size_t at = 0;
  ByteReader reader(
      [&](char* to, std::size_t count) {
        bytes.copy(to, count, at);
        at += count;
      },
      left);
  try {
    reader(parts...);
    EXPECT_EQ(reader.left(), left - at);
  } catch (const BadBytes& e) {
    return e.what();
  }
  return "";
}

// The variables read into have other contents before, which must vanish.
TEST(ByteStream, ReadsBackWhatWasWritten) {
  const std::vector<std::string> names{"a", "", "bc"};
  const std::vector<double> numbers{0.5, -0.0};
  const std::optional<int> nothing;
  const std::string bytes = written(7U, true, names, numbers, nothing);
  unsigned first = 0;
  bool flag = false;
  std::vector<std::string> read_names{"old"};
  std::vector<double> read_numbers{1.0, 2.0, 3.0};
  std::optional<int> read_nothing = 5;
  EXPECT_EQ(complaint(bytes, bytes.size(), first, flag, read_names, read_numbers, read_nothing), "");
  EXPECT_EQ(first, 7U);
  EXPECT_TRUE(flag);
  EXPECT_EQ(read_names, names);
  EXPECT_EQ(read_numbers, numbers);
  EXPECT_FALSE(read_nothing.has_value());
}

TEST(ByteStream, RefusesWhatBreaksOff) {
  const std::string bytes = written(std::uint64_t{1});
  std::uint64_t number = 0;
  EXPECT_EQ(complaint(bytes, 7, number), "ends early");
  std::vector<double> list;
  const std::string three = written(std::vector<double>{1.0, 2.0, 3.0});
  EXPECT_EQ(complaint(three, three.size() - 1, list), "has a list longer than itself");
  bool flag = false;
  EXPECT_EQ(complaint("\x02", 1, flag), "has a flag that is neither 0 nor 1");
}

// In words that differ in their highest bit, which a product does not carry further, each must count.
TEST(BlockHash, SeesEachBit) {
  const auto hash_of = [](std::vector<std::uint64_t> words) {
    BlockHash hash;
    hash.add(reinterpret_cast<const char*>(words.data()), 8 * words.size());
    return hash.value();
  };
  constexpr std::uint64_t high = std::uint64_t{1} << 63U;
  EXPECT_NE(hash_of({1, 2}), hash_of({1 ^ high, 2 ^ high}));
  EXPECT_NE(hash_of({1, 2}), hash_of({2, 1}));
  EXPECT_NE(hash_of({0}), hash_of({0, 0}));
}

}  // namespace
}  // namespace carom
