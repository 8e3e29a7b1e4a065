// Reads the values of options from text. All functions throw InputError with one line that names the option.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>

namespace carom {

// A finite number, without further text.
double number_of(const std::string& option, const std::string& text);

// A whole number from 1 to `most`.
int count_of(const std::string& option, const std::string& text, int most = std::numeric_limits<int>::max());

// Two numbers separated by `between`: "0:2", "1280x720".
std::array<double, 2> pair_of(const std::string& option, const std::string& text, char between,
                              const std::string& expected);

// --max-walltime in seconds; infinity if the option was not given.
double walltime_of(const std::string& text);

// Bytes of a size such as 64MB, 500 kB or 1.5GB (powers of ten), or a bare number of bytes.
std::size_t size_of(const std::string& option, const std::string& text);

// The value of an option that changes the scene (--method, --seed, or a number), as TOML writes it.
std::string toml_value(const std::string& option, const std::string& text);

}  // namespace carom
