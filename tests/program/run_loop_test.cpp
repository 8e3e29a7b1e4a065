// The loop over steps: which frames and samples a run makes, for which times and in which order, and what it calls
// between steps.
#include "run/loop/run_loop.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/disks_by_hand.hpp"
#include "tests/support/scripted_engine.hpp"

namespace carom {
namespace {

using ::testing::ElementsAre;

// One disk; time advances by dt. An exact engine knows it at all times within a step.
class Stepping : public test::ScriptedEngine {
 public:
  Stepping(const Scene& scene, double dt, double from = 0.0)
      : exact_(scene.run.method == Method::exact), dt_(dt), t_end_(scene.run.t_end), begun_(from) {
    state_.time = from;
    append(state_.disks, {1.0, 1.0, 0.0, 0.0, 0.1, 1.0, 0});
  }

  void step() override {
    if (go_on_ && !go_on_()) return;
    begun_ = state_.time;
    state_.time = std::min(state_.time + dt_, t_end_);
    ++steps;
  }
  double disks_at(double t, Disks& out) const override {
    ++asked;
    out = state_.disks;
    return exact_ ? std::max(t, begun_) : state_.time;
  }
  void forget_paths() override { forgot = true; }
  void set_watch(const std::function<bool()>& go_on) override { go_on_ = go_on; }

  int steps = 0;
  mutable int asked = 0;
  bool forgot = false;

 private:
  bool exact_;
  double dt_, t_end_, begun_;
  std::function<bool()> go_on_;
};

Scene scene_of(Method method, double t_end, double frames, double start, double moments) {
  Scene scene = test::scene_of(method, 10.0, 10.0, 0.1, t_end);
  scene.output.every = frames;
  scene.analysis.start = start;
  scene.analysis.every = moments;
  return scene;
}

// The calls in their order: "f" and "s" with the times of frames and samples.
std::vector<std::string> seen(Engine& engine, const Scene& scene, RunObserver observer) {
  std::vector<std::string> all;
  observer.frame = [&](const DisksInPieces& disks) { all.push_back(fmt::format("f {:g}", disks.time())); };
  observer.sample = [&](const DisksInPieces& disks) { all.push_back(fmt::format("s {:g}", disks.time())); };
  run_to_end(engine, scene, observer);
  return all;
}

// Within steps, too, in order of time. Of a frame and a sample at the same time, for which the disks are asked once,
// the sample comes first. The last ones are at the end, for any intervals.
TEST(RunLoop, ExactMakesFramesAndMomentsOfTheirTimes) {
  const Scene scene = scene_of(Method::exact, 2.0, 0.375, 0.5, 0.625);
  Stepping engine(scene, 1.25);
  EXPECT_THAT(seen(engine, scene, {}), ElementsAre("f 0", "f 0.375", "s 0.5", "f 0.75", "s 1.125", "f 1.125", "f 1.5",
                                                   "s 1.75", "f 1.875", "s 2", "f 2"));
  EXPECT_EQ(engine.asked, 7) << "the state itself has the times 0 and 2";
}

// The last sample is at the end itself, even if the start plus the run's length is rounded to another number.
TEST(RunLoop, TheLastMomentIsAtTheEnd) {
  for (const auto& [start, end] : std::vector<std::pair<double, double>>{{0.2, 0.9}, {0.3, 0.9}}) {
    const Scene scene = scene_of(Method::exact, end, 0.0, start, 0.0);
    ASSERT_NE(start + (end - start), end);
    Stepping engine(scene, 1.0);
    std::vector<std::string> kinds;
    std::vector<double> times;
    RunObserver observer;
    observer.frame = [&](const DisksInPieces&) { kinds.emplace_back("f"); };
    observer.sample = [&](const DisksInPieces& disks) { kinds.emplace_back("s"), times.push_back(disks.time()); };
    run_to_end(engine, scene, observer);
    EXPECT_THAT(times, ElementsAre(start, end));
    EXPECT_THAT(kinds, ElementsAre("f", "s", "s", "f"));
  }
}

// A step that ends a rounding before a frame must not stand for it, as it would in time stepping.
TEST(RunLoop, ExactFramesAreNotARoundingEarly) {
  const Scene scene = scene_of(Method::exact, 1.0, 0.5, 0.0, 0.5);
  Stepping engine(scene, 0.5 - 1e-9);
  std::vector<double> times;
  RunObserver observer;
  observer.frame = [&](const DisksInPieces& disks) { times.push_back(disks.time()); };
  run_to_end(engine, scene, observer);
  EXPECT_THAT(times, ElementsAre(0.0, 0.5, 1.0));
}

// Eight steps of 0.1 add up to a little less than 0.8, and a sample at that time must not wait for the ninth.
TEST(RunLoop, TimeSteppingMakesThemAtTheEndsOfSteps) {
  const Scene scene = scene_of(Method::pairwise, 1.2, 0.35, 0.8, 0.2);
  Stepping engine(scene, 0.1);
  EXPECT_THAT(seen(engine, scene, {}), ElementsAre("f 0", "f 0.4", "f 0.7", "s 0.8", "s 1", "f 1.1", "s 1.2", "f 1.2"));
  const Scene together = scene_of(Method::pairwise, 1.2, 0.4, 0.8, 0.2);
  Stepping both(together, 0.1);
  EXPECT_THAT(seen(both, together, {}), ElementsAre("f 0", "f 0.4", "s 0.8", "f 0.8", "s 1", "s 1.2", "f 1.2"));
  const Scene before = scene_of(Method::pairwise, 1.0, 0.0, 3.0, 0.2);
  Stepping early(before, 0.1);
  EXPECT_THAT(seen(early, before, {}), ElementsAre("f 0", "f 1")) << "the run ends before the first sample";
}

// Steps are made in batches, which end when something is due.
TEST(RunLoop, NoneIsLateAmongManySteps) {
  const Scene scene = scene_of(Method::pairwise, 10.0, 2.0, 1.0, 3.0);
  Stepping engine(scene, 1.0 / 1024.0);
  EXPECT_THAT(seen(engine, scene, {}),
              ElementsAre("f 0", "s 1", "f 2", "s 4", "f 4", "f 6", "s 7", "f 8", "s 10", "f 10"));
}

// Frames and samples made before a checkpoint are not made again, and none after it is left out.
TEST(RunLoop, GoesOnBehindTheLastOnes) {
  for (const Method method : {Method::exact, Method::pairwise}) {
    const Scene scene = scene_of(method, 2.0, 0.5, 0.75, 0.25);
    RunObserver observer;
    observer.last_frame = 1.0;
    observer.last_sample = 1.25;
    Stepping engine(scene, 0.25, 1.25);
    EXPECT_THAT(seen(engine, scene, observer), ElementsAre("s 1.5", "f 1.5", "s 1.75", "s 2", "f 2"));
  }
}

// An exact engine keeps the paths of a step only if times within it may be asked for.
TEST(RunLoop, PathsAreForgottenWhereNobodyAsksForThem) {
  const Scene scene = scene_of(Method::exact, 1.0, 0.5, 0.0, 0.5);
  for (const bool frames : {false, true}) {
    for (const bool moments : {false, true}) {
      Stepping engine(scene, 0.4);
      RunObserver observer;
      if (frames) observer.frame = [](const DisksInPieces&) {};
      if (moments) observer.sample = [](const DisksInPieces&) {};
      run_to_end(engine, scene, observer);
      EXPECT_EQ(engine.forgot, !frames && !moments);
    }
  }
}

// The callback comes after each step made, and after the frames in it; not for a step that was not made.
TEST(RunLoop, EachStepIsTold) {
  const Scene scene = scene_of(Method::exact, 2.0, 0.5, 0.0, 0.5);
  Stepping engine(scene, 0.25);
  std::vector<std::string> told;
  RunObserver observer;
  observer.frame = [&](const DisksInPieces& disks) { told.push_back(fmt::format("f {:g}", disks.time())); };
  observer.stepped = [&] { told.push_back(fmt::format("{:g}", engine.state().time)); };
  observer.go_on = [&] { return engine.steps < 3; };
  observer.pulse = [&](double) { return engine.steps < 3; };
  run_to_end(engine, scene, observer);
  EXPECT_THAT(told, ElementsAre("f 0", "0.25", "f 0.5", "0.5", "0.75"));
}

}  // namespace
}  // namespace carom
