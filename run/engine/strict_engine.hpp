// --strict: a run ends at its first warning of validity.
#pragma once

#include <memory>

#include "core/step/engine.hpp"

namespace carom {

// Wraps an engine: step() throws PhysicsError with the first warning that the step raises.
std::unique_ptr<Engine> make_strict(std::unique_ptr<Engine> engine);

// Throws PhysicsError with the first of the warnings, if there are any.
void fail_if_any(const std::vector<std::string>& warnings);

}  // namespace carom
