// Communication between ranks. A rank is a process with its own memory (MpiRanks), or a thread that acts like one
// (LocalRanks). It has a slab of the box; its neighbours are the ranks whose slabs lie below and above. All calls but
// rank() and count() are collective: every rank makes the same calls in the same order. Sums are of whole numbers,
// since floating-point sums would depend on the order of the ranks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "parallel/ranks/traffic.hpp"

namespace carom {

using Bytes = std::vector<std::byte>;

class Ranks {
 public:
  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  virtual ~Ranks() = default;

  virtual int rank() const = 0;   // 0 to count() - 1, from the bottom of the box to its top
  virtual int count() const = 0;  // >= 1

  // The neighbours; the last rank is below the first one.
  int below() const { return rank() > 0 ? rank() - 1 : count() - 1; }
  int above() const { return rank() + 1 < count() ? rank() + 1 : 0; }

  struct FromNeighbours {
    Bytes below, above;
  };
  // Sends a message of any length to each neighbour and returns theirs. With two ranks, each is both neighbours of the
  // other; a single rank is its own neighbour: its message upwards arrives from below.
  FromNeighbours exchange(const Bytes& to_below, const Bytes& to_above) {
    const auto counted = count_in(traffic_.exchange, 2, to_below.size() + to_above.size());
    return send_and_receive(to_below, to_above);
  }

  // Sets values[k] to the sum of all ranks' values[k]. Preconditions: all have the same number of values, and no sum
  // overflows.
  void sum(std::span<std::int64_t> values) {
    const auto counted = count_in(traffic_.all_reduce, 1, values.size_bytes());
    reduce_to_sum(values);
  }
  // Sets values[k] to the largest of all ranks' values[k]. Preconditions: all have the same number of values, and none
  // is NaN.
  void maximum(std::span<double> values) {
    const auto counted = count_in(traffic_.all_reduce, 1, values.size_bytes());
    reduce_to_maximum(values);
  }
  // Is `here` true on any rank?
  bool any(bool here) {
    std::int64_t ranks = here ? 1 : 0;
    sum({&ranks, 1});
    return ranks > 0;
  }
  // Returns the entries of all ranks, in order, on every rank.
  std::vector<Bytes> gather(const Bytes& here) {
    const auto counted = count_in(traffic_.gather, 1, here.size());
    return gather_from_all(here);
  }

  // The same on rank 0 only; empty on the others.
  std::vector<Bytes> collect(const Bytes& here) {
    const auto counted = count_in(traffic_.gather, 1, rank() == 0 ? 0 : here.size());
    return gather_at_first(here);
  }
  // Returns the entry of rank 0 on every rank.
  Bytes share(const Bytes& first) {
    const auto counted = count_in(traffic_.gather, 1, rank() == 0 ? first.size() : 0);
    return share_first(first);
  }

  // The messages and bytes that this rank has sent so far.
  const Traffic& traffic() const { return traffic_; }

 private:
  // The functions above for one kind of ranks.
  virtual FromNeighbours send_and_receive(const Bytes& to_below, const Bytes& to_above) = 0;
  virtual void reduce_to_sum(std::span<std::int64_t> values) = 0;
  virtual void reduce_to_maximum(std::span<double> values) = 0;
  virtual std::vector<Bytes> gather_from_all(const Bytes& here) = 0;
  virtual std::vector<Bytes> gather_at_first(const Bytes& here) = 0;
  virtual Bytes share_first(const Bytes& first) = 0;

  // A single rank sends nothing.
  [[nodiscard]] TrafficTimer count_in(Messages& kind, Count messages, std::size_t bytes) {
    if (count() > 1) kind.add({messages, bytes});
    return TrafficTimer(traffic_.seconds);
  }

  Traffic traffic_;
};

}  // namespace carom
