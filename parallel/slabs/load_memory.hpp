// What contacts of a pile bore in the step before (State::loads), on several ranks: each has those of its own disks,
// both sides of a border what crosses it. They go with their disks from rank to rank.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/disks/state.hpp"
#include "parallel/ranks/ranks.hpp"

namespace carom {

// The loads of contacts in which one of these disks is. ids: ascending.
std::vector<ContactLoad> loads_of(const std::vector<ContactLoad>& loads, const std::vector<DiskId>& ids);

// Adds more loads, some of which may be there; the list stays in order of ids, each contact once.
void merge_loads(const std::vector<ContactLoad>& more, std::vector<ContactLoad>& loads);

// Only those of the state's own disks stay, and memory is given back.
void keep_own_loads(State& state);

// Those of all ranks, each contact once, on rank 0; nothing on the others. Collective, as the next.
std::vector<ContactLoad> collect_loads(Ranks& ranks, const std::vector<ContactLoad>& own);

// all: on rank 0. state.loads become those of the rank's own disks.
void deal_out_loads(Ranks& ranks, const std::vector<ContactLoad>& all, State& state);

}  // namespace carom
