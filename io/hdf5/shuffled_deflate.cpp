#include "io/hdf5/shuffled_deflate.hpp"

#include <zlib.h>

#include <array>
#include <new>

namespace carom {

namespace {

// Bytes of a plane that are sampled to decide whether it is worth compressing.
constexpr std::size_t sample_bytes = 1024;

// Level for planes that are compressed: the fastest, since higher ones gain a few per cent at several times the cost.
constexpr int fast_level = 1;

void shuffle(const unsigned char* data, std::size_t count, std::size_t width, unsigned char* to) {
  for (std::size_t byte = 0; byte < width; ++byte) {
    for (std::size_t i = 0; i < count; ++i) to[byte * count + i] = data[i * width + byte];
  }
}

// In noise every value is about equally frequent, so the sum of squared counts is near n + n^2 / 256. Twice that is far
// beyond chance, and promises to save at least an eighth of the plane.
bool worth_compressing(const unsigned char* plane, std::size_t count) {
  std::array<unsigned, 256> counts{};
  const std::size_t stride = count > sample_bytes ? count / sample_bytes : 1;
  std::size_t looked = 0;
  for (std::size_t i = 0; i < count; i += stride, ++looked) ++counts[plane[i]];
  std::size_t squares = 0;
  for (const unsigned n : counts) squares += static_cast<std::size_t>(n) * n;
  return squares > 2 * (looked + looked * looked / 256);
}

}  // namespace

struct ShuffledDeflate::Stream {
  z_stream z{};
};

ShuffledDeflate::ShuffledDeflate() : stream_(std::make_unique<Stream>()) {
  if (deflateInit(&stream_->z, fast_level) != Z_OK) throw std::bad_alloc();
}

ShuffledDeflate::~ShuffledDeflate() {
  deflateEnd(&stream_->z);
}

const std::vector<unsigned char>& ShuffledDeflate::pack(const void* data, std::size_t bytes, std::size_t width,
                                                        Repetition repetition) {
  const std::size_t count = bytes / width;
  shuffled_.resize(bytes);
  shuffle(static_cast<const unsigned char*>(data), count, width, shuffled_.data());
  z_stream& z = stream_->z;
  deflateReset(&z);
  // Each change of level may end a block, which takes some bytes.
  packed_.resize(deflateBound(&z, static_cast<uLong>(bytes)) + 64 * width);
  z.next_out = packed_.data();
  z.avail_out = static_cast<uInt>(packed_.size());
  const int strategy = repetition == Repetition::runs ? Z_RLE : Z_DEFAULT_STRATEGY;
  for (std::size_t byte = 0; byte < width; ++byte) {
    unsigned char* const plane = shuffled_.data() + byte * count;
    // The new parameters apply to input from now on; earlier input is written with its own.
    deflateParams(&z, worth_compressing(plane, count) ? fast_level : 0, strategy);
    z.next_in = plane;
    z.avail_in = static_cast<uInt>(count);
    deflate(&z, byte + 1 == width ? Z_FINISH : Z_NO_FLUSH);
  }
  packed_.resize(z.total_out);
  return packed_;
}

}  // namespace carom
