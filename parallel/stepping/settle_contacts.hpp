// Resolves the contacts of a step in a scene that settles: impacts, supports and pushing, by patches, with the bits of
// core/reference/step_contacts.cpp.
#pragma once

#include <vector>

#include "core/disks/state.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/physics/resolve.hpp"
#include "core/physics/support_solver.hpp"
#include "parallel/stepping/find_contacts.hpp"
#include "parallel/stepping/id_order.hpp"
#include "parallel/stepping/support_batches.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

struct ContactLists;

// Lists of the settling phase, kept so that a warm step allocates nothing.
struct SettleLists {
  IdOrder pairs;  // the step's contacts
  std::vector<double>
      borne;  // force on each pair, in order of ids: first of the step, or round, before, then of this one
  std::vector<IdPair> placed;          // the pairs in the order of the patches, so that sweeps read them contiguously
  std::vector<unsigned char> holding;  // of each of them: does it bear load?
  SupportBatches batches;
  SupportSet supports;  // an entry for each slot of the batches; velocities end with the patches' spare disks
  std::vector<CycleFigures> figures;  // of each patch in a cycle of sweeps
  std::vector<SupportTotals> totals;  // of each patch
};

// Resolves all pairs found and wall contacts, stores their loads in state.loads, wraps the disks that had contacts, and
// returns the largest squared speed among those.
double settle_contacts(State& state, const StepRules& rules, const FoundContacts& found, const Executor& executor,
                       ContactLists& lists, ImpactTally& tally);

}  // namespace carom
