// The one line in which every complaint about input is made: "where: what is wrong; what was expected".
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace carom {

// Makes text from a user or from a damaged file safe to print: control characters, characters that are invisible or
// reverse the direction of writing, and bytes that are not UTF-8 become '?', one for each byte. The result is one line
// of valid UTF-8.
std::string one_line(std::string_view text);

// Throws InputError with the line "where: what; expected", made safe by one_line(). where is "file:line: key"; an empty
// expected is left out.
[[noreturn]] void fail_input(std::string_view where, std::string_view what, std::string_view expected = {});

// Text from the user in double quotes, cut after 60 characters.
std::string in_quotes(std::string_view text);

// "expected one of a, b, c (nearest: b)" for a name that is none of them; the nearest is named only if is_near() holds.
std::string expected_one_of(std::span<const std::string_view> known, std::string_view name);

}  // namespace carom
