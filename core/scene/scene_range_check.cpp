#include "core/scene/scene_range_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/input_message.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/scene_ranges.hpp"

namespace carom {

namespace {

double longer_side(const Domain& box) {
  return std::max(box.width, box.height);
}

// Throws InputError if `count` is too large. value: of the key, which leads to so many of `noun` until t_end.
void check_count(double count, double value, std::string_view key, std::string_view noun, double t_end,
                 const PlaceOfKey& place) {
  if (count <= most_steps) return;
  fail_input(place(key), fmt::format("is {}, which makes {:g} {} until run.t_end = {}", value, count, noun, t_end),
             fmt::format("expected at most 2^53 = {:g}", most_steps));
}

void check_period(const SideMotion& motion, const std::string& path, double t_end, const PlaceOfKey& place) {
  if (!motion.vibrates()) return;
  // Rounded up, since SideMotion::piece may count one more.
  const double count = std::nextafter(t_end / motion.half(), HUGE_VAL);
  check_count(count, motion.period, path + ".motion.period", "half periods", t_end, place);
}

// distance: covered by the fastest disk until t_end; length.
void check_flight(const Scene& scene, double distance, const std::string& where, const std::string& what) {
  const double crossings = distance / longer_side(scene.box);
  if (crossings <= most_crossings) return;
  fail_input(where, fmt::format("{} crosses the box {:g} times until run.t_end = {}", what, crossings, scene.run.t_end),
             fmt::format("expected at most 2^53 = {:g} times", most_crossings));
}

// what: the thing that has this speed, for messages.
void check_speed(const Scene& scene, double speed, const std::string& where, const std::string& what) {
  if (!(speed <= magnitudes_of(Dimension::speed).most)) {
    fail_input(where, fmt::format("{} has a speed of {}", what, speed), expected_range(Dimension::speed));
  }
  check_flight(scene, speed * scene.run.t_end, where, what);
}

bool steps_in_time(const Scene& scene) {
  return scene.run.method != Method::exact || scene.physics.diffusion > 0.0;
}

void check_gravity(const Scene& scene, const PlaceOfKey& place) {
  const Gravity& g = scene.physics.gravity;
  const bool number = !g.is_tilted() && g.down >= 0.0;
  const std::string given = number ? fmt::format("{}", g.down) : fmt::format("[{}, {}]", 0.0 - g.left, 0.0 - g.down);
  const double t = scene.run.t_end;
  const auto check = [&](double part, double length, bool periodic) {
    if (part == 0.0) return;
    // Between walls no fall is longer than the box; through periodic sides it never ends.
    const double speed = periodic ? 0.5 * part * t : std::sqrt(2.0 * part * length);
    check_flight(scene, speed * t, place("physics.gravity"), fmt::format("is {}: a disk that falls", given));
  };
  check(std::abs(g.left), scene.box.width, scene.box.periodic_x());
  check(std::abs(g.down), scene.box.height, scene.box.periodic_y());
}

void check_diffusion(const Scene& scene, const PlaceOfKey& place) {
  const double d = scene.physics.diffusion;
  if (d == 0.0 || scene.run.dt == 0.0) return;
  const double step = std::sqrt(2.0 * d * scene.run.dt);
  check_flight(scene, step * std::max(1.0, scene.run.t_end / scene.run.dt), place("physics.diffusion"),
               fmt::format("is {}: a disk in Brownian motion", d));
}

}  // namespace

void check_box_range(const Scene& scene, const PlaceOfKey& place) {
  for (const double side : {scene.box.width, scene.box.height}) {
    if (side > 0.0 && in_range(Dimension::length, side)) continue;
    fail_input(place("box.packing_fraction"), fmt::format("gives a box of {} x {}", scene.box.width, scene.box.height),
               fmt::format("{} each", expected_range(Dimension::length)));
  }
}

void check_positions(const PositionLaw& law, const std::string& path, const PlaceOfKey& place) {
  const double most = magnitudes_of(Dimension::length).most;
  for (std::size_t k = 0; k < law.list.size(); ++k) {
    const Vec2 p = law.list[k];
    if (std::abs(p.x) <= most && std::abs(p.y) <= most) continue;
    fail_input(place(fmt::format("{}.positions.{}", path, k)), fmt::format("is [{}, {}]", p.x, p.y),
               fmt::format("expected lengths of at most {}", most));
  }
}

void check_velocities(const Scene& scene, const VelocityLaw& law, double mass, const std::string& path,
                      const PlaceOfKey& place) {
  const auto check = [&](double speed, const std::string& key, const std::string& what) {
    check_speed(scene, speed, place(key), what);
  };
  const std::string key = path + ".velocities";
  if (law.kind == VelocityLaw::Kind::maxwell) {
    check(largest_deviate * std::sqrt(law.temperature / mass), key,
          fmt::format("maxwell = {} with mass {}", law.temperature, mass));
  }
  if (law.kind == VelocityLaw::Kind::uniform) {
    check(std::numbers::sqrt2 * law.limit, key, fmt::format("uniform = {}", law.limit));
  }
  if (law.kind != VelocityLaw::Kind::list) return;
  const double most = std::min(magnitudes_of(Dimension::speed).most,
                               most_crossings * longer_side(scene.box) / std::max(scene.run.t_end, 1e-300));
  for (std::size_t k = 0; k < law.list.size(); ++k) {
    const Vec2 v = law.list[k];
    if (std::abs(v.x) <= 0.5 * most && std::abs(v.y) <= 0.5 * most) continue;  // the usual case, tested cheaply
    check(std::hypot(v.x, v.y), fmt::format("{}.{}", key, k), fmt::format("is [{}, {}]: it", v.x, v.y));
  }
}

void check_thermal_sides(const Scene& scene, double smallest_mass, const PlaceOfKey& place) {
  if (!(smallest_mass > 0.0)) return;
  if (const Thermostat& bath = scene.physics.thermostat; bath.acts()) {
    check_speed(scene, largest_deviate * std::sqrt(bath.temperature / smallest_mass),
                place("physics.thermostat.temperature"),
                fmt::format("is {}: a disk of mass {}", bath.temperature, smallest_mass));
  }
  for (const Side side : all_sides) {
    if (!scene.box.is_thermal(side)) continue;
    const double temperature = scene.box.temperature(side);
    check_speed(scene, largest_deviate * std::sqrt(temperature / smallest_mass),
                place(fmt::format("box.{}.temperature", side_names[static_cast<std::size_t>(side)])),
                fmt::format("is {}: a disk of mass {}", temperature, smallest_mass));
  }
}

void check_emissions(const Scene& scene, const Source& source, const std::string& path, const PlaceOfKey& place) {
  const double due = source.rate * scene.run.t_end;
  if (due <= most_emissions) return;
  fail_input(place(path + ".rate"),
             fmt::format("is {}: {:g} disks are due until run.t_end = {}", source.rate, due, scene.run.t_end),
             fmt::format("expected at most 2^50 = {:g}", most_emissions));
}

void check_times(const Scene& scene, const PlaceOfKey& place) {
  const double t_end = scene.run.t_end;
  const auto check = [&](double interval, std::string_view key, std::string_view noun) {
    if (interval > 0.0) check_count(t_end / interval, interval, key, noun, t_end, place);
  };
  if (steps_in_time(scene)) check(scene.run.dt, "run.dt", "steps");
  if (const Thermostat& bath = scene.physics.thermostat; bath.acts()) {
    check(bath.interval(scene.run.dt), bath.dt > 0.0 ? "physics.thermostat.dt" : "run.dt", "kicks");
  }
  check(scene.output.every, "output.every", "frames");
  check(scene.analysis.every, "analysis.every", "samples");
  for (const Side side : all_sides) {
    const auto k = static_cast<std::size_t>(side);
    check_period(scene.box.motions[k], fmt::format("box.{}", side_names[k]), t_end, place);
  }
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    check_period(scene.walls[k].motion.pace, fmt::format("walls.{}", k), t_end, place);
  }
  check_gravity(scene, place);
  check_diffusion(scene, place);
}

void check_resolution(const Scene& scene, double smallest_radius, const PlaceOfKey& place) {
  const double side = longer_side(scene.box);
  if (smallest_radius == 0.0 || side / smallest_radius <= most_radii) return;
  fail_input(place(scene.box.width >= scene.box.height ? "box.width" : "box.height"),
             fmt::format("{} is {:g} times the smallest radius, {}", side, side / smallest_radius, smallest_radius),
             fmt::format("expected at most 2^40 = {:g} times: positions have 16 digits", most_radii));
}

}  // namespace carom
