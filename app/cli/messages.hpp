// What the program says on its own streams.
#pragma once

#include <string_view>

namespace carom {

// Writes to standard output. Throws RunError where that fails (a full disk, a closed pipe).
void print_out(std::string_view text);

// "carom: ..." and "carom: warning: ..." on standard error, a line each whatever characters names in it have.
void print_note(std::string_view text);
void print_warning(std::string_view text);

}  // namespace carom
