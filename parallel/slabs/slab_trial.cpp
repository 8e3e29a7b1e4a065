#include "parallel/slabs/slab_trial.hpp"

#include <algorithm>
#include <mutex>

#include "core/base/check.hpp"
#include "core/base/wall_clock.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "parallel/slabs/slab_cut.hpp"
#include "parallel/slabs/slab_exact.hpp"
#include "parallel/slabs/slab_pairwise.hpp"

namespace carom {

namespace {

constexpr int most_tried = 3;
// Enough for several sortings of the disks.
constexpr Count most_steps = 200;

// The mean number of borders of a rank, with this number of ranks.
double borders(const Domain& box, int ranks) {
  if (ranks == 1) return 0.0;
  return box.periodic_y() ? 2.0 : 2.0 * (ranks - 1) / ranks;
}

struct Tried {
  Count steps = 0, idle = 0;  // idle: steps of a rank without disks of its own
  Messages exchange, others;  // of all ranks
};

// One rank's part of the trial. The ranks agree on when to stop; these messages are not counted.
Tried try_part(const Scene& scene, const State& start, Ranks& ranks, double seconds) {
  Tried tried;
  const auto make = scene.run.method == Method::exact ? make_slab_exact : make_slab_pairwise;
  const auto engine = make(scene, start, {1}, ranks);
  const auto begin = WallClock::now();
  bool go_on = true;
  while (go_on && tried.steps < most_steps && engine->state().time < scene.run.t_end) {
    const Traffic before = ranks.traffic();
    try {
      engine->step();
    } catch (const PhysicsError&) {
      break;  // it is thrown on all ranks
    }
    const Traffic more = traffic_since(before, ranks.traffic());
    tried.exchange.add(more.exchange);
    tried.others.add(more.all_reduce);
    tried.others.add(more.gather);
    ++tried.steps;
    const auto* const slab = dynamic_cast<const InSlabs*>(engine.get());
    if (slab != nullptr && slab->own_disks() == 0) ++tried.idle;
    go_on = !ranks.any(ranks.rank() == 0 && seconds_since(begin) > seconds);
  }
  return tried;
}

}  // namespace

SlabTraffic try_slabs(const Scene& scene, const State& start, int ranks, double seconds) {
  const int count = std::min(ranks, most_tried);
  Tried all;
  std::mutex mutex;
  run_on_local_ranks(count, [&](Ranks& part) {
    const Tried tried = try_part(scene, start, part, seconds);
    const std::lock_guard lock(mutex);
    all.steps = tried.steps;
    if (part.rank() == 1) all.idle = tried.idle;  // the lead's part would have none
    all.exchange.add(tried.exchange);
    all.others.add(tried.others);
  });
  const double parts = static_cast<double>(std::max<Count>(1, all.steps)) * count;
  const double scale = ranks > count ? borders(scene.box, ranks) / borders(scene.box, count) : 1.0;
  // Lead and followers exchange a message in each step as well.
  const double agreed = ranks > 1 ? 1.0 : 0.0;
  return {agreed + static_cast<double>(all.exchange.messages + all.others.messages) / parts,
          agreed * sizeof(std::int64_t) +
              (scale * static_cast<double>(all.exchange.bytes) + static_cast<double>(all.others.bytes)) / parts,
          all.steps, all.idle, count};
}

}  // namespace carom
