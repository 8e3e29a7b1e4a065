// The end of a window: stores the positions and velocities of the disks then.
#include <cmath>

#include "core/physics/exact_path.hpp"
#include "parallel/exact/logged_paths.hpp"
#include "parallel/exact/window_run.hpp"

namespace carom {

// Stores disks [begin, end) if neither gravity nor a shear acts.
void WindowRun::store_straight(std::size_t begin, std::size_t end, double length) {
  Disks& d = state_.disks;
  const Domain& box = window_.rules.box;
  EndedPaths paths{window_.record.data(), length,    d.x.data(), d.y.data(), d.vx.data(),
                   d.vy.data(),           -HUGE_VAL, HUGE_VAL,   -HUGE_VAL,  HUGE_VAL};
  if (box.periodic_x()) paths.left = 0.0, paths.right = box.width;
  if (box.periodic_y()) paths.bottom = 0.0, paths.top = box.height;
  path_kernels_.end(paths, begin, end);
}

ImpactTally WindowRun::store_paths(const WindowPlan& plan, std::vector<unsigned char>& gone) {
  const PhaseTimer timer(times_, "store");
  if (slots_ != nullptr) return store_part(plan);
  Disks& d = state_.disks;
  const std::size_t n = d.size();
  const bool any_gone = scheduler_.any_gone();
  gone.assign(any_gone ? n : 0, 0);
  const Domain& box = window_.rules.box;
  std::vector<ImpactTally> crossings(box.shear.acts() ? executor_.blocks(n, pass_block) : 0);
  const bool straight = !window_.rules.gravity.acts() && !box.shear.acts();
  const auto store = [&](const auto& wrap_path) {
    executor_.for_ranges(n, pass_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      if (straight) store_straight(begin, end, plan.length);
      for (std::size_t i = straight ? end : begin; i < end; ++i) {
        PathSegment p = carried_to(window_.record[i].path, plan.length, window_.rules.gravity);
        if (!any_gone || !std::isnan(p.x)) wrap_path(p, i, b);
        put(p, d, i);
      }
      for (std::size_t i = begin; any_gone && i < end; ++i) gone[i] = std::isnan(d.x[i]) ? 1 : 0;
      if (!all_->last_contact.empty()) {
        for (std::size_t i = begin; i < end; ++i) {
          all_->last_contact[d.id[i]] = plan.start + window_.last_contact[i];
        }
      }
      if (!all_->thermal_hits.empty()) {
        for (std::size_t i = begin; i < end; ++i) {
          all_->thermal_hits[d.id[i]] = window_.thermal_hits[i];
        }
      }
    });
  };
  if (box.shear.acts()) {
    store([&](PathSegment& p, std::size_t i, std::size_t b) {
      const double work = wrap_with_work(p, d.mass_of(i), box);
      if (work != 0.0) crossings[b].add_shear(0.0, work);
    });
  } else {
    store([&](PathSegment& p, std::size_t, std::size_t) { wrap_into(p, box); });
  }
  if (d.spins()) d.spin = window_.spin;
  return end_window(plan, crossings);
}

ImpactTally WindowRun::end_window(const WindowPlan& plan, const std::vector<ImpactTally>& crossings) {
  if (known_ == Known::lists) known_ = Known::lists_and_times;
  length_ = plan.length;
  meant_ = window_.meant;
  ImpactTally tally = scheduler_.tally();
  for (const ImpactTally& block : crossings) tally.add(block);
  return tally;
}

// Stores only own disks, in the columns of all.
ImpactTally WindowRun::store_part(const WindowPlan& plan) {
  Disks& to = all_->disks;
  const std::uint32_t* const slot = slots_->data();
  for (std::size_t i = 0; i < window_.record.size(); ++i) {
    const DiskRecord& record = window_.record[i];
    if (record.progress.has(DiskProgress::ghost)) continue;
    PathSegment p = carried_to(record.path, plan.length, window_.rules.gravity);
    wrap_into(p, window_.rules.box);
    put(p, to, slot[i]);
    if (!window_.spin.empty()) to.spin[slot[i]] = window_.spin[i];
    if (!window_.last_contact.empty()) all_->last_contact[record.id] = plan.start + window_.last_contact[i];
    if (!window_.thermal_hits.empty()) all_->thermal_hits[record.id] = window_.thermal_hits[i];
  }
  return end_window(plan, {});
}

}  // namespace carom
