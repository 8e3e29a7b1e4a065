// Opens a page in the browser.
#pragma once

#include <string>
#include <string_view>

namespace carom {

// Opens a file or an address with the desktop's own opener. If there is none, or it fails, there is only a warning,
// unless quiet, since the page itself is there. option: the option that opens it, such as "--open".
void open_page(const std::string& page, std::string_view option, bool quiet);

}  // namespace carom
