// sweep.csv: a row for each run.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/sweep/sweep_plan.hpp"

namespace carom {

// A run that has come to its end.
struct SweepRow {
  const SweepRun* run;
  nlohmann::ordered_json summary;
};

// A line of names: the run, the keys of the sweep, the seed, and the columns from the summaries; then a line for each
// run. Heat, work and the disks taken by sinks have columns if a run has them, one for each side or sink: heat_left.
std::string sweep_table(const std::vector<SweepAxis>& axes, const std::vector<SweepRow>& rows);

}  // namespace carom
