// Wall time as people write it: "90", "30 s", "10 min", "2h".
#pragma once

#include <optional>
#include <string_view>

namespace carom {

// What messages say was expected.
inline constexpr std::string_view expected_duration = "expected a time such as 30 s, 10 min or 2 h";

// Seconds; nothing where the text is no number above 0 with one of the units s, min, h or none (seconds).
std::optional<double> parse_duration(std::string_view text);

}  // namespace carom
