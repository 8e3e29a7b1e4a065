#include "parallel/cells/compact.hpp"

#include <cstddef>
#include <tuple>

#include "core/disks/disk_columns.hpp"

namespace carom {

namespace {

constexpr std::size_t compact_block = 16384;

// first: the new index of each block's first remaining entry, from their counts scanned in block order.
template <class T>
void close_up(std::vector<T>& column, std::vector<T>& scratch, const std::vector<unsigned char>& gone,
              const std::vector<std::size_t>& first, const Executor& executor) {
  if (column.empty()) return;
  scratch.resize(first.back());
  executor.for_ranges(column.size(), compact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::size_t at = first[b];
    for (std::size_t i = begin; i < end; ++i) {
      if (gone[i] == 0) scratch[at++] = column[i];
    }
  });
  column.swap(scratch);
}

}  // namespace

void remove_in_parallel(Disks& d, const std::vector<unsigned char>& gone, const Executor& executor,
                        std::vector<double>& column, std::vector<DiskId>& ids) {
  const std::size_t blocks = executor.blocks(d.size(), compact_block);
  std::vector<std::size_t> first(blocks + 1, 0);
  executor.for_ranges(d.size(), compact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::size_t kept = 0;
    for (std::size_t i = begin; i < end; ++i) kept += gone[i] == 0 ? 1U : 0U;
    first[b + 1] = kept;
  });
  for (std::size_t b = 0; b < blocks; ++b) first[b + 1] += first[b];
  for_each_column(d, [&](auto& entries) {
    auto& scratch = std::get<decltype(entries)>(std::tie(column, ids));  // of the same type
    close_up(entries, scratch, gone, first, executor);
  });
}

}  // namespace carom
