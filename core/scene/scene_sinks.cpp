#include "core/scene/scene_sinks.hpp"

#include <fmt/format.h>

#include "core/scene/scene_names.hpp"

namespace carom {

std::vector<SceneSink> sinks_of(const Scene& scene) {
  std::vector<SceneSink> sinks;
  for (const Side side : all_sides) {
    if (scene.box.side(side) != SideKind::sink) continue;
    sinks.push_back({sink_number(side), std::string(side_names[static_cast<std::size_t>(side)])});
  }
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    if (scene.walls[k].sink) sinks.push_back({sink_number_of_table(k), fmt::format("walls.{}", k)});
  }
  return sinks;
}

Count taken_by(const SceneSink& sink, const State& state) {
  return sink.number < state.taken.size() ? state.taken[sink.number] : 0;
}

}  // namespace carom
