#include "core/step/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/base/random.hpp"
#include "core/disks/place_slack.hpp"
#include "core/physics/boundary.hpp"
#include "core/physics/disk_pair.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/physics/roughness.hpp"
#include "core/scene/scene_ranges.hpp"
#include "core/scene/size_law.hpp"

namespace carom {

namespace {

// Streams of different sources must differ, or two sources that try the same id would draw the same place.
Stream stream_of(Stream base, std::size_t source) {
  return static_cast<Stream>(static_cast<std::uint32_t>(base) + (static_cast<std::uint32_t>(source) << 8U));
}

// A disk that enters through a sink starts this share of its radius away from it, since the sink takes disks that touch
// it.
constexpr double clear_of_sink = 0x1p-20;

// box: with its sides at their present places.
void draw_place(const Domain& box, const Source& source, const TwoUniforms& u, Disk& disk) {
  if (!source.side) {
    disk.x = source.region_low.x + (source.region_high.x - source.region_low.x) * u.a;
    disk.y = source.region_low.y + (source.region_high.y - source.region_low.y) * u.b;
    return;
  }
  const bool vertical = *source.side == Side::left || *source.side == Side::right;
  const bool periodic = vertical ? box.periodic_y() : box.periodic_x();
  const double first = box.place(vertical ? Side::bottom : Side::left).inset;
  const double length =
      (vertical ? box.height : box.width) - first - box.place(vertical ? Side::top : Side::right).inset;
  const double along = periodic ? length * u.a : (disk.radius + first) + (length - 2.0 * disk.radius) * u.a;
  const bool sink = box.side(*source.side) == SideKind::sink;
  const double out = sink ? (1.0 + clear_of_sink) * disk.radius : disk.radius;
  const double across = touching_coordinate(*source.side, out, box);
  disk.x = vertical ? across : along;
  disk.y = vertical ? along : across;
}

// The velocity has components along the inward normal and the tangent of the side; a region has no inward direction.
// speed: of the side, towards the inside; the velocity is drawn in its frame.
void draw_velocity(const Scene& scene, const Source& source, std::size_t index, Count step, double speed, Disk& disk) {
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
  inward += speed;
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

// Precondition: the disk's radius and mass are set.
void draw_spin(const Scene& scene, const Source& source, std::size_t index, Count step, Disk& disk) {
  const SpinLaw& law = source.spins;
  disk.spin = law.value;
  if (!(law.temperature > 0.0)) return;
  const double scale = std::sqrt(law.temperature / (scene.physics.surfaces.inertia * disk.mass)) / disk.radius;
  disk.spin = scale * normals(scene.seed, stream_of(Stream::source_spin, index), disk.id, step).x;
}

// Is the whole disk inside every side that is not periodic, and clear of every sink and obstacle? (A region may reach
// closer to a side than a radius.) Inner sinks must be further away than rounding: one along the side through which the
// disk enters would take it at once.
bool inside(const Domain& box, const Disk& d) {
  for (const Side side : all_sides) {
    if (box.side(side) == SideKind::sink && reach_beyond(side, d.x, d.y, d.radius, box) >= 0.0) return false;
  }
  // A disk that touches a wall when written in decimals counts as inside.
  const double slack = place_slack(box, d.radius);
  const auto touching = [&](Side side) { return touching_coordinate(side, d.radius, box); };
  const bool x = box.periodic_x() || (d.x >= touching(Side::left) - slack && d.x <= touching(Side::right) + slack);
  const bool y = box.periodic_y() || (d.y >= touching(Side::bottom) - slack && d.y <= touching(Side::top) + slack);
  const double held = (1.0 + clear_of_sink) * d.radius + slack;
  return x && y && !touches_obstacle(box, d.x, d.y, d.radius) && !touches_inner_sink(box, d.x, d.y, held);
}

}  // namespace

Disk draw_emission(const Scene& scene, const Domain& box, std::size_t index, DiskId id, Count emitted, Count step) {
  const Source& source = scene.sources[index];
  Disk disk;
  disk.id = id;
  const DiskSize size = draw_size(source.radius, source.mass, scene.seed, stream_of(Stream::source_radius, index),
                                  stream_of(Stream::source_mass, index), id, emitted);
  disk.radius = size.radius;
  disk.mass = size.mass;
  draw_place(box, source, uniforms(scene.seed, stream_of(Stream::source_place, index), id, step), disk);
  draw_velocity(scene, source, index, step, source.side ? box.place(*source.side).speed : 0.0, disk);
  draw_spin(scene, source, index, step, disk);
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

namespace {

// Moves the disk, which has its first place, to the first place with room; false if none of the places has room.
bool find_place(const Scene& scene, const Domain& box, std::size_t index, Count step, const PlacesTried& places,
                const std::function<bool(const Disk&)>& room, Disk& disk) {
  const Stream stream = stream_of(Stream::source_place, index);
  for (std::uint32_t k = 0; k < places.count; ++k) {
    const std::uint32_t place = places.first + k;
    if (place > 0) draw_place(box, scene.sources[index], uniforms(scene.seed, stream, disk.id, step, place), disk);
    if (inside(box, disk) && room(disk)) return true;
  }
  return false;
}

}  // namespace

void emit_from_source(const Scene& scene, const Domain& box, State& state, std::size_t index, Count due, Count step,
                      const PlacesTried& places, const std::function<bool(const Disk&)>& room) {
  if (scene.sources[index].limit) due = std::min(due, *scene.sources[index].limit);
  Count& emitted = state.sources[index].emitted;
  while (emitted < due) {
    if (state.next_id >= most_disks) {
      throw PhysicsError(fmt::format(
          "sources: the run has had {} disks, and no id is left for another one; use a lower rate, or a limit",
          state.next_id));
    }
    Disk disk = draw_emission(scene, box, index, state.next_id, emitted, step);
    if (!find_place(scene, box, index, step, places, room, disk)) break;
    append(state.disks, disk);
    ++state.next_id;
    ++emitted;
    ++state.counters.emitted;
    state.counters.emitted_energy +=
        disk.mass * (0.5 * (disk.vx * disk.vx + disk.vy * disk.vy) + scene.physics.gravity.against(disk.x, disk.y));
    if (state.disks.spins()) {
      state.counters.emitted_energy += rotational_energy(state.disks.inertia, disk.mass, disk.radius, disk.spin);
    }
  }
  state.counters.waiting += due - emitted;
}

double emission_time(double rate, Count k) {
  return static_cast<double>(k) / rate;
}

// rate * t may be rounded to below the whole number that it should be.
Count emissions_due(double rate, double t) {
  auto k = static_cast<Count>(std::max(0.0, std::floor(rate * t)));
  while (k > 0 && emission_time(rate, k) > t) --k;
  while (emission_time(rate, k + 1) <= t) ++k;
  return k;
}

Count due_by(const Source& source, double t) {
  const Count due = emissions_due(source.rate, t);
  return source.limit ? std::min(due, *source.limit) : due;
}

Count due_before(const Source& source, double t) {
  return due_by(source, (1.0 - emission_rounding) * t);
}

bool has_more(const Source& source, const SourceState& s) {
  return !source.limit || s.emitted < *source.limit;
}

double emission_rate(const Scene& scene, const State& state) {
  double rate = 0.0;
  for (std::size_t k = 0; k < scene.sources.size(); ++k) {
    if (has_more(scene.sources[k], state.sources[k])) rate += scene.sources[k].rate;
  }
  return rate;
}

double largest_radius_of(const Source& source) {
  return ends_of_sizes(source.radius, source.mass).second.radius;
}

void emit_due(const Scene& scene, State& state, double t, Count step, const std::function<bool(const Disk&)>& room) {
  state.counters.waiting = 0;
  if (scene.sources.empty()) return;
  const Domain box = box_at(scene.box, t);
  for (std::size_t s = 0; s < scene.sources.size(); ++s) {
    emit_from_source(scene, box, state, s, due_by(scene.sources[s], t), step, {}, room);
  }
}

}  // namespace carom
