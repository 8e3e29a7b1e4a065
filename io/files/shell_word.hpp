// Words of commands that messages and scripts give a shell.
#pragma once

#include <string>

namespace carom {

// In a shell's single quotes.
std::string quoted_for_shell(const std::string& text);

// The same, but as it stands where a shell takes it for one word and nothing else.
std::string shell_word(const std::string& text);

}  // namespace carom
