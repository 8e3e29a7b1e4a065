// The reference pair search: a uniform grid without faults F6 to F14 of docs/original.md.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/overlap.hpp"
#include "core/disks/pair.hpp"

namespace carom {

// All pairs that overlap or touch (nearest image), each once, in order of (smaller id, larger id). A disk lies in the
// one cell of its centre and cells are no smaller than the largest diameter, so all partners are in the 3 x 3 cells
// around: no disk is too large for its cell (F6) and no pair is found in two cells (F14). Centres outside the box or on
// an edge belong to the nearest cell (F7, F13); across a periodic side the neighbour is the opposite cell (F10).
std::vector<Pair> find_touching_pairs(const Disks& disks, const Domain& box);

// The deepest overlap of the touching pairs in each of several parts of the box; overlap(i, j) is that of disks i and
// j. O(N) for any mixture of sizes.
std::vector<Overlap> deepest_of_touching_pairs(const Disks& disks, const Domain& box, const BlockRunner& run,
                                               const std::function<double(std::uint32_t, std::uint32_t)>& overlap);

}  // namespace carom
