#include "parallel/slabs/leading_engine.hpp"

#include <cstdint>
#include <vector>

#include "core/base/check.hpp"
#include "core/scene/scene_names.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/slabs/moving_disks.hpp"
#include "parallel/slabs/slab_pairwise.hpp"

namespace carom {

namespace {

// What rank 0 says that comes next.
enum class Call : std::int64_t { end, make, step, collect, contacts, drop };

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

Bytes message_of(const Disks& disks) {
  std::vector<Disk> list;
  for (std::size_t i = 0; i < disks.size(); ++i) list.push_back(disk_at(disks, i));
  Bytes message;
  put_all(message, list);
  return message;
}

class LeadingEngine final : public Engine {
 public:
  LeadingEngine(Ranks& ranks, RankLead& lead, std::unique_ptr<Engine> part)
      : ranks_(ranks), lead_(lead), part_(std::move(part)), columns_(columns_of(part_->state().disks)) {}
  LeadingEngine(const LeadingEngine&) = delete;
  LeadingEngine& operator=(const LeadingEngine&) = delete;
  ~LeadingEngine() override {
    if (!lead_.lost()) agree_on(ranks_, Call::drop);
  }

  void step() override {
    whole_.reset();
    together(Call::step, [&] { part_->step(); });
  }

  const State& state() const override {
    if (whole_) return *whole_;
    together(Call::collect, [&] {
      State all = part_->state();
      const Bytes own = message_of(all.disks);
      truncate(all.disks, 0);
      for (const Bytes& message : ranks_.gather(own)) {
        for (const Disk& disk : MessageReader(message).get_all<Disk>()) push_back(all.disks, disk, columns_);
      }
      whole_ = std::make_unique<State>(std::move(all));
    });
    return *whole_;
  }

  const State& progress() const override { return part_->state(); }

  double disks_at(double /*t*/, Disks& out) const override {
    out = state().disks;
    return state().time;
  }

  std::vector<DiskContact> contacts() const override {
    std::vector<DiskContact> met;
    together(Call::contacts, [&] {
      Bytes own;
      put_all(own, part_->contacts());
      for (const Bytes& message : ranks_.gather(own)) {
        const auto more = MessageReader(message).get_all<DiskContact>();
        met.insert(met.end(), more.begin(), more.end());
      }
    });
    return met;
  }

  const PhaseTimes& phase_times() const override { return part_->phase_times(); }
  std::vector<std::string> take_warnings() override { return part_->take_warnings(); }

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
  std::unique_ptr<Engine> part_;
  DiskColumns columns_;
  mutable std::unique_ptr<State> whole_;  // of all ranks, since it was asked for after the last step
};

// One call of the lead, on another rank.
void follow(Call call, Ranks& ranks, Engine& part) {
  if (call == Call::step) {
    try {
      part.step();
    } catch (const PhysicsError&) {
      // Rank 0 has it too, and says so.
    }
  } else if (call == Call::collect) {
    ranks.gather(message_of(part.state().disks));
  } else if (call == Call::contacts) {
    Bytes own;
    put_all(own, part.contacts());
    ranks.gather(own);
  }
}

}  // namespace

std::unique_ptr<Engine> RankLead::make_engine(const Scene& scene, State initial, const Threads& threads,
                                              const std::string& start) {
  agree_on(ranks_, Call::make);
  shared_text(ranks_, start);
  return std::make_unique<LeadingEngine>(ranks_, *this, make_part(scene, std::move(initial), threads, ranks_));
}

void RankLead::end() {
  if (!lost_) agree_on(ranks_, Call::end);
}

void follow_lead(Ranks& ranks, const Threads& threads,
                 const std::function<std::pair<Scene, State>(const std::string& start)>& read) {
  std::unique_ptr<Engine> part;
  for (;;) {
    const Call call = agree_on(ranks, Call::end);
    if (call == Call::end) return;
    if (call == Call::drop) part = nullptr;
    if (call == Call::make) {
      auto [scene, state] = read(shared_text(ranks, ""));
      try {
        part = make_part(scene, std::move(state), threads, ranks);
      } catch (const InputError&) {
        // Rank 0 has it too, and says so.
      }
    } else if (part != nullptr) {
      follow(call, ranks, *part);
    }
  }
}

}  // namespace carom
