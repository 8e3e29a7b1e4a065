// What carom check --accuracy says: each method's step, error and cost, and which is the cheapest. Costs are those of
// the machine that core/load/method_rates.hpp was measured on. Precondition of both: as of choose_method.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/scene/scene.hpp"

namespace carom {

std::string offers_text(const Scene& scene, double accuracy);
nlohmann::ordered_json offers_json(const Scene& scene, double accuracy);

}  // namespace carom
