#include "core/base/input_message.hpp"

#include <fmt/format.h>

#include "core/base/check.hpp"
#include "core/base/nearest_name.hpp"

namespace carom {

void fail_input(std::string_view where, std::string_view what, std::string_view expected) {
  std::string line = fmt::format("{}: {}", where, what);
  if (!expected.empty()) line += fmt::format("; {}", expected);
  for (char& c : line) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) c = '?';
  }
  throw InputError(line);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;  // characters; keeps the message readable on one terminal line
  if (text.size() <= longest) return fmt::format("\"{}\"", text);
  return fmt::format("\"{}...\"", text.substr(0, longest));
}

bool has_near_name(std::span<const std::string_view> known, std::string_view name) {
  return is_near(name, nearest_name(name.substr(0, 60), known));
}

std::string expected_one_of(std::span<const std::string_view> known, std::string_view name) {
  if (known.size() == 1) return fmt::format("expected {}", known.front());
  const std::string_view nearest = nearest_name(name.substr(0, 60), known);
  if (!is_near(name, nearest)) return fmt::format("expected one of {}", fmt::join(known, ", "));
  return fmt::format("expected one of {} (nearest: {})", fmt::join(known, ", "), nearest);
}

}  // namespace carom
