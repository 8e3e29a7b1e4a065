// The error messages and the help of CLI11, in Carom's form.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace carom {

// Throws InputError if words are left that no option or argument of the command took; for a misspelt option it names
// the nearest one.
void check_leftovers(const CLI::App* command);

// CLI11's own complaints are about values that are missing or superfluous; "--dt: 1 required X missing" becomes an
// InputError of one line.
[[noreturn]] void fail_as_one_line(const CLI::ParseError& error);

// CLI11's help, without the brackets around arguments: they are registered as optional, so that the messages about
// missing ones are ours. shown: app itself or one of its commands.
std::string help_of(const CLI::App& app, const CLI::App& shown);

}  // namespace carom
