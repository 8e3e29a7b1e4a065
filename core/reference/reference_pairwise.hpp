// The method `pairwise`, plain and serial.
#pragma once

#include <memory>

#include "core/step/engine.hpp"

namespace carom {

// Preconditions: scene.run.dt > 0, and `initial` is a state of the scene.
std::unique_ptr<Engine> make_reference_pairwise(const Scene& scene, State initial, CollisionLog* log = nullptr);

}  // namespace carom
