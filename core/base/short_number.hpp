// Numbers and durations as people read them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace carom {

// A number of seconds as 12 s, 3:05 or 2:03:05.
std::string duration_text(double seconds);

// A number with a prefix: 950, 12.3 k, 4.56 M.
std::string short_number(double number);

// How many there are: 1 disk, 2 disks; 1 entry, 2 entries.
std::string counted(std::uint64_t n, std::string_view what);

}  // namespace carom
