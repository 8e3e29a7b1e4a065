// The C interface (include/carom/carom.h) on carom::Simulation: exceptions become a status and a text.
#include <carom/carom.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/float_environment.hpp"
#include "core/measure/invariants.hpp"
#include "io/trajectory/scene_frame_reader.hpp"
#include "run/library/scene_of_struct.hpp"
#include "run/simulation.hpp"

// The text of an error is no part of the world, and a call that only looks may set it.
struct carom_world {
  std::optional<carom::Simulation> simulation;  // absent where it could not be made
  mutable std::string error;
  std::vector<std::string> warnings;  // that were not taken yet, the next one last
  std::string warning;
};

namespace {

using namespace carom;

constexpr const char* no_world = "the world is a null pointer";
constexpr const char* never_made = "the world could not be made";
constexpr const char* no_memory = "out of memory";

carom_status fail(const carom_world* world, carom_status status, const char* what) {
  try {
    world->error = what;
  } catch (const std::bad_alloc&) {
    world->error.clear();
  }
  return status;
}

carom_status fail(const carom_world* world, const char* what) {
  return fail(world, CAROM_INPUT, what);
}

// work() returns a status; what it throws becomes one.
template <class Work>
carom_status guarded(const carom_world* world, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    return fail(world, CAROM_INPUT, error.what());
  } catch (const PhysicsError& error) {
    return fail(world, CAROM_PHYSICS, error.what());
  } catch (const std::bad_alloc&) {
    return fail(world, CAROM_FAILED, no_memory);
  } catch (const std::length_error&) {
    return fail(world, CAROM_FAILED, no_memory);
  } catch (const std::exception& error) {
    return fail(world, CAROM_FAILED, error.what());
  } catch (...) {
    return fail(world, CAROM_FAILED, "failed");
  }
}

// work(simulation), on a world that is there.
template <class World, class Work>
carom_status with(World* world, Work&& work) {
  if (world == nullptr) return CAROM_INPUT;
  if (!world->simulation) return fail(world, never_made);
  return guarded(world, [&] { return work(*world->simulation); });
}

EngineChoice choice_of(const carom_options* options) {
  carom_options chosen;
  carom_options_init(&chosen);
  if (options != nullptr) chosen = *options;
  constexpr int most_threads = 4096;
  if (chosen.threads < 0 || chosen.threads > most_threads) {
    throw InputError(fmt::format("options: threads is {}; expected 0 to {}", chosen.threads, most_threads));
  }
  if (chosen.reference != 0) return choose_engine("reference", std::nullopt);
  return choose_engine("parallel", chosen.threads == 0 ? std::nullopt : std::optional(chosen.threads));
}

// A new world with what make(engine) returns.
template <class Make>
carom_status made(const carom_options* options, carom_world** world, Make&& make) {
  if (world == nullptr) return CAROM_INPUT;
  *world = new (std::nothrow) carom_world;
  if (*world == nullptr) return CAROM_FAILED;
  return guarded(*world, [&] {
    const FloatEnvironment environment;  // a scene's numbers are read with it too
    (*world)->simulation.emplace(make(choice_of(options)));
    return CAROM_OK;
  });
}

void check_pointer(const void* pointer, const char* name) {
  if (pointer == nullptr) throw InputError(fmt::format("{} is a null pointer", name));
}

void check_room(std::size_t room, std::size_t count, const char* what = "disks") {
  if (room < count) throw InputError(fmt::format("the array has room for {} {}, and there are {}", room, what, count));
}

carom_disk as_c(const Disks& d, std::size_t i) {
  const Disk disk = disk_at(d, i);
  return {disk.x, disk.y, disk.vx, disk.vy, disk.radius, disk.mass, disk.id};
}

// put(k, disks, i) for the disks in order of id, into an array with so much room.
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

// value(simulation) of a world that is there, else 0.
template <class Value>
auto value_of(const carom_world* world, Value&& value) noexcept {
  using Result = decltype(value(*world->simulation));
  return world != nullptr && world->simulation ? value(*world->simulation) : Result{};
}

Energy energy_in(const Simulation& s) {
  const FloatEnvironment environment;
  return energy_of(s.state().disks, s.scene().physics.gravity);
}

}  // namespace

extern "C" {

const char* carom_version(void) {
  return CAROM_VERSION;
}

const char* carom_status_text(carom_status status) {
  switch (status) {
    case CAROM_OK:
      return "done";
    case CAROM_FAILED:
      return "failed";
    case CAROM_INPUT:
      return "bad input";
    case CAROM_PHYSICS:
      return "the method cannot go on";
    case CAROM_NO_ROOM:
      return "no room";
    case CAROM_NOT_FOUND:
      return "not found";
  }
  return "no such status";
}

void carom_options_init(carom_options* options) {
  if (options != nullptr) *options = {1, 0};
}

void carom_scene_init(carom_scene* scene) {
  if (scene == nullptr) return;
  *scene = {};
  scene->width = scene->height = scene->wall_restitution = scene->restitution = 1.0;
  scene->method = CAROM_EXACT;
  scene->t_end = 1e9;
  scene->seed = 1;
}

carom_status carom_from_file(const char* path, const carom_options* options, carom_world** world) {
  return made(options, world, [&](const EngineChoice& engine) {
    check_pointer(path, "path");
    return Simulation(load_scene(path, {}, read_scene_frame), engine);
  });
}

carom_status carom_from_text(const char* text, size_t length, const carom_options* options, carom_world** world) {
  return made(options, world, [&](const EngineChoice& engine) {
    check_pointer(text, "text");
    return Simulation(parse_scene({text, length}, "scene", "", {}, read_scene_frame), engine);
  });
}

carom_status carom_from_scene(const carom_scene* scene, const carom_options* options, carom_world** world) {
  return made(options, world, [&](const EngineChoice& engine) {
    check_pointer(scene, "scene");
    return Simulation(scene_of_struct(*scene), engine);
  });
}

carom_status carom_from_checkpoint(const char* path, const carom_options* options, carom_world** world) {
  return made(options, world, [&](const EngineChoice& engine) {
    check_pointer(path, "path");
    return Simulation::resume(path, engine);
  });
}

carom_status carom_from_memory(const void* bytes, size_t size, const carom_options* options, carom_world** world) {
  return made(options, world, [&](const EngineChoice& engine) {
    check_pointer(bytes, "bytes");
    return Simulation::from_bytes({static_cast<const char*>(bytes), size}, engine);
  });
}

void carom_destroy(carom_world* world) {
  delete world;
}

const char* carom_error(const carom_world* world) {
  return world == nullptr ? no_world : world->error.c_str();
}

const char* carom_next_warning(carom_world* world) {
  const char* next = nullptr;
  with(world, [&](Simulation& s) {
    if (world->warnings.empty()) {
      world->warnings = s.take_warnings();
      std::reverse(world->warnings.begin(), world->warnings.end());
    }
    if (world->warnings.empty()) return CAROM_OK;
    world->warning = std::move(world->warnings.back());
    world->warnings.pop_back();
    next = world->warning.c_str();
    return CAROM_OK;
  });
  return next;
}

carom_status carom_step(carom_world* world, uint64_t steps) {
  return with(world, [&](Simulation& s) {
    s.step(steps);
    return CAROM_OK;
  });
}

carom_status carom_run_until(carom_world* world, double t) {
  return with(world, [&](Simulation& s) {
    s.run_until(t);
    return CAROM_OK;
  });
}

carom_status carom_run_while(carom_world* world, double t, int (*go_on)(void* context), void* context) {
  return with(world, [&](Simulation& s) {
    if (go_on == nullptr) throw InputError("go_on is a null pointer");
    s.run_until(t, [&] { return go_on(context) != 0; });
    return CAROM_OK;
  });
}

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
  return value_of(world, [](const Simulation& s) { return energy_in(s).kinetic; });
}

double carom_potential_energy(const carom_world* world) {
  return value_of(world, [](const Simulation& s) { return energy_in(s).potential; });
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

carom_status carom_add(carom_world* world, const carom_disk* disk, uint32_t* id) {
  return with(world, [&](Simulation& s) {
    check_pointer(disk, "disk");
    const std::optional<DiskId> added = s.add({disk->x, disk->y, disk->vx, disk->vy, disk->radius, disk->mass, 0});
    if (!added) return fail(world, CAROM_NO_ROOM, "the disk would overlap another");
    if (id != nullptr) *id = *added;
    return CAROM_OK;
  });
}

carom_status carom_remove(carom_world* world, uint32_t id) {
  return with(world, [&](Simulation& s) {
    return s.remove(id) ? CAROM_OK : fail(world, CAROM_NOT_FOUND, "there is no disk of this id");
  });
}

carom_status carom_set_velocity(carom_world* world, uint32_t id, double vx, double vy) {
  return with(world, [&](Simulation& s) {
    return s.set_velocity(id, {vx, vy}) ? CAROM_OK : fail(world, CAROM_NOT_FOUND, "there is no disk of this id");
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
    if (!first) return fail(world, CAROM_NOT_FOUND, "the ray meets no disk");
    *hit = {first->distance, first->place.x, first->place.y, first->id};
    return CAROM_OK;
  });
}

carom_status carom_save(const carom_world* world, const char* path) {
  return with(world, [&](const Simulation& s) {
    check_pointer(path, "path");
    s.save(std::string(path));
    return CAROM_OK;
  });
}

carom_status carom_save_memory(const carom_world* world, void* bytes, size_t room, size_t* size) {
  return with(world, [&](const Simulation& s) {
    check_pointer(size, "size");
    const std::string saved = s.save();
    *size = saved.size();
    if (bytes == nullptr) return CAROM_OK;
    check_room(room, saved.size(), "bytes");
    std::memcpy(bytes, saved.data(), saved.size());
    return CAROM_OK;
  });
}

carom_status carom_load_memory(carom_world* world, const void* bytes, size_t size) {
  return with(world, [&](Simulation& s) {
    check_pointer(bytes, "bytes");
    s.load({static_cast<const char*>(bytes), size});
    return CAROM_OK;
  });
}

}  // extern "C"
