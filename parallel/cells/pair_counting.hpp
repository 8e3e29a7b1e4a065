// Counting pairs by distance on all threads.
#pragma once

#include "core/measure/pair_distances.hpp"

namespace carom {

// Counts as count_pairs does, on so many threads: rows of cells are counted apart, and whole numbers add up to the same
// in any order.
PairCounter parallel_pair_counter(int threads);

}  // namespace carom
