// Which method and step a scene needs for an accuracy, and why: carom check --accuracy, method = "auto".
#pragma once

#include <string>
#include <vector>

#include "core/load/scene_scales.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// One method for an accuracy.
struct MethodOffer {
  Method method = Method::exact;
  bool possible = false;
  double dt = 0.0;       // 0 where the method needs none
  double error = 0.0;    // relative, predicted
  double seconds = 0.0;  // CPU seconds of the whole run on one thread, from core/load/method_rates.hpp
  std::string why;       // why so, or why not
};

struct MethodChoice {
  SceneScales scales;
  std::vector<MethodOffer> offers;  // pairwise, exact
  int best = -1;                    // the cheapest possible one; -1: none, and `why` says what to do
  std::string why;
};

// Accuracy is the relative error, through the method alone, of what is averaged over disks and time: collision rate,
// pressure, cooling rate (Brownian motion: mean square displacement; scenes that settle: the energy lost, as the number
// of ever softer hits is no number of the physics). What a finite run scatters comes on top. Rollback is never chosen:
// pairwise is cheaper at every error. Precondition: 0 < accuracy <= most_accuracy.
inline constexpr double most_accuracy = 0.1;  // beyond it the laws of errors no longer hold
MethodChoice choose_method(const Scene& scene, double accuracy);

// The line that reports what method = "auto" chose. Precondition: scene.run.automatic.
std::string choice_text(const Scene& scene);

}  // namespace carom
