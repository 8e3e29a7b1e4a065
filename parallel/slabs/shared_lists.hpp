// The lists of the state of all ranks together, on rank 0, a piece at a time, so that no rank has them whole: a
// checkpoint is written from them (core/disks/state_pieces.hpp).
#pragma once

#include <cstddef>
#include <optional>

#include "core/disks/state_pieces.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/id_pieces.hpp"
#include "parallel/slabs/moving_disks.hpp"

namespace carom {

class SharedLists {
 public:
  // own: the state of this rank, with only its own disks; it outlives this and does not change. Collective.
  SharedLists(Ranks& ranks, const State& own);

  // The number of pieces of a list, and of its entries, except for loads; on rank 0.
  std::size_t pieces(StateList list) const;
  Count entries(StateList list) const;

  // The entries of a piece on rank 0, as they are in memory; nothing on the others. Collective; the arguments of rank 0
  // are used. Columns of disks come in order of storage, some disks of each rank in turn, and what is stored by id or
  // by contact in that order: rank 0 would have the same order if it had gathered everything.
  Bytes piece(StateList list, std::size_t number);

 private:
  Bytes some_disks(StateList list, std::size_t number) const;
  Bytes some_loads(std::size_t number) const;
  template <class Value>
  Bytes some_by_id(const std::vector<Value>& values, std::size_t number);

  Ranks& ranks_;
  const State& own_;
  DiskColumns columns_;      // of all ranks
  Count disks_ = 0;          // on all ranks
  std::size_t most_ = 0;     // the largest number of a rank
  bool any_loads_ = false;   // on any rank
  std::size_t at_once_ = 0;  // disks of each rank in a piece
  std::optional<IdPieces> by_id_;
};

}  // namespace carom
