// Packs a chunk of numbers as HDF5's shuffle and deflate filters would, in a fraction of their time.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace carom {

class ShuffledDeflate {
 public:
  ShuffledDeflate();
  ~ShuffledDeflate();
  ShuffledDeflate(const ShuffledDeflate&) = delete;
  ShuffledDeflate& operator=(const ShuffledDeflate&) = delete;

  // bytes of data are numbers of width bytes each. The result is a zlib stream of the shuffled bytes (first byte of all
  // numbers, second byte of all, ...), valid until the next call. Any inflate reads it. The low bytes of coordinates
  // are noise, on which deflate spends nine tenths of its time for nothing: they are stored uncompressed, and only
  // bytes whose sample repeats itself are compressed. The result depends only on the data. Throws std::bad_alloc.
  const std::vector<unsigned char>& pack(const void* data, std::size_t bytes, std::size_t width);

  // The last result of pack.
  const std::vector<unsigned char>& packed() const { return packed_; }

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
  std::vector<unsigned char> shuffled_, packed_;
};

}  // namespace carom
