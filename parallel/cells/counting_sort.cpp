#include "parallel/cells/counting_sort.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <tuple>
#include <utility>

#include "core/base/huge_pages.hpp"
#include "core/disks/disk_columns.hpp"

namespace carom {

namespace {

// Disks in a block: enough that a block's histogram of buckets is small beside it.
constexpr std::size_t sort_block = 32768;
// The first digit has at most this many values: a histogram that stays in the first-level cache.
constexpr std::uint32_t most_buckets = 1024;
// Disks in a block of simple passes over a column.
constexpr std::size_t pass_block = 16384;

std::uint32_t key_of_disk(const Disks& d, const CellGrid& grid, std::size_t i) {
  if (d.radius.empty() || grid.levels.size() == 1) return key_of(grid.levels[0], d.x[i], d.y[i]);
  return key_of(grid.levels[class_of_radius(d.radius[i], grid.levels[0].largest_radius)], d.x[i], d.y[i]);
}

struct Buckets {
  int shift;            // key >> shift is the bucket
  std::uint32_t count;  // of buckets
};

Buckets buckets_for(std::uint32_t keys) {
  const int bits = static_cast<int>(std::bit_width(keys / most_buckets));
  return {bits, (keys >> bits) + 1};
}

// First digit: scatters disks to buckets. counts becomes, for each (block, bucket), the place of its first disk.
void scatter_to_buckets(const Disks& d, const CellGrid& grid, const Executor& executor, Buckets buckets,
                        SortedCells& cells) {
  const std::size_t n = d.size();
  const std::size_t blocks = executor.blocks(n, sort_block);
  cells.counts.assign(blocks * buckets.count, 0);
  executor.for_ranges(n, sort_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::uint32_t* count = &cells.counts[b * buckets.count];
    for (std::size_t i = begin; i < end; ++i) {
      cells.key[i] = key_of_disk(d, grid, i);
      ++count[cells.key[i] >> buckets.shift];
    }
  });
  std::uint32_t place = 0;
  for (std::uint32_t bucket = 0; bucket < buckets.count; ++bucket) {
    for (std::size_t b = 0; b < blocks; ++b) {
      std::uint32_t& count = cells.counts[b * buckets.count + bucket];
      place += std::exchange(count, place);
    }
  }
  executor.for_ranges(n, sort_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::uint32_t* next = &cells.counts[b * buckets.count];
    for (std::size_t i = begin; i < end; ++i) {
      cells.pass[next[cells.key[i] >> buckets.shift]++] = static_cast<std::uint32_t>(i);
    }
  });
}

// Second digit: sorts each bucket by itself. start holds first the counts, then the running places, and at the end the
// first disk of each cell.
void sort_buckets(const Executor& executor, Buckets buckets, std::uint32_t keys, std::size_t n, SortedCells& cells) {
  const std::size_t last_block = executor.blocks(n, sort_block) - 1;
  executor.run(buckets.count, [&](std::size_t bucket) {
    // After scattering, the last block's place in a bucket is the bucket's end.
    const std::uint32_t* ends = &cells.counts[last_block * buckets.count];
    const std::uint32_t begin = bucket == 0 ? 0 : ends[bucket - 1];
    const std::uint32_t end = ends[bucket];
    const auto first = static_cast<std::uint32_t>(bucket << buckets.shift);
    const auto last = static_cast<std::uint32_t>(std::min<std::size_t>(keys, (bucket + 1) << buckets.shift));
    std::uint32_t* start = cells.start.data();
    for (std::uint32_t k = first; k < last; ++k) start[k] = 0;
    for (std::uint32_t p = begin; p < end; ++p) ++start[cells.key[cells.pass[p]]];
    std::uint32_t place = begin;
    for (std::uint32_t k = first; k < last; ++k) place += std::exchange(start[k], place);
    for (std::uint32_t p = begin; p < end; ++p) cells.order[start[cells.key[cells.pass[p]]]++] = cells.pass[p];
    for (std::uint32_t k = last; k-- > first + 1;) start[k] = start[k - 1];
    if (first < last) start[first] = begin;
  });
  cells.start[keys] = static_cast<std::uint32_t>(n);
}

template <class T>
void move_column(std::vector<T>& column, std::vector<T>& scratch, const std::vector<std::uint32_t>& order,
                 const Executor& executor) {
  grow_in_huge_pages(scratch, column.size());
  executor.for_ranges(column.size(), pass_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) scratch[k] = column[order[k]];
  });
  column.swap(scratch);
}

}  // namespace

void sort_into_cells(Disks& d, const CellGrid& grid, const Executor& executor, SortedCells& cells) {
  const std::size_t n = d.size();
  grow_in_huge_pages(cells.key, n);
  grow_in_huge_pages(cells.order, n);
  grow_in_huge_pages(cells.pass, n);
  cells.start.resize(grid.keys + std::size_t{1});
  if (n == 0) {
    std::fill(cells.start.begin(), cells.start.end(), 0U);
    return;
  }
  const Buckets buckets = buckets_for(grid.keys);
  scatter_to_buckets(d, grid, executor, buckets, cells);
  sort_buckets(executor, buckets, grid.keys, n, cells);
  for_each_column(d, [&](auto& column) {
    auto& scratch = std::get<decltype(column)>(std::tie(cells.column, cells.pass));  // of the same type
    if (!column.empty()) move_column(column, scratch, cells.order, executor);
  });
  move_column(cells.key, cells.pass, cells.order, executor);
}

void release_sort_scratch(SortedCells& cells) {
  for (std::vector<std::uint32_t>* scratch : {&cells.key, &cells.order, &cells.pass, &cells.counts}) {
    std::vector<std::uint32_t>().swap(*scratch);
  }
  std::vector<double>().swap(cells.column);
}

}  // namespace carom
