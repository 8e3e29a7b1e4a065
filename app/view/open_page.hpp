// The browser, for a page that is made.
#pragma once

#include <string>
#include <string_view>

namespace carom {

// Opens a file or an address with the desktop's own opener. Where there is none, or it fails, a warning says so, as
// what is to be opened is there all the same; unless quiet. option: that which asks for it, "--open".
void open_page(const std::string& page, std::string_view option, bool quiet);

}  // namespace carom
