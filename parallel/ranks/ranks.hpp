// What an engine on several ranks asks of the others. A rank is a process with memory of its own (MpiRanks), or a
// thread that acts like one (LocalRanks); it has a slab of the box, and its neighbours are the ranks whose slabs lie
// below and above. All calls but rank() and count() are collective: every rank makes the same ones in the same order.
// Sums are of whole numbers, since floating-point ones would depend on the order in which ranks are added.
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

  // The last rank is below the first one.
  int below() const { return rank() > 0 ? rank() - 1 : count() - 1; }
  int above() const { return rank() + 1 < count() ? rank() + 1 : 0; }

  struct FromNeighbours {
    Bytes below, above;
  };
  // Sends a message of any length to each neighbour and returns theirs. Of two ranks each is both neighbours of the
  // other; one rank is its own: what it sends up arrives from below.
  FromNeighbours exchange(const Bytes& to_below, const Bytes& to_above) {
    const auto counted = count_in(traffic_.exchange, 2, to_below.size() + to_above.size());
    return send_and_receive(to_below, to_above);
  }

  // values[k] becomes the sum of all ranks' values[k]; all give as many. Precondition: no sum overflows.
  void sum(std::span<std::int64_t> values) {
    const auto counted = count_in(traffic_.all_reduce, 1, values.size_bytes());
    reduce_to_sum(values);
  }
  // values[k] becomes the largest of all ranks' values[k]; all give as many. Precondition: none is NaN.
  void maximum(std::span<double> values) {
    const auto counted = count_in(traffic_.all_reduce, 1, values.size_bytes());
    reduce_to_maximum(values);
  }
  // Does it hold on any rank?
  bool any(bool here) {
    std::int64_t ranks = here ? 1 : 0;
    sum({&ranks, 1});
    return ranks > 0;
  }
  // What each rank gave, in order of ranks, on all of them.
  std::vector<Bytes> gather(const Bytes& here) {
    const auto counted = count_in(traffic_.gather, 1, here.size());
    return gather_from_all(here);
  }

  // The same for rank 0 alone: nothing on the others.
  std::vector<Bytes> collect(const Bytes& here) {
    const auto counted = count_in(traffic_.gather, 1, rank() == 0 ? 0 : here.size());
    return gather_at_first(here);
  }
  // What rank 0 gave, on all of them.
  Bytes share(const Bytes& first) {
    const auto counted = count_in(traffic_.gather, 1, rank() == 0 ? first.size() : 0);
    return share_first(first);
  }

  // What this rank has given to others since it began.
  const Traffic& traffic() const { return traffic_; }

 private:
  // What the functions above are for one kind of rank.
  virtual FromNeighbours send_and_receive(const Bytes& to_below, const Bytes& to_above) = 0;
  virtual void reduce_to_sum(std::span<std::int64_t> values) = 0;
  virtual void reduce_to_maximum(std::span<double> values) = 0;
  virtual std::vector<Bytes> gather_from_all(const Bytes& here) = 0;
  virtual std::vector<Bytes> gather_at_first(const Bytes& here) = 0;
  virtual Bytes share_first(const Bytes& first) = 0;

  // One rank alone gives nothing to others.
  [[nodiscard]] TrafficTimer count_in(Messages& kind, Count messages, std::size_t bytes) {
    if (count() > 1) kind.add({messages, bytes});
    return TrafficTimer(traffic_.seconds);
  }

  Traffic traffic_;
};

}  // namespace carom
