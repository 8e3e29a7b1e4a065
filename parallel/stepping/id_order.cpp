#include "parallel/stepping/id_order.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

#include "parallel/threads/resize_amply.hpp"

namespace carom {

namespace {

// The approximate number of pairs in a bucket of first ids: few enough to be sorted in the first-level cache.
constexpr std::size_t bucket_pairs = 32;
// Parts of the list that are scattered in parallel; each has its own histogram.
constexpr std::size_t slices = 16;
// Buckets that are sorted in one piece of work.
constexpr std::size_t bucket_block = 64;

struct Slice {
  std::size_t begin, end;
};
Slice slice_of(std::size_t n, std::size_t s) {
  return {n * s / slices, n * (s + 1) / slices};
}

}  // namespace

void sort_by_ids(IdOrder& pairs, DiskId ids, const Executor& executor) {
  const std::size_t n = pairs.found.size();
  resize_amply(pairs.sorted, n);
  const auto bits = static_cast<int>(std::bit_width(std::uint64_t{ids} * bucket_pairs / (n + 1)));
  const int shift = std::min(bits, 31);
  const std::size_t buckets = (ids >> shift) + std::size_t{1};
  const auto bucket_of = [&](const IdPair& p) { return std::min<std::size_t>(p.id1() >> shift, buckets - 1); };
  assign_amply(pairs.counts, slices * buckets, 0U);
  executor.run(slices, [&](std::size_t s) {
    std::uint32_t* const count = &pairs.counts[s * buckets];
    const Slice slice = slice_of(n, s);
    for (std::size_t k = slice.begin; k < slice.end; ++k) ++count[bucket_of(pairs.found[k])];
  });
  std::uint32_t place = 0;
  for (std::size_t b = 0; b < buckets; ++b) {
    for (std::size_t s = 0; s < slices; ++s) {
      std::uint32_t& count = pairs.counts[s * buckets + b];
      place += std::exchange(count, place);
    }
  }
  executor.run(slices, [&](std::size_t s) {
    std::uint32_t* const next = &pairs.counts[s * buckets];
    const Slice slice = slice_of(n, s);
    for (std::size_t k = slice.begin; k < slice.end; ++k) {
      pairs.sorted[next[bucket_of(pairs.found[k])]++] = pairs.found[k];
    }
  });
  // After scattering, the last slice's place in a bucket is the bucket's end.
  const std::uint32_t* const ends = &pairs.counts[(slices - 1) * buckets];
  executor.for_ranges(buckets, bucket_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const auto first = pairs.sorted.begin();
      std::sort(first + (b == 0 ? 0 : ends[b - 1]), first + ends[b],
                [](const IdPair& p, const IdPair& q) { return p.key < q.key; });
    }
  });
}

}  // namespace carom
