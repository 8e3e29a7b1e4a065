#include "app/view/open_page.hpp"

#include <fmt/format.h>

#include "app/cli/messages.hpp"
#include "io/files/child_process.hpp"

namespace carom {

void open_page(const std::string& page, std::string_view option, bool quiet) {
  const auto warn = [&](std::string_view what) {
    if (!quiet) print_warning(fmt::format("{}: {}; open the page in a browser by hand", option, what));
  };
  const std::string opener = find_program("xdg-open");
  if (opener.empty()) return warn("there is no xdg-open");
  ChildProcess browser({opener, page}, ".", "/dev/null");
  if (const int status = browser.wait(); status != 0) warn(fmt::format("xdg-open ended with status {}", status));
}

}  // namespace carom
