#include "run/loop/run_loop.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <memory>

#include "core/base/wall_clock.hpp"
#include "run/loop/frame_schedule.hpp"

namespace carom {

namespace {

constexpr double pulse_seconds = 0.01;
constexpr Count most_steps_between_looks = 100'000;

// Time stepping adds up dt; an exact run has its state at any time, and needs no slack.
double slack_of(const Scene& scene) {
  constexpr double slack = 1e-6;
  return scene.run.method == Method::exact ? 0.0 : slack;
}

// A function that is called with the disks at times of its own schedule.
struct Watcher {
  const std::function<void(const DisksInPieces&)>* look = nullptr;
  bool within_steps = false;  // are times within steps known?
  FrameSchedule schedule;

  // The time at which it is due, if it is, in a run that has come to `now`. If only the ends of steps are known, that
  // is `now`, so that two watchers that get the same state get the same time, too.
  std::optional<double> due(double now) const {
    if (*look == nullptr) return std::nullopt;
    const std::optional<double> time = schedule.due(now);
    return time && !within_steps ? now : time;
  }
};

Watcher watcher(const std::function<void(const DisksInPieces&)>& look, const Scene& scene, double every, double start,
                const std::optional<double>& last) {
  Watcher w{&look, scene.run.method == Method::exact, {every, scene.run.t_end, slack_of(scene), start}};
  if (last) w.schedule.made(*last);
  return w;
}

// Reads the clock during a step, and asks whether to go on; either may end the batch of steps.
class StepWatch {
 public:
  StepWatch(Engine& engine, const RunObserver& observer) : engine_(engine) {
    engine_.set_watch([this, &observer] {
      if (observer.go_on && !observer.go_on()) stopped_ = true;
      if (seconds() > pulse_seconds) late_ = true;
      return !stopped_;
    });
  }
  StepWatch(const StepWatch&) = delete;
  StepWatch& operator=(const StepWatch&) = delete;
  ~StepWatch() { engine_.set_watch({}); }

  void begin_batch() {
    start_ = WallClock::now();
    late_ = false;
  }
  double seconds() const { return seconds_since(start_); }
  bool ends_batch() const { return stopped_ || late_; }
  bool stopped() const { return stopped_; }

 private:
  Engine& engine_;
  WallClock::time_point start_;
  std::atomic<bool> stopped_{false}, late_{false};
};

// Calls the watchers that are due with the disks.
class FrameMaker {
 public:
  FrameMaker(const Engine& engine, const Scene& scene, const RunObserver& observer)
      : engine_(engine),
        watchers_{watcher(observer.sample, scene, scene.analysis.every, scene.analysis.start, observer.last_sample),
                  watcher(observer.frame, scene, scene.output.every, 0.0, observer.last_frame)} {}

  bool due() const {
    const double now = engine_.progress().time;
    return watchers_[0].due(now) || watchers_[1].due(now);
  }

  void make_due() {
    const double now = engine_.progress().time;
    std::unique_ptr<DisksInPieces> disks;
    std::optional<double> shown;  // the time for which the disks were asked
    while (due()) {
      const std::optional<double> times[] = {watchers_[0].due(now), watchers_[1].due(now)};
      const std::size_t first = !times[1] || (times[0] && *times[0] <= *times[1]) ? 0 : 1;
      if (times[first] != shown) disks = engine_.pieces_at(*times[first], room_);
      shown = times[first];
      (*watchers_[first].look)(*disks);
      watchers_[first].schedule.made(disks->time());
    }
  }

 private:
  const Engine& engine_;
  std::array<Watcher, 2> watchers_;
  Disks room_;
};

}  // namespace

double run_to_end(Engine& engine, const Scene& scene, const RunObserver& observer) {
  FrameMaker frames(engine, scene, observer);
  if (!observer.frame && !observer.sample) engine.forget_paths();
  frames.make_due();
  double step_seconds = 0.0;
  // Steps between two readings of the clock, which cost as much as a step of two disks. The number depends on the
  // machine's speed, but no result depends on it.
  Count batch = 1;
  StepWatch watch(engine, observer);
  while (engine.progress().time < scene.run.t_end) {
    watch.begin_batch();
    for (Count k = 0; k < batch && engine.progress().time < scene.run.t_end && !frames.due(); ++k) {
      if (watch.ends_batch()) break;
      if (observer.stepped && k > 0) observer.stepped();
      engine.step();
    }
    const double seconds = watch.seconds();
    step_seconds += seconds;
    if (seconds < 0.5 * pulse_seconds) batch = std::min(2 * batch, most_steps_between_looks);
    if (seconds > pulse_seconds && batch > 1) batch /= 2;
    frames.make_due();
    if (observer.stepped && !watch.stopped()) observer.stepped();
    if (observer.pulse && !observer.pulse(step_seconds)) break;
  }
  // The work after the last step (sums, checkpoints, plots) needs memory, too.
  engine.release_memory();
  return step_seconds;
}

}  // namespace carom
