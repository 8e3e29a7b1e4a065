// The checksum of checkpoints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace carom {

// A 64-bit hash of words of 8 bytes in the machine's order. Each word is combined by a bijection of the hash so far, so
// two inputs that differ in one word never have the same hash; other inputs have it with probability 2^-64. 4 GB a
// second.
class BlockHash {
 public:
  // Precondition: bytes is a multiple of 8.
  void add(const char* data, std::size_t bytes) {
    for (std::size_t at = 0; at < bytes; at += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, data + at, 8);
      hash_ = (hash_ ^ word) * 0x9e3779b97f4a7c15ULL;  // odd, so a bijection; so is the shift
      hash_ ^= hash_ >> 32;
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0x243f6a8885a308d3ULL;
};

}  // namespace carom
