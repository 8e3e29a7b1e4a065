// How many disks one set of neighbour lists, with its calendars, can number.
#pragma once

#include <cstddef>
#include <string>

#include "core/base/check.hpp"

namespace carom {

// Calendars and the kernels of lists tell by the highest of 32 bits what is no disk's number; the ends of the
// calendars' lists are numbered behind the disks (WindowState::entry). Beyond it disks would be left out of lists
// unseen. At 200 bytes a disk that is 430 GB.
inline constexpr std::size_t most_listed_disks = 2'147'000'000;

// Throws RunError where there are more.
inline void check_listed(std::size_t disks) {
  if (disks <= most_listed_disks) return;
  throw RunError("exact: " + std::to_string(disks) + " disks are more than one process can list, " +
                 std::to_string(most_listed_disks) + "; run it on several ranks, or by method \"pairwise\"");
}

// Each of so many disks lists all others in half a gigabyte.
inline constexpr std::size_t most_of_all_pairs = 10'000;

// Throws RunError where there are more, in a box in which disks cannot be listed with a skin.
inline void check_all_listed(std::size_t disks) {
  if (disks <= most_of_all_pairs) return;
  throw RunError("exact: in a box that is so much longer than its period across at most " +
                 std::to_string(most_of_all_pairs) + " disks can be listed, not " + std::to_string(disks) +
                 "; make it less long, or run it by method \"pairwise\"");
}

}  // namespace carom
