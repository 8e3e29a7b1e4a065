// The suite's results as docs/stability.md and docs/stability.csv.
#pragma once

#include <string>
#include <vector>

#include "tests/stability/verdict.hpp"

namespace carom::stability {

// The whole page: what it shows, the counts, and a Markdown table: a row a case, a column a method, in each cell the
// verdict and the figure that is worst against its bound.
std::string page(const std::vector<CaseResult>& results);

// How many results each verdict has, a line of text.
std::string counts_text(const std::vector<CaseResult>& results);

// A line for every check of every run; the warnings of a run stand with its first check.
std::string csv_table(const std::vector<CaseResult>& results);

}  // namespace carom::stability
