// The number of disks that each sink took. Sinks are numbered: first the four sides (order of Side), then all [[walls]]
// tables of the scene, whether they are sinks or not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/obstacle.hpp"

namespace carom {

using SinkNumber = std::uint32_t;
inline constexpr SinkNumber no_sink = ~SinkNumber{0};

inline SinkNumber sink_number(Side side) {
  return static_cast<SinkNumber>(side);
}

// The number of a [[walls]] table, by its position in the scene, and of a segment of its wall.
inline SinkNumber sink_number_of_table(std::size_t table) {
  return static_cast<SinkNumber>(all_sides.size() + table);
}
inline SinkNumber sink_number(const Obstacle& piece) {
  return sink_number_of_table(piece.id);
}

// By sink number; sinks beyond the end of the list took none.
using SinkCounts = std::vector<Count>;

// Adds to the count of a sink.
inline void count_taken(SinkCounts& counts, SinkNumber sink, Count disks = 1) {
  if (counts.size() <= sink) counts.resize(std::size_t{sink} + 1);
  counts[sink] += disks;
}

// Counts the disks i of [begin, end) with gone[i] != 0, each for the sink sink_of(i).
template <class SinkOf>
void count_gone(const std::vector<unsigned char>& gone, std::size_t begin, std::size_t end, SinkCounts& taken,
                SinkOf&& sink_of) {
  for (std::size_t i = begin; i < end; ++i) {
    if (gone[i] != 0) count_taken(taken, sink_of(i));
  }
}

inline void add(SinkCounts& counts, const SinkCounts& more) {
  for (std::size_t k = 0; k < more.size(); ++k) count_taken(counts, static_cast<SinkNumber>(k), more[k]);
}

}  // namespace carom
