// Any text is a trajectory or gives an InputError; a frame that was read has whole columns.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "core/base/check.hpp"
#include "io/trajectory/trajectory_xyz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string path = "/dev/shm/carom_fuzz_" + std::to_string(getpid()) + ".xyz";
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    carom::XyzReader reader(path);
    carom::XyzFrame frame;
    while (reader.read(frame)) {
      const carom::Disks& d = frame.disks;
      if (d.y.size() != d.size() || d.id.size() != d.size() || d.radius.size() != d.size()) std::abort();
    }
  } catch (const carom::InputError& error) {
    if (std::string(error.what()).empty()) std::abort();
  }
  return 0;
}
