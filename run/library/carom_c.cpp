// The C interface (include/carom/carom.h) on carom::Simulation: making, stepping, changing and saving worlds.
#include <carom/carom.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "core/base/check.hpp"
#include "core/base/float_environment.hpp"
#include "io/trajectory/scene_frame_reader.hpp"
#include "run/library/scene_of_struct.hpp"
#include "run/library/world.hpp"

namespace {

using namespace carom;

EngineChoice choice_of(const carom_options* options) {
  carom_options chosen;
  carom_options_init(&chosen);
  if (options != nullptr) chosen = *options;
  if (chosen.threads < 0 || chosen.threads > most_threads) {
    throw InputError(fmt::format("options: threads is {}; expected 0 to {}", chosen.threads, most_threads));
  }
  if (chosen.reference != 0) return choose_engine("reference", std::nullopt);
  return choose_engine("parallel", chosen.threads == 0 ? std::nullopt : std::optional(chosen.threads));
}

// Makes a new world from the result of make(engine).
template <class Make>
carom_status made(const carom_options* options, carom_world** world, Make&& make) {
  if (world == nullptr) return CAROM_INPUT;
  *world = new (std::nothrow) carom_world;
  if (*world == nullptr) return CAROM_FAILED;
  return guarded(*world, [&] {
    const FloatEnvironment environment;  // also for reading the numbers of a scene
    (*world)->simulation.emplace(make(choice_of(options)));
    return CAROM_OK;
  });
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
      return "the method cannot continue";
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

carom_status carom_add(carom_world* world, const carom_disk* disk, uint32_t* id) {
  return with(world, [&](Simulation& s) {
    check_pointer(disk, "disk");
    const std::optional<DiskId> added =
        s.add({disk->x, disk->y, disk->vx, disk->vy, disk->radius, disk->mass, 0, disk->spin});
    if (!added)
      return fail(world, CAROM_NO_ROOM, "the disk would overlap another, an inner wall or a side that has moved in");
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
    check_room(room, saved.size(), "byte");
    std::memcpy(bytes, saved.data(), saved.size());
    return CAROM_OK;
  });
}

carom_status carom_load_memory(carom_world* world, const void* bytes, size_t size) {
  return with_any(world, [&](Simulation& s) {
    check_pointer(bytes, "bytes");
    s.load({static_cast<const char*>(bytes), size});
    return CAROM_OK;
  });
}

}  // extern "C"
