#include "parallel/slabs/slab_pairwise.hpp"

#include <functional>
#include <utility>

#include "core/step/pairwise_method.hpp"
#include "parallel/slabs/load_memory.hpp"
#include "parallel/slabs/lone_rank.hpp"
#include "parallel/slabs/slab_stepping.hpp"

namespace carom {

std::unique_ptr<Engine> make_slab_pairwise(const Scene& scene, State initial, const Threads& threads, Ranks& ranks) {
  const SlabStart start = slab_start(scene, initial.disks, ranks.count());
  keep_own_disks(start.cut, ranks.rank(), initial.disks);
  keep_own_loads(initial);
  return make_slab_part(scene, std::move(initial), start, threads, ranks);
}

std::unique_ptr<Engine> make_slab_part(const Scene& scene, State part, const SlabStart& start, const Threads& threads,
                                       Ranks& ranks) {
  if (!start.alone.empty()) return make_lone_part(scene, std::move(part), start, threads, ranks);
  return std::make_unique<PairwiseMethod<SlabStepping>>(scene, std::move(part), std::cref(start), threads,
                                                        std::ref(ranks));
}

}  // namespace carom
