#include "parallel/slabs/leading_engine.hpp"

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/check.hpp"
#include "core/scene/scene_names.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/slabs/moving_disks.hpp"
#include "parallel/slabs/slab_pairwise.hpp"

namespace carom {

namespace {

// What rank 0 says that comes next.
enum class Call : std::int64_t { end, make, step, collect, contacts, report, drop };

// The same on all ranks; only what rank 0 gives counts.
Call agree_on(Ranks& ranks, Call call) {
  std::int64_t said = ranks.rank() == 0 ? static_cast<std::int64_t>(call) : 0;
  ranks.sum({&said, 1});
  return static_cast<Call>(said);
}

// The text that rank 0 has, on all ranks.
std::string shared_text(Ranks& ranks, const std::string& text) {
  Bytes here;
  put_all(here, std::vector<char>(text.begin(), text.end()));
  const std::vector<Bytes> all = ranks.gather(here);
  const std::vector<char> said = MessageReader(all[0]).get_all<char>();
  return {said.begin(), said.end()};
}

std::unique_ptr<Engine> make_part(const Scene& scene, State initial, const Threads& threads, Ranks& ranks) {
  if (scene.run.method != Method::pairwise) {
    throw InputError("several ranks do not know the method " + std::string(name_of(scene.run.method)) +
                     " yet: use one, or --method pairwise");
  }
  return make_slab_pairwise(scene, std::move(initial), threads, ranks);
}

// The rank's own disks, with what goes with them.
Bytes message_of(const State& state) {
  std::vector<Disk> list;
  std::vector<std::uint32_t> thermal_hits;
  for (std::size_t i = 0; i < state.disks.size(); ++i) {
    list.push_back(disk_at(state.disks, i));
    if (!state.thermal_hits.empty()) thermal_hits.push_back(thermal_hits_of(state, list.back().id));
  }
  Bytes message;
  put_all(message, list);
  put_all(message, thermal_hits);
  return message;
}

// The state with all disks, of which it has those of one rank.
State whole_state(const State& part, const std::vector<Bytes>& messages) {
  State all = part;
  truncate(all.disks, 0);
  // A rank without disks does not show which columns there are.
  DiskColumns columns{false, false, all.disks.spins()};
  for (const Bytes& message : messages) {
    for (const Disk& disk : MessageReader(message).get_all<Disk>()) {
      columns.radius = columns.radius || disk.radius != all.disks.common_radius;
      columns.mass = columns.mass || disk.mass != all.disks.common_mass;
    }
  }
  for (const Bytes& message : messages) {
    MessageReader reader(message);
    const auto disks = reader.get_all<Disk>();
    const auto thermal_hits = reader.get_all<std::uint32_t>();
    for (std::size_t k = 0; k < disks.size(); ++k) {
      push_back(all.disks, disks[k], columns);
      if (!thermal_hits.empty()) take_thermal_hits(all, disks[k].id, thermal_hits.at(k));
    }
  }
  return all;
}

// A rank's part of the engine, and what its steps took. All calls are collective.
class Part {
 public:
  Part(Ranks& ranks, std::unique_ptr<Engine> engine) : ranks_(ranks), engine_(std::move(engine)) {}

  Engine& engine() const { return *engine_; }

  // before: what the ranks had said to each other when they began to agree on this step.
  void step(const Traffic& before) {
    ++steps_;
    engine_->step();
    const Traffic more = traffic_since(before, ranks_.traffic());
    in_steps_.exchange.add(more.exchange);
    in_steps_.all_reduce.add(more.all_reduce);
    in_steps_.gather.add(more.gather);
    in_steps_.seconds += more.seconds;
  }

  RankReport report() const {
    Bytes here;
    put(here, RankLoad{engine_->state().disks.size(), in_steps_});
    RankReport all{steps_, {}};
    for (const Bytes& there : ranks_.gather(here)) all.ranks.push_back(MessageReader(there).get<RankLoad>());
    return all;
  }

 private:
  Ranks& ranks_;
  std::unique_ptr<Engine> engine_;
  Count steps_ = 0;
  Traffic in_steps_;
};

class LeadingEngine final : public Engine {
 public:
  LeadingEngine(Ranks& ranks, RankLead& lead, std::unique_ptr<Engine> part)
      : ranks_(ranks), lead_(lead), part_(ranks, std::move(part)) {}
  LeadingEngine(const LeadingEngine&) = delete;
  LeadingEngine& operator=(const LeadingEngine&) = delete;
  ~LeadingEngine() override {
    if (!lead_.lost()) agree_on(ranks_, Call::drop);
  }

  void step() override {
    whole_.reset();
    const Traffic before = ranks_.traffic();
    together(Call::step, [&] { part_.step(before); });
  }

  const State& state() const override {
    if (whole_) return *whole_;
    together(Call::collect, [&] {
      const State& part = part_.engine().state();
      whole_ = std::make_unique<State>(whole_state(part, ranks_.gather(message_of(part))));
    });
    return *whole_;
  }

  const State& progress() const override { return part_.engine().state(); }

  double disks_at(double /*t*/, Disks& out) const override {
    out = state().disks;
    return state().time;
  }

  std::vector<DiskContact> contacts() const override {
    std::vector<DiskContact> met;
    together(Call::contacts, [&] {
      Bytes own;
      put_all(own, part_.engine().contacts());
      for (const Bytes& message : ranks_.gather(own)) {
        const auto more = MessageReader(message).get_all<DiskContact>();
        met.insert(met.end(), more.begin(), more.end());
      }
    });
    return met;
  }

  RankReport report() const {
    RankReport all;
    together(Call::report, [&] { all = part_.report(); });
    return all;
  }

  const PhaseTimes& phase_times() const override { return part_.engine().phase_times(); }
  std::vector<std::string> take_warnings() override { return part_.engine().take_warnings(); }

 private:
  // What all ranks do at once. An error of the physics is every rank's; any other leaves them apart.
  template <class Work>
  void together(Call call, Work&& work) const {
    try {
      agree_on(ranks_, call);
      work();
    } catch (const PhysicsError&) {
      throw;
    } catch (...) {
      lead_.lose();
      throw;
    }
  }

  Ranks& ranks_;
  RankLead& lead_;
  Part part_;
  mutable std::unique_ptr<State> whole_;  // of all ranks, since it was asked for after the last step
};

// One call of the lead, on another rank.
void follow(Call call, Ranks& ranks, Part& part, const Traffic& before) {
  if (call == Call::step) {
    try {
      part.step(before);
    } catch (const PhysicsError&) {
      // Rank 0 has it too, and says so.
    }
  } else if (call == Call::collect) {
    ranks.gather(message_of(part.engine().state()));
  } else if (call == Call::contacts) {
    Bytes own;
    put_all(own, part.engine().contacts());
    ranks.gather(own);
  } else if (call == Call::report) {
    part.report();
  }
}

}  // namespace

std::unique_ptr<Engine> RankLead::make_engine(const Scene& scene, State initial, const Threads& threads,
                                              const std::string& start) {
  agree_on(ranks_, Call::make);
  shared_text(ranks_, start);
  auto engine = std::make_unique<LeadingEngine>(ranks_, *this, make_part(scene, std::move(initial), threads, ranks_));
  report_ = [lead = engine.get()] { return lead->report(); };
  return engine;
}

void RankLead::end() {
  if (!lost_) agree_on(ranks_, Call::end);
}

void follow_lead(Ranks& ranks, const Threads& threads,
                 const std::function<std::pair<Scene, State>(const std::string& start)>& read) {
  std::optional<Part> part;
  for (;;) {
    const Traffic before = ranks.traffic();
    const Call call = agree_on(ranks, Call::end);
    if (call == Call::end) return;
    if (call == Call::drop) part.reset();
    if (call == Call::make) {
      auto [scene, state] = read(shared_text(ranks, ""));
      try {
        part.emplace(ranks, make_part(scene, std::move(state), threads, ranks));
      } catch (const InputError&) {
        // Rank 0 has it too, and says so.
      }
    } else if (part) {
      follow(call, ranks, *part, before);
    }
  }
}

}  // namespace carom
