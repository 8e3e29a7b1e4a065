// The one line in which every complaint about input is made: "where: what is wrong; what was expected".
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace carom {

// Text with names that users chose, or of a damaged file, as a terminal may have it: control characters, those that
// turn text from right to left or show nothing, and bytes that are no UTF-8 become '?', one for each byte. It stays one
// line, and Python can have it as a string.
std::string one_line(std::string_view text);

// Throws InputError with that line, one_line() of it. where is "file:line: key"; an empty expected is left out.
[[noreturn]] void fail_input(std::string_view where, std::string_view what, std::string_view expected = {});

// Text from the user in double quotes, cut short after 60 characters.
std::string in_quotes(std::string_view text);

// "expected one of a, b, c (nearest: b)" for a name that is none of them; the nearest only if it is near.
std::string expected_one_of(std::span<const std::string_view> known, std::string_view name);

}  // namespace carom
