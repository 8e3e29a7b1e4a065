#include "run/loop/frame_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

// A time k * every this close to t_end, in units of every, counts as t_end, since 0.1 * 7 is not 0.7 and a frame so
// shortly before the last one would show nothing new.
constexpr double end_slack = 1e-6;

}  // namespace

FrameSchedule::FrameSchedule(double every, double t_end, double slack, double start)
    : every_(every), t_end_(t_end), slack_(slack), start_(start), next_(start) {}

std::optional<double> FrameSchedule::due(double now) const {
  if (finished_) return std::nullopt;
  const bool last = next_ == t_end_;
  if (now < (last ? t_end_ : next_ - slack_ * every_)) return std::nullopt;
  return last ? t_end_ : std::min(next_, now);
}

void FrameSchedule::made(double time) {
  if (time >= t_end_) finished_ = true;
  if (every_ <= 0.0) {
    next_ = t_end_;
    return;
  }
  const double k = std::floor((time - start_) / every_ + std::max(slack_, end_slack)) + 1.0;
  // Time advances even if the interval is below the rounding of the time.
  const double next = std::max(start_ + k * every_, std::nextafter(time, t_end_));
  next_ = next < t_end_ - end_slack * every_ ? next : t_end_;
}

Count frame_count(double every, double t_end) {
  if (!(t_end > 0.0)) return 1;
  if (every <= 0.0) return 2;
  return static_cast<Count>(std::min(std::ceil(t_end / every - end_slack), 1e18)) + 1;
}

}  // namespace carom
