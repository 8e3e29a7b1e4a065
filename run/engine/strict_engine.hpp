// --strict: a run that leaves what its method can do right ends there.
#pragma once

#include <memory>

#include "core/step/engine.hpp"

namespace carom {

// The same engine, whose step() throws PhysicsError with the first warning that it would have raised.
std::unique_ptr<Engine> make_strict(std::unique_ptr<Engine> engine);

// Throws PhysicsError with the first of them, if there is one.
void fail_if_any(const std::vector<std::string>& warnings);

}  // namespace carom
