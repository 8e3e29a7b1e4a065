#include "io/files/shell_word.hpp"

#include <algorithm>
#include <string_view>

namespace carom {

namespace {

// A path in a script other than Latin needs no quotes either: its bytes have no meaning to any shell.
bool is_plain(char c) {
  constexpr std::string_view marks = "_-./,:+@%=";
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         static_cast<unsigned char>(c) >= 0x80 || marks.find(c) != std::string_view::npos;
}

}  // namespace

std::string quoted_for_shell(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_word(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_plain) ? text : quoted_for_shell(text);
}

}  // namespace carom
