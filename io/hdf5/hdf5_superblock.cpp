#include "io/hdf5/hdf5_superblock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace carom {

namespace {

constexpr std::size_t superblock_bytes = 48;
constexpr std::size_t version_at = 8, flags_at = 11, end_at = 28, checksum_at = 44;
using Superblock = std::array<unsigned char, superblock_bytes>;

std::uint32_t little_endian(const unsigned char* at) {
  return static_cast<std::uint32_t>(at[0]) | static_cast<std::uint32_t>(at[1]) << 8 |
         static_cast<std::uint32_t>(at[2]) << 16 | static_cast<std::uint32_t>(at[3]) << 24;
}

// Bob Jenkins's lookup3 (2006), as HDF5 applies it to the 44 bytes before the checksum.
std::uint32_t checksum_of(const Superblock& block) {
  std::uint32_t a = 0xdeadbeefU + static_cast<std::uint32_t>(checksum_at);
  std::uint32_t b = a;
  std::uint32_t c = a;
  const auto turn = [](std::uint32_t& x, std::uint32_t& y, std::uint32_t& z, int by) {
    x -= z;
    x ^= std::rotl(z, by);
    z += y;
  };
  std::size_t k = 0;
  for (; k + 12 < checksum_at; k += 12) {
    a += little_endian(&block[k]);
    b += little_endian(&block[k + 4]);
    c += little_endian(&block[k + 8]);
    turn(a, b, c, 4);
    turn(b, c, a, 6);
    turn(c, a, b, 8);
    turn(a, b, c, 16);
    turn(b, c, a, 19);
    turn(c, a, b, 4);
  }
  a += little_endian(&block[k]);
  b += little_endian(&block[k + 4]);
  const auto end = [](std::uint32_t& x, std::uint32_t y, int by) {
    x ^= y;
    x -= std::rotl(y, by);
  };
  end(c, b, 14);
  end(a, c, 11);
  end(b, a, 25);
  end(c, b, 16);
  end(a, c, 4);
  end(b, a, 14);
  end(c, b, 24);
  return c;
}

// Is this a superblock as HDF5 makes it if only the newest format is allowed, and undamaged?
bool is_known(const Superblock& block) {
  constexpr std::array<unsigned char, 8> signature{0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
  return std::memcmp(block.data(), signature.data(), signature.size()) == 0 && block[version_at] == 3 &&
         little_endian(&block[checksum_at]) == checksum_of(block);
}

void put(Superblock& block, std::size_t at, std::uint64_t value, std::size_t bytes) {
  for (std::size_t k = 0; k < bytes; ++k) block[at + k] = static_cast<unsigned char>(value >> (8 * k));
}

// Calls change() with the superblock and the open file; it returns whether to write the superblock.
template <class Change>
bool with_superblock(const std::string& path, Change change) {
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return false;
  Superblock block{};
  bool good = pread(file, block.data(), block.size(), 0) == static_cast<ssize_t>(block.size());
  if (good && is_known(block) && change(block, file)) {
    put(block, checksum_at, checksum_of(block), 4);
    good = pwrite(file, block.data(), block.size(), 0) == static_cast<ssize_t>(block.size());
  }
  close(file);
  return good;
}

}  // namespace

bool make_readable(const std::string& path, std::uint64_t room) {
  return with_superblock(path, [room](Superblock& block, int file) {
    struct stat status {};
    if (fstat(file, &status) != 0) return false;
    const std::uint64_t end = static_cast<std::uint64_t>(status.st_size) + room;
    if (ftruncate(file, static_cast<off_t>(end)) != 0) return false;
    block[flags_at] = 0;
    put(block, end_at, end, 8);
    return true;
  });
}

bool clear_writing_mark(const std::string& path) {
  return with_superblock(path, [](Superblock& block, int) {
    block[flags_at] = 0;
    return true;
  });
}

bool cut_at_end(const std::string& path) {
  bool cut = false;
  const bool read = with_superblock(path, [&cut](const Superblock& block, int file) {
    const std::uint64_t end =
        little_endian(&block[end_at]) | static_cast<std::uint64_t>(little_endian(&block[end_at + 4])) << 32;
    cut = ftruncate(file, static_cast<off_t>(end)) == 0;
    return false;
  });
  return read && cut;
}

}  // namespace carom
