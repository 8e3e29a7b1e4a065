// For measurements: the work that regions have left to the borders between them in a slice.
#pragma once

#include <functional>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/region.hpp"
#include "parallel/exact/window_state.hpp"

namespace carom {

struct SliceBorders {
  const WindowState& window;
  const NeighbourLists& lists;
  const std::vector<Region>& regions;  // with the disks at their borders, and those blocked in the slice
  Count events;                        // of the window so far
  Count at_borders;                    // those of them that the border pass processed
};

using BorderWatch = std::function<void(const SliceBorders&)>;

}  // namespace carom
