#include "parallel/stepping/support_sweeps.hpp"

namespace carom {

void resize_supports(SupportSet& set, const SupportBatches& batches, std::size_t patches, std::size_t disks) {
  for (auto* column : {&set.impulse, &set.last, &set.before, &set.ahead, &set.counted}) {
    assign_amply(*column, batches.slots(), 0.0);
  }
  assign_amply(set.contact_distance, batches.slots(), 1.0);
  resize_amply(set.v, SupportBatches::spare(disks, patches));
  resize_amply(set.last_v, disks);
  for (std::size_t q = 0; q < patches; ++q) set.v[SupportBatches::spare(disks, q)] = {};
}

void keep_loads(State& state, const Executor& executor, ContactLists& lists) {
  SettleLists& settle = lists.settle;
  const std::size_t n = settle.borne.size();
  assign_amply(lists.offsets, executor.blocks(n, contact_block) + 1, std::size_t{0});
  executor.for_ranges(n, contact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    for (std::size_t k = begin; k < end; ++k) count += settle.borne[k] > 0.0 ? std::size_t{1} : 0;
    lists.offsets[b + 1] = count;
  });
  for (std::size_t b = 1; b < lists.offsets.size(); ++b) lists.offsets[b] += lists.offsets[b - 1];
  resize_amply(state.loads, lists.offsets.back());
  executor.for_ranges(n, contact_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::size_t at = lists.offsets[b];
    for (std::size_t k = begin; k < end; ++k) {
      const IdPair& p = settle.pairs.sorted[k];
      if (settle.borne[k] > 0.0) state.loads[at++] = {p.id1(), p.id2(), settle.borne[k]};
    }
  });
}

}  // namespace carom
