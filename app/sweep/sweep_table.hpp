// sweep.csv: a row a run.
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

// A line of names: the run, the keys of the sweep, the seed, and what each row takes from a summary; then a line a run.
// Heat, work and what each sink took have columns where a run has them, one a side or sink: heat_left.
std::string sweep_table(const std::vector<SweepAxis>& axes, const std::vector<SweepRow>& rows);

}  // namespace carom
