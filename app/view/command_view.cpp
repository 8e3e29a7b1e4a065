#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "app/view/recording.hpp"
#include "core/base/check.hpp"
#include "core/base/input_file.hpp"
#include "core/base/input_message.hpp"
#include "io/files/child_process.hpp"
#include "io/files/output_file.hpp"
#include "io/view/view_maker.hpp"
#include "run/make_engine.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

// Of the series: about a tenth of a small page, and never so many that a plot could not show them.
constexpr std::size_t most_series_values = 20'000;
constexpr std::size_t bytes_a_value = 80;

// What the page tells beside the disks, from the files of the run that lie beside the trajectory.
ViewStory story_of(const Recording& recording, std::size_t most_bytes) {
  const std::optional<Scene> scene = scene_of(recording);
  ViewStory story = scene ? view_story(*scene) : ViewStory{};
  if (!scene) story.title = recording.trajectory.string();
  const fs::path series = recording.trajectory.parent_path() / "series.csv";
  if (!fs::exists(series)) return story;
  try {
    const std::size_t most_values = std::min(most_series_values, most_bytes / bytes_a_value);
    story.series = read_view_series(read_text_file(series.string(), "view"), most_values, series.string());
  } catch (const InputError& error) {
    print_warning(fmt::format("the page has no plots: {}", error.what()));
  }
  return story;
}

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
  const EngineChoice choice = choose_engine("", std::nullopt);
  ViewWork work;
  if (options.max_size) work.most_bytes = *options.max_size;
  work.threads = static_cast<std::size_t>(choice.threads);
  work.run = make_block_runner(choice);
  const ViewMade made = make_view([&] { return open_frames(recording); }, recording.trajectory.string(),
                                  story_of(recording, work.most_bytes), work);
  replace_file(file.string(), made.page);
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
