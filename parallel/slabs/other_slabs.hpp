// The exchange with other slabs while a pile on one slab is resolved: as SingleSlab
// (parallel/stepping/support_sweeps.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/physics/support_solver.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/border_rounds.hpp"
#include "parallel/stepping/resolve_contacts.hpp"

namespace carom {

class OtherSlabs {
 public:
  static constexpr bool alone = false;

  OtherSlabs(Ranks& ranks, BorderRounds& rounds) : ranks_(ranks), rounds_(rounds) {}

  bool any(bool here) const { return ranks_.any(here); }
  bool counts(std::size_t patch) const { return rounds_.counts(patch); }

  // Of ghosts this rank has counted only the contacts with its own disks.
  void complete_counts(ContactLists& lists) const { rounds_.refresh(ContactCounts{lists.contacts.data()}); }

  // Joins maxima, and exact sums.
  void add_up(CycleFigures& figures, Watch watch) const {
    std::array<double, 2> largest{figures.largest, figures.strain};
    ranks_.maximum(largest);
    figures.largest = largest[0];
    figures.strain = largest[1];
    if (watch == Watch::all) add_digits(figures.square, figures.ahead);
  }
  void add_up(SupportTotals& totals) const { add_digits(totals.impulse, totals.mass); }

  template <class DisksOf>
  void build(Patches& patches, const Disks& disks, const std::vector<std::uint16_t>& in_contact, std::size_t contacts,
             const Executor& executor, DisksOf&& disks_of) const {
    rounds_.build(patches, disks, in_contact, contacts, executor, disks_of);
  }
  template <class Values>
  auto before(Values values) const {
    return [this, values](std::uint32_t phase, bool backwards) { rounds_.before(phase, backwards, values); };
  }
  template <class Values>
  void refresh(Values values) const {
    rounds_.refresh(values);
  }

 private:
  struct ContactCounts {
    using Value = std::uint16_t;
    std::uint16_t* contacts;
    Value get(std::size_t i) const { return contacts[i]; }
    void set(std::size_t i, Value value) const { contacts[i] = value; }
  };

  void add_digits(ExactSum& a, ExactSum& b) const {
    std::vector<std::int64_t> digits(a.digits().begin(), a.digits().end());
    digits.insert(digits.end(), b.digits().begin(), b.digits().end());
    ranks_.sum(digits);
    const auto half = digits.begin() + static_cast<std::ptrdiff_t>(digits.size() / 2);
    std::copy(digits.begin(), half, a.digits().begin());
    std::copy(half, digits.end(), b.digits().begin());
  }

  Ranks& ranks_;
  BorderRounds& rounds_;
};

}  // namespace carom
