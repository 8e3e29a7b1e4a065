// Any text is a list of finite pairs or gives an InputError of one line.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/check.hpp"
#include "core/scene/csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    for (const carom::Vec2& pair : carom::parse_csv_pairs(text, "fuzz.csv", "disks.0.positions")) {
      if (!std::isfinite(pair.x) || !std::isfinite(pair.y)) std::abort();
    }
  } catch (const carom::InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
