// The line of progress for the growth of an initial state.
#pragma once

#include <functional>

#include "core/start/growth.hpp"

namespace carom {

// Returns a function to be called after each step of the growth: it keeps the line (status_line.hpp) on standard error
// and removes it when its last copy is destroyed. Empty if the line is not wanted.
std::function<void(const GrowthProgress&)> growth_line(bool wanted);

}  // namespace carom
