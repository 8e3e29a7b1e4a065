#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "app/run/check_report.hpp"
#include "app/run/trial_memory.hpp"
#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/base/wall_clock.hpp"
#include "core/disks/fastest_speed.hpp"
#include "core/load/memory_need.hpp"
#include "core/load/method_rates.hpp"
#include "core/load/scene_scales.hpp"
#include "core/load/scene_warnings.hpp"
#include "core/scene/scene_output.hpp"
#include "core/scene/size_law.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/step_start.hpp"
#include "core/step/validity.hpp"
#include "run/engine/make_engine.hpp"

namespace carom {

namespace {

// Time for trying the scene's first steps, in seconds: long enough to measure the cost, short enough to wait for.
constexpr double trial_seconds = 0.2;
// Memory that MPI uses in a process of several ranks, beyond that of a process without it; bytes, measured.
constexpr double mpi_bytes = 25e6;
// A step that takes longer is given up; seconds.
constexpr double longest_trial = 60.0;

void measure_sizes(const Scene& scene, const Disks& disks, Findings& f) {
  f.disks = disks.size();
  f.smallest_radius = smallest_radius(disks);
  f.largest_radius = largest_radius(disks);
  double area = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const double mass = disks.mass_of(i);
    f.smallest_mass = i == 0 ? mass : std::min(f.smallest_mass, mass);
    f.largest_mass = std::max(f.largest_mass, mass);
    area += std::numbers::pi * disks.radius_of(i) * disks.radius_of(i);
  }
  const double box = scene.box.width * scene.box.height;
  f.packing_fraction = area / box;
  DiskId first_id = 0;
  for (const DiskGroup& group : scene.groups) {
    const double squares = group.fixed ? summarise_sizes(group, scene.seed, first_id).radius_squared : 0.0;
    f.packing_fraction_fixed += std::numbers::pi * squares / box;
    first_id += static_cast<DiskId>(group.count);
  }
}

// The time for growing the scene's disks, from the measurements in docs/methods.md: collisions a disk rise steeply
// towards the densest mixtures.
double growth_seconds(const Scene& scene, const Findings& f) {
  if (!grows(scene)) return 0.0;
  constexpr double seconds_a_collision = 2e-6;
  const double to_go = std::max(0.01, 0.86 - f.packing_fraction);
  const double collisions_a_disk = 0.5 / (to_go * to_go) * scene.growth.slowness;
  return 0.5 * seconds_a_collision * collisions_a_disk * static_cast<double>(f.disks);
}

// The scene's disks if growing them takes too long: with their sizes and velocities, but not their places.
State ungrown_state(const Scene& scene) {
  GrowthTools nothing;
  nothing.step = [](Disks&, const Domain&, const std::vector<double>&) { return GrowthTally{}; };
  const auto nowhere = [](const Scene&, Disks&, PlacementGrid&, const std::vector<std::uint32_t>&) {};
  return initial_state(scene, nowhere, nothing);
}

// If sources fill the box, the first steps are not representative: their time for the present disks is scaled to the
// mean number of disks; the result is at least that from the rates of core/load/method_rates.hpp.
double seconds_with_sources(const Scene& scene, const Population& population, double first_steps) {
  const double growth = population.start > 0.0 ? population.mean / population.start : 0.0;
  const double extrapolated = std::isfinite(first_steps) ? first_steps * growth : 0.0;
  const double collisions = 0.5 * population.mean * scales_of(scene).collision_rate * scene.run.t_end;
  const bool stepping = scene.run.method != Method::exact;
  const double steps = uses_dt(scene) ? scene.run.t_end / scene.run.dt : 0.0;
  const double by_rates = rates::pairwise_step * population.mean * steps +
                          collisions * (stepping ? rates::pairwise_collision : rates::exact_collision);
  return std::max(extrapolated, by_rates + (growth > 0.0 ? 0.0 : first_steps));
}

// The mean number of disks over the run, over that at the start, if sinks take disks. They take ever fewer as the disks
// near them disappear, so it is between 1 (no loss) and the mean for a loss at the rate of the trial; the result is the
// geometric mean of these.
double share_left(const Engine& engine, const Scene& scene, const Population& population) {
  const State& now = engine.state();
  const auto left = static_cast<double>(now.disks.size());
  if (!scene.sources.empty() || !(now.time > 0.0) || !(left < population.start)) return 1.0;
  const double losses = std::log(population.start / std::max(0.5, left)) * scene.run.t_end / now.time;
  return std::sqrt(-std::expm1(-losses) / losses);
}

// Will disks collide ever less, since they lose energy or leave, and nothing adds any?
bool runs_down(const Scene& scene) {
  const Physics& physics = scene.physics;
  const bool still = std::all_of(all_sides.begin(), all_sides.end(),
                                 [&](Side side) { return !scene.box.is_thermal(side) && !scene.box.moves(side); });
  const bool nothing_comes = still && !scene.box.inner_walls_move && !scene.box.shear.acts() &&
                             !physics.thermostat.acts() && !physics.gravity.acts() && scene.sources.empty();
  return nothing_comes && !(physics.diffusion > 0.0) && (disks_dissipate(scene) || has_sinks(scene));
}

// Makes the first steps, for trial_seconds after the first one. The cost of the exact method is proportional to
// collisions.
StepTrial time_steps(Engine& engine, const Scene& scene, std::string& stopped) {
  const auto start = WallClock::now();
  engine.set_watch([&] { return seconds_since(start) < longest_trial; });
  StepTrial trial;
  const bool slows = scene.run.method == Method::exact && runs_down(scene);
  std::vector<std::pair<double, Count>> seen;  // time, and number of collisions up to then
  try {
    while (engine.state().time < scene.run.t_end && trial.seconds < trial.first_seconds + trial_seconds) {
      engine.step();
      trial.seconds = seconds_since(start);
      trial.end = engine.state().time;
      const Counters& counters = engine.state().counters;
      if (slows) seen.emplace_back(trial.end, counters.collisions + counters.wall_collisions);
      if (trial.first_end > 0.0) continue;
      trial.first_seconds = trial.seconds;
      trial.first_end = trial.end;
    }
  } catch (const PhysicsError& error) {
    stopped = error.what();
  }
  engine.set_watch({});
  const auto is_half = [&](const auto& moment) { return moment.first >= 0.5 * trial.end; };
  const auto half = std::find_if(seen.begin(), seen.end(), is_half);
  if (half != seen.end()) {
    trial.slowing = slowing_of_collisions(half->first, half->second, seen.back().first, seen.back().second);
  }
  return trial;
}

// Runs the first steps, and extrapolates.
void try_steps(Engine& engine, const Scene& scene, Findings& f) {
  const StepTrial trial = time_steps(engine, scene, f.stopped);
  f.step_seconds = trial.seconds_to(scene.run.t_end);
  const double share = share_left(engine, scene, f.population);
  const bool told_by_collisions = trial.slowing > 0.0;
  if (engine.state().time < scene.run.t_end && !told_by_collisions) f.step_seconds *= share;
  f.population.mean *= share;
  if (f.population.end > f.population.start) {
    f.step_seconds = seconds_with_sources(scene, f.population, f.step_seconds);
  }
}

// That of disks which sources will add; bytes.
double memory_of_newcomers(const Scene& scene, const Population& population) {
  if (!(population.end > population.start)) return 0.0;
  return least_memory(scene.run.method, static_cast<Count>(population.end - population.start),
                      scene.physics.surfaces.are_rough());
}

// Reports sources that had no room in the trial, if there was enough of it: a few disks may well wait for a while.
std::vector<std::string> waiting_in_trial(const Scene& scene, const State& now) {
  constexpr Count enough = 20;  // disks
  const Count due = now.counters.emitted + now.counters.waiting;
  if (due < enough && now.time < scene.run.t_end) return {};
  return waiting_warnings(scene, now, "tried up to");
}

void try_run(const Scene& scene, const EngineChoice& choice, State initial, Findings& found) {
  const auto engine = within_memory(scene, [&] { return make_engine(choice, scene, std::move(initial)); });
  const BlockRunner run = make_block_runner(choice);
  if (!wants_frames(scene.output) && !scene.analysis.any()) engine->forget_paths();
  within_memory(scene, [&] {
    std::optional<TrialFrames> frames(std::in_place, scene, run);
    frames->make(*engine);
    try_steps(*engine, scene, found);
    frames->make(*engine);
    frames.reset();  // files are rehearsed with buffers of their own
    for (const std::string& trouble : waiting_in_trial(scene, engine->progress())) found.troubles.push_back(trouble);
    found.outputs = foresee_outputs(scene, choice, *engine, found.population, found.step_seconds);
    for (const std::string& trouble : found.outputs.missing) found.troubles.push_back(trouble);
    end_in_memory(*engine, scene, run);
    found.memory_bytes = peak_bytes() + memory_of_newcomers(scene, found.population) + found.outputs.ffmpeg_bytes;
  });
}

// After the memory of one process has been measured, since all ranks are threads of this one.
void try_ranks(const Scene& scene, const EngineChoice& choice, int ranks, bool tried, Findings& found) {
  if (!tried) fail_input("--ranks", "the growth of the disks takes too long for a trial", "expected no --ranks");
  found.ranks = within_memory(scene, [&] { return foresee_ranks(scene, make_initial_state(choice, scene), ranks); });
  if (const SlabTraffic& tried_on = found.ranks->traffic; tried_on.lone_steps > 0) {
    found.troubles.push_back(
        fmt::format("in {} of {} of a trial on {} ranks one of them ran all disks, as slabs were too thin or too "
                    "crowded; use fewer ranks, or a higher box",
                    tried_on.lone_steps, counted(tried_on.steps, "step"), tried_on.ranks));
  }
  if (found.ranks->first_has_all) {
    found.ranks->first_bytes = found.memory_bytes + mpi_bytes;
  } else {
    found.ranks->first_bytes += found.outputs.ffmpeg_bytes;
  }
}

}  // namespace

int command_check(const CheckOptions& options) {
  const Scene scene = load_scene_as_told(options.scene, options.changes);
  const EngineChoice choice = choose_engine("", options.threads);
  for (const std::string& warning : scene_warnings(scene)) print_warning(warning);
  Findings found;
  const auto start = WallClock::now();
  State initial =
      within_memory(scene, [&] { return grows(scene) ? ungrown_state(scene) : make_initial_state(choice, scene); });
  measure_sizes(scene, initial.disks, found);
  found.growth_seconds = growth_seconds(scene, found);
  const bool tried = found.growth_seconds <= longest_growth;
  if (tried && grows(scene)) initial = within_memory(scene, [&] { return make_initial_state(choice, scene); });
  found.start_seconds = seconds_since(start);
  for (const std::string& warning :
       validity_warnings_at_start(scene, found.smallest_radius, fastest_speed(initial.disks)))
    print_warning(warning);
  found.steps = foresee_steps(scene, initial.disks);
  found.population = foresee_population(scene, initial.disks);
  found.collapse = foresee_collapse(scene, initial.disks);
  found.troubles = foreseen_troubles(scene, found.steps, found.population, found.collapse);
  found.outputs.frames = moments_shown(scene, scene.output.every, scene.run.t_end);
  if (!tried) found.memory_bytes = least_memory(Method::exact, found.disks, scene.physics.surfaces.are_rough());
  if (tried) try_run(scene, choice, std::move(initial), found);
  if (options.ranks) try_ranks(scene, choice, *options.ranks, tried, found);
  print_out(options.json ? check_json(scene, found, options.accuracy) : check_text(scene, found, options.accuracy));
  return 0;
}

}  // namespace carom
