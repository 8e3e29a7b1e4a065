// Collisions per second of the exact method, compared with the yardstick, over threads, disks and packing fractions.
#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <memory>

#include "bench/figures/figures.hpp"
#include "bench/support/bench_scenes.hpp"
#include "bench/support/interleave.hpp"
#include "bench/support/yardstick.hpp"
#include "core/disks/state_hash.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"

namespace carom::bench {

namespace {

constexpr int rounds = 5;
constexpr int growth_rounds = 2;  // of half a minute each, with as much time for warming up
constexpr std::size_t million = 1'000'000;

// A turn has at least a million collisions (half a million for the yardstick) and several windows, so that making lists
// is shared among them.
constexpr double turn_work = 1e6;
constexpr double windows_at_least = 2.0;
// For each disk; it determines the number of windows in a turn. At packing fraction 0.5 windows in fact have 2, the
// number at which they aim (core/step/window_length.cpp); the hashes of earlier results are for this number of windows.
constexpr double collisions_a_window = 0.9;

int windows_a_turn(std::size_t disks) {
  return static_cast<int>(
      std::max(windows_at_least, turn_work / std::max(32.0, collisions_a_window * static_cast<double>(disks))));
}

// A contender, and its columns in the table.
struct Entry {
  std::string method;
  std::size_t disks;
  double packing_fraction;
  int threads;
  std::shared_ptr<Engine> engine;  // null for the yardstick
  Contender turns;                 // seconds for each collision
};

Entry exact_entry(const Start& start, double packing_fraction, int threads) {
  std::shared_ptr<Engine> engine = make_parallel_engine(start.scene, start.state, {threads});
  engine->forget_paths();
  const std::size_t disks = start.state.disks.size();
  const int windows = windows_a_turn(disks);
  Contender turns{"exact",
                  0.0,
                  [engine, windows] {
                    for (int k = 0; k < windows; ++k) engine->step();
                  },
                  {},
                  [engine] { return static_cast<double>(engine->state().counters.collisions); }};
  return {"exact", disks, packing_fraction, threads, engine, std::move(turns)};
}

Entry yardstick_entry(const Start& start) {
  const auto yardstick = std::make_shared<Yardstick>(start.state.disks, start.scene.box);
  Contender turns{"yardstick",
                  0.0,
                  [yardstick] { yardstick->run_collisions(static_cast<Count>(0.5 * turn_work)); },
                  {},
                  [yardstick] { return static_cast<double>(yardstick->collisions()); }};
  return {"yardstick", start.state.disks.size(), 0.5, 1, nullptr, std::move(turns)};
}

std::vector<Entry> make_entries() {
  std::vector<Entry> all;
  for (const std::size_t disks : {std::size_t{1'000}, std::size_t{10'000}, std::size_t{100'000}, million}) {
    const Start start = exact_gas(disks);
    all.push_back(exact_entry(start, 0.5, 1));
    if (disks > 1'000) all.push_back(exact_entry(start, 0.5, 2));
    all.push_back(yardstick_entry(start));
  }
  for (const double packing_fraction : {0.1, 0.3, 0.7}) {
    const Start start = exact_gas(100'000, packing_fraction);
    for (const int threads : {1, 2}) all.push_back(exact_entry(start, packing_fraction, threads));
  }
  all.push_back(exact_entry(exact_gas(2, 0.1), 0.1, 1));
  return all;
}

// The turns of the entry with these properties.
const Contender& turns_of(const std::vector<Entry>& all, std::size_t disks, int threads,
                          double packing_fraction = 0.5) {
  const auto it = std::find_if(all.begin(), all.end(), [&](const Entry& e) {
    return e.engine && e.disks == disks && e.threads == threads && e.packing_fraction == packing_fraction;
  });
  return it->turns;
}

const Contender& yardstick_of(const std::vector<Entry>& all, std::size_t disks) {
  return std::find_if(all.begin(), all.end(), [&](const Entry& e) { return !e.engine && e.disks == disks; })->turns;
}

double millions_a_second(const Contender& c) {
  return 1e-6 / median_time(c);
}

// Writes the table; returns the number of scenes in which 1 and 2 threads gave different states.
int write_table(const std::string& path, const std::vector<Entry>& all) {
  auto file = fmt::output_file(path);
  file.print("method,disks,packing_fraction,threads,million_collisions_per_s,ns_per_collision,state_hash\n");
  int differ = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Entry& e = all[k];
    const std::uint64_t hash = e.engine ? state_hash(e.engine->state().disks) : 0;
    file.print("{},{},{},{},{:.4f},{:.1f},{}\n", e.method, e.disks, e.packing_fraction, e.threads,
               millions_a_second(e.turns), 1e9 * median_time(e.turns), e.engine ? hash_text(hash) : "");
    const bool pair = e.engine && e.threads == 2;
    if (pair && hash != state_hash(all[k - 1].engine->state().disks)) ++differ;
  }
  return differ;
}

void take_turns(std::vector<Entry>& all, int times) {
  std::vector<Contender> turns;
  for (Entry& e : all) turns.push_back(std::move(e.turns));
  interleave(turns, times);
  for (std::size_t k = 0; k < all.size(); ++k) all[k].turns = std::move(turns[k]);
}

Figure differing_states(int differ) {
  return {"exact: states of 1 and 2 threads that differ", static_cast<double>(differ), "", 0.0, {}};
}

}  // namespace

std::vector<Figure> measure_exact_growth(const std::string& folder) {
  std::vector<Entry> all;
  for (const std::size_t disks : {std::size_t{10'000}, 10 * million}) {
    const Start start = exact_gas(disks);
    for (const int threads : {1, 2}) all.push_back(exact_entry(start, 0.5, threads));
  }
  take_turns(all, growth_rounds);
  const int differ = write_table(folder + "/exact_growth.csv", all);
  const auto growth = [&](int threads) {
    return ratio(turns_of(all, 10 * million, threads), turns_of(all, 10'000, threads));
  };
  return {{"exact: 10^7 over 10^4 disks, time per collision, 1 thread", growth(1), "", 1.5, {}},
          {"exact: 10^7 over 10^4 disks, time per collision, 2 threads", growth(2), "", 1.5, {}},
          differing_states(differ)};
}

std::vector<Figure> measure_exact(const std::string& folder) {
  std::vector<Entry> all = make_entries();
  take_turns(all, rounds);
  const int differ = write_table(folder + "/exact.csv", all);

  const auto over_yardstick = [&](std::size_t disks, int threads) {
    return ratio(yardstick_of(all, disks), turns_of(all, disks, threads));
  };
  const auto speed = [&](std::size_t disks, int threads, double fraction) {
    return millions_a_second(turns_of(all, disks, threads, fraction));
  };
  const char* unit = "10^6 coll./s";
  return {{"exact: over the yardstick, 10^6 disks, 2 threads", over_yardstick(million, 2), "", {}, 6.0},
          {"exact: over the yardstick, 10^6 disks, 1 thread", over_yardstick(million, 1), "", {}, {}},
          {"exact: over the yardstick, 10^5 disks, 1 thread", over_yardstick(100'000, 1), "", {}, {}},
          {"exact: over the yardstick, 10^4 disks, 1 thread", over_yardstick(10'000, 1), "", {}, 1.5},
          {"exact: over the yardstick, 10^3 disks, 1 thread", over_yardstick(1'000, 1), "", {}, 1.5},
          {"exact: 2 threads against 1, 10^6 disks",
           ratio(turns_of(all, million, 1), turns_of(all, million, 2)),
           "",
           {},
           1.85},
          {"exact: 10^6 disks, 2 threads (aim 3)", speed(million, 2, 0.5), unit, {}, {}},
          {"exact: 10^5 disks, 1 thread (aim 1.5)", speed(100'000, 1, 0.5), unit, {}, {}},
          {"exact: 10^5 disks, 1 thread, fraction 0.1 (aim 0.75)", speed(100'000, 1, 0.1), unit, {}, {}},
          {"exact: 10^5 disks, 1 thread, fraction 0.3 (aim 0.75)", speed(100'000, 1, 0.3), unit, {}, {}},
          {"exact: 10^5 disks, 1 thread, fraction 0.7 (aim 0.75)", speed(100'000, 1, 0.7), unit, {}, {}},
          {"exact: two disks", 1e6 * median_time(turns_of(all, 2, 1, 0.1)), "us/collision", {}, {}},
          differing_states(differ)};
}

}  // namespace carom::bench
