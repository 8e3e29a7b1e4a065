// A set of disks by storage index that numbers its disks in order, without a search.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

class PlaceSet {
 public:
  // Makes the set empty, for n disks.
  void clear(std::size_t n) {
    words_.assign(n / places_a_word + 1, 0);
    before_.clear();
  }
  void insert(std::uint32_t place) { words_[place / places_a_word] |= bit_of(place); }
  // Must be called after the last insert().
  void count() {
    before_.resize(words_.size());
    std::uint32_t sum = 0;
    for (std::size_t w = 0; w < words_.size(); ++w) {
      before_[w] = sum;
      sum += static_cast<std::uint32_t>(std::popcount(words_[w]));
    }
  }
  // The number of disks of the set that are stored before this one. Precondition: count() has been called since the
  // last insert().
  std::uint32_t number_of(std::uint32_t place) const {
    const std::size_t w = place / places_a_word;
    return before_[w] + static_cast<std::uint32_t>(std::popcount(words_[w] & (bit_of(place) - 1)));
  }

 private:
  static constexpr std::uint32_t places_a_word = 64;
  static constexpr std::uint64_t bit_of(std::uint32_t place) { return std::uint64_t{1} << (place % places_a_word); }

  std::vector<std::uint64_t> words_;
  std::vector<std::uint32_t> before_;  // for each word: the number of disks in the words before it
};

}  // namespace carom
