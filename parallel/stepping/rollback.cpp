#include "parallel/stepping/rollback.hpp"

#include <utility>
#include <vector>

#include "core/step/rollback_frame.hpp"
#include "core/step/rollback_method.hpp"
#include "parallel/stepping/time_stepping.hpp"
#include "parallel/stepping/wall_reach.hpp"

namespace carom {

namespace {

// Disks in a block of the pass over walls.
constexpr std::size_t wall_block = 8192;

// The phases that only RollbackMethod needs.
class RollbackPhases : public TimeStepping {
 public:
  using TimeStepping::TimeStepping;

  std::vector<DiskContact> contacts() const override {
    std::vector<DiskContact> met;
    for (const ContactEvent& e : lists_.events) {
      if (!is_wall(e.id2)) met.push_back({e.id1, e.id2, state_.time});
    }
    return met;
  }

 protected:
  // The pairs that touch and approach, in storage order.
  const std::vector<ContactEvent>& find_approaching(const StepRules& rules, StepFigures& figures) {
    search(rules);
    gather(rules);
    keep_events(lists_, executor_, [&](const ContactEvent& e) {
      const bool met = is_met(state_.disks, rules, e);
      note_overlaps(state_.disks, rules, e, met, figures);
      return met;
    });
    return lists_.events;
  }

  // Is neither disk in another of the pairs?
  bool is_alone(const ContactEvent& e) const { return carom::is_alone(lists_, e); }

  // All pairs found bounce in canonical order; those that share no disk with another commute.
  void bounce(const StepRules& rules, ImpactTally& tally) {
    const PhaseTimer timer(times_, "resolve");
    with_view(state_.disks, rules, [&](const auto& d) {
      split_crowded(executor_, lists_, tally, [&](const ContactEvent& e, ImpactTally& block) {
        block.add_pair(bounce_pair(d, rules, e.i1, e.i2));
      });
    });
    bounce_all(state_.disks, rules, lists_.crowded, tally);
    finish_contacts();
  }

  void meet_all_walls(const StepRules& rules, ImpactTally& tally, StepFigures& figures) {
    if (!has_walls(rules.box)) return;
    const PhaseTimer timer(times_, "resolve");
    const std::size_t n = state_.disks.size();
    lists_.tallies.assign(executor_.blocks(n, wall_block), {});
    deepest_.assign(executor_.blocks(n, wall_block), {});
    with_view(state_.disks, rules, [&](const auto& d) {
      executor_.for_ranges(n, wall_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          meet_walls(d, rules, static_cast<std::uint32_t>(i), lists_.tallies[b], deepest_[b]);
          wrap(d.x[i], d.y[i], rules.box);
        }
      });
    });
    for (const ImpactTally& t : lists_.tallies) tally.add(t);
    for (const Overlap& deepest : deepest_) figures.wall.raise_to(deepest);
    // Disks may leave these walls faster than they came: a ceiling under gravity, a rough wall (by their spin), a
    // thermal or a moving side.
    const bool rough = rules.surfaces != nullptr;
    if (rough || rules.gravity.acts() || rules.box.has_thermal_side() || rules.box.has_moving_wall()) forget_speeds();
  }

 private:
  std::vector<Overlap> deepest_;  // in walls, of each block
};

}  // namespace

std::unique_ptr<Engine> make_parallel_rollback(const Scene& scene, State initial, const Threads& threads) {
  return std::make_unique<RollbackMethod<RollbackPhases>>(scene, std::move(initial), threads);
}

}  // namespace carom
