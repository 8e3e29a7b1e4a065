// The plan of a wide scene, from which its text is made.
#pragma once

#include <string>

#include "tests/fuzz_scenes/dice.hpp"
#include "tests/fuzz_scenes/random_disks.hpp"

namespace carom::fuzz {

struct WideDraft {
  bool for_oracle = false;  // only disks, walls, periodic sides, gravity, restitution, shear
  std::string method;
  Units units;
  double radius = 0.0;  // the largest radius of most disks
  double ratio = 1.0;   // the largest ratio of their radii
  double giant = 0.0;   // radius of a few other disks; 0: none
  std::size_t giants = 0;
  std::size_t disks = 0;  // number without giants
  double packing = 0.0;   // their area over that of the box
  double width = 0.0, height = 0.0;
  bool periodic_x = false, periodic_y = false;
  double shear = 0.0;
  double thermal = 0.0, flow = 0.0;  // speeds
  double gravity = 0.0, restitution = 1.0, diffusion = 0.0;
  double dt = 0.0, t_end = 0.0;

  double narrow() const { return width < height ? width : height; }
  double fastest() const { return thermal > flow ? thermal : flow; }
  bool is_exact() const { return method == "exact"; }
};

// Tables [[walls]] and fixed [[disks]].
std::string wide_walls_text(Dice& dice, const WideDraft& draft);
std::string wide_obstacles_text(Dice& dice, const WideDraft& draft);

}  // namespace carom::fuzz
