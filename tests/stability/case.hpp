// The cases of the stability suite: which scene, with which changes, and what must come out. Data only, read from
// scenes/stability/cases.toml.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/scene/override.hpp"

namespace carom::stability {

// One figure of a run and what it must be: |measured - expected| <= bound.
struct Check {
  std::string what;                   // a name listed in measure.hpp
  double expected = 0.0;              // ignored where like_exact
  bool like_exact = false;            // expected is what the exact method measures
  bool relative = false;              // the bound is a share of |expected|
  double bound = 0.0;                 // for methods that have none of their own
  std::map<std::string, double> own;  // bounds by method: time stepping has an error of its order, exact has none
  double bound_of(const std::string& method) const;
};

enum class Takes { less, seconds, minutes };

struct Case {
  std::string name;   // of the test; letters, digits, _
  std::string title;  // of the row
  std::string scene;  // file in the folder of the cases, without .toml
  std::vector<Override> changes;
  std::map<std::string, std::vector<Override>> own_changes;  // by method, after the others
  std::vector<Check> checks;
  std::vector<std::string> right;  // methods that must be right; the others may be wrong if they say so
  Count most_steps = 0;            // a run that needs more is ended; 0: no bound
  Takes takes = Takes::less;       // of its test; those that take minutes are run by the parallel engine alone
  bool every_step = false;         // what is worst is looked for after every step, not at some moments
};

// Throws InputError.
std::vector<Case> read_cases(const std::string& path);

}  // namespace carom::stability
