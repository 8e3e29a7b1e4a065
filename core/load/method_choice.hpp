// Which method and step a scene needs for an accuracy, and why: carom check --accuracy, method = "auto".
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// What the choice rests on, estimated from the scene alone: the same for every run and machine.
struct SceneScales {
  double disks = 0.0;            // sources included, all that they may emit
  double diameter = 0.0;         // of the root mean square radius
  double smallest_radius = 0.0;  // length
  double packing_fraction = 0.0;
  // Root mean square of one component, with what gravity adds while falling, walls that move give to disks at rest, and
  // rough disks get from their spins.
  double speed = 0.0;
  double vibration = 0.0;       // largest angular frequency of a wall that vibrates; 1 / time
  double collision_rate = 0.0;  // of a disk, per unit time: 4 (Z - 1) speed / (sqrt(pi) diameter)
  double stopping = 0.0;      // where disks settle: what one loses that is stopped, over what a collision takes from it
  bool settles = false;       // gravity presses and contacts dissipate: in the end a pile
  bool driven = false;        // by walls that move: how fast disks become is known from a run alone
  bool may_collapse = false;  // infinitely many collisions in finite time are to be expected
};

// Precondition: box and radii of the scene are known and good.
SceneScales scales_of(const Scene& scene);

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
