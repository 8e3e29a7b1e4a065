#include "core/load/memory_need.hpp"

namespace carom {

namespace {

// Bytes a disk. Time stepping: 36 of state, 12 to sort by, 8 to move through, 4 of cells, 2 of counts. Exact: 36 of
// state, a path with what goes with it (64), a list (64), a calendar's entry (16) and its pages (3), the slots of cells
// with what is chained to them (13). Spins of rough disks are 8 more of state, and in exact 8 of the window.
constexpr double stepping_bytes = 62.0;
constexpr double exact_bytes = 196.0;
constexpr double spin_bytes = 8.0;

}  // namespace

double least_memory(Method method, Count disks, bool rough) {
  const double plain = method == Method::exact ? exact_bytes : stepping_bytes;
  const double spins = rough ? (method == Method::exact ? 2.0 : 1.0) * spin_bytes : 0.0;
  return static_cast<double>(disks) * (plain + spins);
}

}  // namespace carom
