// What an engine on several ranks asks of the others. A rank is a process with memory of its own (MpiRanks), or a
// thread that acts like one (LocalRanks); it has a slab of the box, and its neighbours are the ranks whose slabs lie
// below and above. All calls but rank() and count() are collective: every rank makes the same ones in the same order.
// Sums are of whole numbers, since floating-point ones would depend on the order in which ranks are added.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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
  virtual FromNeighbours exchange(const Bytes& to_below, const Bytes& to_above) = 0;

  // values[k] becomes the sum of all ranks' values[k]; all give as many. Precondition: no sum overflows.
  virtual void sum(std::span<std::int64_t> values) = 0;
  // values[k] becomes the largest of all ranks' values[k]; all give as many. Precondition: none is NaN.
  virtual void maximum(std::span<double> values) = 0;
  // Does it hold on any rank?
  bool any(bool here) {
    std::int64_t ranks = here ? 1 : 0;
    sum({&ranks, 1});
    return ranks > 0;
  }
  // What each rank gave, in order of ranks, on all of them.
  virtual std::vector<Bytes> gather(const Bytes& here) = 0;
};

}  // namespace carom
