// The command line's words before any option is read.
#pragma once

#include <vector>

namespace carom {

// The words of argv, with "help" replaced by "--help". Throws InputError if the first is not a command of the program
// (and names the nearest one, or the launcher), or if a word is empty.
std::vector<const char*> checked_words(int argc, const char* const* argv);

}  // namespace carom
