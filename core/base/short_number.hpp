// Numbers and durations as people read them.
#pragma once

#include <string>

namespace carom {

// A number of seconds as 12 s, 3:05 or 2:03:05.
std::string duration_text(double seconds);

// A number with a prefix: 950, 12.3 k, 4.56 M.
std::string short_number(double number);

}  // namespace carom
