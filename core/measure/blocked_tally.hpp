// A blocked_sum whose terms come one after the other, or whose disks come in pieces.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/measure/invariants.hpp"

namespace carom {

class BlockedTally {
 public:
  // Adds the next term.
  void add(double term) {
    block_ += term;
    if (++terms_ < sum_block) return;
    total_ += block_;
    block_ = 0.0;
    terms_ = 0;
  }

  // Adds term(i) for each i of order; pieces must come in order of id. The value has the bits of blocked_sum over all
  // disks, for any division into pieces.
  template <class Term>
  void add(std::span<const std::size_t> order, const BlockRunner& run, Term&& term) {
    const std::size_t head = std::min(order.size(), terms_ > 0 ? sum_block - terms_ : 0);
    for (const std::size_t i : order.first(head)) add(term(i));
    const std::span<const std::size_t> rest = order.subspan(head);
    sums_.assign(rest.size() / sum_block, 0.0);
    run(sums_.size(), [&](std::size_t b) {
      double block = 0.0;
      for (const std::size_t i : rest.subspan(b * sum_block, sum_block)) block += term(i);
      sums_[b] = block;
    });
    for (const double sum : sums_) total_ += sum;
    for (const std::size_t i : rest.subspan(sums_.size() * sum_block)) add(term(i));
  }

  double value() const { return terms_ > 0 ? total_ + block_ : total_; }

 private:
  double total_ = 0.0;     // of whole blocks
  double block_ = 0.0;     // of the present, incomplete block
  std::size_t terms_ = 0;  // in the present block
  std::vector<double> sums_;
};

}  // namespace carom
