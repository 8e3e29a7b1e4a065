#include "core/reference/reference_rollback.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/reference/reference_engine.hpp"
#include "core/reference/step_contacts.hpp"
#include "core/step/rollback_frame.hpp"
#include "core/step/rollback_method.hpp"

namespace carom {

namespace {

// The phases that only RollbackMethod needs.
class RollbackPhases : public ReferenceEngine {
 public:
  RollbackPhases(const Scene& scene, State initial, CollisionLog* log)
      : ReferenceEngine(scene, std::move(initial)), log_(log) {}

 protected:
  // The pairs that touch and approach, the earliest contact first.
  const std::vector<ContactEvent>& find_approaching(const StepRules& rules, StepFigures& figures) {
    const PhaseTimer timer(times_, "search");
    events_ = contacts_after_drift(state_.disks, rules);
    std::erase_if(events_, [&](const ContactEvent& e) {
      const bool met = is_met(state_.disks, rules, e);
      note_overlaps(state_.disks, rules, e, met, figures);
      return !met;
    });
    std::sort(events_.begin(), events_.end(), event_order);
    contacts_ = contacts_per_disk(state_.disks.size(), events_);
    return events_;
  }

  // Is neither disk in another of the pairs?
  bool is_alone(const ContactEvent& e) const { return !is_crowded(contacts_, e); }

  void bounce(const StepRules& rules, ImpactTally& tally) {
    const PhaseTimer timer(times_, "resolve");
    bounce_all(state_.disks, rules, events_, tally, log_);
  }

  void meet_all_walls(const StepRules& rules, ImpactTally& tally, StepFigures& figures) {
    const PhaseTimer timer(times_, "resolve");
    with_view(state_.disks, rules, [&](const auto& d) {
      for (std::size_t i = 0; i < state_.disks.size(); ++i) {
        meet_walls(d, rules, static_cast<std::uint32_t>(i), tally, figures.wall);
      }
    });
    wrap_all();
  }

 private:
  CollisionLog* log_;
  std::vector<std::uint32_t> contacts_;  // of each disk in events_
};

}  // namespace

std::unique_ptr<Engine> make_reference_rollback(const Scene& scene, State initial, CollisionLog* log) {
  return std::make_unique<RollbackMethod<RollbackPhases>>(scene, std::move(initial), log);
}

}  // namespace carom
