// Packed frames of a view file: a block of successive frames, which viewer/decode.js unpacks without other blocks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/view/view_axis.hpp"

namespace carom {

using ViewAxes = std::array<ViewAxis, 2>;

// One frame in whole numbers: the disks that it shows, by their place in the table of all disks, ascending.
struct ViewFrame {
  std::vector<std::uint32_t> place;
  std::array<std::vector<std::uint32_t>, 2> at;  // x and y of each disk
};

// A packed block. Inflated, it is
//   frames, order (1 or 2), places             each a 32-bit number; places: the largest place plus one
//   for each frame: removed runs, added runs   runs: their number, then (gap, length) of each, all as 7-bit varints
//   lowest byte of every residual in x, of every one in y, then the next byte of both, and so on
// Residuals are in order of frame and place: the number less the one predicted from the disk's last two frames (order
// 2: the last step is repeated; order 1: the disk stays), modulo 2^bits, with the sign in the lowest bit. A disk that
// is new in a frame is predicted at 0, and then at rest.
struct ViewBlock {
  std::size_t first = 0;      // number of the first frame
  std::size_t frames = 0;     // number of frames
  std::size_t residuals = 0;  // number of disks of all frames
  std::string packed;         // zlib stream
  std::uint32_t check = 0;    // CRC-32 of it
};

// Packs the frames, whose first one has the number `first`.
ViewBlock pack_view_block(const std::vector<ViewFrame>& frames, std::size_t first, const ViewAxes& axes);

// Any bytes as a zlib stream, and the CRC-32 of bytes.
std::string deflated(std::string_view bytes);
std::uint32_t crc_of(std::string_view bytes);

}  // namespace carom
