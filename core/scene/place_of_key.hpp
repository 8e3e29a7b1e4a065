// Where a key of a scene was given, for messages.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace carom {

// The place of a key for messages: "disks.0.count" -> "gas.toml:12: disks.0.count".
using PlaceOfKey = std::function<std::string(std::string_view key)>;

}  // namespace carom
