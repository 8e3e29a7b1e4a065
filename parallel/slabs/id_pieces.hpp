// A rank's disks by ranges of ids: the pieces that all ranks send to rank 0 one at a time if it needs disks in order of
// id.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/disks/disks.hpp"

namespace carom {

// Ids in a piece: a megabyte of disks, so that messages do not have mappings of their own (give_back_columns in
// app/cli).
inline constexpr unsigned id_piece_shift = 14;
inline constexpr std::size_t ids_a_piece = std::size_t{1} << id_piece_shift;

// The number of pieces for ids 0 to ids - 1.
inline std::size_t id_pieces(std::size_t ids) {
  return (ids + ids_a_piece - 1) >> id_piece_shift;
}

class IdPieces {
 public:
  // Precondition: all ids are below count * ids_a_piece.
  IdPieces(const Disks& d, std::size_t count) : ends_(count, 0), disks_(d.size()) {
    for (const DiskId id : d.id) ++ends_[id >> id_piece_shift];
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    std::vector<std::size_t> next(count, 0);
    for (std::size_t p = 1; p < count; ++p) next[p] = ends_[p - 1];
    for (std::size_t i = 0; i < d.size(); ++i) {
      disks_[next[d.id[i] >> id_piece_shift]++] = static_cast<std::uint32_t>(i);
    }
  }

  // Storage indices of the disks of a piece, in any order; empty for a piece that does not exist.
  std::span<const std::uint32_t> operator[](std::size_t piece) const {
    if (piece >= ends_.size()) return {};
    const std::size_t begin = piece == 0 ? 0 : ends_[piece - 1];
    return std::span(disks_).subspan(begin, ends_[piece] - begin);
  }

 private:
  std::vector<std::size_t> ends_;
  std::vector<std::uint32_t> disks_;
};

}  // namespace carom
