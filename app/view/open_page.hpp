// The browser, for a page that is made.
#pragma once

#include <string>

namespace carom {

// Opens a file or an address with the desktop's own opener. Where there is none, or it fails, a warning says so, as
// what is to be opened is there all the same.
void open_page(const std::string& page);

}  // namespace carom
