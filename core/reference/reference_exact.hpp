// The method `exact`, plain and serial.
#pragma once

#include <memory>

#include "core/step/engine.hpp"

namespace carom {

// Precondition: initial is a state of scene; scene.run.dt > 0 if the scene has Brownian motion. window_scale: factor of
// the lengths of windows, for the test that they do not matter.
std::unique_ptr<Engine> make_reference_exact(const Scene& scene, State initial, double window_scale = 1.0,
                                             CollisionLog* log = nullptr);

}  // namespace carom
