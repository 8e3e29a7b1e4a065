// The place of a key in a scene's file, for messages.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace carom {

// Maps a key to its place: "disks.0.count" -> "gas.toml:12: disks.0.count".
using PlaceOfKey = std::function<std::string(std::string_view key)>;

}  // namespace carom
