// Reads the table [analysis]: what a run has to measure.
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The table with the defaults that do not depend on the box. scene: groups, run and output are known. Throws
// InputError.
AnalysisPlan read_analysis(const SceneOrigin& origin, const toml::table& table, const Scene& scene);

// Sets the rest once the box is known: the largest distance of pairs, and the bins. Throws InputError if they do not
// fit into the box.
void settle_analysis(Scene& scene, const PlaceOfKey& place);

}  // namespace carom
