// The loads of the contacts of a pile in the step before (State::loads), on several ranks: each rank has those of its
// own disks, and those across a border are on both of its sides. They move with their disks from rank to rank.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/disks/state.hpp"
#include "parallel/ranks/ranks.hpp"

namespace carom {

// The loads of contacts with one of these disks. ids: ascending.
std::vector<ContactLoad> loads_of(const std::vector<ContactLoad>& loads, const std::vector<DiskId>& ids);

// Adds more loads, some of which the list may already have; the list stays in order of ids, with each contact once.
void merge_loads(const std::vector<ContactLoad>& more, std::vector<ContactLoad>& loads);

// Keeps only the loads of the state's own disks, and frees memory.
void keep_own_loads(State& state);

// The loads of all ranks, each contact once, on rank 0; nothing on the others. Collective, as the next function.
std::vector<ContactLoad> collect_loads(Ranks& ranks, const std::vector<ContactLoad>& own);

// all: on rank 0. Sets state.loads to those of the rank's own disks.
void deal_out_loads(Ranks& ranks, const std::vector<ContactLoad>& all, State& state);

}  // namespace carom
