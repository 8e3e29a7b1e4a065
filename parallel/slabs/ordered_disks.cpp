#include "parallel/slabs/ordered_disks.hpp"

#include <cstdint>

#include "parallel/ranks/message.hpp"
#include "parallel/slabs/moving_disks.hpp"

namespace carom {

OrderedDisks::OrderedDisks(Ranks& ranks, const Disks& own, DiskId ids)
    : ranks_(ranks), own_(own), some_(no_disks_like(own)) {
  auto size = static_cast<std::int64_t>(own.size());
  ranks.sum({&size, 1});
  size_ = static_cast<Count>(size);
  double most = ids;
  ranks.maximum({&most, 1});
  count_ = id_pieces(static_cast<std::size_t>(most));
}

const Disks& OrderedDisks::piece(std::size_t number) {
  if (!pieces_) pieces_.emplace(own_, count_);
  list_.clear();
  for (const std::uint32_t i : (*pieces_)[number]) list_.push_back(disk_at(own_, i));
  here_.clear();
  put_all(here_, list_);
  const std::vector<Bytes> messages = ranks_.collect(here_);
  truncate(some_, 0);
  if (ranks_.rank() > 0) return some_;
  take(messages);
  for (const Disk& disk : list_) push_back(some_, disk, {.radius = true, .mass = true, .spin = own_.spins()});
  return some_;
}

// Puts all disks of a piece at the places of their ids, and then closes the gaps.
void OrderedDisks::take(const std::vector<Bytes>& messages) {
  list_.resize(ids_a_piece);
  there_.assign(ids_a_piece, 0);
  for (const Bytes& message : messages) {
    MessageReader(message).for_each<Disk>([this](const Disk& disk) {
      const std::size_t at = disk.id & (ids_a_piece - 1);
      list_[at] = disk;
      there_[at] = 1;
    });
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < ids_a_piece; ++k) {
    if (there_[k] != 0) list_[kept++] = list_[k];
  }
  list_.resize(kept);
}

}  // namespace carom
