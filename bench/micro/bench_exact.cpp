// The exact method over disks and threads beside the yardstick, in collisions per second (items_per_second), at packing
// fraction 0.5 unless another is named. The label of a row is the hash of the state after its fixed number of windows
// (for the yardstick, of collisions): rows of one scene must agree for any number of threads.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <utility>

#include "bench/support/bench_scenes.hpp"
#include "bench/support/shield.hpp"
#include "bench/support/yardstick.hpp"
#include "core/disks/state_hash.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"

namespace carom::bench {
namespace {

using Clock = std::chrono::steady_clock;

// Collisions in a row: a second of work or two.
constexpr double row_work = 1e6;
// It determines the number of windows in a row, and the work of the yardstick in place of a window. Windows in fact
// have more, two collisions per disk at packing fraction 0.5, at which they aim (core/step/window_length.cpp); the
// hashes of earlier rows are for this number of windows.
double collisions_a_window(std::size_t disks) {
  return std::max(32.0, 0.7 * static_cast<double>(disks));
}

benchmark::IterationCount windows_for(std::size_t disks) {
  return std::max<benchmark::IterationCount>(
      4, static_cast<benchmark::IterationCount>(row_work / collisions_a_window(disks)));
}

const Start& gas_of(std::size_t disks, double packing_fraction) {
  static std::map<std::pair<std::size_t, double>, Start> made;
  const auto [it, fresh] = made.try_emplace({disks, packing_fraction});
  if (fresh) it->second = exact_gas(disks, packing_fraction);
  return it->second;
}

template <class Work, class Collisions>
void time_each(benchmark::State& row, Work&& work, Collisions&& collisions) {
  const Count before = collisions();
  const Shield shield;
  for (auto _ : row) {
    const auto start = Clock::now();
    work();
    row.SetIterationTime(std::chrono::duration<double>(Clock::now() - start).count());
  }
  row.SetItemsProcessed(static_cast<std::int64_t>(collisions() - before));
}

void exact_row(benchmark::State& row, std::size_t disks, double packing_fraction, int threads) {
  const Start& start = gas_of(disks, packing_fraction);
  const auto engine = make_parallel_engine(start.scene, start.state, {threads});
  engine->step();  // makes the lists
  time_each(
      row, [&] { engine->step(); }, [&] { return engine->state().counters.collisions; });
  row.SetLabel(hash_text(state_hash(engine->state().disks)));
}

void yardstick_row(benchmark::State& row, std::size_t disks) {
  const Start& start = gas_of(disks, 0.5);
  Yardstick yardstick(start.state.disks, start.scene.box);
  const auto window = static_cast<Count>(collisions_a_window(disks));
  yardstick.run_collisions(window);
  time_each(
      row, [&] { yardstick.run_collisions(window); }, [&] { return yardstick.collisions(); });
  Disks end = start.state.disks;
  yardstick.write_to(end);
  row.SetLabel(hash_text(state_hash(end)));
}

[[maybe_unused]] const bool rows_registered = [] {
  const auto add = [](const std::string& name, std::size_t disks, auto function) {
    benchmark::RegisterBenchmark(name.c_str(), function)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(windows_for(disks));
  };
  for (const std::size_t disks : {1'000U, 10'000U, 100'000U, 1'000'000U}) {
    for (const int threads : {1, 2}) {
      add(fmt::format("exact/disks:{}/threads:{}", disks, threads), disks,
          [=](benchmark::State& row) { exact_row(row, disks, 0.5, threads); });
    }
    add(fmt::format("yardstick/disks:{}", disks), disks, [=](benchmark::State& row) { yardstick_row(row, disks); });
  }
  for (const double packing_fraction : {0.1, 0.3, 0.7}) {
    for (const int threads : {1, 2}) {
      add(fmt::format("exact/fraction:{}/disks:100000/threads:{}", packing_fraction, threads), 100'000,
          [=](benchmark::State& row) { exact_row(row, 100'000, packing_fraction, threads); });
    }
  }
  // The least cost of a collision, in a scene so small that windows, lists and slices have hardly any cost.
  add("exact/fraction:0.1/disks:2/threads:1", 2, [](benchmark::State& row) { exact_row(row, 2, 0.1, 1); });
  return true;
}();

}  // namespace
}  // namespace carom::bench
