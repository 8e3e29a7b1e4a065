#include "app/cli/messages.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "core/base/input_message.hpp"

namespace carom {

void print_out(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  const int error = errno;
  const std::string what = fmt::format("cannot write to standard output: {}", std::strerror(error));
  if (error == EPIPE) throw ReaderGone(what);
  throw RunError(what);
}

void print_note(std::string_view text) {
  // A closed standard error is no reason to stop a run.
  std::fputs(fmt::format("carom: {}\n", one_line(text)).c_str(), stderr);
}

void print_warning(std::string_view text) {
  print_note(fmt::format("warning: {}", text));
}

}  // namespace carom
