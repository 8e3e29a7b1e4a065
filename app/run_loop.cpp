#include "app/run_loop.hpp"

#include <algorithm>
#include <chrono>

#include "io/frame_schedule.hpp"

namespace carom {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double pulse_seconds = 0.01;
constexpr Count most_steps_between_looks = 100'000;

// Time stepping adds up dt; an exact run can be looked at any time, and needs no slack.
FrameSchedule schedule_of(const Scene& scene) {
  constexpr double slack = 1e-6;
  return {scene.output.every, scene.run.t_end, scene.run.method == Method::exact ? 0.0 : slack};
}

// Makes the frames that have become due.
class FrameMaker {
 public:
  FrameMaker(const Engine& engine, const Scene& scene, const RunObserver& observer)
      : engine_(engine), observer_(observer), schedule_(schedule_of(scene)), wanted_(observer.frame != nullptr) {
    if (observer.last_frame) schedule_.made(*observer.last_frame);
  }

  bool due() const { return wanted_ && schedule_.due(engine_.state().time) >= 0.0; }

  void make_due() {
    while (due()) {
      const double time = engine_.disks_at(schedule_.due(engine_.state().time), disks_);
      observer_.frame(disks_, time);
      schedule_.made(time);
    }
  }

 private:
  const Engine& engine_;
  const RunObserver& observer_;
  FrameSchedule schedule_;
  bool wanted_;
  Disks disks_;
};

}  // namespace

double run_to_end(Engine& engine, const Scene& scene, const RunObserver& observer) {
  FrameMaker frames(engine, scene, observer);
  if (!observer.frame) engine.forget_paths();
  frames.make_due();
  double step_seconds = 0.0;
  // Steps between two looks at the clock: reading it costs as much as a step of two disks. How many they are depends on
  // the machine's speed, but nothing that they compute does.
  Count batch = 1;
  while (engine.state().time < scene.run.t_end) {
    const auto start = Clock::now();
    for (Count k = 0; k < batch && engine.state().time < scene.run.t_end && !frames.due(); ++k) engine.step();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    step_seconds += seconds;
    if (seconds < 0.5 * pulse_seconds) batch = std::min(2 * batch, most_steps_between_looks);
    if (seconds > pulse_seconds && batch > 1) batch /= 2;
    frames.make_due();
    if (observer.pulse && !observer.pulse(step_seconds)) break;
  }
  return step_seconds;
}

}  // namespace carom
