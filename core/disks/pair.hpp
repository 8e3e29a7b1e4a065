// Two disks that may touch.
#pragma once

#include <cstdint>

namespace carom {

struct Pair {
  std::uint32_t i1, i2;  // storage indices; the disk at i1 has the smaller id
  bool operator==(const Pair&) const = default;
};

}  // namespace carom
