// A change to a scene that the command line makes.
#pragma once

#include <string>

namespace carom {

// A change made on the command line: "physics.restitution" = "0.5" (value in TOML syntax; a bare word is a string).
// key may also address one entry of an array of tables: "disks.0.count".
struct Override {
  std::string key;
  std::string value;
};

}  // namespace carom
