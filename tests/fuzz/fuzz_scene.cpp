// Any text is a scene or gives an InputError of one line; a scene that is written out and read again gives the same
// text.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/base/check.hpp"
#include "core/load/scene_file.hpp"
#include "core/scene/scene_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::string resolved;
  try {
    resolved = carom::resolved_toml(carom::parse_scene(text, "fuzz.toml", "/nonexistent"));
  } catch (const carom::InputError& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
    return 0;
  }
  // A scene that was accepted is accepted again, with the same text.
  if (carom::resolved_toml(carom::parse_scene(resolved, "again.toml", "/nonexistent")) != resolved) std::abort();
  return 0;
}
