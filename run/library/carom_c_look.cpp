// The C interface (include/carom/carom.h) on carom::Simulation: reading the state of a world.
#include <carom/carom.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/float_environment.hpp"
#include "core/measure/invariants.hpp"
#include "core/scene/disk_group.hpp"
#include "run/library/world.hpp"

namespace {

using namespace carom;

carom_disk as_c(const Disks& d, std::size_t i) {
  const Disk disk = disk_at(d, i);
  return {disk.x, disk.y, disk.vx, disk.vy, disk.radius, disk.mass, disk.id, disk.spin};
}

// Fills an array of size `room` by put(k, disks, i), for the disks in order of id.
template <class T, class Put>
carom_status fill(const carom_world* world, T* array, std::size_t room, Put&& put) {
  return with(world, [&](const Simulation& s) {
    const Disks& d = s.state().disks;
    check_room(room, d.size());
    if (!d.empty()) check_pointer(array, "the array");
    const std::vector<std::size_t>& order = s.order();
    for (std::size_t k = 0; k < order.size(); ++k) put(k, d, order[k]);
    return CAROM_OK;
  });
}

// One of the energies; 0 for a null world. NaN if there is no memory to sort the terms.
double energy_in(const carom_world* world, double Energy::*which) {
  if (world == nullptr || !world->simulation || world->simulation->lost()) return 0.0;
  double energy = std::numeric_limits<double>::quiet_NaN();
  with(world, [&](const Simulation& s) {
    const FloatEnvironment environment;
    energy = energy_of(s.state().disks, s.scene().physics.gravity).*which;
    return CAROM_OK;
  });
  return energy;
}

}  // namespace

extern "C" {

double carom_time(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.time(); });
}

double carom_end_time(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.scene().run.t_end; });
}

int carom_done(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.done() ? 1 : 0; });
}

size_t carom_count(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.state().disks.size(); });
}

uint64_t carom_steps(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.state().counters.steps; });
}

uint64_t carom_collisions(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.state().counters.collisions; });
}

uint64_t carom_wall_collisions(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.state().counters.wall_collisions; });
}

uint64_t carom_removed(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.state().counters.removed; });
}

uint64_t carom_emitted(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.state().counters.emitted; });
}

uint64_t carom_hash(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.hash(); });
}

double carom_width(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.scene().box.width; });
}

double carom_height(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return s.scene().box.height; });
}

double carom_kinetic_energy(const carom_world* world) {
  return energy_in(world, &Energy::kinetic);
}

double carom_potential_energy(const carom_world* world) {
  return energy_in(world, &Energy::potential);
}

carom_status carom_disks(const carom_world* world, carom_disk* disks, size_t room) {
  return fill(world, disks, room, [&](std::size_t k, const Disks& d, std::size_t i) { disks[k] = as_c(d, i); });
}

carom_status carom_ids(const carom_world* world, uint32_t* ids, size_t room) {
  return fill(world, ids, room, [&](std::size_t k, const Disks& d, std::size_t i) { ids[k] = d.id[i]; });
}

carom_status carom_positions(const carom_world* world, double* xy, size_t room) {
  return fill(world, xy, room, [&](std::size_t k, const Disks& d, std::size_t i) {
    xy[2 * k] = d.x[i];
    xy[2 * k + 1] = d.y[i];
  });
}

carom_status carom_velocities(const carom_world* world, double* xy, size_t room) {
  return fill(world, xy, room, [&](std::size_t k, const Disks& d, std::size_t i) {
    xy[2 * k] = d.vx[i];
    xy[2 * k + 1] = d.vy[i];
  });
}

carom_status carom_radii(const carom_world* world, double* radii, size_t room) {
  return fill(world, radii, room, [&](std::size_t k, const Disks& d, std::size_t i) { radii[k] = d.radius_of(i); });
}

carom_status carom_spins(const carom_world* world, double* spins, size_t room) {
  return fill(world, spins, room, [&](std::size_t k, const Disks& d, std::size_t i) { spins[k] = d.spin_of(i); });
}

carom_status carom_groups(const carom_world* world, uint32_t* groups, size_t room) {
  return fill(world, groups, room,
              [&](std::size_t k, const Disks& d, std::size_t i) { groups[k] = carom_group_of(world, d.id[i]); });
}

uint32_t carom_group_of(const carom_world* world, uint32_t id) {
  return value_of(world, [&](const Simulation& s) { return group_of(s.scene(), id); });
}

carom_status carom_disks_at(const carom_world* world, double t, carom_disk* disks, size_t room, size_t* count,
                            double* time) {
  return with(world, [&](const Simulation& s) {
    check_pointer(count, "count");
    Disks then;
    const double at = s.disks_at(t, then);
    *count = then.size();
    check_room(room, then.size());
    if (!then.empty()) check_pointer(disks, "the array");
    for (std::size_t k = 0; k < then.size(); ++k) disks[k] = as_c(then, k);
    if (time != nullptr) *time = at;
    return CAROM_OK;
  });
}

carom_status carom_get(const carom_world* world, uint32_t id, carom_disk* disk) {
  return with(world, [&](const Simulation& s) {
    check_pointer(disk, "disk");
    const std::optional<std::size_t> i = s.find(id);
    if (!i) return fail(world, CAROM_NOT_FOUND, "there is no disk of this id");
    *disk = as_c(s.state().disks, *i);
    return CAROM_OK;
  });
}

carom_status carom_contacts(const carom_world* world, carom_contact* contacts, size_t room, size_t* count) {
  return with(world, [&](const Simulation& s) {
    check_pointer(count, "count");
    const std::vector<DiskContact> met = s.contacts();
    *count = met.size();
    check_room(room, met.size(), "contact");
    if (met.empty()) return CAROM_OK;
    check_pointer(contacts, "the array");
    for (std::size_t k = 0; k < met.size(); ++k) contacts[k] = {met[k].time, met[k].id1, met[k].id2};
    return CAROM_OK;
  });
}

carom_status carom_query_box(const carom_world* world, double x0, double y0, double x1, double y1, uint32_t* ids,
                             size_t room, size_t* count) {
  return with(world, [&](const Simulation& s) {
    check_pointer(count, "count");
    const std::vector<DiskId> inside = s.disks_in({x0, y0}, {x1, y1});
    *count = inside.size();
    check_room(room, inside.size());
    if (inside.empty()) return CAROM_OK;
    check_pointer(ids, "the array");
    std::copy(inside.begin(), inside.end(), ids);
    return CAROM_OK;
  });
}

carom_status carom_nearest(const carom_world* world, double x, double y, uint32_t* id, double* distance) {
  return with(world, [&](const Simulation& s) {
    check_pointer(id, "id");
    const std::optional<NearDisk> nearest = s.nearest({x, y});
    if (!nearest) return fail(world, CAROM_NOT_FOUND, "there are no disks");
    *id = nearest->id;
    if (distance != nullptr) *distance = nearest->distance;
    return CAROM_OK;
  });
}

carom_status carom_cast_ray(const carom_world* world, double x, double y, double dx, double dy, double length,
                            carom_hit* hit) {
  return with(world, [&](const Simulation& s) {
    check_pointer(hit, "hit");
    const std::optional<RayHit> first = s.cast_ray({x, y}, {dx, dy}, length);
    if (!first) return fail(world, CAROM_NOT_FOUND, "the ray meets nothing");
    *hit = {first->distance, first->place.x, first->place.y, first->id, static_cast<int>(first->what)};
    return CAROM_OK;
  });
}

}  // extern "C"
