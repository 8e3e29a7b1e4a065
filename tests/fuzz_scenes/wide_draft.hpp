// What a wide scene is to be, before it is text.
#pragma once

#include <string>

#include "tests/fuzz_scenes/dice.hpp"
#include "tests/fuzz_scenes/random_disks.hpp"

namespace carom::fuzz {

struct WideDraft {
  bool for_oracle = false;  // disks, walls, periodic sides, gravity, restitution, shear: nothing else
  std::string method;
  Units units;
  double radius = 0.0;  // of most disks, the largest of them
  double ratio = 1.0;   // of their radii, at most
  double giant = 0.0;   // radius of a few others; 0: none
  std::size_t giants = 0;
  std::size_t disks = 0;  // without giants
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

// [[walls]] and fixed [[disks]].
std::string wide_walls_text(Dice& dice, const WideDraft& draft);
std::string wide_obstacles_text(Dice& dice, const WideDraft& draft);

}  // namespace carom::fuzz
