// Reads files that the user names, and refuses those that may never end, such as a device.
#pragma once

#include <string>
#include <string_view>

namespace carom {

// Some editors write this at the beginning of a text in UTF-8.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

// The whole file as text. where: the place that names the file, "file:line: key", for messages. Throws InputError
// unless the path is a regular file that can be read and fits into memory, or an open stream of this process
// (/dev/stdin, /dev/fd/N) of at most 1 GB.
std::string read_text_file(const std::string& path, std::string_view where);

// Throws InputError for an open stream of this process: other processes could not read it.
void check_other_processes_have(const std::string& path);

// Throws InputError, "path: ...", if the path exists and is not a regular file. A missing file is no error here: the
// code that opens it says so.
void check_regular_file(const std::string& path);

}  // namespace carom
