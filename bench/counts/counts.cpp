// The scenes whose instructions and cache misses are counted (bench/counts.sh). They start from a state made beforehand
// and are run for two lengths, so that the difference of the two counts is that of the steady part alone.
//   carom_counts scenes [features]            a line for each: name, disks, unit of work for the counts
//   carom_counts compiler                     the compiler of this program: other compilers give other counts
//   carom_counts prepare SCENE FILE           writes the state from which the scene starts, a checkpoint
//   carom_counts run SCENE FILE short|long    runs it on one thread and prints the work done
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/support/bench_scenes.hpp"
#include "bench/support/gas_features.hpp"
#include "core/base/block_runner.hpp"
#include "core/base/kernel_set.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/analysis.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/scene_text.hpp"
#include "core/step/engine.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "parallel/simulation.hpp"
#include "parallel/slabs/slab_exact.hpp"

namespace carom::bench {
namespace {

struct Counted {
  std::string name;
  std::size_t disks;
  const char* work;  // the unit of work by which counts are divided
  int short_run;     // steps, or windows of exact; enough for queues and lists to reach their usual size
  int long_run;
  std::function<Start()> make;
  std::size_t block_divisor = 1;  // above 1: work is cut into smaller blocks
  std::string quantity{};         // of [analysis]: measured this many times in the start, without a run
  int ranks = 1;                  // that share the scene; threads of this process
};

// One thread uses one queue, or two parts with halos if work is cut in two. Disks are sorted into cells in about one
// step of two dozen, so the long runs of pairwise have several sorts more than the short ones.
const std::vector<Counted>& all_counted() {
  static const std::vector<Counted> all{
      {"exact_0.7", 10'000, "collision", 2, 10, [] { return exact_gas(10'000, 0.7); }},
      {"exact_0.5", 10'000, "collision", 2, 10, [] { return exact_gas(10'000, 0.5); }},
      {"exact_0.2", 10'000, "collision", 2, 10, [] { return exact_gas(10'000, 0.2); }},
      {"exact_0.2_small", 100, "collision", 200, 1000, [] { return exact_gas(100, 0.2); }},
      {"exact_0.5_parts", 50'000, "collision", 2, 6, [] { return exact_gas(50'000, 0.5); }, 2},
      {"exact_0.5_ranks", 50'000, "collision", 2, 6, [] { return exact_gas(50'000, 0.5); }, 1, {}, 2},
      {"pairwise_gas", 100'000, "disk and step", 12, 60, [] { return gas(100'000); }},
      {"pairwise_brownian", 100'000, "disk and step", 2, 14, [] { return gas(100'000, "brownian"); }},
      {"pairwise_pile", 9'600, "disk and step", 2, 8, [] { return settled_pile(240, 40); }}};
  return all;
}

// Scene G with one feature each, by both methods, and with one measurement each.
const std::vector<Counted>& features_counted() {
  static const std::vector<Counted> all = [] {
    std::vector<Counted> list;
    for (const GasFeature& f : gas_features()) {
      const std::string name = f.name;
      list.push_back({"pairwise:" + name, 40'000, "disk and step", 12, 60, [name] { return gas(40'000, name); }});
      if (name == "brownian") continue;
      list.push_back({"exact:" + name, 10'000, "collision", 2, 10, [name] { return exact_gas_with(10'000, name); }});
    }
    for (const std::string_view quantity : quantity_names) {
      list.push_back({fmt::format("analysis:{}", quantity), 10'000, "disk and sample", 1, 3, [] { return gas(10'000); },
                      1, std::string(quantity)});
    }
    return list;
  }();
  return all;
}

const Counted& counted(const std::string& name) {
  const auto& all = name.find(':') == std::string::npos ? all_counted() : features_counted();
  const auto it = std::find_if(all.begin(), all.end(), [&](const Counted& c) { return c.name == name; });
  if (it == all.end()) throw std::invalid_argument("no scene " + name);
  return *it;
}

void prepare(const Counted& scene, const std::string& path) {
  const Start start = scene.make();
  if (start.state.disks.size() != scene.disks) throw std::logic_error(scene.name + " has another number of disks");
  RunRecord record;
  record.scene_text = resolved_toml(start.scene);
  write_checkpoint(path, record, start.state);
}

// Takes this number of samples of one state.
void measure(const Counted& counted, const std::string& path, int samples) {
  const Checkpoint start = read_checkpoint(path);
  const Scene scene = parse_scene(
      start.record.scene_text + fmt::format("\n[analysis]\nwhat = [\"{}\"]\nevery = 1.0\n", counted.quantity),
      counted.name, "");
  AnalysisRecord record = empty_record(scene);
  for (int k = 0; k < samples; ++k) {
    take_sample(record, scene, start.state.disks, start.state.time, start.state, run_in_order);
  }
  fmt::print("{}\n", counted.disks * static_cast<std::size_t>(samples));
}

void run(const Counted& counted, const std::string& path, int steps) {
  if (kernel_set() == KernelSet::baseline) throw std::runtime_error("counts are of a processor with AVX2");
  Checkpoint start = read_checkpoint(path);
  const Scene scene = parse_scene(start.record.scene_text, counted.name, "");
  const bool exact = scene.run.method == Method::exact;
  Count collisions = 0;
  const auto take_steps = [&](Engine& engine) {
    engine.forget_paths();
    for (int k = 0; k < steps; ++k) engine.step();
  };
  if (counted.ranks > 1) {
    run_on_local_ranks(counted.ranks, [&](Ranks& ranks) {
      const auto engine = make_slab_exact(scene, start.state, {1, counted.block_divisor}, ranks);
      take_steps(*engine);
      if (ranks.rank() == 0) collisions = engine->progress().counters.collisions;
    });
  } else {
    const auto engine = make_parallel_engine(scene, std::move(start.state), {1, counted.block_divisor});
    take_steps(*engine);
    collisions = engine->progress().counters.collisions;
  }
  fmt::print("{}\n", exact ? collisions : counted.disks * static_cast<std::size_t>(steps));
}

int act(const std::vector<std::string>& words) {
  const std::string& command = words.at(0);
  if (command == "scenes") {
    const bool features = words.size() > 1 && words[1] == "features";
    for (const Counted& c : features ? features_counted() : all_counted())
      fmt::print("{} {} {}\n", c.name, c.disks, c.work);
    return 0;
  }
  if (command == "compiler") {
    fmt::print("{}\n", CAROM_COMPILER);
    return 0;
  }
  const Counted& scene = counted(words.at(1));
  if (command == "prepare") {
    prepare(scene, words.at(2));
  } else if (command == "run") {
    const int length = words.at(3) == "long" ? scene.long_run : scene.short_run;
    scene.quantity.empty() ? run(scene, words.at(2), length) : measure(scene, words.at(2), length);
  } else {
    throw std::invalid_argument("no command " + command);
  }
  return 0;
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  try {
    return carom::bench::act({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "carom_counts: {}\n", error.what());
    return 1;
  }
}
