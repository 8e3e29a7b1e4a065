#include "core/load/press_warning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/load/densest_packing.hpp"
#include "core/scene/size_law.hpp"

namespace carom {

namespace {

// A lower bound on the area that the initial disks need: for equal disks that of the densest packing, otherwise the sum
// of their areas, since small disks fill gaps. Obstacles, which may overlap, are left out.
double least_room(const Scene& scene) {
  double radius_squared = 0.0;
  double smallest = HUGE_VAL, largest = 0.0;
  DiskId first_id = 0;
  for (const DiskGroup& group : scene.groups) {
    if (group.count > 0 && !group.fixed) {
      const SizeSummary sizes = summarise_sizes(group, scene.seed, first_id);
      radius_squared += sizes.radius_squared;
      smallest = std::min(smallest, sizes.smallest.radius);
      largest = std::max(largest, sizes.largest.radius);
    }
    first_id += static_cast<DiskId>(group.count);
  }
  return std::numbers::pi * radius_squared / (smallest == largest ? densest_packing : 1.0);
}

// The area between the sides at time t; a vibrating side counts at its furthest, once it has been there.
double room_by(const Domain& box, double t) {
  const auto inset = [&](Side side) {
    const SideMotion& motion = box.motions[static_cast<std::size_t>(side)];
    return motion.vibrates() && t >= motion.period ? motion.largest_inset(t) : motion.at(t).inset;
  };
  return (box.width - inset(Side::left) - inset(Side::right)) * (box.height - inset(Side::bottom) - inset(Side::top));
}

}  // namespace

std::vector<std::string> press_warnings(const Scene& scene) {
  if (!scene.box.has_moving_wall() || has_sinks(scene)) return {};
  const double needed = least_room(scene);
  constexpr int looks = 1000;
  for (int k = 0; k <= looks; ++k) {
    const double t = scene.run.t_end * k / looks;
    if (!(room_by(scene.box, t) < needed)) continue;
    return {
        fmt::format("{}: box: the disks need an area of at least {:.4g}, and the moving sides leave less than that "
                    "from t = {:.4g} on: no method gets there, and exact becomes slower and slower before; move the "
                    "sides less far, or end the run sooner",
                    scene.file, needed, t)};
  }
  return {};
}

}  // namespace carom
