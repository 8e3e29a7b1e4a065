#include "parallel/slabs/rank_part.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/base/check.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/slabs/load_memory.hpp"
#include "parallel/slabs/moving_disks.hpp"
#include "parallel/slabs/whole_state.hpp"

namespace carom {

namespace {

// Disks that come to rank 0 at a time: some megabytes, so that no rank has a second copy of all disks.
constexpr std::size_t disks_a_piece = std::size_t{1} << 16;

// A piece of the rank's own disks, with the data of the state that belong to them.
Bytes piece_of(const State& state, std::size_t begin, std::size_t count) {
  std::vector<MovingDisk> list;
  for (std::size_t i = begin; i < std::min(state.disks.size(), begin + count); ++i) {
    list.push_back(moving_disk(state, i));
  }
  Bytes message;
  put_all(message, list);
  return message;
}

// Collects all disks in all.disks on rank 0; the other ranks leave `all` unchanged. all: a copy of the part without
// disks.
void gather_disks(Ranks& ranks, const State& part, State* all) {
  const Disks& own = part.disks;
  // A rank without disks does not know the columns.
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

}  // namespace

RankCall agree_on(Ranks& ranks, RankCall call) {
  std::int64_t said = ranks.rank() == 0 ? static_cast<std::int64_t>(call) : 0;
  ranks.sum({&said, 1});
  return static_cast<RankCall>(said);
}

const SlabCut* RankPart::cut() const {
  const auto* const in_slabs = dynamic_cast<const InSlabs*>(engine_.get());
  return in_slabs != nullptr ? in_slabs->slab_cut() : nullptr;
}

StateSums RankPart::sums() const {
  return sums_over_ranks(ranks_, scene_, engine_->state());
}

DeepestOverlaps RankPart::overlaps() const {
  return overlaps_over_ranks(ranks_, scene_, engine_->state(), *cut());
}

void RankPart::gather(State* all) const {
  const State& own = engine_->state();
  if (all != nullptr) *all = own;
  if (all != nullptr) truncate(all->disks, 0);
  gather_disks(ranks_, own, all);
  std::vector<ContactLoad> loads = collect_loads(ranks_, own.loads);
  if (all != nullptr) all->loads = std::move(loads);
}

void RankPart::gather_at(double& t, State* all) const {
  Bytes asked;
  put(asked, t);
  State then;
  t = engine_->disks_at(MessageReader(ranks_.share(asked)).get<double>(), then.disks);
  if (all != nullptr) all->disks = no_disks_like(then.disks);
  gather_disks(ranks_, then, all);
}

double RankPart::fastest_within() const {
  double fastest = engine_->fastest_within();
  ranks_.maximum({&fastest, 1});
  return fastest;
}

void RankPart::step(const Traffic& before) {
  ++steps_;
  lists_.reset();
  shown_.reset();
  engine_->step();
  const Traffic more = traffic_since(before, ranks_.traffic());
  in_steps_.exchange.add(more.exchange);
  in_steps_.all_reduce.add(more.all_reduce);
  in_steps_.gather.add(more.gather);
  in_steps_.seconds += more.seconds;
}

void RankPart::release_memory() {
  lists_.reset();
  shown_.reset();
  engine_->release_memory();
}

RankReport RankPart::report() const {
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

void follow(RankCall call, Ranks& ranks, RankPart& part, const Traffic& before) {
  switch (call) {
    case RankCall::step:
      try {
        return part.step(before);
      } catch (const PhysicsError&) {
        return;  // rank 0 catches it too, and reports it
      }
    case RankCall::collect:
      return part.gather(nullptr);
    case RankCall::lists:
      return part.share_lists();
    case RankCall::piece:
      return static_cast<void>(part.lists().piece({}, 0));
    case RankCall::show:
      return part.show(false, 0.0);
    case RankCall::some:
      return part.shown().visit({});
    case RankCall::overlap:
      return static_cast<void>(part.shown_overlap());
    case RankCall::pairs:
      return static_cast<void>(part.shown_pairs());
    case RankCall::orders:
      return static_cast<void>(part.visit_shown_orders({}));
    case RankCall::bonds:
      return static_cast<void>(part.shown_bonds());
    case RankCall::look: {
      double t = 0.0;
      return part.gather_at(t, nullptr);
    }
    case RankCall::fastest:
      return static_cast<void>(part.fastest_within());
    case RankCall::contacts: {
      Bytes own;
      put_all(own, part.engine().contacts());
      return static_cast<void>(ranks.collect(own));
    }
    case RankCall::sums:
      return static_cast<void>(part.sums());
    case RankCall::overlaps:
      return static_cast<void>(part.overlaps());
    case RankCall::forget:
      return part.engine().forget_paths();
    case RankCall::release:
      return part.release_memory();
    case RankCall::report:
      return static_cast<void>(part.report());
    // Calls that make or end an engine are follow_lead's.
    case RankCall::end:
    case RankCall::make:
    case RankCall::begin:
    case RankCall::drop:
      return;
  }
}

}  // namespace carom
