#include "core/load/settling_warning.hpp"

#include <fmt/format.h>

#include "core/load/scene_scales.hpp"

namespace carom {

std::vector<std::string> settling_warnings(const Scene& scene) {
  if (scene.run.method != Method::pairwise || !scene.physics.gravity.acts()) return {};
  const SceneScales s = scales_of(scene);
  // For disks less elastic than e = 0.95 the bound is far too pessimistic: at e = 0.9 it is twenty times the measured
  // error.
  constexpr double nearly_elastic = 1.0 / (1.0 - 0.95 * 0.95);
  if (!(s.stopping >= nearly_elastic)) return {};
  constexpr double measured = 0.007;
  constexpr double much = 0.1;
  const double excess = measured * s.stopping * s.collision_rate * scene.run.dt;
  if (!(excess > much)) return {};
  return {
      fmt::format("{}: run.dt: nearly elastic disks may lose up to {:.2g} % too much energy while they settle; use "
                  "method \"exact\" or a smaller dt",
                  scene.file, 100.0 * excess)};
}

}  // namespace carom
