#include <fmt/format.h>
#include <fmt/os.h>

#include <memory>

#include "bench/figures/figures.hpp"
#include "bench/support/bench_scenes.hpp"
#include "bench/support/gas_features.hpp"
#include "bench/support/interleave.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"

namespace carom::bench {

namespace {

constexpr std::size_t million = 1'000'000;
constexpr int steps_a_turn = 24;

// A contender whose turns are steps of an engine of its own; times are in ns per disk and step.
Contender stepping(const std::string& name, const Start& start, int threads) {
  std::shared_ptr<Engine> engine = make_parallel_engine(start.scene, start.state, {threads});
  return {name,
          static_cast<double>(start.state.disks.size()) * steps_a_turn * 1e-9,
          [engine] {
            for (int k = 0; k < steps_a_turn; ++k) engine->step();
          },
          {}};
}

}  // namespace

std::vector<Figure> measure_features(const std::string& folder) {
  constexpr int rounds = 5;
  std::vector<Contender> turns;
  for (const GasFeature& feature : gas_features()) {
    const Start start = gas(million, feature.name);
    turns.push_back(stepping(feature.name, start, 1));
    turns.push_back(stepping(feature.name, start, 2));
  }
  interleave(turns, rounds);
  auto file = fmt::output_file(folder + "/features.csv");
  file.print("feature,ns_per_disk_step_1_thread,over_plain_1_thread,ns_per_disk_step_2_threads,over_plain_2_threads\n");
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < turns.size(); k += 2) {
    const double over_plain = ratio(turns[k + 1], turns[1]);
    file.print("{},{:.2f},{:.3f},{:.2f},{:.3f}\n", turns[k].name, median_time(turns[k]), ratio(turns[k], turns[0]),
               median_time(turns[k + 1]), over_plain);
    if (k > 0) figures.push_back({"G with " + turns[k].name + " over G, 2 threads", over_plain, "", {}, {}});
  }
  return figures;
}

std::vector<Figure> measure_special() {
  constexpr int rounds = 9;
  const Start plain = gas(million);
  const Start wide = wide_radii();
  const Start pile = settled_pile();
  std::vector<Contender> turns{stepping("plain", plain, 1), stepping("plain", plain, 2), stepping("wide", wide, 1),
                               stepping("wide", wide, 2),   stepping("pile", pile, 1),   stepping("pile", pile, 2)};
  interleave(turns, rounds);
  return {{"radii 1 : 100 over equal radii, 2 threads", ratio(turns[3], turns[1]), "", 3.0, {}},
          {"radii 1 : 100 over equal radii, 1 thread", ratio(turns[2], turns[0]), "", 3.0, {}},
          {"radii 1 : 100: 2 threads against 1", ratio(turns[2], turns[3]), "", {}, {}},
          {"pile of 10^5: 2 threads against 1", ratio(turns[4], turns[5]), "", {}, 1.4},
          {"pile of 10^5: step, 2 threads", median_time(turns[5]), "ns per disk", {}, {}},
          {"pile of 10^5: contacts that bear load",
           static_cast<double>(pile.state.loads.size()) / static_cast<double>(pile.state.disks.size()),
           "per disk",
           {},
           {}}};
}

}  // namespace carom::bench
