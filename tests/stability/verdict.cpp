#include "tests/stability/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/check.hpp"
#include "core/disks/fastest_speed.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/energy_gain.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/validity.hpp"
#include "parallel/simulation.hpp"
#include "tests/stability/measure.hpp"

namespace carom::stability {

namespace {

constexpr std::array<const char*, 3> methods{"rollback", "pairwise", "exact"};

// The cost of an event of the exact method in disk-steps (docs/benchmarks.md: about 1 us compared with 30 ns).
constexpr double event_work = 30.0;

// The largest number of measurements in a run: the search for overlaps costs as much as some steps.
constexpr Count looks = 200;

constexpr Count shared_from = 2000;  // from this number of disks on two threads pay

Scene scene_for(const Case& c, const std::string& folder, const std::string& method) {
  std::vector<Override> changes = c.changes;
  const std::vector<Override>& own = c.own_changes.at(method);
  changes.insert(changes.end(), own.begin(), own.end());
  changes.push_back({"run.method", method});
  return load_scene(folder + "/" + c.scene + ".toml", changes);
}

struct Run {
  MethodResult result;
  std::optional<Scene> scene;
  State start, end;
  Worst worst;
};

std::unique_ptr<Engine> engine_for(const Scene& scene, const State& start, Which which) {
  if (which == Which::reference) return make_reference_engine(scene, start);
  return make_parallel_engine(scene, start, {start.disks.size() < shared_from ? 1 : 2});
}

void take(Engine& engine, MethodResult& result) {
  for (std::string& warning : engine.take_warnings()) result.warnings.push_back(std::move(warning));
}

// Steps to the end, to the case's bound on steps, or until the physics stops the run.
void step_through(const Case& c, Engine& engine, Run& run) {
  engine.forget_paths();
  const double every = run.scene->run.t_end / static_cast<double>(looks);
  double due = every;
  try {
    while (engine.state().time < run.scene->run.t_end) {
      if (c.most_steps > 0 && engine.state().counters.steps >= c.most_steps) {
        run.result.stopped = fmt::format("ended by the suite after {} steps", c.most_steps);
        break;
      }
      engine.step();
      if (engine.state().time < due && !c.every_step) continue;
      run.worst.look(*run.scene, run.start, engine.state());
      due = every * (std::floor(engine.state().time / every) + 1.0);
    }
  } catch (const PhysicsError& error) {
    run.result.stopped = error.what();
    run.result.warnings.emplace_back(error.what());
  }
}

Run run_method(const Case& c, const std::string& folder, const std::string& method, Which which) {
  Run run;
  run.result.method = method;
  run.scene = scene_for(c, folder, method);
  run.start = initial_state(*run.scene);
  run.result.warnings =
      validity_warnings_at_start(*run.scene, smallest_radius(run.start.disks), fastest_speed(run.start.disks));
  const auto engine = engine_for(*run.scene, run.start, which);
  step_through(c, *engine, run);
  take(*engine, run.result);
  run.end = engine->state();
  for (std::string& warning : energy_warnings(*run.scene, run_start(run.start, *run.scene), run.end)) {
    run.result.warnings.push_back(std::move(warning));
  }
  run.worst.look(*run.scene, run.start, run.end);
  const double n = static_cast<double>(run.start.disks.size());
  const Counters& counters = run.end.counters;
  run.result.work = static_cast<double>(counters.steps) * n;
  if (method == "exact")
    run.result.work += event_work * static_cast<double>(counters.collisions + counters.wall_collisions);
  if (method == "rollback" && run.end.time > 0.0) {
    run.result.frames = static_cast<double>(counters.steps) * run.scene->run.dt / run.end.time;
  }
  run.result.hash = hash_text(state_hash(run.end.disks));
  return run;
}

// The checks of the case; the first one is that the run came to its end.
void check(const Case& c, const Run& exact, Run& run) {
  const Measured measured{*run.scene, run.start, run.end, run.worst};
  run.result.checks.push_back({"time", run.end.time, run.scene->run.t_end, 0.0});
  for (const Check& wanted : c.checks) {
    CheckResult r{wanted.what, measure(wanted.what, measured), wanted.expected, wanted.bound_of(run.result.method)};
    if (wanted.like_exact) r.expected = measure(wanted.what, {*exact.scene, exact.start, exact.end, exact.worst});
    if (wanted.relative) r.bound *= std::abs(r.expected);
    run.result.checks.push_back(r);
  }
}

void judge(std::vector<MethodResult>& results) {
  double least = std::numeric_limits<double>::infinity();
  for (const MethodResult& r : results) {
    if (r.right()) least = std::min(least, r.work);
  }
  for (MethodResult& r : results) {
    if (r.right()) {
      const bool costly = r.work > std::max(slow_factor * least, little_work);
      const bool stalls = r.frames > most_frames && r.work > least_work;
      r.verdict = costly || stalls ? Verdict::slow : Verdict::right;
    } else {
      r.verdict = r.warnings.empty() ? Verdict::silent : Verdict::says_so;
    }
  }
}

}  // namespace

std::string_view text_of(Verdict verdict) {
  constexpr std::array<std::string_view, 4> texts{"right", "right but slow", "wrong and says so", "wrong in silence"};
  return texts[static_cast<std::size_t>(verdict)];
}

bool CheckResult::holds() const {
  return std::abs(measured - expected) <= bound;
}

double CheckResult::over_bound() const {
  const double error = std::abs(measured - expected);
  if (holds()) return bound > 0.0 ? error / bound : 0.0;
  return bound > 0.0 && std::isfinite(error) ? error / bound : std::numeric_limits<double>::infinity();
}

const CheckResult& MethodResult::telling() const {
  // Of the checks that hold, the first of the case's own is shown, not the time.
  const auto less = [](const CheckResult& a, const CheckResult& b) { return a.over_bound() < b.over_bound(); };
  const auto worst = std::max_element(checks.begin(), checks.end(), less);
  return worst->holds() && worst == checks.begin() && checks.size() > 1 ? checks[1] : *worst;
}

bool MethodResult::right() const {
  return std::all_of(checks.begin(), checks.end(), [](const CheckResult& r) { return r.holds(); });
}

CaseResult run_case(const Case& c, const std::string& folder, Which which) {
  std::vector<Run> runs;
  for (const char* const method : methods) runs.push_back(run_method(c, folder, method, which));
  CaseResult result{&c, {}};
  for (Run& run : runs) {
    check(c, runs.back(), run);
    result.methods.push_back(std::move(run.result));
  }
  judge(result.methods);
  return result;
}

}  // namespace carom::stability
