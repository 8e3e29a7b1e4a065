#include "tests/fuzz_scenes/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/scene_text.hpp"
#include "core/start/initial_state.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "parallel/simulation.hpp"
#include "parallel/start/random_placement.hpp"
#include "run/loop/frame_schedule.hpp"
#include "run/loop/run_loop.hpp"
#include "tests/fuzz_scenes/sanity.hpp"
#include "tests/fuzz_scenes/trace.hpp"

namespace carom::fuzz {

namespace {

// Limits: steps that are compared, and disks times steps.
constexpr std::size_t most_steps = 250;
constexpr std::size_t most_work = 30'000;
constexpr std::size_t least_steps = 8;

struct Variant {
  Threads threads;  // count 0 means the reference
  Handling handling;
};

// The blocks of work are so small that small scenes have many; with a divisor of 1 they have a single one.
constexpr Variant variants[] = {
    {{1, 1}, Handling::looked_at},   {{1, 128}, Handling::left_alone}, {{2, 128}, Handling::looked_at},
    {{2, 1}, Handling::left_alone},  {{3, 1024}, Handling::released},  {{5, 64}, Handling::looked_at},
    {{8, 512}, Handling::looked_at},
};
// The engines that take turns in an interrupted run.
constexpr Threads turns[] = {{3, 512}, {0, 1}, {1, 1}, {2, 128}, {5, 1024}};

std::unique_ptr<Engine> make_engine(const Threads& threads, const Scene& scene, State state) {
  if (threads.count == 0) return make_reference_engine(scene, std::move(state));
  return make_parallel_engine(scene, std::move(state), threads);
}

std::string name_of(const Threads& threads) {
  return threads.count == 0 ? "reference"
                            : fmt::format("{} threads (divisor {})", threads.count, threads.block_divisor);
}

class Court {
 public:
  Court(Scene scene, State start, Trial& trial) : scene_(std::move(scene)), start_(std::move(start)), trial_(trial) {
    const std::size_t n = std::max<std::size_t>(start_.disks.size(), 1);
    steps_ = std::clamp(most_work / n, least_steps, most_steps);
  }

  void run() {
    run_reference();
    for (const Variant& v : variants) compare(v);
    for (const std::size_t first : {0U, 2U}) interrupt(first);
    if (expected_.error.empty()) {
      if (expected_.finished) look_at_cadences();
    } else {
      fail_again();
    }
  }

 private:
  void blame(const std::string& what) { trial_.faults.push_back(what); }

  void run_reference() {
    Sanity sanity(scene_, start_);
    const auto engine = make_reference_engine(scene_, start_);
    double before = 0.0;
    follow(*engine, scene_, steps_, Handling::looked_at, expected_, [&](const State& state, const Moment& moment) {
      if (expected_.error.empty()) {
        sanity.look(state, moment.warnings);
        look_within(*engine, before, sanity);
      }
      before = state.time;
    });
    end_ = engine->state();
    if (!sanity.fault().empty()) blame(sanity.fault());
    trial_.account = fmt::format("{}, {} disks, {} steps, {} collisions, {}",
                                 method_names[static_cast<std::size_t>(scene_.run.method)], start_.disks.size(),
                                 expected_.moments.size(), end_.counters.collisions,
                                 !expected_.error.empty() ? "status 3"
                                 : expected_.finished     ? "finished"
                                                          : "cut short");
  }

  // Two disks that pass through each other overlap for a while: this shows within a window, not at its ends.
  void look_within(const Engine& engine, double before, Sanity& sanity) const {
    constexpr int looks = 12;
    constexpr std::size_t most_disks = 500;
    if (scene_.run.method != Method::exact || start_.disks.size() > most_disks) return;
    Disks disks;
    for (int k = 1; k < looks; ++k) {
      const double t = before + (engine.state().time - before) * k / looks;
      if (engine.disks_at(t, disks) == t) sanity.look_within(disks, t);
    }
  }

  void compare(const Variant& v) {
    Trace found;
    const auto engine = make_parallel_engine(scene_, start_, v.threads);
    follow(*engine, scene_, steps_, v.handling, found);
    const std::string what = difference(expected_, found);
    if (!what.empty()) blame(fmt::format("{}: {}", name_of(v.threads), what));
  }

  // The run is stopped after every second or third step, and goes on from what a checkpoint has of it.
  void interrupt(std::size_t first) {
    RunRecord record;
    record.scene_text = resolved_toml(scene_);
    Checkpoint checkpoint{record, start_};
    Trace found;
    bool goes_on = true;
    for (std::size_t turn = 0; goes_on && found.error.empty(); ++turn) {
      const Scene again = parse_scene(checkpoint.record.scene_text, scene_.file, "");
      const auto engine = make_engine(turns[(first + turn) % std::size(turns)], again, checkpoint.state);
      const std::size_t until = std::min(expected_.moments.size(), found.moments.size() + 2 + turn % 2);
      const std::size_t before = found.moments.size();
      follow(*engine, again, until, Handling::looked_at, found);
      goes_on = found.moments.size() > before;
      checkpoint = decode_checkpoint(encode_checkpoint(record, engine->state()), "checkpoint");
    }
    const std::string what = difference(expected_, found);
    if (!what.empty()) blame(fmt::format("interrupted and resumed ({}): {}", first, what));
  }

  // A run stopped by its physics must fail again at the same place. If time has nearly come to a stop this takes some
  // windows.
  void fail_again() {
    if (expected_.error.find("almost stands still") != std::string::npos) return;
    for (const Threads& threads : {turns[1], turns[3]}) {
      const auto engine = make_engine(threads, scene_, end_);
      Trace again;
      follow(*engine, scene_, 1, Handling::left_alone, again);
      if (again.error != expected_.error) {
        blame(fmt::format("{}: taken up where it failed it says [{}] instead of [{}]", name_of(threads), again.error,
                          expected_.error));
      }
    }
  }

  // Runs the scene as the program does, with frames every `every`, or without frames (every < 0).
  std::vector<Frame> run_with(const Threads& threads, double every) {
    Scene scene = scene_;
    scene.output.every = std::max(every, 0.0);
    const auto engine = make_engine(threads, scene, start_);
    std::vector<Frame> frames;
    RunObserver observer;
    if (every >= 0.0) {
      observer.frame = [&](const DisksInPieces& disks) { frames.push_back({disks.time(), state_hash(disks.whole())}); };
    }
    run_to_end(*engine, scene, observer);
    if (hash_of(engine->state()) != hash_of(end_)) {
      blame(fmt::format("{}: frames every {} change the run", name_of(threads), every));
    }
    return frames;
  }

  void look_at_cadences() {
    run_with({2, 128}, -1.0);
    for (const double every : {0.0, scene_.output.every, scene_.run.t_end / 57.3}) {
      const std::vector<Frame> frames = run_with({0, 1}, every);
      const std::vector<Frame> found = run_with({3, 512}, every);
      if (frames != found) {
        blame(fmt::format("frames every {}: other ones, {} instead of {}", every, found.size(), frames.size()));
      }
      const Count all = every > 0.0 ? frame_count(every, scene_.run.t_end) : scene_.run.t_end > 0.0 ? 2 : 1;
      if (scene_.run.method == Method::exact && frames.size() != all) {
        blame(fmt::format("frames every {}: {} instead of {}", every, frames.size(), all));
      }
    }
  }

  Scene scene_;
  State start_, end_;
  Trial& trial_;
  std::size_t steps_ = 0;
  Trace expected_;
};

// Makes the disks of the scene in every way; they must be the same, and errors, too. Returns false on an error.
bool make_start(const Scene& scene, State& start, Trial& trial) {
  try {
    start = initial_state(scene);
  } catch (const InputError& error) {
    trial.refusal = error.what();
  }
  std::string refusal;
  try {
    const State other = parallel_initial_state(scene, 3);
    if (trial.refusal.empty() && hash_of(other) != hash_of(start))
      trial.faults.push_back("made in parallel it starts otherwise");
  } catch (const InputError& error) {
    refusal = error.what();
  }
  if (refusal != trial.refusal) {
    trial.faults.push_back(
        fmt::format("made in parallel it is refused by [{}] instead of [{}]", refusal, trial.refusal));
  }
  return trial.refusal.empty();
}

// The scene as written by the program must be the same scene. The choice of method = "auto" is made only once.
void read_again(Scene scene, const State& start, Trial& trial) {
  scene.run.automatic = false;
  const std::string text = resolved_toml(scene);
  const Scene again = parse_scene(text, scene.file, "");
  if (resolved_toml(again) != text) trial.faults.push_back("written, read and written again it is another scene");
  if (hash_of(initial_state(again)) != hash_of(start)) trial.faults.push_back("written and read it starts otherwise");
}

}  // namespace

Trial try_scene(const std::string& text, const std::string& name, const std::string& folder) {
  Trial trial;
  Scene scene;
  try {
    scene = parse_scene(text, name, folder);
  } catch (const InputError& error) {
    trial.refusal = error.what();
  }
  State start;
  if (trial.refusal.empty() && make_start(scene, start, trial)) {
    read_again(scene, start, trial);
    Court(scene, start, trial).run();
  }
  if (trial.refusal.find('\n') != std::string::npos) trial.faults.push_back("refused in more than one line");
  return trial;
}

}  // namespace carom::fuzz
