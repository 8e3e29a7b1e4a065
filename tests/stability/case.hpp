// The cases of the stability suite: the scene, its changes, and the results required. They are data, read from
// scenes/stability/cases.toml.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/scene/override.hpp"

namespace carom::stability {

// A figure of a run and its required value: |measured - expected| <= bound.
struct Check {
  std::string what;                   // a name listed in measure.hpp
  double expected = 0.0;              // ignored if like_exact
  bool like_exact = false;            // expected is the value measured with the exact method
  bool relative = false;              // the bound is relative to |expected|
  double bound = 0.0;                 // for methods without a bound of their own
  std::map<std::string, double> own;  // bounds by method: time stepping has an error of its order, exact has none
  double bound_of(const std::string& method) const;
};

enum class Takes { less, seconds, minutes };

struct Case {
  std::string name;   // name of the test; letters, digits, _
  std::string title;  // title of the row
  std::string scene;  // file in the folder of the cases, without .toml
  std::vector<Override> changes;
  std::map<std::string, std::vector<Override>> own_changes;  // by method, applied after the others
  std::vector<Check> checks;
  std::vector<std::string> right;  // methods that must be right; others may be wrong if they warn
  Count most_steps = 0;            // a run that needs more steps is ended; 0: no bound
  Takes takes = Takes::less;       // time of its test; tests that take minutes are run only with the parallel engine
  bool every_step = false;         // the worst figures are taken after every step, not only at some of them
};

// Throws InputError.
std::vector<Case> read_cases(const std::string& path);

}  // namespace carom::stability
