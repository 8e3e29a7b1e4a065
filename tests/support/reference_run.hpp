// A run by the reference, with a call after every step.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/step/engine.hpp"

namespace carom::test {

// The methods that step in time.
inline const std::vector<Method> stepping_methods{Method::rollback, Method::pairwise};

inline std::string name_of(Method method) {
  return method == Method::rollback ? "rollback" : method == Method::pairwise ? "pairwise" : "exact";
}

// Steps to the end of the run; look(engine) after each step.
inline State run(const Scene& scene, State initial, const std::function<void(const Engine&)>& look = {}) {
  const auto engine = make_reference_engine(scene, std::move(initial));
  while (engine->state().time < scene.run.t_end) {
    engine->step();
    if (look) look(*engine);
  }
  return engine->state();
}

}  // namespace carom::test
