// The line of progress of the growth of an initial state.
#pragma once

#include <functional>

#include "core/start/growth.hpp"

namespace carom {

// To be called after each step of the growth: keeps the line (status_line.hpp) on standard error and takes it away when
// the last copy goes. Empty where nothing is wanted.
std::function<void(const GrowthProgress&)> growth_line(bool wanted);

}  // namespace carom
