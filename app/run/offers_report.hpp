// The output of carom check --accuracy: each method's step, error and cost, and the cheapest one. Costs are those of
// the machine on which core/load/method_rates.hpp was measured. Precondition of both functions: as for choose_method.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/scene/scene.hpp"

namespace carom {

std::string offers_text(const Scene& scene, double accuracy);
nlohmann::ordered_json offers_json(const Scene& scene, double accuracy);

}  // namespace carom
