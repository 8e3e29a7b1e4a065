// Unpacks blocks of a view page by the format alone, as written down in io/view/view_block.hpp.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "io/view/view_block.hpp"

namespace carom::test {

inline std::string inflated(const std::string& packed) {
  std::string bytes(std::max<std::size_t>(64, 4 * packed.size()), '\0');
  for (;; bytes.resize(2 * bytes.size())) {
    auto size = static_cast<uLongf>(bytes.size());
    const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                                  reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
    if (status == Z_BUF_ERROR && bytes.size() < (std::size_t{1} << 30U)) continue;
    if (status != Z_OK) throw std::runtime_error("the stream is damaged");
    bytes.resize(size);
    return bytes;
  }
}

class BlockReader {
 public:
  explicit BlockReader(std::string bytes) : bytes_(std::move(bytes)) {}
  bool at_end() const { return at_ == bytes_.size(); }
  std::uint32_t byte() { return static_cast<unsigned char>(bytes_.at(at_++)); }
  std::uint32_t word() {
    std::uint32_t value = 0;
    for (unsigned shift = 0; shift < 32; shift += 8) value |= byte() << shift;
    return value;
  }
  std::uint32_t varint() {
    std::uint32_t value = 0, b = 0x80;
    for (unsigned shift = 0; b >= 0x80; shift += 7) value |= ((b = byte()) & 0x7fU) << shift;
    return value;
  }
  // Calls use(place) for all places of the runs.
  template <class Use>
  void runs(const Use& use) {
    std::uint32_t end = 0;
    for (std::uint32_t left = varint(); left > 0; --left) {
      const std::uint32_t begin = end + varint();
      end = begin + varint();
      for (std::uint32_t p = begin; p < end; ++p) use(p);
    }
  }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

// A disk along one axis: its last two numbers.
struct UnpackedTrack {
  std::uint32_t last = 0, before = 0;
};

// Sets the numbers of one axis. added: the new places of each frame.
inline void set_numbers(const std::vector<std::uint32_t>& residuals, const ViewAxis& axis, std::uint32_t order,
                        const std::vector<std::vector<std::uint32_t>>& added, std::size_t number, std::uint32_t places,
                        std::vector<ViewFrame>& frames) {
  std::vector<UnpackedTrack> tracks(places);
  std::size_t next = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (const std::uint32_t p : added[k]) tracks[p] = {};
    for (const std::uint32_t p : frames[k].place) {
      const std::uint32_t folded = residuals.at(next++);
      const std::uint32_t expected = order == 2 ? 2 * tracks[p].last - tracks[p].before : tracks[p].last;
      const std::uint32_t at = (expected + ((folded >> 1U) ^ (0U - (folded & 1U)))) & axis.mask();
      frames[k].at[number].push_back(at);
      tracks[p] = {at, tracks[p].last};
    }
    for (const std::uint32_t p : added[k]) tracks[p].before = tracks[p].last;
  }
}

// Throws if the block is not as the format says.
inline std::vector<ViewFrame> unpack(const ViewBlock& block, const ViewAxes& axes) {
  BlockReader reader(inflated(block.packed));
  if (reader.word() != block.frames) throw std::runtime_error("another number of frames");
  const std::uint32_t order = reader.word(), places = reader.word();
  std::vector<ViewFrame> frames(block.frames);
  std::vector<std::vector<std::uint32_t>> added(block.frames);
  std::vector<bool> present(places, false);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    reader.runs([&](std::uint32_t p) { present.at(p) = false; });
    reader.runs([&](std::uint32_t p) { added[k].push_back(p); });
    for (const std::uint32_t p : added[k]) present.at(p) = true;
    for (std::uint32_t p = 0; p < places; ++p) {
      if (present[p]) frames[k].place.push_back(p);
    }
  }
  std::array<std::vector<std::uint32_t>, 2> residuals;
  for (auto& column : residuals) column.assign(block.residuals, 0);
  for (unsigned shift = 0; shift < 24; shift += 8) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (shift >= axes[axis].bits) continue;
      for (std::uint32_t& residual : residuals[axis]) residual |= reader.byte() << shift;
    }
  }
  if (!reader.at_end()) throw std::runtime_error("bytes are left over");
  for (std::size_t axis = 0; axis < 2; ++axis) {
    set_numbers(residuals[axis], axes[axis], order, added, axis, places, frames);
  }
  return frames;
}

}  // namespace carom::test
