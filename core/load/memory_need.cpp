#include "core/load/memory_need.hpp"

namespace carom {

namespace {

// Bytes for each disk. Time stepping: state 36, sorting 12, a buffer for moved columns 8, cells 4, counts 2. Exact:
// state 36, path record 64, neighbour list 64, calendar entry 16 and its pages 3, slots of cells and their chains 13.
// Spins of rough disks add 8 to the state, and 8 to the window of exact.
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
