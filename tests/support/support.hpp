// What physics tests share: scenes and states written down by hand, seeded draws, running an engine step by step.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/disks/state.hpp"
#include "core/physics/disk_pair.hpp"
#include "core/scene/scene.hpp"
#include "core/step/engine.hpp"

namespace carom::test {

inline constexpr double pi = 3.14159265358979323846;

// More digits than a double has, for formulas to compare ours with.
using Wide = long double;
inline Wide wide(double x) {
  return static_cast<Wide>(x);
}

// The methods that step in time.
inline const std::vector<Method> stepping_methods{Method::rollback, Method::pairwise};

inline std::string name_of(Method method) {
  return method == Method::rollback ? "rollback" : method == Method::pairwise ? "pairwise" : "exact";
}

// Seeded draws for scenery: splitmix64, so that every machine gets the same test.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  double in(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
  // Every decade equally likely.
  double decades(double low, double high) { return std::exp(in(std::log(low), std::log(high))); }

 private:
  std::uint64_t state_;
};

// A box of walls, nothing moves it: no gravity, e = 1.
inline Scene scene_of(Method method, double width, double height, double dt, double t_end) {
  Scene scene;
  scene.title = "test";
  scene.box.width = width;
  scene.box.height = height;
  scene.run = {method, dt, t_end};
  return scene;
}

inline void set_sides(Domain& box, SideKind left_right, SideKind bottom_top) {
  box.sides = {left_right, left_right, bottom_top, bottom_top};
}

inline Disks disks_of(const std::vector<Disk>& list) {
  Disks disks;
  for (std::size_t i = 0; i < list.size(); ++i) {
    Disk disk = list[i];
    disk.id = static_cast<DiskId>(i);
    append(disks, disk);
  }
  return disks;
}

// Ids from 0 on, in the order of the list.
inline State state_of(const Scene& scene, const std::vector<Disk>& list) {
  State state;
  state.disks = disks_of(list);
  state.next_id = static_cast<DiskId>(list.size());
  state.sources.resize(scene.sources.size());
  return state;
}

// Centre of cell k of a square of per_side x per_side cells, row by row.
inline Vec2 cell_centre(int k, int per_side, double cell) {
  const int column = k % per_side;
  const int row = k / per_side;
  return {cell * (0.5 + column), cell * (0.5 + row)};
}

struct Ranges {
  double radius_low = 1.0, radius_high = 1.0;
  double mass_low = 1.0, mass_high = 1.0;
  double speed = 1.0;  // each component in [-speed, speed]
};

// n disks without overlap; the large ones may not find room, so densities here are modest.
inline std::vector<Disk> random_disks(Draws& draws, const Domain& box, std::size_t n, const Ranges& ranges) {
  std::vector<Disk> list;
  while (list.size() < n) {
    Disk d;
    d.radius = draws.in(ranges.radius_low, ranges.radius_high);
    d.mass = draws.in(ranges.mass_low, ranges.mass_high);
    d.x = draws.in(d.radius, box.width - d.radius);
    d.y = draws.in(d.radius, box.height - d.radius);
    d.vx = draws.in(-ranges.speed, ranges.speed);
    d.vy = draws.in(-ranges.speed, ranges.speed);
    bool free = true;
    for (const Disk& other : list) {
      const double dx = d.x - other.x;
      const double dy = d.y - other.y;
      free = free && !touches(dx * dx + dy * dy, d.radius + other.radius);
    }
    if (free) list.push_back(d);
  }
  return list;
}

// Steps to the end of the run; look(engine) after each step.
inline State run(const Scene& scene, State initial, const std::function<void(const Engine&)>& look = {}) {
  const auto engine = make_reference_engine(scene, std::move(initial));
  while (engine->state().time < scene.run.t_end) {
    engine->step();
    if (look) look(*engine);
  }
  return engine->state();
}

}  // namespace carom::test
