// The rule of carom compare, from its options.
#pragma once

#include <optional>
#include <string>

#include "io/trajectory/trajectory_difference.hpp"

namespace carom {

// From the values of --tolerance, --fields, --times and --at, each empty if not given; no rule if all are empty. Throws
// InputError with one line that names the option.
std::optional<CompareRule> compare_rule(const std::string& tolerance, const std::string& fields,
                                        const std::string& times, const std::string& at);

}  // namespace carom
