// The values of options, from the text that the user wrote. All throw InputError with one line that names the option.
#pragma once

#include <string>

namespace carom {

// A finite number, and nothing after it.
double number_of(const std::string& option, const std::string& text);

// A whole number of 1 or more.
int count_of(const std::string& option, const std::string& text);

// --max-walltime in seconds; infinity where the option was not given.
double walltime_of(const std::string& text);

// The value of an option that changes the scene (--method, --seed, or a number), as TOML writes it.
std::string toml_value(const std::string& option, const std::string& text);

}  // namespace carom
