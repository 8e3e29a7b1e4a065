// Packs a chunk of numbers as HDF5's shuffle and deflate filters would, in a fraction of their time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace carom {

// How equal bytes come after each other among the first, the second, ... bytes of all numbers: if at all as the same
// byte several times, as in the high bytes of coordinates, or in longer patterns as well, as in ids.
enum class Repetition : std::uint8_t { runs, patterns };

class ShuffledDeflate {
 public:
  ShuffledDeflate();
  ~ShuffledDeflate();
  ShuffledDeflate(const ShuffledDeflate&) = delete;
  ShuffledDeflate& operator=(const ShuffledDeflate&) = delete;

  // bytes of data are numbers of width bytes each. The result is a zlib stream of the shuffled bytes (first byte of all
  // numbers, second byte of all, ...), valid until the next call. Any inflate reads it. The low bytes of coordinates
  // are noise, on which deflate spends nine tenths of its time for nothing: they are stored uncompressed, and only
  // bytes whose sample repeats itself are compressed. Where there are runs alone, no time goes into looking for
  // patterns. The result depends only on the data. Throws std::bad_alloc.
  const std::vector<unsigned char>& pack(const void* data, std::size_t bytes, std::size_t width, Repetition repetition);

  // The last result of pack.
  const std::vector<unsigned char>& packed() const { return packed_; }

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
  std::vector<unsigned char> shuffled_, packed_;
};

}  // namespace carom
