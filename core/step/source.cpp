#include "core/step/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/base/random.hpp"
#include "core/physics/boundary.hpp"
#include "core/physics/disk_pair.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/scene/scene_ranges.hpp"
#include "core/scene/size_law.hpp"

namespace carom {

namespace {

// Streams of different sources must differ, or two sources that try the same id would draw the same place.
Stream stream_of(Stream base, std::size_t source) {
  return static_cast<Stream>(static_cast<std::uint32_t>(base) + (static_cast<std::uint32_t>(source) << 8U));
}

// A sink takes what touches it: through one, a disk enters this share of its radius away from it.
constexpr double clear_of_sink = 0x1p-20;

void draw_place(const Scene& scene, const Source& source, const TwoUniforms& u, Disk& disk) {
  const Domain& box = scene.box;
  if (!source.side) {
    disk.x = source.region_low.x + (source.region_high.x - source.region_low.x) * u.a;
    disk.y = source.region_low.y + (source.region_high.y - source.region_low.y) * u.b;
    return;
  }
  const bool vertical = *source.side == Side::left || *source.side == Side::right;
  const double length = vertical ? box.height : box.width;
  const bool periodic = vertical ? box.periodic_y() : box.periodic_x();
  const double along = periodic ? length * u.a : disk.radius + (length - 2.0 * disk.radius) * u.a;
  const double out = box.side(*source.side) == SideKind::sink ? (1.0 + clear_of_sink) * disk.radius : disk.radius;
  double across = out;
  if (*source.side == Side::right) across = box.width - out;
  if (*source.side == Side::top) across = box.height - out;
  disk.x = vertical ? across : along;
  disk.y = vertical ? along : across;
}

// Velocity in terms of the inward normal and the tangent of the side; a region has no inward direction.
void draw_velocity(const Scene& scene, const Source& source, std::size_t index, Count step, Disk& disk) {
  const Stream stream = stream_of(Stream::source_velocity, index);
  Vec2 v;
  double inward = 0.0;
  if (source.velocities.kind == VelocityLaw::Kind::maxwell) {
    const double scale = std::sqrt(source.velocities.temperature / disk.mass);
    const Vec2 a = normals(scene.seed, stream, disk.id, 2 * step);
    const Vec2 b = normals(scene.seed, stream, disk.id, 2 * step + 1);
    inward = scale * std::sqrt(a.x * a.x + a.y * a.y);
    v = {scale * b.x, scale * b.y};
  } else if (source.velocities.kind == VelocityLaw::Kind::uniform) {
    const TwoUniforms u = uniforms(scene.seed, stream, disk.id, step);
    v = {source.velocities.limit * (2.0 * u.a - 1.0), source.velocities.limit * (2.0 * u.b - 1.0)};
    inward = std::abs(v.y);
  }
  disk.vx = v.x;
  disk.vy = v.y;
  if (!source.side) return;
  switch (*source.side) {
    case Side::left:
      disk.vx = inward, disk.vy = v.x;
      break;
    case Side::right:
      disk.vx = -inward, disk.vy = v.x;
      break;
    case Side::bottom:
      disk.vx = v.x, disk.vy = inward;
      break;
    default:
      disk.vx = v.x, disk.vy = -inward;
  }
}

// Is the whole disk inside every side that is not periodic, and clear of every sink and obstacle? A region may reach
// closer to a side than a radius.
bool inside(const Domain& box, const Disk& d) {
  for (const Side side : all_sides) {
    if (box.side(side) == SideKind::sink && reach_beyond(side, d.x, d.y, d.radius, box) >= 0.0) return false;
  }
  const bool x = box.periodic_x() || (d.x >= d.radius && d.x <= box.width - d.radius);
  const bool y = box.periodic_y() || (d.y >= d.radius && d.y <= box.height - d.radius);
  return x && y && !touches_obstacle(box, d.x, d.y, d.radius);
}

}  // namespace

Disk draw_emission(const Scene& scene, std::size_t index, DiskId id, Count emitted, Count step) {
  const Source& source = scene.sources[index];
  Disk disk;
  disk.id = id;
  const DiskSize size = draw_size(source.radius, source.mass, scene.seed, stream_of(Stream::source_radius, index),
                                  stream_of(Stream::source_mass, index), id, emitted);
  disk.radius = size.radius;
  disk.mass = size.mass;
  draw_place(scene, source, uniforms(scene.seed, stream_of(Stream::source_place, index), id, step), disk);
  draw_velocity(scene, source, index, step, disk);
  return disk;
}

bool meets(const Disks& d, const Domain& box, const Disk& newcomer, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const double distance2 = nearest_distance2({newcomer.x - d.x[i], newcomer.y - d.y[i]}, box);
    if (touches(distance2, newcomer.radius + d.radius_of(i))) return true;
  }
  return false;
}

bool has_room(const Disks& d, const Domain& box, const Disk& newcomer) {
  return !meets(d, box, newcomer, 0, d.size());
}

void emit_from_source(const Scene& scene, State& state, std::size_t index, Count due, Count step,
                      const std::function<bool(const Disk&)>& room) {
  if (scene.sources[index].limit) due = std::min(due, *scene.sources[index].limit);
  Count& emitted = state.sources[index].emitted;
  while (emitted < due) {
    if (state.next_id >= most_disks) {
      throw PhysicsError(
          fmt::format("sources: {} disks have been in the run, and there is no id for another; use a "
                      "lower rate, or a limit",
                      state.next_id));
    }
    const Disk disk = draw_emission(scene, index, state.next_id, emitted, step);
    if (!inside(scene.box, disk) || !room(disk)) break;
    append(state.disks, disk);
    ++state.next_id;
    ++emitted;
    ++state.counters.emitted;
    state.counters.emitted_energy +=
        disk.mass * (0.5 * (disk.vx * disk.vx + disk.vy * disk.vy) + scene.physics.gravity.against(disk.x, disk.y));
  }
  state.counters.waiting += due - emitted;
}

void emit_due(const Scene& scene, State& state, double t, Count step, const std::function<bool(const Disk&)>& room) {
  state.counters.waiting = 0;
  for (std::size_t s = 0; s < scene.sources.size(); ++s) {
    const Count due = static_cast<Count>(std::floor(scene.sources[s].rate * t));
    emit_from_source(scene, state, s, due, step, room);
  }
}

}  // namespace carom
