// A box for tests of the C interface and of carom.hpp, to which they add disks one by one.
#pragma once

#include <carom/carom.hpp>

namespace carom::test {

inline carom_scene box(int method = CAROM_PAIRWISE) {
  carom_scene scene = carom::default_scene();
  scene.width = 20.0;
  scene.height = 10.0;
  scene.method = method;
  scene.dt = 0.01;
  return scene;
}

}  // namespace carom::test
