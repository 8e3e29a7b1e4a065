#include "app/cli/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/short_number.hpp"

namespace carom {

namespace {

constexpr double rate_seconds = 2.0;  // rates are means over this time to twice this time

// The number of disks less emitted and plus removed ones: from this and the counters of a later state, which may hold
// only a part of the disks, the number then follows.
Count state_disks(const State& start, Count disks) {
  return disks + start.counters.removed - start.counters.emitted;
}

}  // namespace

std::string progress_text(const ProgressPoint& then, const ProgressPoint& now, std::size_t disks, double t_end) {
  const double share = t_end > 0.0 ? std::min(now.time / t_end, 1.0) : 1.0;
  const double seconds = now.elapsed - then.elapsed;
  const double rate = seconds > 0.0 ? static_cast<double>(now.steps - then.steps) / seconds : 0.0;
  std::string text = fmt::format("{:5.1f} %  t = {:.6g} of {:g}  {} steps/s  {} disk-steps/s", 100.0 * share, now.time,
                                 t_end, short_number(rate), short_number(rate * static_cast<double>(disks)));
  const double gained = now.time - then.time;
  if (gained > 0.0) text += fmt::format("  {} left", duration_text(seconds * (t_end - now.time) / gained));
  return text;
}

Progress::Progress(bool wanted, double t_end, const State& start, Count disks, StatusPlace place)
    : line_(wanted, std::move(place)),
      t_end_(t_end),
      disks_(state_disks(start, disks)),
      start_(line_.seconds()),
      older_{0.0, start.time, start.counters.steps},
      newer_(older_) {}

void Progress::update(const State& state) {
  if (!line_.due()) return;
  const ProgressPoint point{line_.seconds() - start_, state.time, state.counters.steps};
  const Count disks = disks_ + state.counters.emitted - state.counters.removed;
  line_.show(progress_text(older_, point, disks, t_end_));
  if (point.elapsed - newer_.elapsed > rate_seconds) older_ = std::exchange(newer_, point);
}

}  // namespace carom
