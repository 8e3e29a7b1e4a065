// Disks on their way from a rank to its neighbours, a bounded number at a time, so that no rank ever holds a second
// copy of many; and the places in its columns that they leave.
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

// In a message to a neighbour: 180 kB.
inline constexpr std::size_t disks_a_message = std::size_t{1} << 11;

// Disks for each neighbour, by storage index.
struct ForNeighbours {
  std::vector<std::uint32_t> below, above;

  std::size_t most() const { return std::max(below.size(), above.size()); }
};

// A piece of a list of storage indices.
inline std::span<const std::uint32_t> piece_of_list(const std::vector<std::uint32_t>& list, std::size_t begin) {
  const std::size_t from = std::min(list.size(), begin);
  return std::span(list).subspan(from, std::min(list.size() - from, disks_a_message));
}

// Disks that go to a neighbour, with what goes with them; behind how many there are in all its pieces.
inline Bytes message_of(const State& state, std::span<const std::uint32_t> disks, std::size_t in_all) {
  Bytes message;
  message.reserve(2 * sizeof(std::size_t) + disks.size() * sizeof(MovingDisk));
  put(message, in_all);
  put(message, disks.size());
  for (const std::uint32_t i : disks) put(message, moving_disk(state, i));
  return message;
}

// Collective; most: of any rank's lists. expect(below, above): so many will come in all, called once, before the
// others. sent(k): disks with these storage indices have been sent, and may be written over. take(disk, is_from_above):
// one has come; those from one neighbour in the order of its list.
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

// Places that disks have left: others take them, and in the end those that are stored last. Which disk is stored where
// changes by that, which no bit depends on.
class DiskHoles {
 public:
  void add(std::span<const std::uint32_t> places) { places_.insert(places_.end(), places.begin(), places.end()); }

  void take_in(const MovingDisk& moving, DiskColumns columns, State& state) {
    if (places_.empty()) return carom::take_in(state, moving, columns);
    put_at(state.disks, places_.back(), moving.disk);
    take_what_goes_along(state, moving);
    places_.pop_back();
  }

  // From the last hole to the first: what is stored last is then never in another one.
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
