// How a slice of a window of the exact engine ended.
#pragma once

#include <cstdint>

namespace carom {

// Unless it is `done`, nothing of the window counts: what happened to a disk of this rank, or of a part of the box,
// depends on disks that it does not have (ghosts_too_few); disks that a neighbour does not have came nearer to it than
// it takes them to (strangers_too_near); the window is crowded (core/step/window_length.hpp); a disk was faster than
// the speed bound; it was given up.
enum class SliceOutcome : std::uint8_t { done, ghosts_too_few, strangers_too_near, crowded, too_fast, given_up };

}  // namespace carom
