// The least possible cost of a step on this machine: the four state columns read once and written once, 64 bytes per
// disk.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

#include "parallel/threads/executor.hpp"

namespace carom::bench {

class CopyLimit {
 public:
  explicit CopyLimit(std::size_t disks) : disks_(disks) {
    for (auto& column : from_) column.assign(disks, 1.0);
    for (auto& column : to_) column.assign(disks, 0.0);
  }

  // Copies once, by all threads of the executor, in blocks like those of the engine's own passes.
  void copy(const Executor& executor) {
    constexpr std::size_t block = 16384;
    executor.for_ranges(disks_, block, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t k = 0; k < from_.size(); ++k) {
        std::memcpy(&to_[k][begin], &from_[k][begin], (end - begin) * sizeof(double));
      }
    });
  }

 private:
  std::size_t disks_;
  std::array<std::vector<double>, 4> from_, to_;
};

}  // namespace carom::bench
