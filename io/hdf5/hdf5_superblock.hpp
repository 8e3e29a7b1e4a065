// The first bytes of an HDF5 file, by which a reader decides whether to open it at all.
#pragma once

#include <cstdint>
#include <string>

namespace carom {

// A writer in HDF5's SWMR mode keeps its file consistent at any moment, and yet two fields of the superblock (version
// 3, HDF5 File Format Specification 3.0, II.A) may prevent others from reading what a kill leaves: the mark "being
// written" (byte 11), and the end of the file (bytes 28 to 35), which is updated last, after addresses beyond it. These
// functions correct them, and the checksum (bytes 44 to 47). They do nothing to a file that begins otherwise, and
// return false if the file cannot be read or written.

// Clears the mark and moves the end to `room` bytes behind the actual one; the room is a hole, which takes no space on
// the disk. Until this much has been added, no address can be beyond the end.
bool make_readable(const std::string& path, std::uint64_t room);

// Clears the mark.
bool clear_writing_mark(const std::string& path);

// After closing: cuts off what is behind the end.
bool cut_at_end(const std::string& path);

}  // namespace carom
