// The results of the suite as docs/stability.md and docs/stability.csv.
#pragma once

#include <string>
#include <vector>

#include "tests/stability/verdict.hpp"

namespace carom::stability {

// The whole page: an introduction, the counts, and a Markdown table with a row for each case and a column for each
// method; each cell has the verdict and the figure that is worst relative to its bound.
std::string page(const std::vector<CaseResult>& results);

// The number of results with each verdict, in a line of text.
std::string counts_text(const std::vector<CaseResult>& results);

// A line for every check of every run; the warnings of a run are in the line of its first check.
std::string csv_table(const std::vector<CaseResult>& results);

}  // namespace carom::stability
