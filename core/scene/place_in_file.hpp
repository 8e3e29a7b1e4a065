// Where a table of a scene stands, for messages of what was found long after it was read.
#pragma once

#include <string>
#include <string_view>

namespace carom {

// "gas.toml:12: disks.0.region", of a key in a table whose header stands in this line of the scene's file. 0: in no
// line, as where --set or a program gave the table; then the file alone is named.
inline std::string place_in_file(const std::string& file, int line, std::string_view key) {
  return (file + (line > 0 ? ":" + std::to_string(line) : "") + ": ").append(key);
}

}  // namespace carom
