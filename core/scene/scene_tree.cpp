#include "core/scene/scene_tree.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/input_file.hpp"
#include "core/base/input_message.hpp"

namespace carom {

namespace {

// The beginning of a line of the text, counted from 1; npos if there are fewer lines.
std::size_t begin_of_line(std::string_view text, std::size_t line) {
  std::size_t begin = 0;
  for (std::size_t k = 1; k < line && begin != std::string::npos; ++k) {
    begin = text.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  return begin;
}

// Puts quotes around the digits of "seed = digits" in the line numbered line (from 1). False if it is another line.
bool quote_seed(std::string& text, std::size_t line) {
  const std::size_t begin = begin_of_line(text, line);
  if (begin == std::string::npos) return false;
  const std::size_t name = text.find_first_not_of(" \t", begin);
  if (name == std::string::npos || text.compare(name, 4, "seed") != 0) return false;
  const std::size_t equals = text.find_first_not_of(" \t", name + 4);
  if (equals == std::string::npos || text[equals] != '=') return false;
  const std::size_t first = text.find_first_not_of(" \t", equals + 1);
  if (first == std::string::npos || !is_digit(text[first])) return false;
  std::size_t last = first;
  while (last < text.size() && is_digit(text[last])) ++last;
  text.insert(last, "\"");
  text.insert(first, "\"");
  return true;
}

// The end of the string that starts with the quote at text[at], which may be of either kind, single or threefold. A
// string without a closing quote ends with its line, or with the text; the parser will report it.
std::size_t skip_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string closing(text.substr(at, 3) == std::string(3, quote) ? 3 : 1, quote);
  for (std::size_t k = at + closing.size(); k < text.size(); ++k) {
    if (text[k] == '\\' && quote == '"') {
      ++k;
    } else if (text.substr(k, closing.size()) == closing) {
      return k + closing.size();
    } else if (text[k] == '\n' && closing.size() == 1) {
      return k;
    }
  }
  return text.size();
}

// The text of what was expected where the parser stopped. Two common errors after a number are a decimal comma and a
// unit.
std::string expected_at(std::string_view text, const toml::source_position& place) {
  const std::string valid = "expected valid TOML 1.0";
  const std::size_t begin = begin_of_line(text, std::max<std::size_t>(1, place.line));
  if (begin == std::string::npos || place.column < 2) return valid;
  const std::size_t at = begin + place.column - 1;
  if (at >= text.size()) return valid;
  const std::size_t before = text.find_last_not_of(" \t", at - 1);
  if (before == std::string::npos || before < begin || !is_digit(text[before])) return valid;
  if (text[at] == ',') return valid + ", where decimals have a point: 0.5";
  const std::size_t after = std::min(text.find_first_of("=,]}#\n", at), text.size());
  const bool key = after < text.size() && text[after] == '=';  // a comma is missing before it
  const bool letter = (text[at] >= 'a' && text[at] <= 'z') || (text[at] >= 'A' && text[at] <= 'Z');
  return !key && (letter || text[at] == '%') ? valid + ", where numbers have no unit" : valid;
}

// Throws InputError when the text has a stray character.
void check_ascii(std::string_view text, const std::string& name) {
  const std::string_view stray = stray_character(text);
  if (stray.empty()) return;
  const auto line = 1 + std::count(text.data(), stray.data(), '\n');
  fail_input(fmt::format("{}:{}: TOML syntax", name, line),
             fmt::format("{} outside strings and comments", in_quotes(stray)), "expected ASCII characters there");
}

}  // namespace

std::string_view stray_character(std::string_view text) {
  std::size_t at = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else if (c == '"' || c == '\'') {
      at = skip_string(text, at);
    } else if (static_cast<unsigned char>(c) >= 0x80) {
      std::size_t end = at + 1;
      while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80) ++end;
      return text.substr(at, end - at);
    } else {
      ++at;
    }
  }
  return {};
}

toml::table parse_scene_tree(std::string_view text, const std::string& name) {
  check_ascii(text, name);
  std::string copy(text);
  for (bool retried = false;; retried = true) {
    try {
      return toml::parse(std::string_view(copy), std::string_view(name));
    } catch (const toml::parse_error& e) {
      const std::size_t line = std::max<std::size_t>(1, e.source().begin.line);
      if (!retried && quote_seed(copy, line)) continue;
      fail_input(fmt::format("{}:{}: TOML syntax", name, line), e.description(), expected_at(copy, e.source().begin));
    }
  }
}

}  // namespace carom
