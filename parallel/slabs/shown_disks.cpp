#include "parallel/slabs/shown_disks.hpp"

#include "parallel/ranks/message.hpp"
#include "parallel/slabs/slab_orders.hpp"
#include "parallel/slabs/slab_pairs.hpp"
#include "parallel/slabs/whole_state.hpp"

namespace carom {

namespace {

struct Moment {
  double t = 0.0;
  bool within = false;
};

}  // namespace

ShownDisks::ShownDisks(Ranks& ranks, const Engine& engine, bool within, double t)
    : ranks_(ranks), ids_(engine.progress().next_id) {
  Bytes asked;
  put(asked, Moment{t, within});
  const auto moment = MessageReader(ranks.share(asked)).get<Moment>();
  time_ = moment.within ? engine.disks_at(moment.t, then_) : engine.progress().time;
  own_ = moment.within ? &then_ : &engine.state().disks;
  ordered_.emplace(ranks, *own_, ids_);
}

void ShownDisks::visit(const DisksInPieces::Use& use) {
  visit(*ordered_, use);
}

void ShownDisks::visit(OrderedDisks& disks, const DisksInPieces::Use& use) const {
  for (std::size_t k = 0; k < disks.pieces(); ++k) {
    const Disks& some = disks.piece(k);
    if (ranks_.rank() == 0) use(some);
  }
}

bool ShownDisks::find_orders(const Scene& scene, const SlabCut& cut, const BlockRunner& run) {
  if (!orders_) orders_ = orders_over_ranks(ranks_, scene.analysis, box_at(scene.box, time_), *own_, cut, run);
  return orders_.has_value();
}

bool ShownDisks::visit_orders(const Scene& scene, const SlabCut& cut, const BlockRunner& run,
                              const DisksInPieces::Use& use) {
  if (!find_orders(scene, cut, run)) return false;
  OrderedDisks ordered(ranks_, *orders_, ids_);
  visit(ordered, use);
  return true;
}

double ShownDisks::max_overlap(const Scene& scene, const SlabCut& cut) const {
  return overlap_over_ranks(ranks_, box_at(scene.box, time_), *own_, cut).size;
}

std::optional<std::vector<PairCounts>> ShownDisks::pair_counts(const Scene& scene, const SlabCut& cut,
                                                               const BlockRunner& run) const {
  return pairs_over_ranks(ranks_, scene.analysis, box_at(scene.box, time_), *own_, cut, run);
}

std::optional<BondPairs> ShownDisks::bond_pairs(const Scene& scene, const SlabCut& cut, const BlockRunner& run) {
  if (!find_orders(scene, cut, run)) return std::nullopt;
  return bond_pairs_over_ranks(ranks_, scene.analysis, box_at(scene.box, time_), *orders_, cut, run);
}

}  // namespace carom
