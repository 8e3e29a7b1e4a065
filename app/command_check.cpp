#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/commands.hpp"
#include "app/make_engine.hpp"
#include "app/progress.hpp"
#include "app/run_outputs.hpp"
#include "core/check.hpp"
#include "core/initial_state.hpp"
#include "core/invariants.hpp"
#include "core/memory_need.hpp"
#include "core/method_choice.hpp"
#include "core/scene_check.hpp"
#include "core/scene_names.hpp"
#include "core/step_clock.hpp"
#include "core/validity.hpp"
#include "io/frame_schedule.hpp"

namespace carom {

namespace {

// Time spent on trying the scene's first steps, in seconds: long enough to tell the cost, short enough to wait for.
constexpr double trial_seconds = 0.2;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Bytes that a disk takes in a frame of trajectory.xyz, with all digits, and of trajectory.h5, packed.
constexpr double xyz_bytes = 134.0, h5md_bytes = 32.0, h5md_single_bytes = 15.0;

double trajectory_bytes(const OutputPlan& plan) {
  const double all = plan.trajectory == TrajectoryFormat::xyz ? xyz_bytes
                     : plan.single_precision                  ? h5md_single_bytes
                                                              : h5md_bytes;
  return all / static_cast<double>(plan.select.stride);
}

// A growth that takes longer is not worth waiting for here; seconds.
constexpr double longest_growth = 10.0;

struct Findings {
  Count disks = 0;
  double smallest_radius = 0.0, largest_radius = 0.0;
  double smallest_mass = 0.0, largest_mass = 0.0;
  double packing_fraction = 0.0;
  double safe_dt = 0.0;            // infinite if nothing moves
  double cost_seconds = infinity;  // of all steps, as far as the first ones tell
  double memory_bytes = 0.0;
  Count frames = 0;
  double growth_seconds = 0.0;  // of one core; above longest_growth the disks were not grown, and no step tried
  std::string stopped;          // what the physics said, if it stopped the trial
};

// The longest step in which no disk moves further than the share of its radius that step_clock.hpp calls safe:
// fastest dt + fall dt^2 = safe_travel, with the speeds of the start in radii.
double safe_step(const Scene& scene, const Disks& disks) {
  double fastest = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    fastest = std::max(fastest, std::hypot(disks.vx[i], disks.vy[i]) / disks.radius_of(i));
  }
  const double radius = smallest_radius(disks);
  if (radius <= 0.0) return infinity;
  const double fall = scene.physics.gravity / radius;
  double safe = 2.0 * safe_travel / (fastest + std::sqrt(fastest * fastest + 4.0 * fall * safe_travel));
  // A Brownian step is sqrt(2 D dt) in each direction; three of that, as some disk always moves so far.
  const double share = safe_travel * radius / 3.0;
  if (scene.physics.diffusion > 0.0) safe = std::min(safe, share * share / (2.0 * scene.physics.diffusion));
  return safe;
}

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
  f.packing_fraction = area / (scene.box.width * scene.box.height);
}

// What growing the scene's disks takes, by the measurements in docs/methods.md: collisions a disk rise steeply towards
// the densest mixtures.
double growth_seconds(const Scene& scene, const Findings& f) {
  if (!grows(scene)) return 0.0;
  constexpr double seconds_a_collision = 3e-6;
  const double to_go = std::max(0.01, 0.86 - f.packing_fraction);
  const double collisions_a_disk = 0.5 / (to_go * to_go) * scene.growth.slowness;
  return 0.5 * seconds_a_collision * collisions_a_disk * static_cast<double>(f.disks);
}

// The scene's disks, where growing them takes too long: with their sizes and velocities, but no places.
State ungrown_state(const Scene& scene) {
  GrowthTools nothing;
  nothing.step = [](Disks&, const Domain&, const std::vector<double>&) { return GrowthTally{}; };
  const auto nowhere = [](const Scene&, Disks&, PlacementGrid&, const std::vector<std::uint32_t>&) {};
  return initial_state(scene, nowhere, nothing);
}

// Takes the memory that a run takes besides its steps: a copy of the disks for its frames, their order for sums, and a
// search for the largest overlap at the end.
void look_as_a_run_does(const Engine& engine, const Scene& scene) {
  const Disks& disks = engine.state().disks;
  if (wants_frames(scene.output)) {
    const Disks frame = disks;
    momentum_of(frame);
  }
  max_overlap(disks, scene.box);
}

// Runs the first steps, and extrapolates.
void try_steps(Engine& engine, const Scene& scene, Findings& f) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  double seconds = 0.0;
  try {
    while (engine.state().time < scene.run.t_end && seconds < trial_seconds) {
      engine.step();
      seconds = std::chrono::duration<double>(Clock::now() - start).count();
    }
  } catch (const PhysicsError& error) {
    f.stopped = error.what();
  }
  const double time = engine.state().time;
  f.cost_seconds = time > 0.0 ? seconds * scene.run.t_end / time : infinity;
  look_as_a_run_does(engine, scene);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  f.memory_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
}

std::string range_text(double low, double high) {
  return low == high ? fmt::format("{:g}", low) : fmt::format("{:g} to {:g}", low, high);
}

std::string sides_text(const Domain& box) {
  std::string text;
  for (const Side side : all_sides) {
    const auto k = static_cast<std::size_t>(side);
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", side_names[k],
                        side_kind_names[static_cast<std::size_t>(box.side(side))]);
  }
  return text;
}

std::string physics_text(const Scene& scene) {
  const Physics& p = scene.physics;
  std::string text = p.gravity > 0.0 ? fmt::format("gravity {:g} downwards; ", p.gravity) : "no gravity; ";
  text += p.restitution == 1.0 ? "elastic collisions" : fmt::format("restitution {:g} of disks", p.restitution);
  if (scene.box.has(SideKind::wall)) text += fmt::format(", {:g} at walls", scene.box.wall_restitution);
  if (p.diffusion > 0.0) {
    text += fmt::format("; Brownian motion, D = {:g}{}", p.diffusion, p.accumulate ? ", accumulating velocity" : "");
  }
  for (const Source& source : scene.sources) text += fmt::format("; a source of {:g} disks per unit time", source.rate);
  return text;
}

// Does the run step by dt? The exact method leaves it unused, except as the step of Brownian motion.
bool uses_dt(const Scene& scene) {
  return scene.run.method != Method::exact || scene.physics.diffusion > 0.0;
}

std::string method_text(const Scene& scene) {
  const std::string_view name = method_names[static_cast<std::size_t>(scene.run.method)];
  if (!uses_dt(scene)) return fmt::format("{} to t = {:g}", name, scene.run.t_end);
  return fmt::format("{}, dt = {:g}, {} steps to t = {:g}", name, scene.run.dt,
                     make_step_clock(scene.run.dt, scene.run.t_end).steps, scene.run.t_end);
}

std::string step_text(const Scene& scene, const Findings& f) {
  if (std::isinf(f.safe_dt)) return "any: nothing moves at the start";
  const bool safe = scene.run.dt <= f.safe_dt;
  return fmt::format("{:.3g} or less at the speeds of the start; dt is {}", f.safe_dt,
                     safe ? "safe" : "longer, and steps will be split");
}

std::string outputs_text(const Scene& scene, const Findings& f) {
  const OutputPlan& plan = scene.output;
  std::vector<std::string> files;
  const double bytes = trajectory_bytes(plan) * static_cast<double>(f.disks) * static_cast<double>(f.frames);
  if (plan.trajectory != TrajectoryFormat::none)
    files.push_back(fmt::format("trajectory (about {}B)", short_number(bytes)));
  if (plan.series) files.emplace_back("series.csv");
  for (const std::string& plot : plan.plots) files.push_back(plot + ".svg");
  if (plan.movie)
    files.push_back(fmt::format("movie ({} at 25 a second)", duration_text(static_cast<double>(f.frames) / 25.0)));
  std::vector<std::string> parts;
  if (!files.empty()) parts.push_back(fmt::format("{} frames: {}", f.frames, fmt::join(files, ", ")));
  if (scene.analysis.any()) {
    const Count samples = frame_count(scene.analysis.every, scene.run.t_end - scene.analysis.start);
    parts.push_back(fmt::format("analysis.h5 and its plots from {} samples", samples));
  }
  return parts.empty() ? "none asked for" : fmt::format("{}", fmt::join(parts, "; "));
}

std::string offer_text(const MethodOffer& offer, bool best) {
  const std::string_view name = method_names[static_cast<std::size_t>(offer.method)];
  if (!offer.possible) return fmt::format("  {:<10}no: {}\n", name, offer.why);
  const std::string dt = offer.dt > 0.0 ? fmt::format("dt = {:g}, ", offer.dt) : "";
  const std::string error = offer.error > 0.0 ? fmt::format("{:.1e}", offer.error) : "rounding only";
  return fmt::format("{}{:<10}{}error {}, about {} of one core: {}\n", best ? "> " : "  ", name, dt, error,
                     duration_text(offer.seconds), offer.why);
}

// What the error is one of.
const char* averages_of(const Scene& scene, const MethodChoice& choice) {
  if (scene.physics.diffusion > 0.0) return "mean square displacement";
  // Where disks come to rest, how often they still hit each other depends on the step: soft hits become load.
  if (choice.scales.settles) return "energy lost; not collisions, of which a pile has as many as steps show";
  return scene.physics.restitution < 1.0 ? "collision rate, pressure, cooling rate" : "collision rate, pressure";
}

// Which method and step an accuracy needs. Costs are those of the machine that core/method_rates.hpp was measured on.
std::string choice_text(const Scene& scene, double accuracy) {
  const MethodChoice choice = choose_method(scene, accuracy);
  std::string text =
      fmt::format("for an error of {:g} in averages over disks and time ({}):\n", accuracy, averages_of(scene, choice));
  for (std::size_t k = 0; k < choice.offers.size(); ++k) {
    text += offer_text(choice.offers[k], static_cast<int>(k) == choice.best);
  }
  if (choice.offers.empty()) return text + fmt::format("  {}\n", choice.why);
  if (choice.best < 0) return text + "  out of reach: ask for a larger error, or name a method and its dt\n";
  const MethodOffer& best = choice.offers[static_cast<std::size_t>(choice.best)];
  const std::string dt = best.dt > 0.0 ? fmt::format(" --dt {:g}", best.dt) : "";
  return text + fmt::format("  take it with --method {}{}, or method = \"auto\", accuracy = {:g} in [run]\n",
                            method_names[static_cast<std::size_t>(best.method)], dt, accuracy);
}

nlohmann::ordered_json choice_json(const Scene& scene, double accuracy) {
  const MethodChoice choice = choose_method(scene, accuracy);
  nlohmann::ordered_json j{{"accuracy", accuracy}, {"method", nullptr}, {"why", choice.why}};
  for (std::size_t k = 0; k < choice.offers.size(); ++k) {
    const MethodOffer& o = choice.offers[k];
    const std::string_view name = method_names[static_cast<std::size_t>(o.method)];
    if (static_cast<int>(k) == choice.best) j["method"] = name;
    j["offers"].push_back({{"method", name},
                           {"possible", o.possible},
                           {"dt", o.dt},
                           {"error", o.error},
                           {"cpu_s", o.seconds},
                           {"why", o.why}});
  }
  return j;
}

std::string text_of(const Scene& scene, const Findings& f) {
  std::string text = fmt::format("{}: {}\n", scene.file, scene.title.empty() ? "a scene" : scene.title);
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  line("disks", fmt::format("{}, radius {}, mass {}", f.disks, range_text(f.smallest_radius, f.largest_radius),
                            range_text(f.smallest_mass, f.largest_mass)));
  line("box",
       fmt::format("{:g} x {:g}, packing fraction {:.4g}", scene.box.width, scene.box.height, f.packing_fraction));
  line("sides", sides_text(scene.box));
  line("physics", physics_text(scene));
  line("method", scene.run.automatic ? choice_text(scene) : method_text(scene));
  if (scene.run.method != Method::exact) line("safe step", step_text(scene, f));
  line("outputs", outputs_text(scene, f));
  if (f.growth_seconds > longest_growth) {
    line("growth",
         fmt::format("about {} of one core before the first step, not tried", duration_text(f.growth_seconds)));
    line("memory", fmt::format("at least {}B", short_number(f.memory_bytes)));
    line("cost", "not tried either");
    return text;
  }
  line("memory", fmt::format("about {}B, as measured", short_number(f.memory_bytes)));
  line("cost", f.stopped.empty()
                   ? fmt::format("about {} of steps on this machine, from a trial", duration_text(f.cost_seconds))
                   : fmt::format("stops early: {}", f.stopped));
  return text;
}

std::string json_of(const Scene& scene, const Findings& f, const std::optional<double>& accuracy) {
  nlohmann::ordered_json j;
  const auto number = [](double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
  };
  j["scene"] = scene.file;
  j["method"] = method_names[static_cast<std::size_t>(scene.run.method)];
  j["particles"] = f.disks;
  j["width"] = scene.box.width;
  j["height"] = scene.box.height;
  j["packing_fraction"] = number(f.packing_fraction);
  j["dt"] = scene.run.dt;
  j["safe_dt"] = number(f.safe_dt);
  j["t_end"] = scene.run.t_end;
  j["frames"] = f.frames;
  j["memory_bytes"] = f.memory_bytes;
  j["cost_s"] = number(f.cost_seconds);
  if (f.growth_seconds > 0.0) j["growth_s"] = f.growth_seconds;
  if (accuracy) j["choice"] = choice_json(scene, *accuracy);
  return j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

int command_check(const CheckOptions& options) {
  const Scene scene = load_scene_as_told(options.scene, options.changes);
  const EngineChoice choice = choose_engine("", std::nullopt);
  for (const std::string& warning : scene_warnings(scene)) print_warning(warning);
  State initial =
      within_memory(scene, [&] { return grows(scene) ? ungrown_state(scene) : make_initial_state(choice, scene); });
  Findings found;
  measure_sizes(scene, initial.disks, found);
  found.growth_seconds = growth_seconds(scene, found);
  const bool tried = found.growth_seconds <= longest_growth;
  if (tried && grows(scene)) initial = within_memory(scene, [&] { return make_initial_state(choice, scene); });
  for (const std::string& warning : validity_of(scene, found.smallest_radius)) print_warning(warning);
  found.safe_dt = safe_step(scene, initial.disks);
  found.frames = frame_count(scene.output.every, scene.run.t_end);
  if (!tried) found.memory_bytes = least_memory(Method::exact, found.disks);
  if (tried) {
    const auto engine = within_memory(scene, [&] { return make_engine(choice, scene, std::move(initial)); });
    within_memory(scene, [&] { try_steps(*engine, scene, found); });
  }
  if (options.json) {
    print_out(json_of(scene, found, options.accuracy));
    return 0;
  }
  const std::string hint = "  --accuracy 1e-3 says which method and dt that needs\n";
  print_out(text_of(scene, found) + (options.accuracy ? choice_text(scene, *options.accuracy) : hint));
  return 0;
}

}  // namespace carom
