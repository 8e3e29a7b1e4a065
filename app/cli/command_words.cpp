#include "app/cli/command_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"

namespace carom {

namespace {

constexpr std::array<std::string_view, 9> command_names{"run",  "check", "resume", "compare", "render",
                                                        "view", "sweep", "chart",  "docs"};

void check_command_name(const std::vector<const char*>& words) {
  if (words.size() < 2)
    throw InputError(fmt::format("no command given; expected one of {} (or --help)", fmt::join(command_names, ", ")));
  const std::string_view name = words[1];
  if (name.starts_with("-")) {
    constexpr std::array<std::string_view, 2> general{"--help", "--version"};
    if (name == "-h" || std::find(general.begin(), general.end(), name) != general.end()) return;
    throw InputError(
        fmt::format("there is no option {} before the command; {}", in_quotes(name), expected_one_of(general, name)));
  }
  constexpr std::array<std::string_view, 5> of_the_launcher{"test", "bench", "python", "paper", "packages"};
  if (std::find(of_the_launcher.begin(), of_the_launcher.end(), name) != of_the_launcher.end()) {
    throw InputError(
        fmt::format("{} is a command of the launcher ./carom in the sources, not of this program", in_quotes(name)));
  }
  if (std::find(command_names.begin(), command_names.end(), name) == command_names.end()) {
    throw InputError(fmt::format("there is no command {}; {}", in_quotes(name), expected_one_of(command_names, name)));
  }
}

// An empty word usually is an unset variable of the caller's shell; its value would be left out silently.
void check_empty_words(const std::vector<const char*>& words) {
  for (std::size_t k = 1; k < words.size(); ++k) {
    if (*words[k] != '\0') continue;
    const std::string before = k > 1 ? words[k - 1] : "carom";
    fail_input(before, "is followed by an empty argument", "expected a value; is a variable of the shell not set?");
  }
}

// carom help and carom help run, for carom --help and carom run --help.
void replace_help_word(std::vector<const char*>& words) {
  if (words.size() < 2 || std::string_view(words[1]) != "help") return;
  words.erase(words.begin() + 1);
  words.push_back("--help");
}

}  // namespace

std::vector<const char*> checked_words(int argc, const char* const* argv) {
  std::vector<const char*> words(argv, argv + argc);
  check_empty_words(words);
  replace_help_word(words);
  check_command_name(words);
  return words;
}

}  // namespace carom
