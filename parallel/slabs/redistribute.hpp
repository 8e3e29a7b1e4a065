// The redistribution of disks to the ranks in whose slabs they are.
#pragma once

#include "core/disks/state.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/moving_disks.hpp"
#include "parallel/slabs/slab_cut.hpp"

namespace carom {

// Slabs with about the same number of disks each. own: the disks of the rank, wherever they are. Collective, as all
// functions below unless stated otherwise.
SlabCut cut_by_rows_of_all(Ranks& ranks, const Domain& box, const Disks& own);

// Sends each disk, from any rank, to the rank whose slab it is in.
void redistribute(Ranks& ranks, const SlabCut& cut, DiskColumns columns, State& state);

// All ranks have drawn the same newcomers: each keeps those in its slab. are_first: there were no disks before.
// columns: those of the disks, which get those of the newcomers. Not collective.
void take_newcomers(const SlabCut& cut, int rank, const Disks& newcomers, bool are_first, DiskColumns& columns,
                    Disks& own);

// Sends all disks to rank 0, with their loads; the others have none then.
void collect_on_first(Ranks& ranks, DiskColumns columns, State& state);

}  // namespace carom
