#include "parallel/slabs/lone_rank.hpp"

#include <optional>
#include <utility>

#include "core/base/check.hpp"
#include "parallel/exact/exact_engine.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/slabs/redistribute.hpp"

namespace carom {

namespace {

// What all ranks know of a state.
struct Progress {
  double time, window;
  Counters counters;
  StallWatch stall;
  ValidityCounts validity;
  Count intervals;
  DiskId next_id;
};

void put_progress(Bytes& message, const State& state) {
  put(message,
      Progress{state.time, state.window, state.counters, state.stall, state.validity, state.intervals, state.next_id});
  put_all(message, state.sources);
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
  state.sources = message.get_all<SourceState>();
}

void put_text(Bytes& message, const std::string& text) {
  put_all(message, std::vector<char>(text.begin(), text.end()));
}

}  // namespace

void LoneRank::begin(State& state) {
  runs_ = true;
  collect_on_first(ranks_, columns_, state);
  if (ranks_.rank() > 0) return;
  State all = state;
  engine_ = make_parallel_exact(scene_, std::move(all), threads_);
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
  const auto text = reader.get_all<char>();
  take_progress(reader, state);
  while (!reader.at_end()) {
    const auto warning = reader.get_all<char>();
    warnings_.emplace_back(warning.begin(), warning.end());
  }
  if (!text.empty()) throw PhysicsError(std::string(text.begin(), text.end()));
}

void LoneRank::end(State& state) {
  runs_ = false;
  if (!engine_) return;
  state = engine_->state();
  engine_.reset();
}

double LoneRank::disks_at(double t, const State& here, Disks& out) const {
  if (engine_) return engine_->disks_at(t, out);
  out = here.disks;
  return t;
}

std::vector<DiskContact> LoneRank::contacts() const {
  return engine_ ? engine_->contacts() : std::vector<DiskContact>();
}

std::vector<std::string> LoneRank::take_warnings() {
  return std::exchange(warnings_, {});
}

}  // namespace carom
