// Scenes that settle: impacts, supports and pushing of core/reference/step_contacts.cpp, patch by patch.
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
  IdOrder pairs;              // the step's contacts
  std::vector<double> borne;  // the force on each pair in order of ids: of the step, or round, before, then of this one
  std::vector<IdPair> placed;          // the pairs in the order of the patches, so that sweeps read them in a row,
  std::vector<unsigned char> holding;  // and whether each bears load
  SupportBatches batches;
  SupportSet supports;                // an entry a slot of the batches; velocities end with the patches' spare disks
  std::vector<CycleFigures> figures;  // of each patch in a cycle of sweeps
  std::vector<SupportTotals> totals;  // of each patch
};

// Resolves all pairs found and wall contacts, keeps their loads in state.loads, wraps the disks that had contacts, and
// returns the largest squared speed among those.
double settle_contacts(State& state, const StepRules& rules, const FoundContacts& found, const Executor& executor,
                       ContactLists& lists, ImpactTally& tally);

}  // namespace carom
