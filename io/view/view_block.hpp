// Frames of a view file, packed: some frames that follow each other, and the first of them needs no other block.
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
  std::array<std::vector<std::uint32_t>, 2> at;  // x and y of each
};

// A packed block. Inflated, it is
//   frames, order (1 or 2), places             each a 32-bit number; places: one more than the last one
//   for each frame: removed runs, added runs   runs: their number, then (gap, length) of each, all as 7-bit varints
//   lowest byte of every residual in x, of every one in y, then the next byte of both, and so on
// Residuals are in order of frame and place: the number less what the last two frames of the disk let expect (order 2:
// as far again as the last step; order 1: where it was), modulo 2^bits, sign folded into the lowest bit. What is new in
// a frame is expected at 0, and then at rest.
struct ViewBlock {
  std::size_t first = 0;      // frame
  std::size_t frames = 0;     // how many
  std::size_t residuals = 0;  // disks of all frames
  std::string packed;         // zlib stream
  std::uint32_t check = 0;    // CRC-32 of it
};

// Packs frames `first` and on.
ViewBlock pack_view_block(const std::vector<ViewFrame>& frames, std::size_t first, const ViewAxes& axes);

// The frames again. Throws InputError, "name: frames A to B are damaged: ..." (frames counted from 1).
std::vector<ViewFrame> unpack_view_block(const ViewBlock& block, const ViewAxes& axes, const std::string& name);

// Any bytes as a zlib stream, and its CRC-32.
std::string deflated(std::string_view bytes);
std::uint32_t crc_of(std::string_view bytes);

}  // namespace carom
