// What carom compare compares, from its options.
#pragma once

#include <optional>
#include <string>

#include "io/trajectory/trajectory_difference.hpp"

namespace carom {

// The values of --tolerance, --fields, --times and --at, empty where not given; none, if all are. Throws InputError
// with one line that names the option.
std::optional<CompareRule> compare_rule(const std::string& tolerance, const std::string& fields,
                                        const std::string& times, const std::string& at);

}  // namespace carom
