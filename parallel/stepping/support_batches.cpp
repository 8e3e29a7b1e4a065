#include "parallel/stepping/support_batches.hpp"

#include "parallel/stepping/most_contacts.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

void begin_batches(SupportBatches& batches, const Patches& patches, std::size_t disks) {
  check_numbered(disks, most_disks_of_pile, "disks of a pile");
  const std::size_t contacts = patches.start.back();
  resize_amply(batches.first, patches.count() + 1);
  resize_amply(batches.slot, contacts);
  resize_amply(batches.taken, contacts);
  resize_amply(batches.onward, contacts + patches.count());
  assign_amply(batches.latest, disks, {no_slot, 0});
}

void lay_out_batches(SupportBatches& batches) {
  batches.first[0] = 0;
  for (std::size_t q = 1; q < batches.first.size(); ++q) batches.first[q] += batches.first[q - 1];
  check_numbered(batch_lanes * batches.first.back(), most_contacts, "slots of supports");
  resize_amply(batches.batch, batches.first.back());
}

void clear_batches(SupportBatches& batches, const Patches& patches, std::size_t patch, std::size_t spare) {
  const auto v = static_cast<std::uint32_t>(2 * spare);
  const SupportBatch empty{{}, {}, {}, {}, {}, {1.0, 1.0, 1.0, 1.0}, {v, v, v, v}, {v, v, v, v}};
  for (std::uint32_t b = batches.first[patch]; b < batches.first[patch + 1]; ++b) batches.batch[b] = empty;
  const std::uint32_t on = static_cast<std::uint32_t>(batch_lanes) * batches.first[patch];
  for (std::uint32_t at = patches.start[patch]; at < patches.start[patch + 1]; ++at) {
    if (batches.slot[at] != no_slot) batches.slot[at] += on;
  }
}

}  // namespace carom
