// What CLI11 finds wrong, and its help, in our words.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace carom {

// Throws InputError about what no option or argument of the command took, with the nearest option for a misspelt one.
void check_leftovers(const CLI::App* command);

// CLI11's own complaints are about values that are missing or superfluous; "--dt: 1 required X missing" becomes an
// InputError of one line.
[[noreturn]] void fail_as_one_line(const CLI::ParseError& error);

// CLI11's help, without the brackets around arguments: they are registered as optional, so that the messages about
// missing ones are ours. shown: app itself or one of its commands.
std::string help_of(const CLI::App& app, const CLI::App& shown);

}  // namespace carom
