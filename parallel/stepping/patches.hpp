// Runs a list of contacts on many threads with the bits of the serial order. Contacts that share no disk commute
// exactly, so each contact only has to wait for the earlier ones of its own disks. The box is divided into patches. A
// contact inside a patch, whose disks have had no earlier contact across an edge, runs with its patch; patches run in
// parallel, and each visits a few thousand disks that are near in memory. The contacts along edges are treated in the
// same way in a second layout of patches, shifted across those edges, and then in a third one; the few that are left
// run serially.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/pair.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

// The number of layouts; a contact that fits none of them is left to the last phase.
inline constexpr std::uint32_t patch_layouts = 3;
inline constexpr std::uint32_t patch_phases = patch_layouts + 1;

struct Patches {
  std::vector<std::uint32_t> order;  // indices into the list, patch by patch, in the list's order within each
  std::vector<std::uint32_t> start;  // of each patch in order; patches + 1
  std::vector<std::uint32_t> first;  // patch of each phase; phases + 1
  // Scratch.
  std::vector<std::array<std::uint16_t, patch_layouts>> home;  // patch of each disk in each layout
  std::vector<unsigned char> reached;                          // for each disk: the phase of its latest contact
  std::vector<std::uint32_t> patch;                            // of each contact
  std::vector<std::array<double, 4>> bounds;                   // of blocks of disks

  std::size_t count() const { return start.size() - 1; }
  std::uint32_t phases() const { return static_cast<std::uint32_t>(first.size()) - 1; }
};

// contacts: their number. in_contact[i]: 0 for a disk without contacts. Returns whether a layout has more than one
// patch; if not, all contacts belong to the single patch of the last phase. Patches do not depend on the number of
// threads.
bool lay_out(Patches& patches, const Disks& disks, const std::vector<std::uint16_t>& in_contact, std::size_t contacts,
             const Executor& executor);

// Sorts patch indices in patches.patch into order and start.
void order_by_patch(Patches& patches);

// Puts all contacts into one patch, in the order of the list; patches.order is not made.
void take_as_one_patch(Patches& patches, std::size_t contacts);

// disks_of(k): the storage indices of the disks of contact k, twice the same for a wall.
template <class DisksOf>
void build_patches(Patches& patches, const Disks& disks, const std::vector<std::uint16_t>& in_contact,
                   std::size_t contacts, const Executor& executor, DisksOf&& disks_of) {
  resize_amply(patches.patch, contacts);
  if (!lay_out(patches, disks, in_contact, contacts, executor)) {
    patches.patch.assign(contacts, 0);
    return order_by_patch(patches);
  }
  patches.reached.assign(disks.size(), 0);
  for (std::size_t k = 0; k < contacts; ++k) {
    const Pair p = disks_of(k);
    const auto& home1 = patches.home[p.i1];
    const auto& home2 = patches.home[p.i2];
    unsigned char phase = std::max(patches.reached[p.i1], patches.reached[p.i2]);
    while (phase < patch_layouts && home1[phase] != home2[phase]) ++phase;
    patches.reached[p.i1] = patches.reached[p.i2] = phase;
    patches.patch[k] = patches.first[phase] + (phase < patch_layouts ? home1[phase] : 0U);
  }
  order_by_patch(patches);
}

// Calls task(patch) for every patch. If tasks run the contacts of their patch in order, the bits are those of running
// the whole list in order; with `backwards` and tasks that run theirs backwards, those of running the whole list
// backwards. before(phase, backwards) is called before each phase.
template <class Task, class Before>
void run_patches(const Patches& patches, bool backwards, const Executor& executor, Task&& task, Before&& before) {
  const std::uint32_t phases = patches.phases();
  for (std::uint32_t n = 0; n < phases; ++n) {
    const std::uint32_t phase = backwards ? phases - 1 - n : n;
    before(phase, backwards);
    const std::uint32_t first = patches.first[phase];
    executor.run(patches.first[phase + 1] - first, [&](std::size_t b) { task(first + b); });
  }
}

template <class Task>
void run_patches(const Patches& patches, bool backwards, const Executor& executor, Task&& task) {
  run_patches(patches, backwards, executor, task, [](std::uint32_t /*phase*/, bool /*backwards*/) {});
}

}  // namespace carom
