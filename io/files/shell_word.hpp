// Quotes words of shell commands in messages and scripts.
#pragma once

#include <string>

namespace carom {

// The text in single quotes.
std::string quoted_for_shell(const std::string& text);

// The same, but without quotes if the shell reads the text as one plain word.
std::string shell_word(const std::string& text);

}  // namespace carom
