#include "run/simulation/newcomer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/base/input_message.hpp"
#include "core/disks/place_slack.hpp"
#include "core/physics/boundary.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/scene/scene_ranges.hpp"
#include "core/step/source.hpp"

namespace carom {

namespace {

void check_magnitude(const char* what, Dimension dimension, double value) {
  if (in_range(dimension, value)) return;
  fail_input(what, fmt::format("is {}", value), expected_range(dimension));
}

void check_size(const char* what, Dimension dimension, double value) {
  check_magnitude(what, dimension, value);
  if (!(value > 0.0)) fail_input(what, fmt::format("is {}", value), "expected a number above 0");
}

// Checks one coordinate of a disk that must be inside the box; it may touch a side in decimals, as the disks of a scene
// may.
void check_coordinate(const char* what, double c, double radius, double size, bool periodic) {
  const double slack = place_slack(radius, size);
  if (!periodic && !(radius <= size / 2.0 + slack)) {
    fail_input("radius", fmt::format("is {}", radius),
               fmt::format("expected at most {}, half the box, for a disk that has to lie inside it", size / 2.0));
  }
  const bool inside = periodic ? c >= 0.0 && c < size : c >= radius - slack && c <= size - radius + slack;
  if (!inside) {
    fail_input(what, fmt::format("is {}", c),
               periodic ? fmt::format("expected a number from 0 to below {}", size)
                        : fmt::format("expected the whole disk inside the box, from {} to {}", radius, size - radius));
  }
}

// box: with its sides at their present places.
bool is_beyond_moving_side(const Domain& box, const Disk& disk) {
  return std::any_of(all_sides.begin(), all_sides.end(), [&](Side side) {
    return box.moves(side) && reach_beyond_wall(side, disk.x, disk.y, disk.radius, box) > place_slack(box, disk.radius);
  });
}

bool meets_fixed(const ObstacleCells& fixed, const Domain& box, const Disk& disk) {
  bool met = false;
  fixed.visit({disk.x - disk.radius, disk.y - disk.radius}, {disk.x + disk.radius, disk.y + disk.radius},
              [&](std::uint32_t k, Vec2) {
                const double distance2 = nearest_distance2({disk.x - fixed[k].x, disk.y - fixed[k].y}, box);
                met = met || touches(distance2, disk.radius + fixed[k].radius);
              });
  return met;
}

}  // namespace

void check_velocity(Vec2 velocity) {
  check_magnitude("vx", Dimension::speed, velocity.x);
  check_magnitude("vy", Dimension::speed, velocity.y);
}

void check_newcomer(const Scene& scene, const State& state, const Disk& disk) {
  const Domain& box = scene.box;
  check_size("radius", Dimension::length, disk.radius);
  check_size("mass", Dimension::mass, disk.mass);
  check_velocity({disk.vx, disk.vy});
  if (state.disks.spins()) check_magnitude("spin", Dimension::frequency, disk.spin);
  // As for a scene's disks: in a sheared box images also move, and larger disks could touch one image more.
  const double share = box.shear.acts() ? 0.125 : 0.25;
  const auto check_axis = [&](const char* what, double size, bool periodic) {
    if (!periodic || disk.radius <= share * size) return;
    fail_input("radius", fmt::format("is {}", disk.radius),
               fmt::format("expected at most {} of the periodic {}, {}",
                           box.shear.acts() ? "an eighth (box.shear_rate)" : "a quarter", what, share * size));
  };
  check_axis("width", box.width, box.periodic_x());
  check_axis("height", box.height, box.periodic_y());
  check_coordinate("x", disk.x, disk.radius, box.width, box.periodic_x());
  check_coordinate("y", disk.y, disk.radius, box.height, box.periodic_y());
  if (state.next_id >= most_disks) fail_input("disk", "has no id left", "expected fewer disks");
}

bool has_room(const Scene& scene, const State& state, const Disk& disk, const VisitNear& near,
              const ObstacleCells* fixed) {
  const Domain box = box_at(scene.box, state.time);
  bool met = is_beyond_moving_side(box, disk);
  const double reach = disk.radius + largest_radius(state.disks);
  near({disk.x, disk.y}, reach, reach, [&](std::size_t i) { met = met || meets(state.disks, box, disk, i, i + 1); });
  met = met || (fixed != nullptr && meets_fixed(*fixed, scene.box, disk));
  const std::vector<WallMotion> motions = motions_of(scene);
  return !met && std::none_of(state.obstacles.begin(), state.obstacles.end(), [&](const Obstacle& before) {
    const Obstacle o = at_time(before, motions, state.time, box);
    return o.is_segment() && gap_to(o, disk.x, disk.y, disk.radius, scene.box).beyond >= 0.0;
  });
}

}  // namespace carom
