// A scene: the complete description of a run, with every default filled in. Plain data; scene_file.hpp reads it from
// TOML, initial_state.hpp makes disks from it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/gravity.hpp"
#include "core/disks/restitution_law.hpp"
#include "core/disks/roughness.hpp"

namespace carom {

enum class Method : std::uint8_t { rollback, pairwise, exact };

// How one group of disks (or one source) gets its radii or masses. Radius in length, mass in mass units.
struct SizeLaw {
  enum class Kind : std::uint8_t {
    constant,   // value
    list,       // values, one for each disk
    uniform,    // drawn from [low, high]
    normal,     // mean value, standard deviation
    lognormal,  // value times exp of a normal deviate of this standard deviation
    choice,     // one of values, by weights
    from_other  // radius from mass, r = sqrt(m / (pi density)), or mass from radius, m = pi density r^2
  };
  Kind kind = Kind::constant;
  double value = 0.0;
  std::vector<double> values;
  double low = 0.0, high = 0.0;
  double deviation = 0.0;       // of the size for normal, of its logarithm for lognormal
  std::vector<double> weights;  // as many as values
  double density = 0.0;         // mass / length^2
  std::string file{};           // the file of the values; empty if they are in the scene
};

// Part of the box within which a group starts, with whole disks: a rectangle or a circle.
struct StartRegion {
  bool circle = false;
  Vec2 low, high;       // corners of the rectangle, or of the square around a circle
  Vec2 centre;          // of a circle
  double radius = 0.0;  // of a circle; length
};

struct PositionLaw {
  enum class Kind : std::uint8_t { random, square, hexagonal, growth, list };
  Kind kind = Kind::random;
  std::vector<Vec2> list;             // from the scene or from a file
  std::string file;                   // the file of the list, for messages; empty if it is in the scene
  std::optional<StartRegion> region;  // for random places and lattices; absent: the whole box
  std::string where;                  // "file:line: key" of positions, for messages; empty if no file was read
};

struct VelocityLaw {
  enum class Kind : std::uint8_t {
    rest,
    maxwell,  // normal deviates at temperature (energy units, k_B = 1)
    uniform,  // each component uniform in [-limit, limit]
    list
  };
  Kind kind = Kind::rest;
  double temperature = 0.0;
  double limit = 0.0;
  std::vector<Vec2> list;
  std::string file;
};

// The initial spins of rough disks.
struct SpinLaw {
  double value = 0.0;        // 1 / time, counter-clockwise
  std::vector<double> list;  // if not empty, one for each disk, instead of value
  double temperature = 0.0;  // if > 0, normal deviates of mean square T / I instead of both
  std::string file;          // the file of the list; empty if it is in the scene
};

struct DiskGroup {
  std::string name;  // for columns, options and messages; empty: none
  Count count = 0;
  PositionLaw positions;
  VelocityLaw velocities;
  Vec2 drift;  // added to the velocities of the law; length / time
  SpinLaw spins;
  SizeLaw radius;
  SizeLaw mass;
  bool fixed = false;  // obstacles: they never move; their mass is infinite and not given
  int line = 0;        // of the [[disks]] header in the scene file, for error messages
};

// Emits the k-th disk (k = 1, 2, ...) at time k / rate, or later, once a place drawn for it is free.
struct Source {
  std::optional<Side> side;      // disks enter at this side, touching it, and move inwards
  Vec2 region_low, region_high;  // otherwise: centres uniform in this rectangle
  double rate = 0.0;             // disks / time
  SizeLaw radius, mass;
  VelocityLaw velocities;  // rest, maxwell or uniform
  SpinLaw spins;           // no list
  std::optional<Count> limit;
  int line = 0;
};

// A line of segments within the box, without thickness: each segment is an obstacle.
struct InnerWall {
  std::vector<Vec2> points;  // two or more; successive points differ
  bool sink = false;         // takes disks that touch it
  double restitution = 1.0;
  int line = 0;  // of the [[walls]] header
  WallMotion motion{};
};

// Keeps the disks at a temperature (core/step/thermostat.hpp).
struct Thermostat {
  enum class Kind : std::uint8_t {
    langevin,  // friction and noise on every disk
    andersen,  // some disks get new velocities
    none
  };
  Kind kind = Kind::none;
  double temperature = 0.0;  // k_B = 1
  double rate = 0.0;         // of friction, or of new velocities for a disk; 1 / time
  double dt = 0.0;           // between two kicks; 0: that of the run
  bool acts() const { return kind != Kind::none; }
  // Time between two kicks; step: of the run.
  double interval(double step) const { return dt > 0.0 ? dt : step; }
};

struct Physics {
  Gravity gravity;           // length / time^2
  double restitution = 1.0;  // of two disks, in [0, 1]; its least value if it depends on their speed
  RestitutionLaw law;        // further rules for restitution, beside that number
  double diffusion = 0.0;    // length^2 / time; > 0: Brownian motion, (24) of docs/original.md
  bool accumulate = false;   // docs/original.md: u / dt is added to the velocity instead of replacing it
  std::optional<double> collapse_contact_time;  // TC model, exact only
  Thermostat thermostat;
  Surfaces surfaces;  // rough or smooth
};

// The parameters of positions = "growth" (growth.hpp).
struct GrowthPlan {
  bool given = false;     // does the scene have [growth]?
  double slowness = 1.0;  // > 0; factor of the distance that disks move between two steps of growth
  Count steps = 10'000;   // the most steps
};

struct RunPlan {
  Method method = Method::exact;
  double dt = 0.0;         // time; 0 if the method needs none
  double t_end = 0.0;      // time
  bool automatic = false;  // method = "auto": method and dt were chosen for accuracy (method_choice.hpp)
  double accuracy = 0.0;   // allowed relative error of the method; 0: not given
  std::string choice{};    // the reason of the choice; empty unless automatic
};

enum class TrajectoryFormat : std::uint8_t { none, xyz, h5md };

// Disks with ids in [first, end). No disk has the largest number as id, so the default contains all disks.
struct IdRange {
  DiskId first = 0;
  DiskId end = std::numeric_limits<DiskId>::max();
  bool holds(DiskId id) const { return id >= first && id < end; }
  bool operator==(const IdRange&) const = default;
};

// The disks in a trajectory: those of a group, every n-th by id, or those with the centre in a rectangle.
struct Selection {
  std::string group;  // empty: all
  IdRange ids;        // of the group
  Count stride = 1;
  bool by_region = false;
  Vec2 low, high;  // of the rectangle, corners included
  bool all() const { return !by_region && stride == 1 && ids == IdRange{}; }
};

// The quantity that colours show in movies and pictures.
enum class ColourBy : std::uint8_t { speed, group, radius, mass, id };

// The settings of movies and pictures.
struct PictureLook {
  ColourBy colour = ColourBy::speed;
  double fps = 25.0;                           // frames per second of a movie
  int width = 0, height = 0;                   // pixels, both even; 0: chosen by the shape of the box
  std::optional<std::array<double, 2>> range;  // ends of the colour scale; absent: chosen by the run
  bool operator==(const PictureLook&) const = default;
};

struct OutputPlan {
  double every = 0.0;  // simulated time between frames; 0: only the first and the last
  TrajectoryFormat trajectory = TrajectoryFormat::none;
  Selection select;
  bool single_precision = false;  // of positions, velocities and spins in the trajectory
  bool series = false;
  std::vector<std::string> plots;  // "velocity", "energy"
  int dimensions = 2;              // components of positions and velocities in trajectory.h5; a third one is 0
  bool movie = false;
  PictureLook look;
  bool view = false;        // write a page that plays the trajectory
  double checkpoint = 0.0;  // wall time between checkpoints in seconds; 0: only on a signal
};

// The quantities that a run can measure.
enum class Quantity : std::uint8_t {
  pair_correlation,
  displacement,
  speeds,
  density,
  pressure,
  collision_rate,
  profile,
  velocity_autocorrelation,
  structure_factor,
  bond_order,
  bond_correlation,
  bond_autocorrelation
};
inline constexpr std::size_t quantities = 12;

// Equal bins of the distance of pairs.
struct DistancePlan {
  double r_max = 0.0;  // length
  Count bins = 0;
  double wall_margin = 0.0;  // least distance from walls and sinks of disks around which pairs are counted; length
};

struct NamedIds {
  std::string name;  // of a group
  IdRange ids;
};

// Measured at the times start + k every, and at t_end.
struct AnalysisPlan {
  std::array<bool, quantities> wanted{};  // by Quantity
  std::string group;   // its disks are measured, except for pressure and collision rate; empty: all disks
  IdRange ids;         // of the group
  double every = 0.0;  // simulated time between samples; 0: only the first and the last
  double start = 0.0;  // simulated time of the first
  DistancePlan pairs;  // of the pair correlation
  std::vector<NamedIds> pair_groups;  // each pair of them has a g(r)
  DistancePlan bonds;                 // of the bond correlation
  double speed_max = 0.0;             // of the speed histogram, in units of sqrt(T / m)
  Count speed_bins = 0;
  bool density_along_x = false;  // else along y
  Count density_bins = 0;
  double density_every = 0.0;    // simulated time of a row of the profile; 0: one profile for the whole run
  bool profile_along_x = false;  // profiles of velocity and temperature; else along y
  Count profile_bins = 0;
  double profile_every = 0.0;  // simulated time of a row of these profiles; 0: one for the whole run
  Count wave_numbers = 0;      // of the structure factor, along each periodic axis

  bool wants(Quantity q) const { return wanted[static_cast<std::size_t>(q)]; }
  bool any() const { return wanted != std::array<bool, quantities>{}; }
};

struct Scene {
  std::string title;
  std::string file;  // as given on the command line
  std::uint64_t seed = 1;
  Domain box;
  std::array<std::optional<double>, 4> side_places{};  // coordinates of moving sides, where the scene gives them
  Physics physics;
  std::vector<DiskGroup> groups;
  std::vector<Source> sources;
  std::vector<InnerWall> walls;
  GrowthPlan growth;
  RunPlan run;
  OutputPlan output;
  AnalysisPlan analysis;
};

// Is a side of the box or an inner wall a sink?
inline bool has_sinks(const Scene& scene) {
  for (const InnerWall& wall : scene.walls) {
    if (wall.sink) return true;
  }
  return scene.box.has(SideKind::sink);
}

// The number of sink numbers (core/disks/sink_counts.hpp); 0 without a sink.
inline std::size_t sink_numbers(const Scene& scene) {
  return has_sinks(scene) ? all_sides.size() + scene.walls.size() : 0;
}

// May a collision of two disks, fixed ones included, lose energy?
inline bool disks_dissipate(const Scene& scene) {
  const Surfaces& surfaces = scene.physics.surfaces;
  return scene.physics.restitution < 1.0 || scene.physics.law.dissipates() ||
         (surfaces.are_rough() && surfaces.disks.dissipates());
}

// May friction at walls dissipate energy?
inline bool walls_rub(const Scene& scene) {
  return scene.physics.surfaces.are_rough() && scene.physics.surfaces.walls.dissipates();
}

// Null if all surfaces are smooth. Valid as long as the scene.
inline const Surfaces* surfaces_of(const Scene& scene) {
  return scene.physics.surfaces.are_rough() ? &scene.physics.surfaces : nullptr;
}

// Null if one number is enough. Valid as long as the scene.
inline const RestitutionLaw* law_of(const Scene& scene) {
  return scene.physics.law.is_empty() ? nullptr : &scene.physics.law;
}

// The motion of each [[walls]] table; empty if no inner wall moves.
inline std::vector<WallMotion> motions_of(const Scene& scene) {
  std::vector<WallMotion> motions;
  if (!scene.box.inner_walls_move) return motions;
  for (const InnerWall& wall : scene.walls) motions.push_back(wall.motion);
  return motions;
}

// Speed of the fastest inner wall; length / time.
inline double fastest_inner_wall(const Scene& scene) {
  double fastest = 0.0;
  if (!scene.box.inner_walls_move) return fastest;
  for (const InnerWall& wall : scene.walls) fastest = std::max(fastest, wall.motion.largest_speed());
  return fastest;
}

// May a collision with an inner wall lose energy?
inline bool inner_walls_dissipate(const Scene& scene) {
  for (const InnerWall& wall : scene.walls) {
    if (wall.restitution < 1.0) return true;
  }
  return false;
}

}  // namespace carom
