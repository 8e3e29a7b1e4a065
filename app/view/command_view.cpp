#include <fmt/format.h>

#include <filesystem>

#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "app/view/live_view.hpp"
#include "app/view/open_page.hpp"
#include "core/base/short_number.hpp"
#include "run/recordings/run_view.hpp"

namespace carom {

namespace fs = std::filesystem;

int command_view(const ViewOptions& options) {
  if (options.live) return view_live(options);
  const Recording recording = open_recording(options.source);
  const fs::path file = options.file ? fs::path(*options.file) : recording.folder / "view.html";
  check_page_file(file, options.force);
  const std::string note = note_of_another_run(recording);
  if (!options.quiet && !note.empty()) print_note(note);
  ViewSettings settings;
  if (options.max_size) settings.most_bytes = *options.max_size;
  if (!options.quiet) settings.warn = print_warning;
  const ViewMade made = write_view(file, recording, settings);
  if (!options.quiet) {
    for (const std::string& sentence : made.left_out) print_note(fmt::format("the page {}", sentence));
    print_note(fmt::format("{}, {}, {:.2f} MB", counted(made.frames, "frame"), counted(made.disks, "disk"),
                           static_cast<double>(made.page.size()) / 1e6));
    print_out(fmt::format("{}\n", file.string()));
  }
  if (options.open) open_page(fs::absolute(file).string(), "--open", options.quiet);
  return 0;
}

}  // namespace carom
