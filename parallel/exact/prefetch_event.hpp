// Prefetches the data of an event some events before it comes. The functions are inlined, since g++ 12 drops calls of
// functions that only prefetch.
#pragma once

#include <cstddef>
#include <cstdint>

#include "parallel/exact/disk_record.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/worker.hpp"

namespace carom {

// Four at a time, as in a prediction.
[[gnu::always_inline]] inline void prefetch_neighbours(const DiskRecord* record, const NeighbourLists& lists,
                                                       std::uint32_t i) {
  const ListRow& row = lists.rows().row(i);
  // Offsets are added in bytes: with records, compilers would add i to each offset first.
  const char* const own = reinterpret_cast<const char*>(record + i);
  const auto prefetch = [own](std::int16_t offset) __attribute__((always_inline)) {
    __builtin_prefetch(own + std::ptrdiff_t{offset} * std::ptrdiff_t{sizeof(DiskRecord)});
  };
  static_assert(row_offsets % row_padding == 0 && row_padding == 4);
  const std::int16_t* offset = row.offset;
  const std::int16_t* const end = offset + row.count;
  do {
    prefetch(offset[0]);
    prefetch(offset[1]);
    prefetch(offset[2]);
    prefetch(offset[3]);
    offset += row_padding;
  } while (offset < end);
}

// For an event of disk i. Stage 0 prefetches the disk and its list; stage 1, when those have come, its neighbours, its
// partner and the partner's list, or the cells that are searched if it is relisted; stage 2 the partner's neighbours.
// Reads nothing outside the worker's region.
[[gnu::always_inline]] inline void prefetch_event(const DiskRecord* record, const NeighbourLists& lists,
                                                  const Worker& worker, std::uint32_t i, int stage) {
  if (stage == 0) {
    __builtin_prefetch(&record[i]);
    lists.prefetch(i);
    return;
  }
  if (stage == 1) prefetch_neighbours(record, lists, i);
  const Partner partner = record[i].partner;
  if (stage == 1 && partner.is_relist()) {
    const double time = worker.calendar.time_of(i);
    lists.prefetch_search(record[i].path, record[i].radius, time, lists.relist_distance_elsewhere());
    return;
  }
  if (!partner.is_disk() || !worker.region.holds(partner.index())) return;
  const std::uint32_t j = partner.index();
  if (stage == 1) {
    __builtin_prefetch(&record[j]);
    lists.prefetch(j);
    worker.calendar.prefetch(j);
  } else {
    prefetch_neighbours(record, lists, j);
  }
}

}  // namespace carom
