// The supports of a step four at a time, for kernels that relax four at once: the supports of a batch share no disk,
// and the batches of a patch one after another have each disk's supports in the order of the step's contacts. So sweeps
// over batches, forward or back, have the bits of the serial sweeps: supports that share no disk commute exactly.
// (Box2D 3 colours its contacts to the same end, for another order and so other bits.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/physics/support_solver.hpp"
#include "parallel/stepping/patches.hpp"

namespace carom {

inline constexpr std::size_t batch_lanes = 4;

// A lane that is left over has effective mass 1 and no direction: its impulse is and stays 0, and its disks are the
// patch's spare one (SupportBatches::spare).
struct alignas(32) SupportBatch {  // as Support
  double nx[batch_lanes], ny[batch_lanes];
  double inverse1[batch_lanes], inverse2[batch_lanes];  // the second is 0 for a wall alone, and where there is none
  double wall_speed[batch_lanes];
  double effective[batch_lanes];
  // Twice where the disks are stored: where their velocities are, counted in doubles.
  std::uint32_t v1[batch_lanes], v2[batch_lanes];
};

inline constexpr std::uint32_t no_slot = ~std::uint32_t{0};

struct SupportBatches {
  std::vector<SupportBatch> batch;   // patch by patch
  std::vector<std::uint32_t> first;  // of each patch; patches + 1
  // Of each contact in the order of the patches: 4 times its batch and its lane, or no_slot where it is no support.
  std::vector<std::uint32_t> slot;
  // Scratch.
  struct Latest {
    std::uint32_t patch, batch;
  };
  std::vector<Latest> latest;  // of each disk: where its latest support is
  // In a patch, batch by batch from the patch's start: how many lanes are taken, and a batch that is not before the
  // first with a lane left from this one on.
  std::vector<unsigned char> taken;
  std::vector<std::uint32_t> onward;

  std::size_t slots() const { return batch_lanes * batch.size(); }
  // Where the velocity of the spare disk of a patch is: no two of them share a cache line.
  static std::size_t spare(std::size_t disks, std::size_t patch) { return disks + batch_lanes * patch; }
};

// Makes room for the contacts of these patches, before place_in_batches.
void begin_batches(SupportBatches& batches, const Patches& patches, std::size_t disks);

// The slots of a patch's supports, from its own first batch on; batches.first[patch + 1] becomes its number of batches.
// disks_of(at): the disks of the contact at this place of the patches' order, twice the same for a wall;
// is_support(at): is it a support? Patches that share disks: in their order.
template <class DisksOf, class IsSupport>
void place_in_batches(SupportBatches& batches, const Patches& patches, std::size_t patch, DisksOf&& disks_of,
                      IsSupport&& is_support);

// After all patches: the first batch of each, and that many batches.
void lay_out_batches(SupportBatches& batches);

// Makes all batches of a patch empty, and its slots those among all batches. spare: SupportBatches::spare.
void clear_batches(SupportBatches& batches, const Patches& patches, std::size_t patch, std::size_t spare);

inline void put_support(SupportBatches& batches, std::uint32_t slot, const Support& s) {
  SupportBatch& b = batches.batch[slot / batch_lanes];
  const std::size_t lane = slot % batch_lanes;
  b.nx[lane] = s.nx;
  b.ny[lane] = s.ny;
  b.inverse1[lane] = s.inverse1;
  b.inverse2[lane] = s.inverse2;
  b.wall_speed[lane] = s.wall_speed;
  b.effective[lane] = s.effective;
  b.v1[lane] = 2 * s.i1;
  b.v2[lane] = 2 * s.i2;
}

inline Support support_in(const SupportBatches& batches, std::uint32_t slot) {
  const SupportBatch& b = batches.batch[slot / batch_lanes];
  const std::size_t lane = slot % batch_lanes;
  return {b.nx[lane],         b.ny[lane],        b.inverse1[lane], b.inverse2[lane],
          b.wall_speed[lane], b.effective[lane], b.v1[lane] / 2,   b.v2[lane] / 2};
}

// The first batch from b on with a lane left, or the next one that is new. onward: of the patch.
inline std::uint32_t find_open(std::uint32_t* onward, std::uint32_t b) {
  while (onward[b] != b) {
    onward[b] = onward[onward[b]];
    b = onward[b];
  }
  return b;
}

template <class DisksOf, class IsSupport>
void place_in_batches(SupportBatches& batches, const Patches& patches, std::size_t patch, DisksOf&& disks_of,
                      IsSupport&& is_support) {
  const std::uint32_t start = patches.start[patch];
  const auto q = static_cast<std::uint32_t>(patch);
  unsigned char* const taken = batches.taken.data() + start;
  // One more than its contacts: the patch's own number moves it on.
  std::uint32_t* const onward = batches.onward.data() + start + patch;
  std::uint32_t count = 0;
  onward[0] = 0;
  for (std::uint32_t at = start; at < patches.start[patch + 1]; ++at) {
    batches.slot[at] = no_slot;
    if (!is_support(at)) continue;
    const Pair p = disks_of(at);
    auto& latest1 = batches.latest[p.i1];
    auto& latest2 = batches.latest[p.i2];
    const std::uint32_t after1 = latest1.patch == q ? latest1.batch + 1 : 0;
    const std::uint32_t after2 = latest2.patch == q ? latest2.batch + 1 : 0;
    const std::uint32_t b = find_open(onward, after1 > after2 ? after1 : after2);
    if (b == count) {
      taken[b] = 0;
      onward[++count] = b + 1;
    }
    batches.slot[at] = static_cast<std::uint32_t>(batch_lanes) * b + taken[b];
    if (++taken[b] == batch_lanes) onward[b] = b + 1;
    latest1 = latest2 = {q, b};
  }
  batches.first[patch + 1] = count;
}

}  // namespace carom
