#include "parallel/slabs/slab_exact.hpp"

#include <utility>

#include "parallel/slabs/lone_rank.hpp"
#include "parallel/slabs/slab_exact_engine.hpp"

namespace carom {

std::unique_ptr<Engine> make_slab_exact_part(const Scene& scene, State part, const SlabStart& start,
                                             const Threads& threads, Ranks& ranks) {
  if (ranks.count() == 1 || !start.alone.empty()) return make_lone_part(scene, std::move(part), start, threads, ranks);
  return std::make_unique<SlabExact>(scene, std::move(part), start, threads, ranks);
}

std::unique_ptr<Engine> make_slab_exact(const Scene& scene, State initial, const Threads& threads, Ranks& ranks) {
  const SlabStart start = slab_start(scene, initial.disks, ranks.count());
  keep_own_disks(start.cut, ranks.rank(), initial.disks);
  return make_slab_exact_part(scene, std::move(initial), start, threads, ranks);
}

}  // namespace carom
