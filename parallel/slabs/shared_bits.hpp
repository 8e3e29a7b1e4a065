// Bits that are set by different ranks and shared with all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/ranks/ranks.hpp"

namespace carom {

class SharedBits {
 public:
  // Makes this number of bits, none of them set.
  void clear(std::size_t bits) { numbers_.assign(bits / bits_a_number + 1, 0); }
  // Precondition: no rank has set the bit since clear().
  void set(std::size_t bit) { numbers_[bit / bits_a_number] |= std::int64_t{1} << (bit % bits_a_number); }
  bool is_set(std::size_t bit) const { return (numbers_[bit / bits_a_number] >> (bit % bits_a_number) & 1) != 0; }
  // A bit that any rank has set becomes set on all. Collective.
  void share(Ranks& ranks) { ranks.sum(numbers_); }

 private:
  static constexpr std::size_t bits_a_number = 63;  // without the sign bit
  std::vector<std::int64_t> numbers_;
};

}  // namespace carom
