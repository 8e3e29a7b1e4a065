#include "core/start/between_sides.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/base/input_message.hpp"
#include "core/disks/place_slack.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/swept_room.hpp"
#include "core/start/placement.hpp"
#include "core/start/wall_segments.hpp"

namespace carom {

namespace {

// A moving side must not run into a fixed disk.
void check_clear_of_sides(const Scene& scene, const Obstacle& o) {
  const Vec2 low{o.x - o.radius, o.y - o.radius};
  const Vec2 high{o.x + o.radius, o.y + o.radius};
  const Sweep sweep = first_sweep(scene.box, low, high, place_slack(scene.box, o.radius), scene.run.t_end);
  if (!sweep.happens()) return;
  fail_input(place_in_group(scene, group_of(scene, o.id), "positions"),
             fmt::format("the {} side hits {}, of radius {} at ({:g}, {:g}), at t = {:g}",
                         side_names[static_cast<std::size_t>(sweep.side)], name_of(o), o.radius, o.x, o.y, sweep.time),
             fmt::format("expected fixed disks that no side reaches until run.t_end = {}", scene.run.t_end));
}

}  // namespace

Scene inside_moving_sides(const Scene& scene) {
  Scene inner = scene;
  const auto& place = scene.box.places;
  inner.box.motions = {};
  inner.box.inner_walls_move = false;  // at time 0 they are at their places of the scene
  inner.box.places = {};
  inner.box.width -= place[0].inset + place[1].inset;
  inner.box.height -= place[2].inset + place[3].inset;
  const auto moved = [&](Vec2 p) { return Vec2{p.x - place[0].inset, p.y - place[2].inset}; };
  for (InnerWall& wall : inner.walls) {
    wall.motion = {};
    for (Vec2& p : wall.points) p = moved(p);
  }
  for (std::size_t g = 0; g < inner.groups.size(); ++g) {
    PositionLaw& law = inner.groups[g].positions;
    for (Vec2& p : law.list) p = moved(p);
    if (!law.region) continue;
    StartRegion& region = *law.region;
    region.low = moved(region.low);
    region.high = moved(region.high);
    region.centre = moved(region.centre);
    const double slack = place_slack(scene.box, 0.0);
    const bool inside = region.low.x >= -slack && region.low.y >= -slack && region.high.x <= inner.box.width + slack &&
                        region.high.y <= inner.box.height + slack;
    if (inside) continue;
    fail_input(place_in_group(scene, g, "region"), "reaches beyond a moving side",
               "expected a region between the sides where they are at time 0");
  }
  return inner;
}

State moved_back(const Scene& scene, State state) {
  const double right = scene.box.place(Side::left).inset;
  const double up = scene.box.place(Side::bottom).inset;
  for (double& x : state.disks.x) x += right;
  for (double& y : state.disks.y) y += up;
  std::erase_if(state.obstacles, [](const Obstacle& o) { return o.is_segment(); });
  for (Obstacle& o : state.obstacles) {
    o.x += right;
    o.y += up;
    check_clear_of_sides(scene, o);
  }
  const std::vector<Obstacle> segments = segments_of(scene);
  state.obstacles.insert(state.obstacles.end(), segments.begin(), segments.end());
  return state;
}

}  // namespace carom
