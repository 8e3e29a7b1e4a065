#include "parallel/slabs/leading_engine.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/slabs/load_memory.hpp"
#include "parallel/slabs/moving_disks.hpp"
#include "parallel/slabs/shared_lists.hpp"
#include "parallel/slabs/slab_exact.hpp"
#include "parallel/slabs/slab_pairwise.hpp"
#include "parallel/slabs/start_on_slabs.hpp"
#include "parallel/slabs/whole_state.hpp"

namespace carom {

namespace {

// What rank 0 says that comes next.
enum class Call : std::int64_t {
  end,
  make,
  begin,
  step,
  collect,
  lists,
  piece,
  look,
  contacts,
  sums,
  overlaps,
  forget,
  release,
  report,
  drop
};

// The same on all ranks; only what rank 0 gives counts.
Call agree_on(Ranks& ranks, Call call) {
  std::int64_t said = ranks.rank() == 0 ? static_cast<std::int64_t>(call) : 0;
  ranks.sum({&said, 1});
  return static_cast<Call>(said);
}

// The text that rank 0 has, on all ranks.
std::string shared_text(Ranks& ranks, const std::string& text) {
  Bytes first;
  put_all(first, std::vector<char>(text.begin(), text.end()));
  const std::vector<char> said = MessageReader(ranks.share(first)).get_all<char>();
  return {said.begin(), said.end()};
}

// Disks that go from a rank to others at a time: some megabytes, so that no rank has a second copy of them all.
constexpr std::size_t disks_a_piece = std::size_t{1} << 16;

SlabStart start_of(const Scene& scene, const Disks& all, int ranks) {
  if (scene.run.method == Method::rollback) {
    throw InputError(
        "several ranks do not know the method rollback, whose frames are of the whole box: use one, or "
        "--method exact");
  }
  return slab_start(scene, all, ranks);
}

std::unique_ptr<Engine> make_part(const Scene& scene, State part, const SlabStart& start, const Threads& threads,
                                  Ranks& ranks) {
  const auto make = scene.run.method == Method::exact ? make_slab_exact_part : make_slab_part;
  return make(scene, std::move(part), start, threads, ranks);
}

// Each rank takes the disks in its slab of all that rank 0 has.
Disks deal_out(Ranks& ranks, const SlabStart& start, const Disks& all, Disks part) {
  truncate(part, 0);
  const auto expected = static_cast<std::size_t>(start.disks) / static_cast<std::size_t>(ranks.count());
  reserve(part, expected + expected / 32, start.columns);
  for (std::size_t begin = 0; begin < start.disks; begin += disks_a_piece) {
    std::vector<Disk> piece;
    for (std::size_t i = begin; i < std::min(all.size(), begin + disks_a_piece); ++i) piece.push_back(disk_at(all, i));
    Bytes message;
    put_all(message, piece);
    for (const Disk& disk : MessageReader(ranks.share(message)).get_all<Disk>()) {
      if (start.cut.rank_at(disk.y) == ranks.rank()) push_back(part, disk, start.columns);
    }
  }
  return part;
}

// A piece of the rank's own disks, with what of the state goes with them.
Bytes piece_of(const State& state, std::size_t begin, std::size_t count) {
  std::vector<MovingDisk> list;
  for (std::size_t i = begin; i < std::min(state.disks.size(), begin + count); ++i) {
    list.push_back(moving_disk(state, i));
  }
  Bytes message;
  put_all(message, list);
  return message;
}

// To all.disks on rank 0; the other ranks leave `all` alone. all: a copy of the part but for its disks.
void gather_disks(Ranks& ranks, const State& part, State* all) {
  const Disks& own = part.disks;
  // A rank without disks does not show which columns there are.
  std::array<double, 3> most{static_cast<double>(own.size()), own.radius.empty() ? 0.0 : 1.0,
                             own.mass.empty() ? 0.0 : 1.0};
  ranks.maximum(most);
  auto disks = static_cast<std::int64_t>(own.size());
  ranks.sum({&disks, 1});
  const DiskColumns columns{most[1] > 0.0, most[2] > 0.0, own.spins()};
  if (all != nullptr) reserve(all->disks, static_cast<std::size_t>(disks), columns);
  const std::size_t piece = std::max<std::size_t>(1024, disks_a_piece / static_cast<std::size_t>(ranks.count()));
  for (std::size_t begin = 0; begin < static_cast<std::size_t>(most[0]); begin += piece) {
    for (const Bytes& message : ranks.collect(piece_of(part, begin, piece))) {
      for (const MovingDisk& disk : MessageReader(message).get_all<MovingDisk>()) take_in(*all, disk, columns);
    }
  }
}

// The disks of a rank at the time that rank 0 asks for, which becomes that of what they give.
State look_at(Ranks& ranks, const Engine& engine, double& t) {
  Bytes asked;
  put(asked, t);
  t = MessageReader(ranks.share(asked)).get<double>();
  State then;
  t = engine.disks_at(t, then.disks);
  return then;
}

// A rank's part of the engine, and what its steps took. All calls are collective.
class Part {
 public:
  Part(Ranks& ranks, const Scene& scene, std::unique_ptr<Engine> engine)
      : ranks_(ranks), scene_(scene), engine_(std::move(engine)) {}

  const Scene& scene() const { return scene_; }
  Engine& engine() const { return *engine_; }

  StateSums sums() const { return sums_over_ranks(ranks_, scene_, engine_->state()); }

  // Null: only a state with all disks tells how deep they overlap.
  const SlabCut* cut() const {
    const auto* const in_slabs = dynamic_cast<const InSlabs*>(engine_.get());
    return in_slabs != nullptr ? in_slabs->slab_cut() : nullptr;
  }
  DeepestOverlaps overlaps() const { return overlaps_over_ranks(ranks_, scene_, engine_->state(), *cut()); }

  // The lists of the state as it is now; until the next step.
  void share_lists() { lists_.emplace(ranks_, engine_->state()); }
  SharedLists& lists() { return *lists_; }

  // before: what the ranks had said to each other when they began to agree on this step.
  void step(const Traffic& before) {
    ++steps_;
    lists_.reset();
    engine_->step();
    const Traffic more = traffic_since(before, ranks_.traffic());
    in_steps_.exchange.add(more.exchange);
    in_steps_.all_reduce.add(more.all_reduce);
    in_steps_.gather.add(more.gather);
    in_steps_.seconds += more.seconds;
  }

  RankReport report() const {
    Bytes here;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto* const in_slabs = dynamic_cast<const InSlabs*>(engine_.get());
    const Count own = in_slabs != nullptr ? in_slabs->own_disks() : engine_->state().disks.size();
    put(here, RankLoad{own, in_slabs != nullptr ? in_slabs->ghosts() : 0,
                       Count{1024} * static_cast<Count>(usage.ru_maxrss), in_steps_});
    RankReport all{steps_, {}};
    for (const Bytes& there : ranks_.gather(here)) all.ranks.push_back(MessageReader(there).get<RankLoad>());
    return all;
  }

 private:
  Ranks& ranks_;
  Scene scene_;
  std::unique_ptr<Engine> engine_;
  std::optional<SharedLists> lists_;
  Count steps_ = 0;
  Traffic in_steps_;
};

class LeadingEngine final : public Engine {
 public:
  // Of exact: it knows where disks were within a window.
  LeadingEngine(Ranks& ranks, RankLead& lead, const Scene& scene, std::unique_ptr<Engine> part)
      : ranks_(ranks),
        lead_(lead),
        part_(ranks, scene, std::move(part)),
        knows_paths_(scene.run.method == Method::exact) {}
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
      State all = part_.engine().state();
      truncate(all.disks, 0);
      gather_disks(ranks_, part_.engine().state(), &all);
      all.loads = collect_loads(ranks_, part_.engine().state().loads);
      whole_ = std::make_unique<State>(std::move(all));
    });
    return *whole_;
  }

  const State& progress() const override { return part_.engine().progress(); }

  std::unique_ptr<StatePieces> pieces() const override { return std::make_unique<Pieces>(*this); }

  double disks_at(double t, Disks& out) const override {
    if (!knows_paths_ || !(t < progress().time)) {
      out = state().disks;
      return state().time;
    }
    double at = t;
    together(Call::look, [&] {
      const State here = look_at(ranks_, part_.engine(), at);
      State all;
      all.disks = no_disks_like(here.disks);
      gather_disks(ranks_, here, &all);
      out = std::move(all.disks);
    });
    return at;
  }

  void forget_paths() override {
    knows_paths_ = false;
    together(Call::forget, [&] { part_.engine().forget_paths(); });
  }

  std::vector<DiskContact> contacts() const override {
    std::vector<DiskContact> met;
    together(Call::contacts, [&] {
      Bytes own;
      put_all(own, part_.engine().contacts());
      for (const Bytes& message : ranks_.collect(own)) {
        const auto more = MessageReader(message).get_all<DiskContact>();
        met.insert(met.end(), more.begin(), more.end());
      }
    });
    return met;
  }

  StateSums sums() const {
    if (whole_) return sums_of(*whole_, part_.scene());
    StateSums all;
    together(Call::sums, [&] { all = part_.sums(); });
    return all;
  }

  DeepestOverlaps overlaps() const {
    if (whole_ || part_.cut() == nullptr) return overlaps_of(state(), part_.scene());
    DeepestOverlaps all;
    together(Call::overlaps, [&] { all = part_.overlaps(); });
    return all;
  }

  void release_memory() override {
    together(Call::release, [&] { part_.engine().release_memory(); });
  }

  RankReport report() const {
    RankReport all;
    together(Call::report, [&] { all = part_.report(); });
    return all;
  }

  const PhaseTimes& phase_times() const override { return part_.engine().phase_times(); }
  std::vector<std::string> take_warnings() override { return part_.engine().take_warnings(); }

 private:
  // Each piece is a call of its own, so that ranks wait for the next call, whatever it is, when a writer gives up.
  class Pieces final : public StatePieces {
   public:
    explicit Pieces(const LeadingEngine& engine) : engine_(engine) {
      engine.together(Call::lists, [&] { engine.part_.share_lists(); });
    }

    const State& part() const override { return engine_.progress(); }

    // Loads across borders are there twice, so that only those that come can be counted.
    Count entries(StateList list) const override {
      if (list != StateList::loads) return engine_.part_.lists().entries(list);
      Count loads = 0;
      visit(list, [&loads](std::span<const std::byte> some) { loads += some.size() / sizeof(ContactLoad); });
      return loads;
    }

    void visit(StateList list, const Use& use) const override {
      SharedLists& lists = engine_.part_.lists();
      for (std::size_t k = 0; k < lists.pieces(list); ++k) {
        Bytes some;
        engine_.together(Call::piece, [&] { some = lists.piece(list, k); });
        use(some);
      }
    }

   private:
    const LeadingEngine& engine_;
  };

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
  mutable Part part_;
  bool knows_paths_;
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
    gather_disks(ranks, part.engine().state(), nullptr);
    collect_loads(ranks, part.engine().state().loads);
  } else if (call == Call::lists) {
    part.share_lists();
  } else if (call == Call::piece) {
    part.lists().piece({}, 0);
  } else if (call == Call::look) {
    double t = 0.0;
    gather_disks(ranks, look_at(ranks, part.engine(), t), nullptr);
  } else if (call == Call::forget) {
    part.engine().forget_paths();
  } else if (call == Call::contacts) {
    Bytes own;
    put_all(own, part.engine().contacts());
    ranks.collect(own);
  } else if (call == Call::sums) {
    part.sums();
  } else if (call == Call::overlaps) {
    part.overlaps();
  } else if (call == Call::release) {
    part.engine().release_memory();
  } else if (call == Call::report) {
    part.report();
  }
}

}  // namespace

std::unique_ptr<Engine> RankLead::make_engine(const Scene& scene, State initial, const Threads& threads,
                                              const std::function<std::string(const State&)>& start) {
  const SlabStart slabs = start_of(scene, initial.disks, ranks_.count());
  try {
    agree_on(ranks_, Call::make);
    Disks all = std::move(initial.disks);
    initial.disks = no_disks_like(all);
    const std::vector<ContactLoad> loads = std::exchange(initial.loads, {});
    shared_text(ranks_, start(initial));
    ranks_.share(message_of(slabs));
    initial.disks = deal_out(ranks_, slabs, all, std::move(initial.disks));
    all = Disks();
    deal_out_loads(ranks_, loads, initial);
    return lead_engine(scene, make_part(scene, std::move(initial), slabs, threads, ranks_));
  } catch (...) {
    lose();
    throw;
  }
}

std::unique_ptr<Engine> RankLead::make_engine_at_start(const Scene& scene, const Threads& threads,
                                                       const std::function<std::string(const State&)>& start) {
  if (scene.run.method == Method::rollback || !starts_on_slabs(scene)) return nullptr;
  try {
    agree_on(ranks_, Call::begin);
    shared_text(ranks_, start({}));
    std::optional<StartOnSlab> made = start_on_slab(scene, ranks_);
    if (!made) return nullptr;
    return lead_engine(scene, make_part(scene, std::move(made->part), made->start, threads, ranks_));
  } catch (...) {
    lose();
    throw;
  }
}

std::unique_ptr<Engine> RankLead::lead_engine(const Scene& scene, std::unique_ptr<Engine> part) {
  auto engine = std::make_unique<LeadingEngine>(ranks_, *this, scene, std::move(part));
  report_ = [lead = engine.get()] { return lead->report(); };
  sums_ = [lead = engine.get()] { return lead->sums(); };
  overlaps_ = [lead = engine.get()] { return lead->overlaps(); };
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
      const SlabStart start = slab_start_of(ranks.share({}));
      state.disks = deal_out(ranks, start, {}, std::move(state.disks));
      deal_out_loads(ranks, {}, state);
      part.emplace(ranks, scene, make_part(scene, std::move(state), start, threads, ranks));
    } else if (call == Call::begin) {
      const Scene scene = read(shared_text(ranks, "")).first;
      std::optional<StartOnSlab> made = start_on_slab(scene, ranks);
      if (made) part.emplace(ranks, scene, make_part(scene, std::move(made->part), made->start, threads, ranks));
    } else if (part) {
      follow(call, ranks, *part, before);
    }
  }
}

}  // namespace carom
