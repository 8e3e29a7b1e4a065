// Writes to the program's standard streams.
#pragma once

#include <string_view>

#include "core/base/check.hpp"

namespace carom {

// Thrown if standard output is a pipe whose reader has gone, as in `carom docs scene | head -1`.
struct ReaderGone : RunError {
  using RunError::RunError;
  int status = 1;  // exit status, if the signal does not end the program
};

// Writes to standard output. Throws ReaderGone, or RunError for other failures (a full disk).
void print_out(std::string_view text);

// Write "carom: ..." and "carom: warning: ..." to standard error, always as one line.
void print_note(std::string_view text);
void print_warning(std::string_view text);

}  // namespace carom
