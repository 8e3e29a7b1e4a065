// The lists of the state of all ranks together, on rank 0, a piece at a time, so that no rank has them whole: what a
// checkpoint is written from (core/disks/state_pieces.hpp).
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
  // own: the state of this rank, with its own disks alone; it outlives this and stays as it is. Collective.
  SharedLists(Ranks& ranks, const State& own);

  // In how many pieces a list comes, and, of all but loads, how many entries it has; on rank 0.
  std::size_t pieces(StateList list) const;
  Count entries(StateList list) const;

  // The entries of a piece on rank 0, as they lie in memory; nothing on the others. Collective; what rank 0 asks for
  // counts. Disks come as they are stored, some of each rank in turn, what goes by id or contact in that order: the
  // order in which rank 0 would have them, had it gathered all.
  Bytes piece(StateList list, std::size_t number);

 private:
  Bytes some_disks(StateList list, std::size_t number) const;
  Bytes some_loads(std::size_t number) const;
  template <class Value>
  Bytes some_by_id(const std::vector<Value>& values, std::size_t number);

  Ranks& ranks_;
  const State& own_;
  DiskColumns columns_;      // of the disks of all ranks
  Count disks_ = 0;          // of all ranks
  std::size_t most_ = 0;     // disks of a rank
  bool any_loads_ = false;   // on any rank
  std::size_t at_once_ = 0;  // disks of a rank in a piece
  std::optional<IdPieces> by_id_;
};

}  // namespace carom
