#include "app/view/open_page.hpp"

#include <fmt/format.h>

#include "app/cli/messages.hpp"
#include "io/files/child_process.hpp"

namespace carom {

void open_page(const std::string& page) {
  const std::string opener = find_program("xdg-open");
  if (opener.empty()) {
    print_warning("--open: there is no xdg-open; open the page in a browser by hand");
    return;
  }
  ChildProcess browser({opener, page}, ".", "/dev/null");
  if (const int status = browser.wait(); status != 0) {
    print_warning(fmt::format("--open: xdg-open ended with status {}; open the page in a browser by hand", status));
  }
}

}  // namespace carom
