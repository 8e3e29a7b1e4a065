// Bits of which each rank sets some, and all ranks see all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/ranks/ranks.hpp"

namespace carom {

class SharedBits {
 public:
  // So many, none of them set.
  void clear(std::size_t bits) { numbers_.assign(bits / bits_a_number + 1, 0); }
  // Precondition: no other rank sets it, and none has since they were cleared.
  void set(std::size_t bit) { numbers_[bit / bits_a_number] |= std::int64_t{1} << (bit % bits_a_number); }
  bool is_set(std::size_t bit) const { return (numbers_[bit / bits_a_number] >> (bit % bits_a_number) & 1) != 0; }
  // Whatever a rank has set is set on all. Collective.
  void share(Ranks& ranks) { ranks.sum(numbers_); }

 private:
  static constexpr std::size_t bits_a_number = 63;  // without the sign's
  std::vector<std::int64_t> numbers_;
};

}  // namespace carom
