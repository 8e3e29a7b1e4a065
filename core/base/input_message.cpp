#include "core/base/input_message.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/check.hpp"
#include "core/base/nearest_name.hpp"

namespace carom {

namespace {

// Is the character that begins with these bytes invisible, or does it end the line or reverse the direction of writing?
// A name that contains one can look like another name. The two joiners, U+200C and U+200D, are allowed: some scripts
// need them.
bool misleads(unsigned first, unsigned second, unsigned third) {
  if (first == 0xd8) return second == 0x9c;                   // U+061C
  if (first == 0xef) return second == 0xbb && third == 0xbf;  // U+FEFF
  if (first != 0xe2) return false;
  if (second == 0x81) return third >= 0xa0 && third <= 0xaf;                    // U+2060 to U+206F
  return second == 0x80 && (third == 0x8b || third == 0x8e || third == 0x8f ||  // U+200B, U+200E, U+200F
                            (third >= 0xa8 && third <= 0xae));                  // U+2028 to U+202E
}

// The number of bytes of the first character of the text; 0 if that is not valid UTF-8, or not to be shown.
std::size_t shown_length(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned first = byte(0);
  if (first < 0x80) return first < 0x20 || first == 0x7f ? 0 : 1;
  const std::size_t length = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xc0U) != 0x80) return 0;
  }
  // Overlong forms, UTF-16 surrogates, numbers above U+10FFFF; and control characters of two bytes.
  const unsigned second = byte(1);
  if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0)) return 0;
  if ((first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90)) return 0;
  if (first == 0xc2 && second < 0xa0) return 0;
  return misleads(first, second, length > 2 ? byte(2) : 0U) ? 0 : length;
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const std::size_t length = shown_length(text);
    line += length == 0 ? std::string_view("?") : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return line;
}

void fail_input(std::string_view where, std::string_view what, std::string_view expected) {
  std::string line = fmt::format("{}: {}", where, what);
  if (!expected.empty()) line += fmt::format("; {}", expected);
  throw InputError(one_line(line));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;  // characters; keeps the message readable on one terminal line
  if (text.size() <= longest) return fmt::format("\"{}\"", text);
  return fmt::format("\"{}...\"", text.substr(0, longest));
}

std::string expected_one_of(std::span<const std::string_view> known, std::string_view name) {
  if (known.size() == 1) return fmt::format("expected {}", known.front());
  const std::string_view nearest = nearest_name(name.substr(0, 60), known);
  if (!is_near(name, nearest)) return fmt::format("expected one of {}", fmt::join(known, ", "));
  return fmt::format("expected one of {} (nearest: {})", fmt::join(known, ", "), nearest);
}

}  // namespace carom
