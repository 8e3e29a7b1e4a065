#include "parallel/stepping/pairwise.hpp"

#include <utility>

#include "core/step/pairwise_method.hpp"
#include "parallel/stepping/time_stepping.hpp"

namespace carom {

std::unique_ptr<Engine> make_parallel_pairwise(const Scene& scene, State initial, const Threads& threads) {
  return std::make_unique<PairwiseMethod<TimeStepping>>(scene, std::move(initial), threads);
}

}  // namespace carom
