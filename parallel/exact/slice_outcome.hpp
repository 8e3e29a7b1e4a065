// The outcome of a slice of a window of the exact engine.
#pragma once

#include <cstdint>

namespace carom {

// Unless the outcome is `done`, the window is void and has no effect.
enum class SliceOutcome : std::uint8_t {
  done,
  ghosts_too_few,      // the motion of a disk of this rank, or part of the box, depends on disks that it does not have
  strangers_too_near,  // disks that a neighbouring rank does not have came nearer to it than it assumes
  crowded,             // the window holds too many events (core/step/window_length.hpp)
  too_fast,            // a disk was faster than the speed bound, or could have left its skin
  given_up,            // Engine::set_watch said to stop
};

}  // namespace carom
