// Files that the user names: read only where they can end.
#pragma once

#include <string>
#include <string_view>

namespace carom {

// What some editors begin a text in UTF-8 with.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

// The whole file as text. where ("file:line: key") is what asked for it. Throws InputError unless it is a regular file
// that can be read and fits into memory, or an open stream of this process (/dev/stdin, /dev/fd/N) of at most 1 GB.
std::string read_text_file(const std::string& path, std::string_view where);

// Throws InputError for an open stream of this process, which others that are to read it would not have.
void check_other_processes_have(const std::string& path);

// Throws InputError, "path: ...", where there is something else than a regular file: it may never end. A file that is
// not there is left to what opens it.
void check_regular_file(const std::string& path);

}  // namespace carom
