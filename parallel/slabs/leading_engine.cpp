#include "parallel/slabs/leading_engine.hpp"

#include <cstddef>
#include <exception>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/slabs/load_memory.hpp"
#include "parallel/slabs/rank_part.hpp"
#include "parallel/slabs/slab_exact.hpp"
#include "parallel/slabs/slab_pairwise.hpp"
#include "parallel/slabs/start_on_slabs.hpp"

namespace carom {

namespace {

// Returns rank 0's text on all ranks.
std::string shared_text(Ranks& ranks, const std::string& text) {
  Bytes first;
  put_text(first, text);
  return MessageReader(ranks.share(first)).get_text();
}

std::unique_ptr<Engine> make_part(const Scene& scene, State part, const SlabStart& start, const Threads& threads,
                                  Ranks& ranks) {
  const auto make = scene.run.method == Method::exact ? make_slab_exact_part : make_slab_part;
  return make(scene, std::move(part), start, threads, ranks);
}

class LeadingEngine final : public Engine {
 public:
  // For exact: the engine knows where disks were within a window.
  LeadingEngine(Ranks& ranks, RankLead& lead, const Scene& scene, std::unique_ptr<Engine> part, const Threads& threads)
      : ranks_(ranks),
        lead_(lead),
        part_(ranks, scene, std::move(part), threads),
        knows_paths_(scene.run.method == Method::exact) {}
  LeadingEngine(const LeadingEngine&) = delete;
  LeadingEngine& operator=(const LeadingEngine&) = delete;
  ~LeadingEngine() override {
    if (!lead_.lost()) agree_on(ranks_, RankCall::drop);
  }

  void step() override {
    whole_.reset();
    shown_ = 0;
    const Traffic before = ranks_.traffic();
    together(RankCall::step, [&] { part_.step(before); });
  }

  const State& state() const override {
    if (whole_) return *whole_;
    together(RankCall::collect, [&] {
      State all;
      part_.gather(&all);
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
    together(RankCall::look, [&] {
      State all;
      part_.gather_at(at, &all);
      out = std::move(all.disks);
    });
    return at;
  }

  std::unique_ptr<DisksInPieces> pieces_at(double t, Disks& room) const override {
    return std::make_unique<Shown>(*this, t, room);
  }

  double fastest_within() const override {
    double fastest = 0.0;
    if (knows_paths_) together(RankCall::fastest, [&] { fastest = part_.fastest_within(); });
    return fastest;
  }

  void forget_paths() override {
    knows_paths_ = false;
    together(RankCall::forget, [&] { part_.engine().forget_paths(); });
  }

  std::vector<DiskContact> contacts() const override {
    std::vector<DiskContact> met;
    together(RankCall::contacts, [&] {
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
    together(RankCall::sums, [&] { all = part_.sums(); });
    return all;
  }

  DeepestOverlaps overlaps() const {
    if (whole_ || part_.cut() == nullptr) return overlaps_of(state(), part_.scene());
    DeepestOverlaps all;
    together(RankCall::overlaps, [&] { all = part_.overlaps(); });
    return all;
  }

  // Ranks may store their disks in another order afterwards.
  void release_memory() override {
    whole_.reset();
    shown_ = 0;
    together(RankCall::release, [&] { part_.release_memory(); });
  }

  RankReport report() const {
    RankReport all;
    together(RankCall::report, [&] { all = part_.report(); });
    return all;
  }

  const PhaseTimes& phase_times() const override { return part_.engine().phase_times(); }
  std::vector<std::string> take_warnings() override { return part_.engine().take_warnings(); }

 private:
  // Each piece is a call of its own, so that ranks wait for the next call, whichever it is, if a writer gives up.
  class Pieces final : public StatePieces {
   public:
    explicit Pieces(const LeadingEngine& engine) : engine_(engine) {
      engine.together(RankCall::lists, [&] { engine.part_.share_lists(); });
    }

    const State& part() const override { return engine_.progress(); }

    // Loads across borders exist twice, so they can only be counted as they come.
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
        engine_.together(RankCall::piece, [&] { some = lists.piece(list, k); });
        use(some);
      }
    }

   private:
    const LeadingEngine& engine_;
  };

  // The ranks show one moment at a time: if another one has been shown in between, this one is shown again when needed.
  class Shown final : public DisksInPieces {
   public:
    Shown(const LeadingEngine& engine, double t, Disks& room) : engine_(engine), t_(t), room_(room) {
      size_ = shown().size();
      time_ = shown().time();
    }

    double time() const override { return time_; }
    Count size() const override { return size_; }

    void visit(const Use& use) const override {
      ShownDisks& disks = shown();
      visit_all(RankCall::some, use, [&](const Use& all) { disks.visit(all); });
    }

    bool visit_orders(const Use& use) const override {
      if (engine_.part_.cut() == nullptr) return false;
      shown();
      bool known = false;
      visit_all(RankCall::orders, use, [&](const Use& all) { known = engine_.part_.visit_shown_orders(all); });
      return known;
    }

    std::optional<double> max_overlap() const override {
      return found<double>(RankCall::overlap, [](const RankPart& part) { return part.shown_overlap(); });
    }

    std::optional<std::vector<PairCounts>> pair_counts() const override {
      return found<std::vector<PairCounts>>(RankCall::pairs, [](const RankPart& part) { return part.shown_pairs(); });
    }

    std::optional<BondPairs> bond_pairs() const override {
      return found<BondPairs>(RankCall::bonds, [](RankPart& part) { return part.shown_bonds(); });
    }

    const Disks& whole() const override {
      if (!within()) return engine_.state().disks;
      if (!gathered_) engine_.disks_at(t_, room_);
      gathered_ = true;
      return room_;
    }

   private:
    // The result of the ranks for the disks that are shown, each in its slab.
    template <class Found, class Find>
    std::optional<Found> found(RankCall call, const Find& find) const {
      if (engine_.part_.cut() == nullptr) return std::nullopt;
      shown();
      std::optional<Found> all;
      engine_.together(call, [&] { all = find(engine_.part_); });
      return all;
    }

    // All pieces are one call, in each of which ranks wait for each other: an exception of use() is kept until all have
    // come.
    template <class Visit>
    void visit_all(RankCall call, const Use& use, const Visit& visit_them) const {
      std::exception_ptr failed;
      const auto use_if_whole = [&](const Disks& some) {
        try {
          if (!failed) use(some);
        } catch (...) {
          failed = std::current_exception();
        }
      };
      engine_.together(call, [&] { visit_them(use_if_whole); });
      if (failed) std::rethrow_exception(failed);
    }

    bool within() const { return engine_.knows_paths_ && t_ < engine_.progress().time; }

    ShownDisks& shown() const {
      if (number_ == 0 || engine_.shown_ != number_) {
        engine_.together(RankCall::show, [&] { engine_.part_.show(within(), t_); });
        number_ = ++engine_.shows_;
        engine_.shown_ = number_;
      }
      return engine_.part_.shown();
    }

    const LeadingEngine& engine_;
    double t_;
    Disks& room_;
    double time_ = 0.0;
    Count size_ = 0;
    mutable bool gathered_ = false;
    mutable Count number_ = 0;
  };

  // Runs work on all ranks at once. An error of the physics occurs on every rank; after any other one they are out of
  // step.
  template <class Work>
  void together(RankCall call, Work&& work) const {
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
  mutable RankPart part_;
  bool knows_paths_;
  mutable Count shows_ = 0, shown_ = 0;  // how many moments have been shown, and the number of the present one; 0: none
  mutable std::unique_ptr<State> whole_;  // of all ranks, if it was asked for after the last step
};

}  // namespace

std::unique_ptr<Engine> RankLead::make_engine(const Scene& scene, State initial, const Threads& threads,
                                              const std::function<std::string(const State&)>& start) {
  check_ranks_know(scene.run.method);
  const SlabStart slabs = slab_start(scene, initial.disks, ranks_.count());
  Disks none = no_disks_like(initial.disks);
  auto disks = std::make_unique<HeldDisks>(std::exchange(initial.disks, std::move(none)));
  return make_parts(scene, std::move(initial), std::move(disks), slabs, threads, start);
}

std::unique_ptr<Engine> RankLead::make_engine(const Scene& scene, State initial, std::unique_ptr<DiskSource> disks,
                                              const Threads& threads,
                                              const std::function<std::string(const State&)>& start) {
  check_ranks_know(scene.run.method);
  const SlabStart slabs = slab_start(scene, *disks, ranks_.count());
  return make_parts(scene, std::move(initial), std::move(disks), slabs, threads, start);
}

std::unique_ptr<Engine> RankLead::make_parts(const Scene& scene, State initial, std::unique_ptr<DiskSource> disks,
                                             const SlabStart& slabs, const Threads& threads,
                                             const std::function<std::string(const State&)>& start) {
  try {
    agree_on(ranks_, RankCall::make);
    const std::vector<ContactLoad> loads = std::exchange(initial.loads, {});
    shared_text(ranks_, start(initial));
    ranks_.share(message_of(slabs));
    initial.disks = deal_out(ranks_, slabs, disks.get(), std::move(initial.disks));
    disks.reset();
    deal_out_loads(ranks_, loads, initial);
    return lead_engine(scene, make_part(scene, std::move(initial), slabs, threads, ranks_), threads);
  } catch (...) {
    lose();
    throw;
  }
}

std::unique_ptr<Engine> RankLead::make_engine_at_start(const Scene& scene, const Threads& threads,
                                                       const std::function<std::string(const State&)>& start) {
  if (scene.run.method == Method::rollback || !starts_on_slabs(scene)) return nullptr;
  try {
    agree_on(ranks_, RankCall::begin);
    shared_text(ranks_, start({}));
    std::optional<StartOnSlab> made = start_on_slab(scene, ranks_);
    if (!made) return nullptr;
    return lead_engine(scene, make_part(scene, std::move(made->part), made->start, threads, ranks_), threads);
  } catch (...) {
    lose();
    throw;
  }
}

std::unique_ptr<Engine> RankLead::lead_engine(const Scene& scene, std::unique_ptr<Engine> part,
                                              const Threads& threads) {
  auto engine = std::make_unique<LeadingEngine>(ranks_, *this, scene, std::move(part), threads);
  report_ = [lead = engine.get()] { return lead->report(); };
  sums_ = [lead = engine.get()] { return lead->sums(); };
  overlaps_ = [lead = engine.get()] { return lead->overlaps(); };
  return engine;
}

void RankLead::end() {
  if (!lost_) agree_on(ranks_, RankCall::end);
}

void follow_lead(Ranks& ranks, const Threads& threads,
                 const std::function<std::pair<Scene, State>(const std::string& start)>& read) {
  std::optional<RankPart> part;
  for (;;) {
    const Traffic before = ranks.traffic();
    const RankCall call = agree_on(ranks, RankCall::end);
    if (call == RankCall::end) return;
    if (call == RankCall::drop) part.reset();
    if (call == RankCall::make) {
      auto [scene, state] = read(shared_text(ranks, ""));
      const SlabStart start = slab_start_of(ranks.share({}));
      state.disks = deal_out(ranks, start, nullptr, std::move(state.disks));
      deal_out_loads(ranks, {}, state);
      part.emplace(ranks, scene, make_part(scene, std::move(state), start, threads, ranks), threads);
    } else if (call == RankCall::begin) {
      const Scene scene = read(shared_text(ranks, "")).first;
      std::optional<StartOnSlab> made = start_on_slab(scene, ranks);
      if (made)
        part.emplace(ranks, scene, make_part(scene, std::move(made->part), made->start, threads, ranks), threads);
    } else if (part) {
      follow(call, ranks, *part, before);
    }
  }
}

}  // namespace carom
