// The disks of all ranks in order of id, on rank 0, a piece at a time.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/disks/disks.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/id_pieces.hpp"

namespace carom {

class OrderedDisks {
 public:
  // own: outlives this, and does not change. ids: larger than all ids of its disks. Collective, but does not read the
  // disks: it costs no more than asking for their number.
  OrderedDisks(Ranks& ranks, const Disks& own, DiskId ids);

  Count size() const { return size_; }  // on all ranks
  std::size_t pieces() const { return count_; }

  // The disks of a piece in order of id, each with a radius and a mass, on rank 0; nothing on the others. Collective.
  const Disks& piece(std::size_t number);

 private:
  void take(const std::vector<Bytes>& messages);

  Ranks& ranks_;
  const Disks& own_;
  Count size_ = 0;
  std::size_t count_ = 0;
  std::optional<IdPieces> pieces_;  // made when the first piece is asked for
  Disks some_;
  // Kept from piece to piece, since fresh memory costs more than the work done in it.
  Bytes here_;
  std::vector<Disk> list_;
  std::vector<unsigned char> there_;
};

}  // namespace carom
