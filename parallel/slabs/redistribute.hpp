// Disks on their way to the ranks in whose slabs they are.
#pragma once

#include "core/disks/state.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/moving_disks.hpp"
#include "parallel/slabs/slab_cut.hpp"

namespace carom {

// Slabs with about as many disks each; own: the disks of the rank, wherever they are. Collective, as all here.
SlabCut cut_by_rows_of_all(Ranks& ranks, const Domain& box, const Disks& own);

// Each disk goes to the rank whose slab it is in, from any other.
void redistribute(Ranks& ranks, const SlabCut& cut, DiskColumns columns, State& state);

// Newcomers that all ranks have drawn alike: each takes those in its slab. are_first: there were no disks before.
// columns: those that the disks have, then with the newcomers'. Not collective.
void take_newcomers(const SlabCut& cut, int rank, const Disks& newcomers, bool are_first, DiskColumns& columns,
                    Disks& own);

// All go to rank 0, with what they bear; the others have none then.
void collect_on_first(Ranks& ranks, DiskColumns columns, State& state);

}  // namespace carom
