// Text that programs which draw it take without an error.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace carom {

// How many bytes of UTF-8 the letter at the beginning has (RFC 3629); 0 where it is none.
inline std::size_t letter_bytes(std::string_view text) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80U) return 1;
  if (first < 0xc2U || first > 0xf4U) return 0;
  const std::size_t bytes = first < 0xe0U ? 2 : first < 0xf0U ? 3 : 4;
  // Neither a longer form of a letter than needed, nor a half of a pair of UTF-16, nor beyond U+10FFFF.
  const unsigned least = first == 0xe0U ? 0xa0U : first == 0xf0U ? 0x90U : 0x80U;
  const unsigned most = first == 0xedU ? 0x9fU : first == 0xf4U ? 0x8fU : 0xbfU;
  if (byte(1) < least || byte(1) > most) return 0;
  for (std::size_t k = 2; k < bytes; ++k) {
    if ((byte(k) & 0xc0U) != 0x80U) return 0;
  }
  return bytes;
}

// With U+FFFD, which stands for what cannot be shown, for U+FFFE and U+FFFF, which are no characters, and for bytes
// that are no UTF-8, as names of files may have them: Cairo draws nothing after either, and no XML may have them.
inline std::string shown_text(std::string_view text) {
  constexpr std::string_view none = "\xef\xbf\xbd";
  std::string shown;
  while (!text.empty()) {
    const std::size_t bytes = letter_bytes(text);
    const std::string_view letter = text.substr(0, bytes);
    const bool is_character = bytes > 0 && letter != "\xef\xbf\xbe" && letter != "\xef\xbf\xbf";
    shown += is_character ? letter : none;
    text.remove_prefix(bytes > 0 ? bytes : 1);
  }
  return shown;
}

}  // namespace carom
