// Chooses the method and step that a scene needs for an accuracy, with the reason: for carom check --accuracy and
// method = "auto".
#pragma once

#include <string>
#include <vector>

#include "core/load/scene_scales.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// What one method can offer for an accuracy.
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

// Accuracy is the relative error of averages over disks and time that the method causes: of collision rate, pressure
// and cooling rate (with Brownian motion, of the mean square displacement; in scenes that settle, of the energy lost,
// since the number of ever softer collisions has no physical meaning). Statistical errors of a finite run come on top.
// Rollback is never chosen: pairwise is cheaper at every error. Precondition: 0 < accuracy <= most_accuracy.
inline constexpr double most_accuracy = 0.1;  // beyond it the error laws do not hold
MethodChoice choose_method(const Scene& scene, double accuracy);

// The line that reports what method = "auto" chose. Precondition: scene.run.automatic.
std::string choice_text(const Scene& scene);

}  // namespace carom
