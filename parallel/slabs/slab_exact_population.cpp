// Changes between two windows of `exact` on slabs: disks come from sources, leave through sinks, and are kicked.
#include "core/step/source.hpp"
#include "core/step/step_start.hpp"
#include "core/step/thermostat.hpp"
#include "core/step/window_start.hpp"
#include "parallel/exact/window_passes.hpp"
#include "parallel/kicks/kick_all.hpp"
#include "parallel/slabs/newcomers_alone.hpp"
#include "parallel/slabs/rank_sums.hpp"
#include "parallel/slabs/redistribute.hpp"
#include "parallel/slabs/slab_exact_engine.hpp"

namespace carom {

// The numbers drawn for a disk are the same on its rank and on those that have it as a ghost.
void SlabExact::start_window() {
  const PhaseTimer timer(times_, "start");
  if (!scene_.sources.empty()) emit();
  if (scene_.physics.collapse_contact_time) state_.last_contact.resize(state_.next_id, -never);
  count_thermal_hits(scene_, state_);
  if (brownian_interval_begins(scene_, state_)) {
    const BrownianInterval interval = begin_brownian_interval(scene_, state_);
    draw_brownian_interval(state_.disks, scene_, interval, executor_, gone_);
    windows_.forget(Known::lists);
    SinkCounts taken;
    if (!gone_.empty()) {
      ghosts_.visit_own(gone_.size(), [&](std::size_t first, std::size_t last) {
        count_crossed(state_.disks, scene_, interval, gone_, first, last, taken);
      });
    }
    if (remove_gone()) count_taken_on_ranks(ranks_, taken, state_.taken);
  }
  if (is_kick_due(scene_, state_)) kick();
}

void SlabExact::emit() {
  const Disks newcomers = emit_alone(state_, [&](const Disks& own) {
    emit_at_window_start(scene_, state_, [&](const Disk& disk) {
      return !ranks_.any(meets(state_.disks, scene_.box, disk, 0, state_.disks.size()) ||
                         meets(own, scene_.box, disk, 0, own.size()));
    });
  });
  if (newcomers.empty()) return;
  take_newcomers(cut_, ranks_.rank(), newcomers, start_.disks == 0, start_.columns, state_.disks);
  start_.disks += newcomers.size();
  windows_.forget(Known::nothing);
}

// Counts the disks marked in gone_, if it is not empty, over all ranks. Returns whether any left; ghosts have left with
// them.
bool SlabExact::remove_gone() {
  if (!takes_) return false;
  std::int64_t gone = 0;
  if (!gone_.empty()) {
    ghosts_.visit_own(gone_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) gone += gone_[i];
    });
  }
  ranks_.sum({&gone, 1});
  if (gone == 0) return false;
  ghosts_.drop(state_, gone_);
  windows_.forget(Known::nothing);
  start_.disks -= static_cast<Count>(gone);
  state_.counters.removed += static_cast<Count>(gone);
  return true;
}

void SlabExact::kick() {
  const Count number = state_.intervals++;
  const std::size_t n = state_.disks.size();
  std::vector<ExactSum> heat(executor_.blocks(n, kick_block) + 1);
  std::vector<ExactSum> of_ghosts(heat.size());
  executor_.for_ranges(n, kick_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    ghosts_.visit_runs(begin, end, [&](std::size_t first, std::size_t last, bool is_own) {
      kick_range(state_.disks, scene_, number, first, last, is_own ? heat[b] : of_ghosts[b]);
    });
  });
  for (std::size_t b = 1; b < heat.size(); ++b) heat[0].add(heat[b]);
  ranks_.sum(heat[0].digits());
  state_.counters.thermostat_heat += heat[0].value();
  windows_.forget(Known::lists);
}

}  // namespace carom
