#include "io/hdf5/hdf5_kinds.hpp"

#include <cstdint>
#include <limits>

namespace carom {

Hdf5Kind double_kind() {
  static constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, sizeof(double), &nothing};
}

Hdf5Kind count_kind() {
  static constexpr std::int64_t nothing = 0;
  return {H5T_STD_I64LE, H5T_NATIVE_INT64, sizeof(std::int64_t), &nothing};
}

}  // namespace carom
