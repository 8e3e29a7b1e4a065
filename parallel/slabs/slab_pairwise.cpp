#include "parallel/slabs/slab_pairwise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "core/base/check.hpp"
#include "core/step/pairwise_method.hpp"
#include "core/step/step_start.hpp"
#include "parallel/slabs/slab_cut.hpp"
#include "parallel/slabs/slab_stepping.hpp"

namespace carom {

namespace {

// What of the scene slabs cannot do yet; empty: they can do all of it.
std::string unsupported(const Scene& scene) {
  if (settles(scene)) return "gravity with restitution below 1";
  return "";
}

void check(const Scene& scene, const State& state, int ranks) {
  const std::string what = unsupported(scene);
  if (!what.empty()) throw InputError(fmt::format("several ranks do not know {} yet: use one", what));
  const double radius = largest_radius_ever(scene, state.disks);
  const double least = least_thickness * radius;
  if (ranks == 1 || least * ranks <= scene.box.height) return;
  throw InputError(
      fmt::format("{} ranks: slabs of a box {:g} high would be thinner than two diameters of the largest disk, whose "
                  "radius is {:g}; use {} at most",
                  ranks, scene.box.height, radius, std::max(1, static_cast<int>(scene.box.height / least))));
}

}  // namespace

std::unique_ptr<Engine> make_slab_pairwise(const Scene& scene, State initial, const Threads& threads, Ranks& ranks) {
  check(scene, initial, ranks.count());
  return std::make_unique<PairwiseMethod<SlabStepping>>(scene, std::move(initial), threads, std::ref(ranks));
}

}  // namespace carom
