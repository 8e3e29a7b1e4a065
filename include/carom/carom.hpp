// Carom from C++20: carom.h with an owner for the handle, spans, and exceptions, which are thrown on this side of the C
// interface. Everything is inline and calls the C functions; no physics is compiled with the program's flags.
#ifndef CAROM_HPP
#define CAROM_HPP

#include <carom/carom.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom {
inline namespace handle {

// A failed call: the line of carom_error(), and the kind of failure.
class Error : public std::runtime_error {
 public:
  Error(carom_status status, const char* what) : std::runtime_error(what), status_(status) {}
  carom_status status() const { return status_; }

 private:
  carom_status status_;
};

inline carom_options default_options() {
  carom_options options;
  carom_options_init(&options);
  return options;
}

inline carom_scene default_scene() {
  carom_scene scene;
  carom_scene_init(&scene);
  return scene;
}

// A world; it can be moved, not copied. Each function is described, with units and preconditions, at the C function of
// the same name in carom.h. It throws Error if that returns a failure; functions that look for something return an
// empty optional (or false) if there is none.
class World {
 public:
  static World from_file(const std::string& path, carom_options options = default_options()) {
    return make([&](carom_world** w) { return carom_from_file(path.c_str(), &options, w); });
  }
  static World from_text(std::string_view toml, carom_options options = default_options()) {
    return make([&](carom_world** w) { return carom_from_text(toml.data(), toml.size(), &options, w); });
  }
  static World from_checkpoint(const std::string& path, carom_options options = default_options()) {
    return make([&](carom_world** w) { return carom_from_checkpoint(path.c_str(), &options, w); });
  }
  static World from_memory(std::span<const std::byte> bytes, carom_options options = default_options()) {
    return make([&](carom_world** w) { return carom_from_memory(bytes.data(), bytes.size(), &options, w); });
  }
  explicit World(const carom_scene& scene, carom_options options = default_options())
      : World(make([&](carom_world** w) { return carom_from_scene(&scene, &options, w); })) {}

  World(World&& other) noexcept : world_(std::exchange(other.world_, nullptr)) {}
  World& operator=(World&& other) noexcept {
    std::swap(world_, other.world_);
    return *this;
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() { carom_destroy(world_); }

  carom_world* get() const { return world_; }  // for the C functions

  void step(std::uint64_t steps = 1) { check(carom_step(world_, steps)); }
  void run_until(double t) { check(carom_run_until(world_, t)); }
  // go_on() is called before each step. If it returns false the call ends; if it throws the call ends, too, and throws
  // an Error with the exception's text.
  template <class GoOn>
  void run_while(double t, GoOn go_on) {
    check(carom_run_while(
        world_, t, [](void* f) { return (*static_cast<GoOn*>(f))() ? 1 : 0; }, &go_on));
  }

  double time() const { return carom_time(world_); }
  double end_time() const { return carom_end_time(world_); }
  bool done() const { return carom_done(world_) != 0; }
  std::size_t size() const { return carom_count(world_); }
  std::uint64_t steps() const { return carom_steps(world_); }
  std::uint64_t collisions() const { return carom_collisions(world_); }
  std::uint64_t wall_collisions() const { return carom_wall_collisions(world_); }
  std::uint64_t removed() const { return carom_removed(world_); }
  std::uint64_t emitted() const { return carom_emitted(world_); }
  std::uint64_t hash() const { return carom_hash(world_); }
  double width() const { return carom_width(world_); }
  double height() const { return carom_height(world_); }
  double kinetic_energy() const { return carom_kinetic_energy(world_); }
  double potential_energy() const { return carom_potential_energy(world_); }

  // In order of id; the span has room for size() disks (for positions and velocities twice as many numbers).
  void disks(std::span<carom_disk> out) const { check(carom_disks(world_, out.data(), out.size())); }
  void ids(std::span<std::uint32_t> out) const { check(carom_ids(world_, out.data(), out.size())); }
  void positions(std::span<double> xy) const { check(carom_positions(world_, xy.data(), xy.size() / 2)); }
  void velocities(std::span<double> xy) const { check(carom_velocities(world_, xy.data(), xy.size() / 2)); }
  void radii(std::span<double> out) const { check(carom_radii(world_, out.data(), out.size())); }
  void spins(std::span<double> out) const { check(carom_spins(world_, out.data(), out.size())); }
  void groups(std::span<std::uint32_t> out) const { check(carom_groups(world_, out.data(), out.size())); }
  std::uint32_t group_of(std::uint32_t id) const { return carom_group_of(world_, id); }
  std::vector<carom_disk> disks() const {
    std::vector<carom_disk> all(size());
    disks(all);
    return all;
  }
  // *time, if given, is set to the time to which the disks belong.
  std::vector<carom_disk> disks_at(double t, double* time = nullptr) const {
    std::vector<carom_disk> then(size());  // enough unless a sink took disks in this step, which existed before
    std::size_t count = 0;
    if (carom_disks_at(world_, t, then.data(), then.size(), &count, time) != CAROM_OK) {
      then.resize(count);
      check(carom_disks_at(world_, t, then.data(), then.size(), &count, time));
    }
    then.resize(count);
    return then;
  }
  std::vector<carom_contact> contacts() const {
    std::vector<carom_contact> met(size());  // usually enough
    std::size_t count = 0;
    if (carom_contacts(world_, met.data(), met.size(), &count) != CAROM_OK) {
      met.resize(count);
      check(carom_contacts(world_, met.data(), met.size(), &count));
    }
    met.resize(count);
    return met;
  }
  std::optional<carom_disk> find(std::uint32_t id) const {
    carom_disk disk;
    return found(carom_get(world_, id, &disk)) ? std::optional(disk) : std::nullopt;
  }

  // The id of the new disk; empty if there is no room.
  std::optional<std::uint32_t> add(const carom_disk& disk) {
    std::uint32_t id = 0;
    const carom_status status = carom_add(world_, &disk, &id);
    if (status == CAROM_NO_ROOM) return std::nullopt;
    check(status);
    return id;
  }
  bool remove(std::uint32_t id) { return found(carom_remove(world_, id)); }
  bool set_velocity(std::uint32_t id, double vx, double vy) { return found(carom_set_velocity(world_, id, vx, vy)); }

  // The ids, ascending, of the disks whose centres are in the rectangle.
  std::vector<std::uint32_t> disks_in(double x0, double y0, double x1, double y1) const {
    std::vector<std::uint32_t> ids(size());  // enough unless disks are fixed: those are found, but not counted
    std::size_t count = 0;
    if (carom_query_box(world_, x0, y0, x1, y1, ids.data(), ids.size(), &count) != CAROM_OK) {
      ids.resize(count);
      check(carom_query_box(world_, x0, y0, x1, y1, ids.data(), ids.size(), &count));
    }
    ids.resize(count);
    return ids;
  }
  std::optional<std::uint32_t> nearest(double x, double y) const {
    std::uint32_t id = 0;
    return found(carom_nearest(world_, x, y, &id, nullptr)) ? std::optional(id) : std::nullopt;
  }
  std::optional<carom_hit> cast_ray(double x, double y, double dx, double dy, double length) const {
    carom_hit hit;
    return found(carom_cast_ray(world_, x, y, dx, dy, length, &hit)) ? std::optional(hit) : std::nullopt;
  }

  void save(const std::string& path) const { check(carom_save(world_, path.c_str())); }
  // Saves into memory; that of `into` is used again.
  void save(std::vector<std::byte>& into) const {
    std::size_t size = 0;
    into.resize(into.capacity() > 0 ? into.capacity() : 1);  // without room the call returns only the size
    if (carom_save_memory(world_, into.data(), into.size(), &size) != CAROM_OK) {
      into.resize(size);
      check(carom_save_memory(world_, into.data(), into.size(), &size));
    }
    into.resize(size);
  }
  void load(std::span<const std::byte> bytes) { check(carom_load_memory(world_, bytes.data(), bytes.size())); }

  std::vector<std::string> take_warnings() {
    std::vector<std::string> warnings;
    while (const char* warning = carom_next_warning(world_)) warnings.emplace_back(warning);
    return warnings;
  }

 private:
  World() = default;

  template <class Make>
  static World make(Make&& make_handle) {
    World world;
    world.check(make_handle(&world.world_));
    return world;
  }
  void check(carom_status status) const {
    if (status != CAROM_OK) throw Error(status, carom_error(world_));
  }
  bool found(carom_status status) const {
    if (status == CAROM_NOT_FOUND) return false;
    check(status);
    return true;
  }

  carom_world* world_ = nullptr;
};

}  // namespace handle
}  // namespace carom

#endif
