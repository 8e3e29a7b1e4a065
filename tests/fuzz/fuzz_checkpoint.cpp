// Any bytes behind a right checksum are a checkpoint or give an InputError; a checkpoint, written again, has the same
// bytes. The first byte decides between this and a whole file with its checksum.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

#include "core/base/check.hpp"
#include "io/checkpoint/checkpoint.hpp"

namespace {

void read_file(std::string_view bytes) {
  static const std::string path = "/dev/shm/carom_fuzz_" + std::to_string(getpid()) + ".carom";
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  carom::read_checkpoint(path);
}

void decode(std::string_view bytes) {
  const carom::Checkpoint checkpoint = carom::decode_checkpoint(bytes, "fuzz");
  if (carom::encode_checkpoint(checkpoint.record, checkpoint.state) != bytes) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    if (data[0] % 16 == 1) {
      read_file(bytes);
    } else {
      decode(bytes);
    }
  } catch (const carom::InputError& error) {
    if (std::string_view(error.what()).empty()) std::abort();
  }
  return 0;
}
