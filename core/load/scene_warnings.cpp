#include "core/load/scene_warnings.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/load/brownian_warnings.hpp"
#include "core/load/press_warning.hpp"
#include "core/load/settling_warning.hpp"
#include "core/load/wall_warnings.hpp"
#include "core/scene/scene_names.hpp"
#include "core/step/window_plan.hpp"

namespace carom {

namespace {

// Warns if frames or samples are wanted at shorter intervals than dt, except for the default interval, a hundredth of
// the run.
void warn_of_interval(const Scene& scene, const char* key, double every, std::vector<std::string>& warnings) {
  constexpr double rounding = 1e-6;
  const bool steps = scene.run.method != Method::exact;
  if (!steps || every == scene.run.t_end / 100.0 || !(every > 0.0 && every < (1.0 - rounding) * scene.run.dt)) return;
  warnings.push_back(
      fmt::format("{}: {}: is {:g}, shorter than dt = {:g}: time stepping has states only at the ends of its steps",
                  scene.file, key, every, scene.run.dt));
}

}  // namespace

std::vector<std::string> scene_warnings(const Scene& scene) {
  std::vector<std::string> warnings;
  if (scene.physics.collapse_contact_time && scene.run.method != Method::exact) {
    warnings.push_back(fmt::format("{}: physics.collapse: only the exact method uses it, method {} does not",
                                   scene.file, name_of(scene.run.method)));
  }
  if (scene.physics.collapse_contact_time && scene.run.method == Method::exact && !has_tc(scene)) {
    warnings.push_back(
        fmt::format("{}: physics.collapse: restitution and wall_restitution are 1, so no energy is lost and the TC "
                    "model does nothing",
                    scene.file));
  }
  for (const auto warnings_of : {brownian_warnings, settling_warnings, wall_warnings, press_warnings}) {
    for (std::string& warning : warnings_of(scene)) warnings.push_back(std::move(warning));
  }
  warn_of_interval(scene, "output.every", scene.output.every, warnings);
  if (scene.analysis.any() && scene.analysis.every != scene.output.every)
    warn_of_interval(scene, "analysis.every", scene.analysis.every, warnings);
  if (scene.run.accuracy > 0.0 && !scene.run.automatic) {
    warnings.push_back(fmt::format("{}: run.accuracy: only method \"auto\" uses it, method {} does not", scene.file,
                                   name_of(scene.run.method)));
  }
  return warnings;
}

}  // namespace carom
