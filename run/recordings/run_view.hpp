// The page that plays a run, from the files in its folder.
#pragma once

#include <cstddef>
#include <filesystem>

#include "io/view/view_maker.hpp"
#include "run/engine/make_engine.hpp"
#include "run/recordings/recording.hpp"

namespace carom {

struct ViewSettings {
  std::size_t most_bytes = ViewWork{}.most_bytes;         // of the page
  EngineChoice engine = choose_engine("", std::nullopt);  // for its threads
  const Scene* scene = nullptr;                           // of the recording; null: the one beside the trajectory
  WarningSink warn = [](std::string_view) {};
};

// What the page shows besides the disks, from the files of the run beside the trajectory.
ViewStory story_of(const Recording& recording, const ViewSettings& settings);

// Only the plots of series.csv; none if it cannot be read.
ViewSeries series_of(const Recording& recording, const ViewSettings& settings);

// The page of a recording, with title, sides and sources from the scene, and the plots of series.csv if that is beside
// the trajectory. Throws as make_view() does.
ViewMade view_of(const Recording& recording, const ViewSettings& settings);

// Throws InputError if a page may not be written to this file, because of its extension or of an existing file.
void check_page_file(const std::filesystem::path& file, bool force);

// Writes the page that view_of() makes to a file, which it replaces. Throws RunError if it cannot be written.
ViewMade write_view(const std::filesystem::path& file, const Recording& recording, const ViewSettings& settings);

}  // namespace carom
