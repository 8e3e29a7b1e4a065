#include "core/disks/disk_source.hpp"

#include <cstddef>

#include "core/disks/disk_columns.hpp"

namespace carom {

Disks HeldDisks::read(std::size_t begin, std::size_t end) {
  Disks some = no_disks_like(disks_);
  for_each_column(disks_, some, [&](const auto& all, auto& read) {
    if (all.empty()) return;
    read.assign(all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end));
  });
  return some;
}

}  // namespace carom
