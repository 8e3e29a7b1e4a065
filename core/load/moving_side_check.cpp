#include "core/load/moving_side_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/input_message.hpp"
#include "core/load/scene_check.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/swept_room.hpp"

namespace carom {

namespace {

std::string_view name_of(Side side) {
  return side_names[static_cast<std::size_t>(side)];
}

void check_wall(const Scene& scene, const InnerWall& wall, const std::string& where) {
  Vec2 low = wall.points.front();
  Vec2 high = low;
  for (const Vec2& p : wall.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Sweep sweep = first_sweep(scene.box, low, high, slack_of_sides(scene.box, 0.0), scene.run.t_end);
  if (!sweep.happens()) return;
  fail_input(where, fmt::format("the {} side runs into it at t = {:g}", name_of(sweep.side), sweep.time),
             fmt::format("expected walls where no side comes until run.t_end = {}", scene.run.t_end));
}

// radius: the largest that the source can give. A side that has swept over the whole region leaves it no place; over a
// part, and disks come from the rest.
void check_source(const Scene& scene, const Source& source, double radius, const std::string& where) {
  if (source.side) return;
  const Vec2 low{source.region_high.x - radius, source.region_high.y - radius};
  const Vec2 high{source.region_low.x + radius, source.region_low.y + radius};
  const Sweep sweep = first_sweep(scene.box, low, high, slack_of_sides(scene.box, radius), scene.run.t_end);
  if (!sweep.happens()) return;
  fail_input(where,
             fmt::format("the {} side leaves no place in it for the centre of a disk of radius {} from t = {:g}",
                         name_of(sweep.side), radius, sweep.time),
             fmt::format("expected a region of which a part stays clear until run.t_end = {}", scene.run.t_end));
}

}  // namespace

void check_sweeps(const Scene& scene, const PlaceOfKey& place) {
  if (!scene.box.has_moving_side()) return;
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    check_wall(scene, scene.walls[k], place(fmt::format("walls.{}", k)));
  }
  for (std::size_t k = 0; k < scene.sources.size(); ++k) {
    const Source& source = scene.sources[k];
    const double radius = source_sizes(source).second.radius;
    check_source(scene, source, radius, place(fmt::format("sources.{}.region", k)));
  }
}

}  // namespace carom
