// The command line's words before any option is read.
#pragma once

#include <vector>

namespace carom {

// The words of argv, "help" made "--help". Throws InputError where the first is no command of the program (and names
// the nearest one, or the launcher), or where a word is empty.
std::vector<const char*> checked_words(int argc, const char* const* argv);

}  // namespace carom
