#include "app/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/progress.hpp"
#include "core/scene_names.hpp"
#include "core/state_hash.hpp"

namespace carom {

namespace {

// JSON knows no infinity and no NaN.
nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

double momentum_drift(const Momentum& start, const Momentum& end) {
  const double dx = end.x - start.x;
  const double dy = end.y - start.y;
  const double scale = std::max(start.magnitude, end.magnitude);
  return scale > 0.0 ? std::sqrt(dx * dx + dy * dy) / scale : 0.0;
}

// "1 disk", "2 disks".
std::string counted(Count n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string disks_line(const Summary& s) {
  std::string text = fmt::format("{}", s.particles);
  if (s.counters.removed > 0) text += fmt::format(", {} left through sinks", s.counters.removed);
  if (s.counters.emitted > 0) text += fmt::format(", {} came from sources", s.counters.emitted);
  if (s.counters.waiting > 0) text += fmt::format(", {} wait for room", s.counters.waiting);
  return text;
}

}  // namespace

Summary summarize(const RunStart& start, const Engine& engine, const Scene& scene, const EngineChoice& choice) {
  const State& state = engine.state();
  const Energy energy = energy_of(state.disks, scene.physics.gravity);
  const double elapsed = state.time - start.time;
  Summary s;
  s.scene = scene.file;
  s.title = scene.title;
  s.method = method_names[static_cast<std::size_t>(scene.run.method)];
  s.engine = choice;
  s.particles = state.disks.size();
  s.time = state.time;
  s.counters = state.counters;
  s.energy_initial = start.energy.total();
  s.energy_final = energy.total();
  s.momentum_drift = momentum_drift(start.momentum, momentum_of(state.disks));
  s.max_overlap = max_overlap(state.disks, scene.box);
  s.wall_overlap = wall_overlap(state.disks, scene.box);
  const Energy halfway{0.5 * (start.energy.kinetic + energy.kinetic), 0.0};
  s.pressure = pressure(halfway, state.counters.virial, elapsed, scene.box);
  const double mean_disks = 0.5 * (static_cast<double>(start.particles) + static_cast<double>(s.particles));
  const double disk_time = mean_disks * elapsed;
  if (disk_time > 0.0) s.collision_rate = 2.0 * static_cast<double>(state.counters.collisions) / disk_time;
  s.state_hash = hash_text(state_hash(state.disks));
  s.seed = scene.seed;
  s.phases = engine.phase_times();
  return s;
}

std::string json_text(const Summary& s) {
  nlohmann::ordered_json j;
  j["scene"] = s.scene;
  j["method"] = s.method;
  j["engine"] = s.engine.name;
  j["threads"] = s.engine.threads;
  j["particles"] = s.particles;
  j["steps"] = s.counters.steps;
  j["time"] = number(s.time);
  j["collisions"] = s.counters.collisions;
  j["wall_collisions"] = s.counters.wall_collisions;
  j["wall_s"] = number(s.wall_s);
  j["cpu_s"] = number(s.cpu_s);
  j["step_s"] = number(s.step_s);
  j["energy_initial"] = number(s.energy_initial);
  j["energy_final"] = number(s.energy_final);
  j["momentum_drift"] = number(s.momentum_drift);
  j["max_overlap"] = number(s.max_overlap);
  j["wall_overlap"] = number(s.wall_overlap);
  j["pressure"] = number(s.pressure);
  j["collision_rate"] = number(s.collision_rate);
  j["removed"] = s.counters.removed;
  j["emitted"] = s.counters.emitted;
  j["state_hash"] = s.state_hash;
  j["version"] = CAROM_VERSION;
  j["seed"] = s.seed;
  j["waiting"] = s.counters.waiting;
  j["frames"] = s.frames;
  j["resumed"] = s.resumed;
  if (!s.resume_with.empty()) j["resume_with"] = s.resume_with;
  j["warnings"] = s.warnings;
  nlohmann::ordered_json& phases = j["phase_s"] = nlohmann::ordered_json::object();
  for (const Phase& phase : s.phases.phases()) phases[std::string(phase.name)] = number(phase.seconds);
  return j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string table_text(const Summary& s, const std::string& folder) {
  std::string text = fmt::format("{}: {}, {} engine, {}, seed {}\n", s.title.empty() ? s.scene : s.title, s.method,
                                 s.engine.name, counted(static_cast<Count>(s.engine.threads), "thread"), s.seed);
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  const double steps = static_cast<double>(s.counters.steps);
  const double rate = s.step_s > 0.0 ? steps / s.step_s : 0.0;
  line("disks", disks_line(s));
  line("time", fmt::format("{:g} in {}", s.time, counted(s.counters.steps, "step")));
  line("collisions", fmt::format("{} of disks, {} with walls; {:.4g} per disk and unit time", s.counters.collisions,
                                 s.counters.wall_collisions, s.collision_rate));
  line("energy", fmt::format("{:.6g} at the start, {:.6g} at the end", s.energy_initial, s.energy_final));
  line("momentum", fmt::format("changed by {:.2g} of sum m |v|", s.momentum_drift));
  line("overlap", fmt::format("{:.2g} of two disks, {:.2g} with a wall", s.max_overlap, s.wall_overlap));
  line("pressure", fmt::format("{:.6g}", s.pressure));
  line("state hash", s.state_hash);
  line("speed", fmt::format("{} steps/s, {} disk-steps/s; {} in all", short_number(rate),
                            short_number(rate * static_cast<double>(s.particles)), duration_text(s.wall_s)));
  if (s.resumed > 0) line("resumed", s.resumed == 1 ? "once" : fmt::format("{} times", s.resumed));
  if (!folder.empty()) line("results", folder);
  return text;
}

}  // namespace carom
