// sweep.csv: a row a run.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/sweep/sweep_plan.hpp"

namespace carom {

// The line of names: the run, the keys of the sweep, the seed, and what each row takes from a summary.
std::string table_head(const std::vector<SweepAxis>& axes);

// The line of a run, of which this many keys are the sweep's.
std::string table_row(const SweepRun& run, std::size_t axes, const nlohmann::ordered_json& summary);

}  // namespace carom
