#include <fmt/format.h>

#include <filesystem>

#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "core/base/input_message.hpp"
#include "io/files/child_process.hpp"
#include "run/run_view.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

// Where there is no program to open it with, a warning says so: the page is made all the same.
void open_page(const fs::path& file) {
  const std::string opener = find_program("xdg-open");
  if (opener.empty()) {
    print_warning("--open: there is no xdg-open; open the file in a browser by hand");
    return;
  }
  ChildProcess browser({opener, fs::absolute(file).string()}, ".", "/dev/null");
  if (const int status = browser.wait(); status != 0) {
    print_warning(fmt::format("--open: xdg-open ended with status {}; open the file in a browser by hand", status));
  }
}

}  // namespace

int command_view(const ViewOptions& options) {
  const Recording recording = open_recording(options.source);
  const fs::path file = options.file ? fs::path(*options.file) : recording.folder / "view.html";
  if (const std::string ending = file.extension().string(); ending != ".html" && ending != ".htm") {
    fail_input("-o", fmt::format("{} ends in \"{}\"", in_quotes(file.string()), ending), "expected .html");
  }
  check_free(file, options.force);
  ViewSettings settings;
  if (options.max_size) settings.most_bytes = *options.max_size;
  settings.warn = print_warning;
  const ViewMade made = write_view(file, recording, settings);
  if (!options.quiet) {
    for (const std::string& sentence : made.left_out) print_note(fmt::format("the page {}", sentence));
    print_note(fmt::format("{} frames, {} disks, {:.2f} MB", made.frames, made.disks,
                           static_cast<double>(made.page.size()) / 1e6));
    print_out(fmt::format("{}\n", file.string()));
  }
  if (options.open) open_page(file);
  return 0;
}

}  // namespace carom
