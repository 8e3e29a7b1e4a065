// Wall time as people write it: "90", "30 s", "10 min", "2h".
#pragma once

#include <optional>
#include <string_view>

namespace carom {

// The second half of a message about a text that parse_duration does not accept.
inline constexpr std::string_view expected_duration = "expected a time such as 30 s, 10 min or 2 h";

// Seconds; nothing unless the text is a number above 0 with the unit s, min or h, or with none (seconds).
std::optional<double> parse_duration(std::string_view text);

}  // namespace carom
