#include "run/results/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/build_version.hpp"
#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/disks/state_hash.hpp"
#include "core/scene/drawn_velocities.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/scene_sinks.hpp"
#include "parallel/slabs/leading_engine.hpp"

namespace carom {

namespace {

Json phase_seconds(const Summary& s) {
  Json phases = Json::object();
  for (const Phase& phase : s.phases.phases()) phases[std::string(phase.name)] = json_number(phase.seconds);
  return phases;
}

// The energy that each side gave, for those sides for which `gives` is true.
template <class Gives>
Json side_energy_of(const Summary& s, Gives&& gives) {
  Json energy = Json::object();
  for (std::size_t k = 0; k < side_names.size(); ++k) {
    if (gives(all_sides[k])) energy[std::string(side_names[k])] = json_number(s.counters.side_energy[k]);
  }
  return energy.empty() ? absent() : energy;
}

Json removed_by(const Summary& s) {
  Json counts = Json::object();
  for (const auto& [sink, disks] : s.removed_by) counts[sink] = disks;
  return counts;
}

Json means_of(const Summary& s) {
  Json means = Json::object();
  for (const MeasuredMean& mean : s.measured) {
    means[std::string(mean.name)] = json_number(mean.value);
    means[fmt::format("{}_error", mean.name)] = json_number(mean.error);
  }
  return means;
}

// These ids, if there was an overlap.
Json ids_of(const WorstOverlap& worst, const std::vector<DiskId>& ids) {
  return worst.overlap.size > 0.0 ? Json(ids) : Json::array();
}

// The mean of a rank's traffic in a step.
double a_step_and_rank(const RankReport& report, Count all) {
  const double steps = static_cast<double>(std::max<Count>(1, report.steps));
  return static_cast<double>(all) / (steps * static_cast<double>(report.ranks.size()));
}

Json messages_of(const RankReport& report, const Messages& all) {
  return {{"messages", a_step_and_rank(report, all.messages)}, {"bytes", a_step_and_rank(report, all.bytes)}};
}

Json traffic_of(const Summary& s) {
  if (!s.ranks) return absent();
  Json disks = Json::array();
  Json ghosts = Json::array();
  Json peaks = Json::array();
  Json seconds = Json::array();
  for (const RankLoad& rank : s.ranks->ranks) {
    disks.push_back(rank.disks);
    ghosts.push_back(rank.ghosts);
    peaks.push_back(rank.peak_bytes);
    seconds.push_back(rank.in_steps.seconds);
  }
  const Traffic all = s.ranks->traffic();
  return {{"disks", disks},
          {"ghosts", ghosts},
          {"peak_bytes", peaks},
          {"imbalance", s.ranks->imbalance()},
          {"exchange", messages_of(*s.ranks, all.exchange)},
          {"all_reduce", messages_of(*s.ranks, all.all_reduce)},
          {"gather", messages_of(*s.ranks, all.gather)},
          {"seconds", seconds}};
}

// For a new key, add a row here.
const JsonKey<Summary> summary_keys[] = {
    {"scene", "", "file of the scene", [](const Summary& s) -> Json { return s.scene; }},
    {"method", "", "`rollback`, `pairwise` or `exact`", [](const Summary& s) -> Json { return s.method; }},
    {"engine", "", "`parallel` or `reference`", [](const Summary& s) -> Json { return s.engine.name; }},
    {"threads", "", "threads of the engine on each rank", [](const Summary& s) -> Json { return s.engine.threads; }},
    {"ranks", "", "processes that shared the box; 1 without `--ranks`",
     [](const Summary& s) -> Json { return s.engine.ranks; }},
    {"particles", "", "disks in the box at the end", [](const Summary& s) -> Json { return s.particles; }},
    {"steps", "", "steps done; with `exact`, windows", [](const Summary& s) -> Json { return s.counters.steps; }},
    {"time", "time", "simulated time at the end", [](const Summary& s) -> Json { return json_number(s.time); }},
    {"collisions", "", "collisions of two disks", [](const Summary& s) -> Json { return s.counters.collisions; }},
    {"wall_collisions", "", "collisions of a disk with a wall or a fixed disk",
     [](const Summary& s) -> Json { return s.counters.wall_collisions; }},
    {"wall_s", "s", "wall time of the whole run", [](const Summary& s) -> Json { return json_number(s.wall_s); }},
    {"cpu_s", "s", "processor time of the whole run", [](const Summary& s) -> Json { return json_number(s.cpu_s); }},
    {"step_s", "s", "wall time of the steps, without the start and the output",
     [](const Summary& s) -> Json { return json_number(s.step_s); }},
    {"energy_initial", "energy",
     "kinetic, rotational and potential energy at the start; null for Brownian motion, which has no velocities",
     [](const Summary& s) -> Json { return json_number(s.energy_initial); }},
    {"energy_final", "energy", "the same at the end; null for Brownian motion",
     [](const Summary& s) -> Json { return json_number(s.energy_final); }},
    {"momentum_drift", "",
     "change of sum m v from start to end, over sum m abs(v) at the start or end, whichever is larger; zero to "
     "rounding in a periodic box without shear, external forces, walls and fixed disks; null for Brownian motion",
     [](const Summary& s) -> Json { return json_number(s.momentum_drift); }},
    {"max_overlap", "",
     "largest overlap of two disks in the last state, over the sum of their radii; 0 without overlap",
     [](const Summary& s) -> Json { return json_number(s.max_overlap); }},
    {"wall_overlap", "", "largest overlap of a disk and a wall in the last state, over its radius; 0 without overlap",
     [](const Summary& s) -> Json { return json_number(s.wall_overlap); }},
    {"pressure", "energy / area",
     "mean pressure over the run, from the collisions and the mean of the kinetic energies at start and end (relative "
     "to a shear flow); if sides move, in the area between their mean places. null for Brownian motion, for a run "
     "without duration, and if the two energies differ by more than a quarter, or are 0 in spite of collisions: if a "
     "gas cools or heats up, see its pressure over time in series.csv (`output.series`)",
     [](const Summary& s) -> Json { return json_number(s.pressure); }},
    {"collision_rate", "1 / time",
     "collisions of a disk per unit time, over the time for which each disk was in the box; in time stepping a disk "
     "that a sink removes counts for half of that step",
     [](const Summary& s) -> Json { return json_number(s.collision_rate); }},
    {"removed", "", "disks that sinks have removed", [](const Summary& s) -> Json { return s.counters.removed; }},
    {"removed_by", "",
     "only with sinks: an object with the number of disks that each of them has removed (`left` or another side, "
     "`walls.0` for the first of `[[walls]]`, ...)",
     [](const Summary& s) -> Json { return s.removed_by.empty() ? absent() : removed_by(s); }},
    {"analysis", "",
     "only if `[analysis]` measures them: an object with the means of `pressure`, `collision_rate`, `bond_order_local` "
     "and `bond_order_global` over the samples, and `diffusion`, each with its standard error (`pressure_error`, ...), "
     "as in analysis.h5; null with too few samples or if there is nothing to measure",
     [](const Summary& s) -> Json { return s.measured.empty() ? absent() : means_of(s); }},
    {"emitted", "", "disks that came from sources", [](const Summary& s) -> Json { return s.counters.emitted; }},
    {"state_hash", "", "64-bit hash of (id, x, y, vx, vy), and of the spin of rough disks, for all disks at the end",
     [](const Summary& s) -> Json { return s.state_hash; }},
    {"version", "", "version of Carom, with the commit from which it was built",
     [](const Summary&) -> Json { return build_version(); }},
    {"heat", "energy", "only with thermal sides: an object with the energy that each of them gave to the disks",
     [](const Summary& s) -> Json { return side_energy_of(s, [&](Side side) { return s.box.is_thermal(side); }); }},
    {"thermostat_heat", "energy", "only with a thermostat: the energy that it gave to the disks",
     [](const Summary& s) -> Json { return s.thermostat ? json_number(s.counters.thermostat_heat) : absent(); }},
    {"work", "energy", "only with moving sides: an object with the work of each of them on the disks",
     [](const Summary& s) -> Json { return side_energy_of(s, [&](Side side) { return s.box.moves(side); }); }},
    {"wall_work", "energy", "only with moving inner walls: their work on the disks",
     [](const Summary& s) -> Json { return s.box.inner_walls_move ? json_number(s.counters.wall_work) : absent(); }},
    {"wall_push", "mass length / time",
     "only with moving inner walls: the momentum [px, py] that they gave to the disks",
     [](const Summary& s) -> Json {
       if (!s.box.inner_walls_move) return absent();
       return Json::array({json_number(s.counters.wall_push[0]), json_number(s.counters.wall_push[1])});
     }},
    {"shear_work", "energy", "only with `shear_rate`: work of the moving images on the disks",
     [](const Summary& s) -> Json { return s.box.shear.acts() ? json_number(s.counters.shear_work) : absent(); }},
    {"seed", "", "seed of the random numbers", [](const Summary& s) -> Json { return s.seed; }},
    {"waiting", "", "disks of sources that are due and wait for room",
     [](const Summary& s) -> Json { return s.counters.waiting; }},
    {"frames", "", "frames written", [](const Summary& s) -> Json { return s.frames; }},
    {"resumed", "", "number of times that the run was resumed from a checkpoint",
     [](const Summary& s) -> Json { return s.resumed; }},
    {"resume_with", "", "only of a run that stopped early: the command that resumes it",
     [](const Summary& s) -> Json { return s.resume_with.empty() ? absent() : Json(s.resume_with); }},
    {"worst_overlap", "",
     "largest overlap of two disks at the end of any step of the run, over the sum of their radii; 0 without overlap",
     [](const Summary& s) -> Json { return json_number(s.worst_disks.overlap.size); }},
    {"worst_overlap_time", "time", "time of this overlap; 0 without overlap",
     [](const Summary& s) -> Json { return json_number(s.worst_disks.time); }},
    {"worst_overlap_ids", "", "ids of its two disks; empty without overlap",
     [](const Summary& s) -> Json {
       return ids_of(s.worst_disks, {s.worst_disks.overlap.id1, s.worst_disks.overlap.id2});
     }},
    {"worst_wall_overlap", "",
     "largest overlap of a disk and a wall at the end of any step of the run, over its radius; 0 without overlap",
     [](const Summary& s) -> Json { return json_number(s.worst_wall.overlap.size); }},
    {"worst_wall_overlap_time", "time", "time of this overlap; 0 without overlap",
     [](const Summary& s) -> Json { return json_number(s.worst_wall.time); }},
    {"worst_wall_overlap_ids", "", "id of its disk; empty without overlap",
     [](const Summary& s) -> Json { return ids_of(s.worst_wall, {s.worst_wall.overlap.id1}); }},
    {"warnings", "", "the warnings about validity, with the worst value",
     [](const Summary& s) -> Json { return s.warnings; }},
    {"phase_s", "s",
     "an object with the wall time of each phase of a step, in this part of the run; with several ranks those of the "
     "first rank, and `communication`, the part of the others that is spent on messages and on waiting for them",
     [](const Summary& s) -> Json { return phase_seconds(s); }},
    {"traffic", "", "only with several ranks: an object with their loads and messages, see below",
     [](const Summary& s) -> Json { return traffic_of(s); }},
};

// The worst overlap so far, or the present one if that is deeper.
WorstOverlap worst_of(const WorstOverlap& before, const Overlap& now, double time) {
  return now.size > before.overlap.size ? WorstOverlap{now, time} : before;
}

// "0.003 of two disks, 0.001 with a wall", and the times.
std::string worst_line(const WorstOverlap& disks, const WorstOverlap& wall) {
  const auto when = [](const WorstOverlap& worst) {
    return worst.overlap.size > 0.0 ? fmt::format(" at time {:g}", worst.time) : "";
  };
  return fmt::format("at most {:.2g} of two disks{}, {:.2g} with a wall{}", disks.overlap.size, when(disks),
                     wall.overlap.size, when(wall));
}

// "2 threads", "1 thread on each of 4 ranks".
std::string threads_text(const EngineChoice& engine) {
  const std::string threads = counted(static_cast<Count>(engine.threads), "thread");
  return engine.ranks == 1 ? threads : fmt::format("{} on each of {} ranks", threads, engine.ranks);
}

// "4950 to 5050 disks each; 14.0 messages with 2.1 kB a step and rank; 3 s in communication".
std::string traffic_line(const Summary& s) {
  const RankReport& report = *s.ranks;
  const auto fewer = [](const RankLoad& a, const RankLoad& b) { return a.disks < b.disks; };
  const auto [least, most] = std::minmax_element(report.ranks.begin(), report.ranks.end(), fewer);
  const Messages all = report.traffic().all();
  const double seconds = report.traffic().seconds / static_cast<double>(report.ranks.size());
  return fmt::format("{} to {} disks each; {:.1f} messages with {}B per step and rank; {} in communication",
                     least->disks, most->disks, a_step_and_rank(report, all.messages),
                     short_number(a_step_and_rank(report, all.bytes)), duration_text(seconds));
}

// "0.0734"; for a gas that cools or heats up, the reason why there is none.
std::string pressure_line(const Summary& s) {
  if (std::isnan(s.pressure)) {
    if (s.counters.steps == 0) return "unknown, as no time has passed";
    return fmt::format(
        "unknown from the kinetic energy {}of {:.6g} at the start and {:.6g} at the end; {}",
        s.box.shear.acts() ? "relative to the flow " : "", s.kinetic_initial, s.kinetic_final,
        s.series ? "series.csv has the pressure over time" : "output.series = true gives the pressure over time");
  }
  return fmt::format("{:.6g}", s.pressure);
}

// "pressure 0.734 +- 0.002, diffusion 0.031 +- 0.001"
std::string measured_line(const Summary& s) {
  std::string text;
  for (const MeasuredMean& mean : s.measured) {
    if (!text.empty()) text += ", ";
    text += std::isnan(mean.value) ? fmt::format("{} unknown, as {}", mean.name, mean.missing)
                                   : fmt::format("{} {:.6g}", mean.name, mean.value);
    if (!std::isnan(mean.error)) text += fmt::format(" +- {:.2g}", mean.error);
  }
  return text;
}

std::string disks_line(const Summary& s) {
  std::string text = fmt::format("{}", s.particles);
  if (s.counters.removed > 0) text += fmt::format(", {} left through sinks", s.counters.removed);
  if (s.counters.emitted > 0) text += fmt::format(", {} came from sources", s.counters.emitted);
  if (s.counters.waiting > 0) text += fmt::format(", {} wait for room", s.counters.waiting);
  return text;
}

// The mean pressure of a run of this duration, from the kinetic energy halfway between start and end. NaN if that is
// not its mean: disks that fell from rest and rest again have moved in between, and a sheared gas may have cooled for
// most of its collisions.
double mean_pressure(const Summary& s, double elapsed) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  constexpr double most_change = 0.25;  // of the larger of the two
  const double change = std::abs(s.kinetic_final - s.kinetic_initial);
  const double larger = std::max(s.kinetic_initial, s.kinetic_final);
  if (!(elapsed > 0.0) && larger > 0.0) return nothing;
  const bool have_met = s.counters.collisions + s.counters.wall_collisions > 0;
  if (change > most_change * larger || (larger == 0.0 && have_met)) return nothing;
  const Energy mean{0.5 * (s.kinetic_initial + s.kinetic_final), 0.0};
  return pressure(mean, s.counters.virial, elapsed, box_in_mean(s.box, s.time - elapsed, s.time));
}

}  // namespace

StateSums sums_of(const Engine& engine, const Scene& scene, const EngineChoice& choice) {
  return choice.lead != nullptr ? choice.lead->sums() : sums_of(engine.state(), scene);
}

Summary summarize(const RunStart& start, const Engine& engine, const Scene& scene, const EngineChoice& choice) {
  const State& state = engine.progress();
  const StateSums sums = sums_of(engine, scene, choice);
  const Energy& energy = sums.at.energy;
  const double elapsed = state.time - start.time;
  Summary s;
  s.scene = scene.file;
  s.title = scene.title;
  s.method = name_of(scene.run.method);
  s.engine = choice;
  s.box = scene.box;
  s.particles = sums.at.particles;
  s.time = state.time;
  s.counters = state.counters;
  s.drawn_velocities = velocities_are_drawn(scene);
  s.keeps_momentum = keeps_momentum(scene);
  const auto of_velocities = [&](double value) {
    return s.drawn_velocities ? std::numeric_limits<double>::quiet_NaN() : value;
  };
  s.energy_initial = of_velocities(start.energy.total());
  s.energy_final = of_velocities(energy.total());
  s.momentum_drift = of_velocities(momentum_drift(start.momentum, sums.at.momentum));
  const DeepestOverlaps deepest = choice.lead != nullptr ? choice.lead->overlaps() : overlaps_of(state, scene);
  s.max_overlap = deepest.disks.size;
  s.wall_overlap = deepest.wall.size;
  s.worst_disks = worst_of(state.validity.disks, deepest.disks, state.time);
  s.worst_wall = worst_of(state.validity.wall, deepest.wall, state.time);
  s.kinetic_initial = start.relative;
  s.kinetic_final = sums.at.relative;
  s.pressure = of_velocities(mean_pressure(s, elapsed));
  const double disk_time = state.counters.disk_time;
  if (disk_time > 0.0) s.collision_rate = 2.0 * static_cast<double>(state.counters.collisions) / disk_time;
  if (elapsed > 0.0) s.mean_disks = disk_time / elapsed;
  s.state_hash = hash_text(sums.hash);
  s.seed = scene.seed;
  s.thermostat = scene.physics.thermostat.acts();
  s.series = scene.output.series;
  for (const SceneSink& sink : sinks_of(scene)) s.removed_by.emplace_back(sink.name, taken_by(sink, state));
  s.phases = engine.phase_times();
  if (choice.lead != nullptr && choice.ranks > 1) {
    s.ranks = choice.lead->report();
    s.phases.add("communication", s.ranks->ranks[0].in_steps.seconds);
  }
  return s;
}

std::string json_text(const Summary& s) {
  return json_object(summary_keys, s);
}

std::vector<KeyText> summary_key_texts() {
  return key_texts(summary_keys);
}

std::vector<KeyText> traffic_key_texts() {
  return {{"disks", "", "a list: disks of each rank at the end"},
          {"ghosts", "", "a list: copies of disks of other ranks that each rank had in the last step"},
          {"imbalance", "", "largest number of disks of a rank over the mean number"},
          {"peak_bytes", "bytes", "a list: largest memory of each rank"},
          {"exchange", "",
           "an object with the `messages` and `bytes` that a rank sends to its two neighbours in a step, mean over the "
           "ranks and this part of the run"},
          {"all_reduce", "", "the same for reductions over all ranks"},
          {"gather", "", "the same for data that are gathered from all ranks"},
          {"seconds", "s", "a list: time of each rank in these calls"}};
}

std::string table_text(const Summary& s, const std::string& folder) {
  std::string text = fmt::format("{}: {}, {} engine, {}, seed {}\n", one_line(s.title.empty() ? s.scene : s.title),
                                 s.method, s.engine.name, threads_text(s.engine), s.seed);
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  const double steps = static_cast<double>(s.counters.steps);
  const double rate = s.step_s > 0.0 ? steps / s.step_s : 0.0;
  line("disks", disks_line(s));
  line("time", fmt::format("{:g} in {}", s.time, counted(s.counters.steps, "step")));
  line("collisions", fmt::format("{} of disks, {} with walls; {:.4g} per disk and unit time", s.counters.collisions,
                                 s.counters.wall_collisions, s.collision_rate));
  if (!s.drawn_velocities)
    line("energy", fmt::format("{:.6g} at the start, {:.6g} at the end", s.energy_initial, s.energy_final));
  if (s.keeps_momentum) line("momentum", fmt::format("changed by {:.2g} of sum m |v|", s.momentum_drift));
  line("overlap", worst_line(s.worst_disks, s.worst_wall));
  if (!s.drawn_velocities) line("pressure", pressure_line(s));
  if (!s.measured.empty()) line("measured", measured_line(s));
  line("state hash", s.state_hash);
  line("speed", fmt::format("{} steps/s, {} disk-steps/s; {} in all", short_number(rate),
                            short_number(rate * s.mean_disks), duration_text(s.wall_s)));
  if (s.ranks) line("ranks", traffic_line(s));
  if (s.resumed > 0) line("resumed", s.resumed == 1 ? "once" : fmt::format("{} times", s.resumed));
  if (!folder.empty()) line("results", one_line(folder));
  return text;
}

}  // namespace carom
