#include "core/load/moving_side_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/input_message.hpp"
#include "core/disks/place_slack.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/size_law.hpp"
#include "core/scene/swept_room.hpp"

namespace carom {

namespace {

std::string_view name_of(Side side) {
  return side_names[static_cast<std::size_t>(side)];
}

// A moving inner wall must stay in the box until the run's end, except along periodic axes.
void check_wall_stays(const Scene& scene, Vec2 low, Vec2 high, const std::string& where) {
  const Domain& box = scene.box;
  const double slack = place_slack(box, 0.0);
  const bool leaves_x = !box.periodic_x() && (low.x < -slack || high.x > box.width + slack);
  const bool leaves_y = !box.periodic_y() && (low.y < -slack || high.y > box.height + slack);
  if (!leaves_x && !leaves_y) return;
  const double least = leaves_x ? low.x : low.y;
  const bool below = least < -slack;
  fail_input(where,
             fmt::format("brings the wall to {} = {:g}, beyond the {} side, before run.t_end = {}",
                         leaves_x ? 'x' : 'y', below ? least : (leaves_x ? high.x : high.y),
                         name_of(leaves_x ? (below ? Side::left : Side::right) : (below ? Side::bottom : Side::top)),
                         scene.run.t_end),
             "expected a wall that stays in the box");
}

// The times until t_end at which a motion reaches its extreme places.
std::array<double, 4> turning_times(const SideMotion& motion, double t_end) {
  if (!motion.vibrates()) return {0.0, 0.0, t_end, t_end};
  return {0.0, std::min(0.25 * motion.period, t_end), std::min(0.75 * motion.period, t_end), t_end};
}

// Do a side and an inner wall that move alike (both steadily, or in phase) stay apart until the run's end? Their
// distance is least at one of the turning times. low, high: extent of the wall at time 0.
bool stay_apart(const Scene& scene, Side side, const InnerWall& wall, Vec2 low, Vec2 high) {
  const SideMotion& motion = scene.box.motions[static_cast<std::size_t>(side)];
  const SideMotion& pace = wall.motion.pace;
  if (motion.kind != pace.kind || (motion.vibrates() && motion.period != pace.period)) return false;
  for (const double t : turning_times(motion, scene.run.t_end)) {
    const Vec2 shift = wall.motion.at({t, t}).shift;
    const double limit =
        inset_to_reach(scene.box, side, {low.x + shift.x, low.y + shift.y}, {high.x + shift.x, high.y + shift.y});
    if (motion.at(t).inset > limit + place_slack(scene.box, 0.0)) return false;
  }
  return true;
}

void check_wall(const Scene& scene, const InnerWall& wall, const std::string& where) {
  Vec2 low = wall.points.front();
  Vec2 high = low;
  for (const Vec2& p : wall.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Vec2 first_low = low;
  const Vec2 first_high = high;
  if (wall.motion.moves()) {
    const WallMotion::Range range = wall.motion.range(0.0, scene.run.t_end);
    low = {low.x + range.low.x, low.y + range.low.y};
    high = {high.x + range.high.x, high.y + range.high.y};
    check_wall_stays(scene, low, high, where);
  }
  Sweep sweep;
  for (const Side side : all_sides) {
    const Sweep next = sweep_of(scene.box, side, low, high, place_slack(scene.box, 0.0), scene.run.t_end);
    if (next.time < sweep.time && !stay_apart(scene, side, wall, first_low, first_high)) sweep = next;
  }
  if (!sweep.happens()) return;
  const std::string_view side = name_of(sweep.side);
  // If their motions differ, the areas that they sweep over must not overlap.
  if (wall.motion.moves()) {
    fail_input(where, fmt::format("the {} side enters the path of this wall at t = {:g}", side, sweep.time),
               fmt::format("expected paths of the two that do not overlap until run.t_end = {}", scene.run.t_end));
  }
  fail_input(where, fmt::format("the {} side hits this wall at t = {:g}", side, sweep.time),
             fmt::format("expected walls that no side reaches until run.t_end = {}", scene.run.t_end));
}

// radius: the largest of the source's disks. A side must not sweep over the whole region of a source; if it covers a
// part, disks come from the rest.
void check_source(const Scene& scene, const Source& source, double radius, const std::string& where) {
  if (source.side) return;
  const Vec2 low{source.region_high.x - radius, source.region_high.y - radius};
  const Vec2 high{source.region_low.x + radius, source.region_low.y + radius};
  const Sweep sweep = first_sweep(scene.box, low, high, place_slack(scene.box, radius), scene.run.t_end);
  if (!sweep.happens()) return;
  fail_input(
      where,
      fmt::format("the {} side leaves no place in this region for the centre of a disk of radius {} from t = {:g} on",
                  name_of(sweep.side), radius, sweep.time),
      fmt::format("expected a region of which some part stays free until run.t_end = {}", scene.run.t_end));
}

}  // namespace

void check_sweeps(const Scene& scene, const PlaceOfKey& place) {
  if (!scene.box.has_moving_wall()) return;
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const bool moves = scene.walls[k].motion.moves();
    check_wall(scene, scene.walls[k], place(fmt::format("walls.{}{}", k, moves ? ".motion" : "")));
  }
  for (std::size_t k = 0; k < scene.sources.size(); ++k) {
    const Source& source = scene.sources[k];
    const double radius = ends_of_sizes(source.radius, source.mass).second.radius;
    check_source(scene, source, radius, place(fmt::format("sources.{}.region", k)));
  }
}

}  // namespace carom
