// The method `rollback`: the predictor-corrector of docs/original.md, plain and serial, without faults F3 to F15. F1
// and F2 belong to the method: the whole system goes back by one time, and every pair found bounces at that moment.
#pragma once

#include <memory>

#include "core/step/engine.hpp"

namespace carom {

// Precondition: scene.run.dt > 0, initial is a state of scene.
std::unique_ptr<Engine> make_reference_rollback(const Scene& scene, State initial, CollisionLog* log = nullptr);

}  // namespace carom
