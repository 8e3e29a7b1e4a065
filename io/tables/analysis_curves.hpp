// Curves of analysis.h5, read back for a page that shows them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace carom {

struct AnalysisCurve {
  std::string name;       // such as "g(r)"
  std::vector<double> x;  // time, or what the name says in brackets
  std::vector<double> y;  // NaN where there is no value
  bool in_time = false;
};

// The curves in the file: g(r), S(k), speeds, density, profiles, displacement, autocorrelation, order, pressure and
// collision rate. A curve with more than most_points (>= 2) points is thinned evenly, and its name says so. Throws
// InputError if the file cannot be read.
std::vector<AnalysisCurve> read_analysis_curves(const std::string& path, std::size_t most_points);

}  // namespace carom
