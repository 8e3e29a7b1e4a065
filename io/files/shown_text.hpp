// Makes text safe for programs that draw it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace carom {

// The number of bytes of the first character (UTF-8, RFC 3629); 0 if it is invalid.
inline std::size_t letter_bytes(std::string_view text) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80U) return 1;
  if (first < 0xc2U || first > 0xf4U) return 0;
  const std::size_t bytes = first < 0xe0U ? 2 : first < 0xf0U ? 3 : 4;
  // Excludes overlong forms, UTF-16 surrogates and numbers above U+10FFFF.
  const unsigned least = first == 0xe0U ? 0xa0U : first == 0xf0U ? 0x90U : 0x80U;
  const unsigned most = first == 0xedU ? 0x9fU : first == 0xf4U ? 0x8fU : 0xbfU;
  if (byte(1) < least || byte(1) > most) return 0;
  for (std::size_t k = 2; k < bytes; ++k) {
    if ((byte(k) & 0xc0U) != 0x80U) return 0;
  }
  return bytes;
}

// Replaces U+FFFE, U+FFFF (not characters) and invalid UTF-8, which names of files may contain, by U+FFFD: Cairo would
// draw nothing after them, and XML does not allow them.
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
