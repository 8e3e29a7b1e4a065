// Each phase of a step of scene G alone, over disks and threads; the sort also with disks stored in random order (the
// other phases always get sorted disks). The label of a row is a hash of the phase's result.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <map>

#include "bench/support/bench_scenes.hpp"
#include "bench/support/copy_limit.hpp"
#include "bench/support/shield.hpp"
#include "core/disks/state_hash.hpp"
#include "core/step/step_start.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/counting_sort.hpp"
#include "parallel/stepping/drift_blocks.hpp"
#include "parallel/stepping/find_contacts.hpp"
#include "parallel/stepping/resolve_contacts.hpp"

namespace carom::bench {
namespace {

using Clock = std::chrono::steady_clock;

// Scene G at the end of a drift, in sorted cells, as the search gets it.
struct Drifted {
  Start start;  // before the drift, sorted
  State state;
  CellList cells;
};

const Drifted& drifted_gas(std::size_t disks) {
  static std::map<std::size_t, Drifted> made;
  const auto [it, fresh] = made.try_emplace(disks);
  Drifted& d = it->second;
  if (!fresh) return d;
  d.start = gas(disks);
  const Executor executor(2);
  const double radius = d.start.state.disks.common_radius;
  d.cells.grid = make_grid(d.start.scene.box, radius, {disks});
  sort_into_cells(d.start.state.disks, d.cells.grid, executor, d.cells.sorted);
  d.state = d.start.state;
  begin_coarse_positions(d.state.disks, executor, d.cells);
  drift_blocks(d.state.disks, d.start.scene.box, 0.0, d.start.scene.run.dt, executor, d.cells);
  return d;
}

// In each iteration prepare() is not timed, and work() is.
template <class Prepare, class Work>
void time_work(benchmark::State& row, std::size_t disks, Prepare&& prepare, Work&& work) {
  prepare();
  work();  // allocates memory and warms up the caches
  for (auto _ : row) {
    prepare();
    const Shield shield;
    const auto start = Clock::now();
    work();
    row.SetIterationTime(std::chrono::duration<double>(Clock::now() - start).count());
  }
  row.SetItemsProcessed(row.iterations() * static_cast<std::int64_t>(disks));
}

void sort_row(benchmark::State& row, std::size_t disks, int threads, bool shuffle) {
  const Drifted& gas = drifted_gas(disks);
  const State input = shuffle ? shuffled(gas.state) : gas.state;
  const Executor executor(threads);
  State state;
  SortedCells cells;
  time_work(
      row, disks, [&] { state = input; }, [&] { sort_into_cells(state.disks, gas.cells.grid, executor, cells); });
  // The ids in their new order: disks of one cell keep their previous order.
  std::uint64_t order = 0;
  for (const DiskId id : state.disks.id) order = order * 0x9e3779b97f4a7c15ULL + id;
  row.SetLabel(hash_text(order));
}

void drift_row(benchmark::State& row, std::size_t disks, int threads) {
  const Drifted& gas = drifted_gas(disks);
  const Executor executor(threads);
  State state = gas.state;
  CellList cells = gas.cells;
  double t = gas.start.scene.run.dt;  // forwards and backwards, so that disks stay where they are on average
  time_work(
      row, disks, [&] { t = -t; }, [&] { drift_blocks(state.disks, gas.start.scene.box, 0.0, t, executor, cells); });
  row.SetLabel(hash_text(state_hash(state.disks)));
}

void search_row(benchmark::State& row, std::size_t disks, int threads) {
  const Drifted& gas = drifted_gas(disks);
  const Executor executor(threads);
  FoundContacts found;
  time_work(
      row, disks, [] {}, [&] { find_contacts(gas.state.disks, gas.start.scene.box, gas.cells, executor, found); });
  std::vector<std::size_t> offset;
  std::uint64_t pairs = found.find_offsets(offset);
  for (std::size_t b = 0; b < found.used; ++b) {
    for (const Pair& p : found.buffers[b]) pairs = (pairs * 0x9e3779b97f4a7c15ULL + p.i1) * 31 + p.i2;
  }
  row.SetLabel(hash_text(pairs));
}

void resolve_row(benchmark::State& row, std::size_t disks, int threads) {
  const Drifted& gas = drifted_gas(disks);
  const Executor executor(threads);
  const StepRules rules = rules_for(gas.start.scene, gas.start.scene.run.dt);
  FoundContacts found;
  find_contacts(gas.state.disks, gas.start.scene.box, gas.cells, executor, found);
  ContactLists lists;
  State state;
  time_work(
      row, disks, [&] { state = gas.state; }, [&] { resolve_contacts(state, rules, found, executor, lists); });
  row.SetLabel(hash_text(state_hash(state.disks)));
}

void copy_row(benchmark::State& row, std::size_t disks, int threads) {
  CopyLimit columns(disks);
  const Executor executor(threads);
  time_work(
      row, disks, [] {}, [&] { columns.copy(executor); });
}

[[maybe_unused]] const bool rows_registered = [] {
  for (const std::size_t disks : {10'000U, 100'000U, 1'000'000U, 10'000'000U}) {
    const auto times = static_cast<benchmark::IterationCount>(disks > 1'000'000 ? 5 : 5'000'000 / disks + 5);
    for (const int threads : {1, 2}) {
      const auto add = [&](const char* what, auto function) {
        benchmark::RegisterBenchmark(fmt::format("{}/disks:{}/threads:{}", what, disks, threads).c_str(), function)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(times);
      };
      add("sort_sorted", [=](benchmark::State& row) { sort_row(row, disks, threads, false); });
      add("sort_shuffled", [=](benchmark::State& row) { sort_row(row, disks, threads, true); });
      add("drift", [=](benchmark::State& row) { drift_row(row, disks, threads); });
      add("search", [=](benchmark::State& row) { search_row(row, disks, threads); });
      add("resolve", [=](benchmark::State& row) { resolve_row(row, disks, threads); });
      add("copy_limit", [=](benchmark::State& row) { copy_row(row, disks, threads); });
    }
  }
  return true;
}();

}  // namespace
}  // namespace carom::bench
