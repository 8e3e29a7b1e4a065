// The first bytes of an HDF5 file, by which a reader decides whether to open it at all.
#pragma once

#include <cstdint>
#include <string>

namespace carom {

// A writer in HDF5's SWMR mode keeps its file whole at any moment, and yet two fields of the superblock (version 3,
// HDF5 File Format Specification 3.0, II.A) may keep others from reading what a kill leaves: the mark "being written"
// (byte 11), and the end of the file (bytes 28 to 35), which is brought up to date last, after what points beyond it.
// These functions mend them, and the checksum (bytes 44 to 47). They do nothing to a file that begins otherwise, and
// return false where the file cannot be read or written.

// Takes the mark away and moves the end to `room` bytes behind the last one there is; the room is a hole, which takes
// no space on the disk. Until so much has been added, nothing can point beyond the end.
bool make_readable(const std::string& path, std::uint64_t room);

// Takes the mark away.
bool clear_writing_mark(const std::string& path);

// After closing: cuts off what lies behind the end.
bool cut_at_end(const std::string& path);

}  // namespace carom
