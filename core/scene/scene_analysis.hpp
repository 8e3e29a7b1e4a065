// Reading what a run shall measure on its way, the table [analysis].
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The table with the defaults that do not depend on the box. scene: groups, run and output are known. Throws
// InputError.
AnalysisPlan read_analysis(const SceneOrigin& origin, const toml::table& table, const Scene& scene);

// The rest, once the box is known: how far pairs are looked at, whether that fits into the box, and the bins. Throws
// InputError.
void settle_analysis(Scene& scene, const PlaceOfKey& place);

}  // namespace carom
