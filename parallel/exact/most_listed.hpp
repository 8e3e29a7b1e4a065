// The largest number of disks in one set of neighbour lists with its calendars.
#pragma once

#include <cstddef>
#include <string>

#include "core/base/check.hpp"

namespace carom {

// In calendars and in the kernels of lists a number whose highest of 32 bits is set is not a disk, and the ends of the
// calendars' lists are numbered behind the disks (WindowState::entry). With more disks than this, some would be missing
// in lists without notice. At 200 bytes a disk this many take 430 GB.
inline constexpr std::size_t most_listed_disks = 2'147'000'000;

// Throws RunError if there are more.
inline void check_listed(std::size_t disks) {
  if (disks <= most_listed_disks) return;
  throw RunError("exact: " + std::to_string(disks) + " disks are more than one process can list, " +
                 std::to_string(most_listed_disks) + "; run the scene on several ranks, or with method \"pairwise\"");
}

// With this many disks, lists in which each has all others take half a gigabyte.
inline constexpr std::size_t most_of_all_pairs = 10'000;

// Throws RunError if there are more, in a box in which disks cannot be listed with a skin.
inline void check_all_listed(std::size_t disks) {
  if (disks <= most_of_all_pairs) return;
  throw RunError("exact: in a box that is so long compared with its period at most " +
                 std::to_string(most_of_all_pairs) + " disks can be listed, not " + std::to_string(disks) +
                 "; make the box shorter, or run the scene with method \"pairwise\"");
}

}  // namespace carom
