// The supports of a step in batches of four, for kernels that relax four at once. The supports of a batch share no
// disk, and over the batches of a patch each disk's supports keep the order of the step's contacts. So sweeps over
// batches, forward or back, have the bits of the serial sweeps: supports that share no disk commute exactly. (Box2D 3
// colours its contacts for the same purpose; that changes their order, and the bits.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/physics/support_solver.hpp"
#include "parallel/stepping/patches.hpp"

namespace carom {

inline constexpr std::size_t batch_lanes = 4;

// An unused lane has effective mass 1 and no direction: its impulse stays 0, and its disks are the patch's spare one
// (SupportBatches::spare).
struct alignas(32) SupportBatch {  // as Support
  double nx[batch_lanes], ny[batch_lanes];
  double inverse1[batch_lanes], inverse2[batch_lanes];  // the second is 0 for a wall, and in unused lanes
  double wall_speed[batch_lanes];
  double effective[batch_lanes];
  // Indices of the disks' velocities, counted in doubles: twice the storage indices.
  std::uint32_t v1[batch_lanes], v2[batch_lanes];
};

inline constexpr std::uint32_t no_slot = ~std::uint32_t{0};

struct SupportBatches {
  std::vector<SupportBatch> batch;   // patch by patch
  std::vector<std::uint32_t> first;  // of each patch; patches + 1
  // For each contact in the order of the patches: 4 batch + lane, or no_slot if it is not a support.
  std::vector<std::uint32_t> slot;
  // Scratch.
  struct Latest {
    std::uint32_t patch, batch;
  };
  std::vector<Latest> latest;  // of each disk: its latest support
  // For the batches of a patch, from the patch's start: the number of lanes taken; and, from each batch on, a lower
  // bound on the first batch with a free lane.
  std::vector<unsigned char> taken;
  std::vector<std::uint32_t> onward;

  std::size_t slots() const { return batch_lanes * batch.size(); }
  // The index of the spare disk of a patch; no two spare disks share a cache line.
  static std::size_t spare(std::size_t disks, std::size_t patch) { return disks + batch_lanes * patch; }
};

// Allocates for the contacts of these patches, before place_in_batches.
void begin_batches(SupportBatches& batches, const Patches& patches, std::size_t disks);

// Sets the slots of a patch's supports, counted from its own first batch, and batches.first[patch + 1] to its number of
// batches. disks_of(at): the disks of the contact at this place of the patches' order, twice the same for a wall;
// is_support(at): is it a support? Patches that share disks must be placed in their order.
template <class DisksOf, class IsSupport>
void place_in_batches(SupportBatches& batches, const Patches& patches, std::size_t patch, DisksOf&& disks_of,
                      IsSupport&& is_support);

// After all patches: sets the first batch of each patch, and allocates the batches.
void lay_out_batches(SupportBatches& batches);

// Empties all batches of a patch, and renumbers its slots among all batches. spare: SupportBatches::spare.
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

// The first batch from b on with a free lane, or the next new one. onward: of the patch.
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
  // A patch has one entry more than contacts, so its part is shifted by its own number.
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
