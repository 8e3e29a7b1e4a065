// Numbers of a trajectory in single precision.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "core/base/check.hpp"

namespace carom {

// The nearest number in single precision; 0 below 1e-45. Throws InputError, naming the file, beyond 3.4e38.
inline float single_of(double value, std::string_view file) {
  const auto single = static_cast<float>(value);
  if (std::isinf(single)) {
    throw InputError(fmt::format(
        "{} in single precision cannot hold {:g}: it ends at 3.4e38; expected output.precision = \"double\"", file,
        value));
  }
  return single;
}

}  // namespace carom
