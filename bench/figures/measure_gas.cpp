#include <fmt/format.h>
#include <fmt/os.h>

#include <map>

#include "bench/figures/figures.hpp"
#include "bench/support/bench_scenes.hpp"
#include "bench/support/copy_limit.hpp"
#include "bench/support/interleave.hpp"
#include "core/disks/state_hash.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"

namespace carom::bench {

namespace {

constexpr std::size_t million = 1'000'000;
// Steps in a turn: about three sorts, so that turns are alike.
constexpr int steps_a_turn = 36;
constexpr int rounds = 9;

// The time of a phase in each round.
class PhaseRounds {
 public:
  explicit PhaseRounds(const Engine& engine) : engine_(engine) {}
  void end_round() {
    for (const Phase& phase : engine_.phase_times().phases()) {
      double& before = before_[std::string(phase.name)];
      times_[std::string(phase.name)].push_back(phase.seconds - before);
      before = phase.seconds;
    }
  }
  // Excludes the first round, which warms up.
  std::vector<double> times(const std::string& name) const {
    const std::vector<double>& all = times_.at(name);
    return {all.begin() + 1, all.end()};
  }

 private:
  const Engine& engine_;
  std::map<std::string, double> before_;
  std::map<std::string, std::vector<double>> times_;
};

// Phases shorter than this share of the step need not have a speed-up of their own.
constexpr double small_share = 0.1;

void add_phases(const Engine& one, const PhaseRounds& rounds_one, const PhaseRounds& rounds_two, double step_two,
                const std::string& folder, std::vector<Figure>& figures) {
  auto file = fmt::output_file(folder + "/phases.csv");
  file.print("phase,ns_per_disk_step_1_thread,ns_per_disk_step_2_threads,share_of_step,speed_up\n");
  const double nanoseconds = 1e9 / (static_cast<double>(million) * steps_a_turn);
  for (const Phase& phase : one.phase_times().phases()) {
    const std::string name(phase.name);
    const double two = median(rounds_two.times(name)) * nanoseconds;
    const double speed_up = ratio(rounds_one.times(name), rounds_two.times(name));
    const double share = two / step_two;
    file.print("{},{:.3f},{:.3f},{:.3f},{:.3f}\n", name, median(rounds_one.times(name)) * nanoseconds, two, share,
               speed_up);
    // Short phases are listed as well, so that no row of an earlier commit remains for them.
    const auto at_least = share > small_share ? std::optional(1.5) : std::nullopt;
    figures.push_back({"phase " + name + ": 2 threads against 1", speed_up, "", {}, at_least});
  }
}

}  // namespace

std::vector<Figure> measure_gas(const std::string& folder) {
  const Start start = gas(million);
  const Executor one(1);
  const Executor two(2);
  CopyLimit columns(million);
  const auto engine_one = make_parallel_engine(start.scene, start.state, {1});
  const auto engine_two = make_parallel_engine(start.scene, start.state, {2});
  const auto steps = [](Engine& engine) {
    for (int k = 0; k < steps_a_turn; ++k) engine.step();
  };
  const auto copies = [&](const Executor& executor) {
    for (int k = 0; k < steps_a_turn; ++k) columns.copy(executor);
  };
  const double work = static_cast<double>(million) * steps_a_turn * 1e-9;  // times are in ns per disk and step
  std::vector<Contender> turns{{"step, 1 thread", work, [&] { steps(*engine_one); }, {}},
                               {"copy, 1 thread", work, [&] { copies(one); }, {}},
                               {"step, 2 threads", work, [&] { steps(*engine_two); }, {}},
                               {"copy, 2 threads", work, [&] { copies(two); }, {}}};
  PhaseRounds phases_one(*engine_one);
  PhaseRounds phases_two(*engine_two);
  interleave(turns, rounds, [&] {
    phases_one.end_round();
    phases_two.end_round();
  });
  std::vector<Figure> figures{
      {"G: step over copy limit, 2 threads", ratio(turns[2], turns[3]), "", 8.0, {}},
      {"G: step over copy limit, 1 thread", ratio(turns[0], turns[1]), "", {}, {}},
      {"G: step, 2 threads against 1", ratio(turns[0], turns[2]), "", {}, 1.8},
      {"G: step, 2 threads", median_time(turns[2]), "ns per disk", {}, {}},
      {"G: step, 1 thread", median_time(turns[0]), "ns per disk", {}, {}},
      {"G: copy limit, 2 threads", median_time(turns[3]), "ns per disk", {}, {}},
      {"G: copy limit, 1 thread", median_time(turns[1]), "ns per disk", {}, {}},
      {"G: states of 1 and 2 threads that differ",
       state_hash(engine_one->state().disks) == state_hash(engine_two->state().disks) ? 0.0 : 1.0,
       "",
       0.0,
       {}}};
  add_phases(*engine_one, phases_one, phases_two, median_time(turns[2]), folder, figures);
  return figures;
}

}  // namespace carom::bench
