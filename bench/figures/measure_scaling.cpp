#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <array>
#include <memory>

#include "bench/figures/figures.hpp"
#include "bench/support/bench_scenes.hpp"
#include "bench/support/copy_limit.hpp"
#include "bench/support/interleave.hpp"
#include "core/disks/state_hash.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"

namespace carom::bench {

namespace {

constexpr std::array<std::size_t, 4> sizes{10'000, 100'000, 1'000'000, 10'000'000};
constexpr int rounds = 5;

// About 10^7 disk-steps in a turn, and at least two or three sorts.
int steps_a_turn(std::size_t disks) {
  return std::max(10, static_cast<int>(10'000'000 / disks));
}

// The contenders for one number of disks.
struct Size {
  std::size_t disks;
  std::unique_ptr<Engine> one, two;
  std::unique_ptr<CopyLimit> columns;
};

Size make_size(std::size_t disks) {
  Start start = gas(disks);
  auto one = make_parallel_engine(start.scene, start.state, {1});
  auto two = make_parallel_engine(start.scene, std::move(start.state), {2});
  return {disks, std::move(one), std::move(two), std::make_unique<CopyLimit>(disks)};
}

}  // namespace

std::vector<Figure> measure_scaling(const std::string& folder) {
  const Executor executor_one(1);
  const Executor executor_two(2);
  std::vector<Size> all;
  for (const std::size_t disks : sizes) all.push_back(make_size(disks));
  std::vector<Contender> turns;  // four for each size
  for (const Size& size : all) {
    const int steps = steps_a_turn(size.disks);
    const auto repeat = [&](const char* what, auto&& one_step) {
      turns.push_back({what,
                       static_cast<double>(size.disks) * steps * 1e-9,
                       [=] {
                         for (int k = 0; k < steps; ++k) one_step();
                       },
                       {}});
    };
    repeat("step, 1 thread", [&size] { size.one->step(); });
    repeat("step, 2 threads", [&size] { size.two->step(); });
    repeat("copy, 1 thread", [&] { size.columns->copy(executor_one); });
    repeat("copy, 2 threads", [&] { size.columns->copy(executor_two); });
  }
  interleave(turns, rounds);

  auto file = fmt::output_file(folder + "/scaling.csv");
  file.print("disks,step_1_thread_ns,step_2_threads_ns,copy_1_thread_ns,copy_2_threads_ns,speed_up,state_hash\n");
  bool same = true;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Contender* t = &turns[4 * k];
    const std::uint64_t hash = state_hash(all[k].one->state().disks);
    same = same && hash == state_hash(all[k].two->state().disks);
    file.print("{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{}\n", all[k].disks, median_time(t[0]), median_time(t[1]),
               median_time(t[2]), median_time(t[3]), ratio(t[0], t[1]), hash_text(hash));
  }
  return {{"10^7 over 10^4 disks: time per disk and step, 2 threads", ratio(turns[13], turns[1]), "", 1.6, {}},
          {"10^7 over 10^4 disks: time per disk and step, 1 thread", ratio(turns[12], turns[0]), "", 1.6, {}},
          {"10^4 to 10^7 disks: states of 1 and 2 threads that differ", same ? 0.0 : 1.0, "", 0.0, {}}};
}

}  // namespace carom::bench
