// The line on a terminal that tells how far the growth of an initial state has come.
#pragma once

#include <functional>

#include "core/growth.hpp"

namespace carom {

// Whom to tell of the growth's steps: writes the line to standard error, at most five times a second, and takes it away
// when the last copy goes. Empty where nothing is wanted, or standard error is no terminal.
std::function<void(const GrowthProgress&)> growth_line(bool wanted);

}  // namespace carom
