// The known name closest to a misspelt one, for error messages.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace carom {

// Edit distance of two names: insertions, deletions, replacements and swaps of neighbours (optimal string alignment);
// ASCII case is ignored. O(|a| |b|) time.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The entry of known with the smallest edit distance to name, the first of several. Precondition: known not empty.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

// Is known close enough to name to have been meant? At most half of the longer one may differ; dashes before options do
// not count.
bool is_near(std::string_view name, std::string_view known);

}  // namespace carom
