#include "parallel/slabs/lone_rank.hpp"

#include <optional>
#include <utility>

#include "core/base/check.hpp"
#include "core/base/phase_times.hpp"
#include "parallel/exact/exact_engine.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/slabs/redistribute.hpp"
#include "parallel/stepping/pairwise.hpp"

namespace carom {

namespace {

// What all ranks know of a state. In an empty box the first newcomer sets the radius and the mass that disks share.
struct Progress {
  double time, window;
  Counters counters;
  StallWatch stall;
  ValidityCounts validity;
  Count intervals;
  DiskId next_id;
  bool step_begun;
  double common_radius, common_mass;
};

void put_progress(Bytes& message, const State& state) {
  put(message, Progress{state.time, state.window, state.counters, state.stall, state.validity, state.intervals,
                        state.next_id, state.step_begun, state.disks.common_radius, state.disks.common_mass});
  put_all(message, state.sources);
  put_all(message, state.taken);
}

void take_progress(MessageReader& message, State& state) {
  const auto p = message.get<Progress>();
  state.time = p.time;
  state.window = p.window;
  state.counters = p.counters;
  state.stall = p.stall;
  state.validity = p.validity;
  state.intervals = p.intervals;
  state.next_id = p.next_id;
  state.step_begun = p.step_begun;
  state.disks.common_radius = p.common_radius;
  state.disks.common_mass = p.common_mass;
  state.sources = message.get_all<SourceState>();
  state.taken = message.get_all<Count>();
}

class LoneEngine final : public Engine {
 public:
  LoneEngine(const Scene& scene, State part, const SlabStart& start, const Threads& threads, Ranks& ranks)
      : state_(std::move(part)), t_end_(scene.run.t_end), lone_(scene, threads, ranks) {
    if (ranks.count() > 1 && !start.alone.empty()) warnings_ = {"one rank runs all disks: " + start.alone};
    lone_.begin(start.columns, state_);
  }

  void step() override {
    if (state_.time < t_end_) lone_.step(state_);
  }
  const State& state() const override { return lone_.state(state_); }
  double disks_at(double t, Disks& out) const override { return lone_.disks_at(t, state_, out); }
  double fastest_within() const override { return lone_.fastest_within(); }
  std::vector<DiskContact> contacts() const override { return lone_.contacts(); }
  void forget_paths() override { lone_.forget_paths(); }
  void release_memory() override { lone_.release_memory(); }
  const PhaseTimes& phase_times() const override { return lone_.phase_times(); }
  std::vector<std::string> take_warnings() override {
    std::vector<std::string> all = std::exchange(warnings_, {});
    const std::vector<std::string> more = lone_.take_warnings();
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

 private:
  State state_;  // without disks
  double t_end_;
  LoneRank lone_;
  std::vector<std::string> warnings_;
};

}  // namespace

void LoneRank::begin(DiskColumns columns, State& state) {
  runs_ = true;
  collect_on_first(ranks_, columns, state);
  if (ranks_.rank() > 0) return;
  State all = state;
  const auto make = [](const Scene& scene, State start, const Threads& threads) {
    return scene.run.method == Method::exact ? make_parallel_exact(scene, std::move(start), threads)
                                             : make_parallel_pairwise(scene, std::move(start), threads);
  };
  engine_ = make(scene_, std::move(all), threads_);
  if (!keeps_paths_) engine_->forget_paths();
  state.disks = no_disks_like(state.disks);
}

void LoneRank::forget_paths() {
  keeps_paths_ = false;
  if (engine_) engine_->forget_paths();
}

void LoneRank::step(State& state) {
  Bytes message;
  std::optional<std::string> error;
  if (engine_) {
    try {
      engine_->step();
    } catch (const PhysicsError& failed) {
      error = failed.what();
    }
    put_text(message, error.value_or(""));
    put_progress(message, engine_->state());
    for (const std::string& warning : engine_->take_warnings()) put_text(message, warning);
  }
  const Bytes said = ranks_.share(message);
  MessageReader reader(said);
  const std::string text = reader.get_text();
  take_progress(reader, state);
  while (!reader.at_end()) warnings_.push_back(reader.get_text());
  if (!text.empty()) throw PhysicsError(text);
}

void LoneRank::end(State& state, DiskColumns& columns, Count& disks) {
  runs_ = false;
  Bytes message;
  if (engine_) {
    state = engine_->state();
    engine_.reset();
    put(message, columns_of(state.disks));
    put(message, Count{state.disks.size()});
  }
  const Bytes said = ranks_.share(message);
  MessageReader reader(said);
  columns = reader.get<DiskColumns>();
  disks = reader.get<Count>();
}

double LoneRank::disks_at(double t, const State& here, Disks& out) const {
  if (engine_) return engine_->disks_at(t, out);
  out = here.disks;
  return t;
}

std::vector<DiskContact> LoneRank::contacts() const {
  return engine_ ? engine_->contacts() : std::vector<DiskContact>();
}

const PhaseTimes& LoneRank::phase_times() const {
  return engine_ ? engine_->phase_times() : no_times_;
}

std::vector<std::string> LoneRank::take_warnings() {
  return std::exchange(warnings_, {});
}

std::unique_ptr<Engine> make_lone_part(const Scene& scene, State part, const SlabStart& start, const Threads& threads,
                                       Ranks& ranks) {
  return std::make_unique<LoneEngine>(scene, std::move(part), start, threads, ranks);
}

}  // namespace carom
