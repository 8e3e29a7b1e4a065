// Text that programs which draw it take without an error.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace carom {

// With U+FFFD, which stands for what cannot be shown, for U+FFFE and U+FFFF, which are no characters: Cairo draws
// nothing after them, and no XML may have them. text: UTF-8.
inline std::string without_noncharacters(std::string text) {
  for (const std::string_view none : {"\xef\xbf\xbe", "\xef\xbf\xbf"}) {
    for (std::size_t at = 0; (at = text.find(none, at)) != std::string::npos;) text[at + 2] = '\xbd';
  }
  return text;
}

}  // namespace carom
