// The place of a table in a scene's file, for messages long after it was read.
#pragma once

#include <string>
#include <string_view>

namespace carom {

// "gas.toml:12: disks.0.region", for a key in a table whose header is in this line of the scene's file. Line 0 (a table
// from --set or from a program) is left out.
inline std::string place_in_file(const std::string& file, int line, std::string_view key) {
  return (file + (line > 0 ? ":" + std::to_string(line) : "") + ": ").append(key);
}

}  // namespace carom
