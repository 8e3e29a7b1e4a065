// What the program says on its own streams.
#pragma once

#include <string_view>

#include "core/base/check.hpp"

namespace carom {

// Standard output is a pipe, and its reader has gone, as that of `carom docs scene | head -1`.
struct ReaderGone : RunError {
  using RunError::RunError;
  int status = 1;  // to end with where the signal does not end the program
};

// Writes to standard output. Throws ReaderGone, or RunError where that fails otherwise (a full disk).
void print_out(std::string_view text);

// "carom: ..." and "carom: warning: ..." on standard error, a line each whatever characters names in it have.
void print_note(std::string_view text);
void print_warning(std::string_view text);

}  // namespace carom
