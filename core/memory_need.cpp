#include "core/memory_need.hpp"

#include <unistd.h>

#include <limits>

namespace carom {

namespace {

// Bytes a disk. Time stepping: 36 of state, 12 to sort by, 8 to move through, 4 of cells, 2 of counts. Exact, peaks as
// measured: state, to sort and to move as well, a path with what goes with it (64), place and list (64), due time (8),
// what happens in a slice, which is less where there are very many disks, and the sums at the end.
constexpr double stepping_bytes = 62.0;
constexpr double exact_bytes = 290.0;
constexpr double lean_exact_bytes = 255.0;

double bytes_a_disk(Method method, Count disks) {
  if (method != Method::exact) return stepping_bytes;
  return disks < lean_exact_disks ? exact_bytes : lean_exact_bytes;
}

}  // namespace

double least_memory(Method method, Count disks) {
  return static_cast<double>(disks) * bytes_a_disk(method, disks);
}

double machine_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(pages) * static_cast<double>(page);
}

}  // namespace carom
