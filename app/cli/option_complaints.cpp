#include "app/cli/option_complaints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"

namespace carom {

namespace {

// Long names of a command's options, --help included.
std::vector<std::string_view> option_names(const CLI::App* command, std::vector<std::string>& storage) {
  for (const CLI::Option* option : command->get_options()) {
    for (const std::string& name : option->get_lnames()) storage.push_back("--" + name);
  }
  return {storage.begin(), storage.end()};
}

// Help about further commands of ./carom, which builds the program and then runs it.
constexpr const char* launcher_help = R"(The launcher ./carom in the sources has more commands:
  test [ctest's arguments]    build and run the tests
  python [ARGUMENTS]          build the Python module and start Python with it
  bench                       build and run the benchmarks
  bench counts [--check]      count the instructions and cache misses of fixed scenes
  bench counts --features     count those of a gas with one feature each
  bench ranks                 time ranks on this machine beside a model of their parts
  paper [--full [NAME...]]    make the methods paper from its kept results, or from new ones
  packages [SECTION]          only install what cmake/packages.txt lists
)";

}  // namespace

void check_leftovers(const CLI::App* command) {
  std::vector<std::string> rest = command->remaining();
  const auto mark = std::find(rest.begin(), rest.end(), "--");  // words after it are not options
  const auto option = std::find_if(rest.begin(), mark, [](const auto& word) { return word.starts_with("-"); });
  if (option == mark) {
    if (mark != rest.end()) rest.erase(mark);
    if (rest.empty()) return;
    fail_input(command->get_name(), fmt::format("one argument too many, {}", in_quotes(rest[0])),
               command->get_name() == "chart" ? fmt::format("expected carom chart --scene {}", rest[0])
                                              : fmt::format("see carom {} --help", command->get_name()));
  }
  std::vector<std::string> storage;
  const std::string name = option->substr(0, option->find('='));
  fail_input(command->get_name(), fmt::format("there is no option {}", in_quotes(name)),
             expected_one_of(option_names(command, storage), name));
}

void fail_as_one_line(const CLI::ParseError& error) {
  const std::string text = error.what();
  constexpr std::string_view with_value = " was given a disallowed flag override";  // in the words of CLI11
  if (text.ends_with(with_value)) {
    fail_input(fmt::format("--{}", text.substr(0, text.size() - with_value.size())), "takes no value",
               "expected the option alone");
  }
  const std::string where = text.substr(0, text.find_first_of(": "));
  if (where.starts_with("-") && dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    fail_input(where, "its value is missing", "see --help");
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {  // after "--"; check_leftovers handles all others
    throw InputError(
        fmt::format("one argument too many, {}; see --help", in_quotes(text.substr(text.rfind(": ") + 2))));
  }
  throw InputError(text.substr(0, text.find('\n')));
}

std::string help_of(const CLI::App& app, const CLI::App& shown) {
  std::string text = shown.help(&shown == &app ? "" : app.get_name());
  if (&shown == &app) text += launcher_help;
  for (const std::string argument : {"SCENE", "CHECKPOINT", "A", "B", "DIR"}) {
    const std::string optional = "[" + argument + "]";
    const std::size_t at = text.find(optional);
    if (at != std::string::npos) text.replace(at, optional.size(), argument);
  }
  return text;
}

}  // namespace carom
