// Disks that move from a rank to its neighbours, a bounded number at a time, so that no rank ever holds a second copy
// of many disks; and the places that they leave in its columns.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "parallel/ranks/message.hpp"
#include "parallel/slabs/moving_disks.hpp"

namespace carom {

// Disks in a message to a neighbour: 180 kB.
inline constexpr std::size_t disks_a_message = std::size_t{1} << 11;

// The disks for each neighbour, by storage index.
struct ForNeighbours {
  std::vector<std::uint32_t> below, above;

  std::size_t most() const { return std::max(below.size(), above.size()); }
};

// A piece of a list of storage indices.
inline std::span<const std::uint32_t> piece_of_list(const std::vector<std::uint32_t>& list, std::size_t begin) {
  const std::size_t from = std::min(list.size(), begin);
  return std::span(list).subspan(from, std::min(list.size() - from, disks_a_message));
}

// A message with disks for a neighbour and the data that belong to them, behind the number of disks in all its pieces.
inline Bytes message_of(const State& state, std::span<const std::uint32_t> disks, std::size_t in_all) {
  Bytes message;
  message.reserve(2 * sizeof(std::size_t) + disks.size() * sizeof(MovingDisk));
  put(message, in_all);
  put(message, disks.size());
  for (const std::uint32_t i : disks) put(message, moving_disk(state, i));
  return message;
}

// Collective. most: the largest number of disks in any rank's lists. expect(below, above) is called once, before the
// others, with the numbers of disks that will come in all. sent(k): the disks with these storage indices have been
// sent, and may be overwritten. take(disk, is_from_above): a disk has come; those from one neighbour come in the order
// of its list.
template <class Expect, class Sent, class Take>
void exchange_disks(Ranks& ranks, const State& state, const ForNeighbours& disks, std::size_t most, Expect&& expect,
                    Sent&& sent, Take&& take) {
  for (std::size_t begin = 0; begin < most; begin += disks_a_message) {
    const auto down = piece_of_list(disks.below, begin);
    const auto up = piece_of_list(disks.above, begin);
    const auto come =
        ranks.exchange(message_of(state, down, disks.below.size()), message_of(state, up, disks.above.size()));
    MessageReader from_below(come.below);
    MessageReader from_above(come.above);
    const auto of_below = from_below.get<std::size_t>();
    const auto of_above = from_above.get<std::size_t>();
    if (begin == 0) expect(of_below, of_above);
    sent(down);
    sent(up);
    for (std::size_t k = from_below.get<std::size_t>(); k > 0; --k) take(from_below.get<MovingDisk>(), false);
    for (std::size_t k = from_above.get<std::size_t>(); k > 0; --k) take(from_above.get<MovingDisk>(), true);
  }
}

// Places left by disks: new disks take them, and in the end the disks that are stored last. This changes which disk is
// stored where, which affects no bit.
class DiskHoles {
 public:
  void add(std::span<const std::uint32_t> places) { places_.insert(places_.end(), places.begin(), places.end()); }

  void take_in(const MovingDisk& moving, DiskColumns columns, State& state) {
    if (places_.empty()) return carom::take_in(state, moving, columns);
    put_at(state.disks, places_.back(), moving.disk);
    take_what_goes_along(state, moving);
    places_.pop_back();
  }

  // From the last hole to the first, so that the disk that is stored last is never in another hole.
  void close(Disks& d) {
    std::sort(places_.begin(), places_.end(), std::greater<>());
    std::size_t n = d.size();
    for (const std::uint32_t hole : places_) copy_within(d, --n, hole);
    truncate(d, n);
    places_.clear();
  }

 private:
  std::vector<std::uint32_t> places_;
};

}  // namespace carom
