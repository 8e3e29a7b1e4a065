#include "parallel/simulation.hpp"

#include <utility>

#include "parallel/exact/exact_engine.hpp"
#include "parallel/stepping/pairwise.hpp"
#include "parallel/stepping/rollback.hpp"

namespace carom {

std::unique_ptr<Engine> make_parallel_engine(const Scene& scene, State initial, const Threads& threads) {
  switch (scene.run.method) {
    case Method::rollback:
      return make_parallel_rollback(scene, std::move(initial), threads);
    case Method::pairwise:
      return make_parallel_pairwise(scene, std::move(initial), threads);
    case Method::exact:
      break;
  }
  return make_parallel_exact(scene, std::move(initial), threads);
}

}  // namespace carom
