#include "app/run/check_foresight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/load/scene_scales.hpp"
#include "core/physics/boundary.hpp"
#include "core/scene/drawn_velocities.hpp"
#include "core/scene/size_law.hpp"
#include "core/step/source.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_start.hpp"
#include "core/step/validity.hpp"

namespace carom {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Random addition jams at a packing fraction of 0.547 (equal disks): sources find hardly any room beyond it.
constexpr double source_fill = 0.547;

// The number of draws of a source from which the smallest disk and the mean area are found.
constexpr Count most_draws = 1000;

// How far a disk at this place may fall towards the side.
double way_to(Side side, const Domain& box, Vec2 centre, double radius) {
  return std::max(-reach_beyond(side, centre.x, centre.y, radius, box), 0.0);
}

// The speed that a disk of this speed has after falling from its place to the sides towards which gravity pulls it; if
// there is no such side it falls to the end of the run.
double fallen_speed(const Scene& scene, double speed, Vec2 centre, double radius) {
  double square = speed * speed, endless = 0.0;
  for (const Side side : all_sides) {
    const double g = outward_acceleration(side, scene.physics.gravity);
    if (!(g > 0.0)) continue;
    if (scene.box.side(side) == SideKind::periodic) {
      endless += g * scene.run.t_end;
    } else {
      square += 2.0 * g * way_to(side, scene.box, centre, radius);
    }
  }
  return std::sqrt(square) + endless;
}

// The number of disks that a source emits, as far as it finds room.
double emitted_by(const Source& source, double t_end) {
  return static_cast<double>(due_before(source, t_end));
}

struct SourceDisks {
  double smallest_radius = infinity;
  double mean_area = 0.0;
  double speed = 0.0;          // of the fastest disk emitted
  double lightest = infinity;  // mass
  Vec2 centre;                 // the place from which disks fall furthest
};

// The corner of a rectangle from which a disk falls furthest.
Vec2 highest_corner(const Gravity& g, Vec2 low, Vec2 high) {
  return {g.left < 0.0 ? low.x : high.x, g.down < 0.0 ? low.y : high.y};
}

// The place where a source's disks can begin from which they fall furthest.
Vec2 highest_place(const Scene& scene, const Source& source) {
  const Gravity& g = scene.physics.gravity;
  if (!source.side) return highest_corner(g, source.region_low, source.region_high);
  Vec2 low, high{scene.box.width, scene.box.height};
  switch (*source.side) {
    case Side::left:
      high.x = 0.0;
      break;
    case Side::right:
      low.x = high.x;
      break;
    case Side::bottom:
      high.y = 0.0;
      break;
    case Side::top:
      low.y = high.y;
  }
  return highest_corner(g, low, high);
}

SourceDisks disks_of(const Scene& scene, const Source& source) {
  SourceDisks d;
  const double count = std::max(1.0, emitted_by(source, scene.run.t_end));
  const Count draws = std::min(most_draws, static_cast<Count>(count));
  double mass = infinity;
  for (Count k = 0; k < draws; ++k) {
    const DiskSize size = draw_size(source.radius, source.mass, scene.seed, Stream::source_radius, Stream::source_mass,
                                    static_cast<DiskId>(k), k);
    d.smallest_radius = std::min(d.smallest_radius, size.radius);
    d.mean_area += std::numbers::pi * size.radius * size.radius / static_cast<double>(draws);
    mass = std::min(mass, size.mass);
  }
  const VelocityLaw& law = source.velocities;
  if (law.kind == VelocityLaw::Kind::uniform) d.speed = std::numbers::sqrt2 * law.limit;
  // In two dimensions the fastest of n draws has about m v^2 / 2 = T ln n.
  if (law.kind == VelocityLaw::Kind::maxwell) {
    d.speed = std::sqrt(2.0 * law.temperature / mass * std::log(std::max(2.0, count)));
  }
  d.lightest = mass;
  d.centre = highest_place(scene, source);
  return d;
}

bool emits(const Scene& scene, const Source& source) {
  return emitted_by(source, scene.run.t_end) >= 1.0;
}

double speed_of(const Disks& d, std::size_t i) {
  return std::hypot(d.vx[i], d.vy[i]);
}

// What gives speed to disks: the fastest wall, a side or an inner one, and the hottest side or thermostat.
struct Drive {
  double wall = 0.0;         // length / time
  double temperature = 0.0;  // mass length^2 / time^2

  explicit Drive(const Scene& scene)
      : wall(fastest_inner_wall(scene)), temperature(scene.physics.thermostat.temperature) {
    for (const Side side : all_sides) {
      wall = std::max(wall, scene.box.motions[static_cast<std::size_t>(side)].largest_speed());
      temperature = std::max(temperature, scene.box.temperature(side));
    }
  }
  // The speed of the fastest of n disks, of this mass, that start at this speed: in two dimensions the fastest of n
  // draws has m v^2 / 2 = T ln n, and a moving wall sends a disk off faster by twice the wall's speed.
  double speed(double start, double mass, double n) const {
    return std::max(start, std::sqrt(2.0 * temperature / mass * std::log(std::max(2.0, n)))) + 2.0 * wall;
  }
};

// A Brownian step is sqrt(2 D dt) in each direction; three times that is allowed for, since some disk always moves so
// far. The exact method divides no steps, and warns if that of one disk is too long for its collisions.
double brownian_step(const Scene& scene, double radius) {
  if (!(scene.physics.diffusion > 0.0)) return infinity;
  const double share = (scene.run.method == Method::exact ? largest_brownian_step : safe_travel / 3.0) * radius;
  return share * share / (2.0 * scene.physics.diffusion);
}

// For steps that draw their own speeds, or that no speed divides.
StepForesight foresee_brownian_steps(const Scene& scene, const Disks& start) {
  double radius = start.empty() ? infinity : smallest_radius(start);
  StepForesight f;
  f.at_start = brownian_step(scene, radius);
  for (const Source& source : scene.sources) {
    if (emits(scene, source)) radius = std::min(radius, disks_of(scene, source).smallest_radius);
  }
  f.later = brownian_step(scene, radius);
  f.resting = infinity;
  return f;
}

// The time at which a disk at this distance from a side, moving away from it at `rising`, has bounced there for the
// last time, if it meets nothing else: each flight is shorter than the last by the wall's restitution.
double rest_time(const Scene& scene, Side side, double way, double rising) {
  const double g = outward_acceleration(side, scene.physics.gravity), e = scene.box.restitution(side);
  const double landing = std::sqrt(rising * rising + 2.0 * g * way);
  return (rising + landing) / g + 2.0 * landing * e / (g * (1.0 - e));
}

// The time at which the first disk comes to rest on this side.
double first_rest(const Scene& scene, Side side, const Disks& start) {
  double first = infinity;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const double way = way_to(side, scene.box, {start.x[i], start.y[i]}, start.radius_of(i));
    first = std::min(first, rest_time(scene, side, way, -outward_speed(side, start.vx[i], start.vy[i])));
  }
  for (const Source& source : scene.sources) {
    if (!emits(scene, source)) continue;
    const double way = way_to(side, scene.box, highest_place(scene, source), 0.0);
    first = std::min(first, 1.0 / source.rate + rest_time(scene, side, way, 0.0));
  }
  return first;
}

}  // namespace

bool uses_dt(const Scene& scene) {
  return scene.run.method != Method::exact || scene.physics.diffusion > 0.0;
}

double StepTrial::seconds_to(double t_end) const {
  if (!(t_end > 0.0)) return 0.0;
  if (!(end > 0.0)) return infinity;
  if (!(end > first_end)) return seconds * t_end / end;
  const auto paid = [&](double t) { return slowing > 0.0 ? std::log1p(slowing * t) : t; };
  return seconds + (seconds - first_seconds) * (paid(t_end) - paid(end)) / (paid(end) - paid(first_end));
}

double slowing_of_collisions(double half, Count count_half, double end, Count count_end) {
  constexpr Count enough = 10'000;
  constexpr double steady = 0.97, least = 1e-3, most = 1e6;  // of k times the end
  if (count_half < enough || !(end > half)) return 0.0;
  const double ratio = static_cast<double>(count_end) / static_cast<double>(count_half);
  if (ratio > std::pow(end / half, steady)) return 0.0;
  double low = least / end, high = most / end;
  for (int k = 0; k < 60; ++k) {
    const double middle = std::sqrt(low * high);
    (std::log1p(middle * end) > ratio * std::log1p(middle * half) ? low : high) = middle;
  }
  return low;
}

double StepForesight::safe() const {
  return std::min({at_start, later, resting});
}

StepForesight foresee_steps(const Scene& scene, const Disks& start) {
  if (scene.physics.diffusion > 0.0 && (scene.run.method == Method::exact || velocities_are_drawn(scene))) {
    return foresee_brownian_steps(scene, start);
  }
  const double g = scene.physics.gravity.size;
  double radius = start.empty() ? infinity : smallest_radius(start);
  double fastest = 0.0, later = 0.0;  // radii per unit time
  const Drive drive(scene);
  StepForesight f;
  f.driven = drive.wall > 0.0 || drive.temperature > 0.0;
  const auto see = [&](double speed, Vec2 centre, double r) {
    const double landing = g > 0.0 ? fallen_speed(scene, speed, centre, r) : speed;
    later = std::max(later, landing / r);
    if (g > 0.0) f.landing_speed = std::max(f.landing_speed, landing);
  };
  for (std::size_t i = 0; i < start.size(); ++i) {
    const double r = start.radius_of(i);
    fastest = std::max(fastest, speed_of(start, i) / r);
    const double speed = drive.speed(speed_of(start, i), start.mass_of(i), static_cast<double>(start.size()));
    see(speed, {start.x[i], start.y[i]}, r);
  }
  const double fall_at_start = radius < infinity ? g / radius : 0.0;
  if (radius < infinity) fastest += fastest_inner_wall(scene) / radius;  // neither may a wall jump over a disk
  f.at_start = std::min(step_within(safe_travel, fastest, fall_at_start), brownian_step(scene, radius));
  for (const Source& source : scene.sources) {
    if (!emits(scene, source)) continue;
    const SourceDisks d = disks_of(scene, source);
    radius = std::min(radius, d.smallest_radius);
    see(drive.speed(d.speed, d.lightest, 2.0), d.centre, d.smallest_radius);
  }
  const double fall = radius < infinity ? g / radius : 0.0;
  f.later = std::min(step_within(safe_travel, later, fall), brownian_step(scene, radius));
  // A support is recognised by speeds of about g dt: a disk at rest falls by g dt^2 before its contact is found.
  f.resting = settles(scene) && radius < infinity ? std::sqrt(largest_overlap * radius / g) : infinity;
  return f;
}

Population foresee_population(const Scene& scene, const Disks& start) {
  Population p;
  p.start = p.mean = p.end = static_cast<double>(start.size());
  double area = 0.0;
  for (std::size_t i = 0; i < start.size(); ++i) area += std::numbers::pi * start.radius_of(i) * start.radius_of(i);
  for (const Source& source : scene.sources) {
    const double emitted = emitted_by(source, scene.run.t_end);
    if (!(emitted >= 1.0)) continue;
    // The number rises at a constant rate, and stays constant from the end of the source on.
    const double filling = std::min(1.0, emitted / (source.rate * scene.run.t_end));
    p.mean += emitted * (1.0 - 0.5 * filling);
    p.end += emitted;
    area += emitted * disks_of(scene, source).mean_area;
  }
  p.fill = area / (scene.box.width * scene.box.height);
  return p;
}

CollapseForesight foresee_collapse(const Scene& scene, const Disks& start) {
  const Physics& p = scene.physics;
  if (scene.run.method != Method::exact || p.collapse_contact_time || p.diffusion > 0.0) return {};
  const SceneScales scales = scales_of(scene);
  if (!scales.may_collapse) return {};
  bool floor = false, soft = false;
  double first = infinity;
  for (const Side side : all_sides) {
    const bool presses = outward_acceleration(side, p.gravity) > 0.0;
    if (!presses || scene.box.side(side) != SideKind::wall) continue;
    floor = true;
    if (scene.box.restitution(side) >= 1.0) continue;
    soft = true;
    first = std::min(first, first_rest(scene, side, start));
  }
  if (!soft) return {!p.gravity.acts() || floor, std::nullopt};
  return first < scene.run.t_end ? CollapseForesight{true, first} : CollapseForesight{};
}

namespace {

// Is the wall a straight line from one periodic side to the other that moves along itself? Then it looks the same at
// all times, and has no effect on disks unless it is rough.
bool runs_round(const InnerWall& wall, const Domain& box) {
  if (!wall.motion.moves() || wall.points.size() != 2) return false;
  const Vec2 a = wall.points.front(), b = wall.points.back(), along = wall.motion.along;
  const bool round_x = box.periodic_x() && along.y == 0.0 && a.y == b.y && std::abs(b.x - a.x) >= box.width;
  const bool round_y = box.periodic_y() && along.x == 0.0 && a.x == b.x && std::abs(b.y - a.y) >= box.height;
  return round_x || round_y;
}

void add_smooth_drives(const Scene& scene, std::vector<std::string>& troubles) {
  if (scene.physics.surfaces.are_rough() && scene.physics.surfaces.walls.acts()) return;
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    if (!runs_round(scene.walls[k], scene.box)) continue;
    troubles.push_back(
        fmt::format("walls.{} moves along itself but is smooth, so it does not drag disks along: that needs "
                    "physics.roughness and box.wall_roughness",
                    k));
  }
}

void add_collapse(const CollapseForesight& collapse, std::vector<std::string>& troubles) {
  if (!collapse.expected) return;
  const std::string when = collapse.from ? fmt::format("about t = {:.2g}", *collapse.from) : "some time";
  troubles.push_back(fmt::format(
      "inelastic collapse, infinitely many collisions in finite time, is expected from {} on: the run would stop with "
      "status 3; use --method pairwise, or set physics.collapse = {{ model = \"tc\", contact_time = ... }}",
      when));
}

// The consequence of a dt longer than the safe step. Only the speeds of the start are certain: those of a fall through
// the whole box or off the fastest wall, and three deviations of a draw, may never be reached.
const char* outcome_of_long_step(const Scene& scene, const StepForesight& steps) {
  if (scene.run.method == Method::exact) return "collisions of Brownian disks will be wrong";
  const bool brownian = scene.physics.diffusion > 0.0;
  const bool hopeless = !brownian && scene.run.dt > most_parts * steps.at_start;
  if (hopeless) return "the run will stop at once, with status 3";
  return !brownian && scene.run.dt > steps.at_start ? "steps will be split" : "steps may be split";
}

void add_long_step(const Scene& scene, const StepForesight& steps, std::vector<std::string>& troubles) {
  const double dt = scene.run.dt;
  const double safe = std::min(steps.at_start, steps.later);
  if (!uses_dt(scene) || !(dt > safe)) return;
  const char* const when =
      scene.run.method == Method::exact ? " of disks from sources" : " at the speeds that disks may reach";
  troubles.push_back(fmt::format("dt = {:g} is longer than the safe step{}: {}; use dt <= {:.2g}", dt,
                                 dt <= steps.at_start ? when : "", outcome_of_long_step(scene, steps), safe));
}

void add_fall_in_pile(const Scene& scene, const StepForesight& steps, std::vector<std::string>& troubles) {
  if (scene.run.method == Method::exact || !(scene.run.dt > steps.resting)) return;
  troubles.push_back(fmt::format(
      "in a pile a disk falls by g dt^2 before it is held, more than {:g} % of the smallest radius: use dt <= {:.2g}",
      100.0 * largest_overlap, steps.resting));
}

void add_full_box(const Scene& scene, const Population& population, std::vector<std::string>& troubles) {
  if (has_sinks(scene) || !(population.end > population.start && population.fill > source_fill)) return;
  troubles.push_back(
      fmt::format("the sources would fill the box to a packing fraction of {:.2g}, but there is no room beyond about "
                  "{:g}: set a limit, or add a sink",
                  population.fill, source_fill));
}

}  // namespace

std::vector<std::string> foreseen_troubles(const Scene& scene, const StepForesight& steps, const Population& population,
                                           const CollapseForesight& collapse) {
  std::vector<std::string> troubles;
  add_collapse(collapse, troubles);
  add_long_step(scene, steps, troubles);
  add_fall_in_pile(scene, steps, troubles);
  add_full_box(scene, population, troubles);
  add_smooth_drives(scene, troubles);
  return troubles;
}

}  // namespace carom
