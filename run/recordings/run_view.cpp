#include "run/recordings/run_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <system_error>

#include "core/base/check.hpp"
#include "core/base/input_file.hpp"
#include "core/base/input_message.hpp"
#include "io/files/output_file.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

// The most values of the series: about a tenth of a small page, and no more than a plot can show.
constexpr std::size_t most_series_values = 20'000;
constexpr std::size_t bytes_a_value = 80;
constexpr std::size_t most_curve_points = 500;

// The curves of analysis.h5; none if there is no such file, or if it cannot be read.
std::vector<AnalysisCurve> curves_of(const Recording& recording, const ViewSettings& settings) {
  const fs::path file = recording.trajectory.parent_path() / "analysis.h5";
  if (!fs::exists(file)) return {};
  try {
    const std::size_t most_points = std::min(most_curve_points, settings.most_bytes / bytes_a_value / 20);
    return read_analysis_curves(file.string(), most_points);
  } catch (const InputError& error) {
    settings.warn(fmt::format("the page has no curves of the analysis: {}", error.what()));
    return {};
  }
}

}  // namespace

ViewSeries series_of(const Recording& recording, const ViewSettings& settings) {
  const fs::path series = recording.trajectory.parent_path() / "series.csv";
  if (!fs::exists(series)) return {};
  try {
    const std::size_t most_values = std::min(most_series_values, settings.most_bytes / bytes_a_value);
    return read_view_series(read_text_file(series.string(), "view"), most_values, series.string());
  } catch (const InputError& error) {
    settings.warn(fmt::format("the page has no plots: {}", error.what()));
    return {};
  }
}

ViewStory story_of(const Recording& recording, const ViewSettings& settings) {
  const std::optional<Scene> found = settings.scene != nullptr ? std::nullopt : scene_of(recording, settings.warn);
  const Scene* const scene = found ? &*found : settings.scene;
  ViewStory story = scene != nullptr ? view_story(*scene) : ViewStory{};
  if (scene == nullptr) story.title = recording.trajectory.string();
  story.series = series_of(recording, settings);
  story.curves = curves_of(recording, settings);
  return story;
}

ViewMade view_of(const Recording& recording, const ViewSettings& settings) {
  ViewWork work;
  work.most_bytes = settings.most_bytes;
  work.threads = static_cast<std::size_t>(settings.engine.threads);
  work.run = make_block_runner(settings.engine);
  const auto open = [&] { return open_frames(recording); };
  return make_view(open, recording.trajectory.string(), story_of(recording, settings), work);
}

void check_page_file(const fs::path& file, bool force) {
  if (const std::string ending = file.extension().string(); ending != ".html" && ending != ".htm") {
    fail_input("-o", fmt::format("{} ends in \"{}\"", in_quotes(file.string()), ending), "expected .html");
  }
  check_free(file, force);
  check_writable(file);
}

ViewMade write_view(const fs::path& file, const Recording& recording, const ViewSettings& settings) {
  ViewMade made = view_of(recording, settings);
  std::error_code ignored;  // an error shows when the file is written
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);
  replace_file(file.string(), made.page);
  return made;
}

}  // namespace carom
