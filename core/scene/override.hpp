// A change of a scene by the command line.
#pragma once

#include <string>

namespace carom {

// For example key "physics.restitution", value "0.5" (TOML syntax; a bare word is a string). key may address an entry
// of an array of tables: "disks.0.count".
struct Override {
  std::string key;
  std::string value;
};

}  // namespace carom
