// Any bytes are a trajectory or give an InputError; a frame that was read has whole columns. What the HDF5 library
// reads from damaged files is not under our control, so the reader checks sizes and types itself, and repairs the file
// of a killed writer (hdf5_superblock.hpp).
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "core/base/check.hpp"
#include "io/trajectory/h5md_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string path = "/dev/shm/carom_fuzz_" + std::to_string(getpid()) + ".h5";
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    carom::H5mdReader reader(path);
    carom::TrajectoryFrame frame;
    for (int k = 0; k < 100 && reader.read(frame); ++k) {
      const carom::Disks& d = frame.disks;
      if (d.y.size() != d.size() || d.id.size() != d.size() || d.radius.size() != d.size()) std::abort();
    }
  } catch (const carom::InputError& error) {
    if (std::string(error.what()).empty()) std::abort();
  }
  return 0;
}
