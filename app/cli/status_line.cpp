#include "app/cli/status_line.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

namespace carom {

namespace {

constexpr double terminal_seconds = 0.2, elsewhere_seconds = 60.0;

std::size_t terminal_columns() {
  constexpr std::size_t usual_columns = 80;
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return usual_columns;
  return size.ws_col;
}

}  // namespace

StatusPlace on_standard_error() {
  return {isatty(STDERR_FILENO) == 1, terminal_columns(),
          [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); },
          [](const std::string& text) { std::fputs(text.c_str(), stderr); }};
}

StatusLine::StatusLine(bool wanted, StatusPlace place)
    : wanted_(wanted), place_(std::move(place)), last_(place_.seconds()) {}

bool StatusLine::due() const {
  return wanted_ && place_.seconds() - last_ >= (place_.terminal ? terminal_seconds : elsewhere_seconds);
}

void StatusLine::show(const std::string& text) {
  if (!wanted_) return;
  last_ = place_.seconds();
  if (!place_.terminal) {
    place_.write(fmt::format("carom: {}\n", text));
    return;
  }
  // ESC [ K clears the rest of a longer line.
  place_.write(fmt::format("\r{}\x1b[K", text.substr(0, std::max<std::size_t>(place_.columns, 1) - 1)));
  on_screen_ = true;
}

void StatusLine::clear() {
  if (!std::exchange(on_screen_, false)) return;
  place_.write("\r\x1b[K");
}

}  // namespace carom
