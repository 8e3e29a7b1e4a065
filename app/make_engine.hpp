// Which engine runs a scene.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/engine.hpp"

namespace carom {

struct EngineChoice {
  std::string name;  // "reference" or "parallel"
  int threads = 1;   // that it will use
};

// What --engine and --threads ask for; empty and absent mean the default: parallel, on all cores. The reference has one
// thread whatever is asked for. Throws InputError for an engine that does not exist.
EngineChoice choose_engine(const std::string& engine, std::optional<int> threads);

std::unique_ptr<Engine> make_engine(const EngineChoice& choice, const Scene& scene, State initial);

}  // namespace carom
