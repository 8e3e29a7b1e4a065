#include "core/reference/reference_pairwise.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/reference/pair_search.hpp"
#include "core/reference/reference_engine.hpp"
#include "core/reference/step_contacts.hpp"
#include "core/step/pairwise_method.hpp"
#include "core/step/step_rounds.hpp"

namespace carom {

namespace {

// The phases that only PairwiseMethod needs.
class PairwisePhases : public ReferenceEngine {
 public:
  PairwisePhases(const Scene& scene, State initial, CollisionLog* log)
      : ReferenceEngine(scene, std::move(initial)), log_(log) {}

 protected:
  void search(const StepRules& rules) {
    const PhaseTimer timer(times_, "search");
    events_ = contacts_after_drift(state_.disks, rules);
  }

  StepFigures resolve(const StepRules& rules) {
    const PhaseTimer timer(times_, "resolve");
    const StepFigures figures = resolve_serially(state_, rules, events_, log_);
    wrap_all();
    return figures;
  }

  void keep_places() {
    x_ = state_.disks.x;
    y_ = state_.disks.y;
  }

  // Is a disk that this round displaced pressed into another disk or into a wall?
  bool presses_others() {
    Disks& disks = state_.disks;
    const Domain& box = scene_.box;
    return with_view(disks, [&](const auto& d) {
      std::vector<unsigned char> displaced(disks.size(), 0);
      bool any = false;
      for (std::size_t i = 0; i < disks.size(); ++i) {
        displaced[i] = is_displaced(d, box, i, x_[i], y_[i]) ? 1 : 0;
        if (displaced[i] != 0 && is_pressed_into_wall(d, box, i)) return true;
        any = any || displaced[i] != 0;
      }
      if (!any) return false;
      const std::vector<Pair> pairs = find_touching_pairs(disks, box);
      return std::any_of(pairs.begin(), pairs.end(), [&](const Pair& p) {
        return (displaced[p.i1] | displaced[p.i2]) != 0 && are_pressed(d, box, p.i1, p.i2);
      });
    });
  }

 private:
  CollisionLog* log_;
  std::vector<double> x_, y_;  // places kept
};

}  // namespace

std::unique_ptr<Engine> make_reference_pairwise(const Scene& scene, State initial, CollisionLog* log) {
  return std::make_unique<PairwiseMethod<PairwisePhases>>(scene, std::move(initial), log);
}

}  // namespace carom
