// The runs of the chart, and running them side by side.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "app/chart/chart_result.hpp"

namespace carom::chart {

namespace {

// The ratio of successive steps.
constexpr double step_factor = 2.0;

double step_of(const ChartScene& scene, int power) {
  return scene.longest_step / std::pow(step_factor, power);
}

// Short steps cost more, and their errors are seen with fewer seeds; rollback, whose errors are large, needs fewer.
std::uint64_t seeds_of(const Effort& effort, Method method, int power) {
  constexpr int free_powers = 4;
  const std::uint64_t wanted = effort.most_seeds >> std::max(0, power - free_powers);
  const std::uint64_t seeds = std::max(effort.least_seeds, wanted);
  return method == Method::rollback ? std::max(effort.least_seeds, seeds / 4) : seeds;
}

std::vector<Setting> settings_of(const Effort& effort, const ChartScene& scene) {
  const bool brownian = scene.figure == Figure::spread;
  const std::uint64_t most = scene.same_start ? 1 : effort.most_seeds;
  std::vector<Setting> settings;
  if (!brownian) settings.push_back({Method::exact, 0.0, most});
  const auto add_step = [&](double dt, int power) {
    for (const Method method : {Method::rollback, Method::pairwise, Method::exact}) {
      if (method == Method::exact && !brownian) continue;
      settings.push_back({method, dt, std::min(most, seeds_of(effort, method, power))});
    }
  };
  bool own_seen = !(scene.own_step > 0.0);
  for (const int power : effort.powers) {
    own_seen = own_seen || step_of(scene, power) == scene.own_step;
    add_step(step_of(scene, power), power);
  }
  if (!own_seen) add_step(scene.own_step, 0);
  return settings;
}

// One start with all runs from it.
struct Task {
  std::size_t scene = 0;
  std::uint64_t seed = 0;
  double weight = 0.0;  // number of steps and events, for the remaining time
};

// An estimate: disks times steps of each run, with exact's collisions at the price of ten steps.
double weight_of(const ChartScene& scene, std::uint64_t seed, const std::vector<Setting>& settings) {
  double weight = scene.melting * 100.0;
  for (const Setting& s : settings) {
    if (seed > s.seeds) continue;
    weight += s.dt > 0.0 ? (scene.length + 5.0 * scene.flight) / s.dt : 0.0;
    if (s.method == Method::rollback) weight += 2000.0 * scene.length;
  }
  return weight;
}

ChartScene scaled(ChartScene scene, double scale) {
  scene.melting *= scale;
  scene.flight *= scale;
  scene.length *= scale;
  return scene;
}

// Runs task(k) for k = 0 .. count - 1 on several threads; rethrows the first error.
template <class Run>
void run_all(std::size_t count, int threads, Run run) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;
  const auto work = [&] {
    for (std::size_t k = next++; k < count; k = next++) {
      try {
        run(k);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> others;  // its destructor waits for them, also if no further one can be started
    for (int t = 1; t < threads; ++t) others.emplace_back(work);
    work();
  }
  if (error) std::rethrow_exception(error);
}

std::vector<CrowdPoint> crowd_settings(const Effort& effort) {
  std::vector<CrowdPoint> points;
  for (const std::size_t disks : effort.crowds) {
    points.push_back({disks, Method::exact});
    for (const double dt : {0.032, 0.008}) {
      for (const Method method : {Method::rollback, Method::pairwise}) points.push_back({disks, method, dt});
    }
  }
  return points;
}

}  // namespace

Effort full_effort() {
  return {"full", {0, 1, 2, 3, 4, 5, 6, 7, 8}, 96, 6, {16, 64, 256, 1024, 4096, 16384, 65536}, 1.0};
}

Effort quick_effort() {
  return {"quick", {0, 2, 3, 4, 5}, 4, 2, {16, 256, 4096}, 1.0};
}

Effort tiny_effort() {
  return {"tiny", {0, 2}, 2, 2, {16, 64}, 0.02};
}

Effort for_own(Effort effort) {
  constexpr std::uint64_t most_own_seeds = 24;
  effort.most_seeds = std::min(effort.most_seeds, most_own_seeds);
  effort.crowds.clear();
  effort.scale = 1.0;  // its times were found without a scale: in shorter ones there might be no collision
  return effort;
}

ChartResult measure_scenes(const std::vector<ChartScene>& wanted, const Effort& effort, int threads,
                           const Watch& watch) {
  ChartResult result;
  std::vector<ChartScene> scenes;
  std::vector<std::vector<Setting>> settings;
  for (const ChartScene& scene : wanted) {
    scenes.push_back(scaled(scene, effort.scale));
    settings.push_back(settings_of(effort, scenes.back()));
  }
  // Seed by seed, so that every scene is measured early and late, while the machine is busy and while it is not.
  std::vector<Task> tasks;
  double total = 0.0, done = 0.0;
  for (std::uint64_t seed = 1; seed <= effort.most_seeds; ++seed) {
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      if (scenes[s].same_start && seed > 1) continue;
      tasks.push_back({s, seed, weight_of(scenes[s], seed, settings[s])});
      total += tasks.back().weight;
    }
  }
  std::vector<std::vector<std::vector<Sample>>> samples(scenes.size());
  for (auto& of_scene : samples) of_scene.resize(effort.most_seeds);
  std::mutex mutex;
  run_all(tasks.size(), threads, [&](std::size_t k) {
    const Task& task = tasks[k];
    samples[task.scene][task.seed - 1] = measure_seed(scenes[task.scene], task.seed, settings[task.scene]);
    const std::lock_guard lock(mutex);
    done += task.weight;
    watch(done / total);
  });
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    // One run that represents all seeds has no scatter: it counts as two runs with the same result.
    if (scenes[s].same_start) samples[s] = {samples[s][0], samples[s][0]};
    result.scenes.push_back(summed_up(scenes[s], samples[s]));
  }
  return result;
}

ChartResult measure_chart(const Effort& effort, int threads, const Watch& watch) {
  ChartResult result = measure_scenes(chart_scenes(), effort, threads, watch);
  result.crowd = crowd_settings(effort);
  // Each of these is timed alone on its thread, long after the others of its size; the least of three times counts.
  const double unit = result.scenes[1].unit;
  run_all(result.crowd.size(), threads, [&](std::size_t k) {
    CrowdPoint& p = result.crowd[k];
    const ShortRun run = run_fluid(p.disks, p.method, p.dt, 3);
    p.cost = unit * run.cost;
    p.frames = run.steps * p.dt;
  });
  return result;
}

}  // namespace carom::chart
