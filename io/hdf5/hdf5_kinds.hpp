// The kinds of numbers that most datasets hold.
#pragma once

#include "io/hdf5/hdf5_output.hpp"

namespace carom {

// Little-endian in the file on every machine. The fill values are NaN for doubles and 0 for counts.
Hdf5Kind double_kind();
Hdf5Kind count_kind();  // std::int64_t

}  // namespace carom
