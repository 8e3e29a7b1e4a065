// The page that plays a run: one HTML file with everything in it.
#pragma once

#include <string>
#include <vector>

#include "io/view/view_encoder.hpp"
#include "io/view/view_story.hpp"

namespace carom {

// The page of viewer/, made at build time (cmake/EmbedViewer.cmake), with markers where a run's own text goes.
extern const char* const viewer_page;

// left_out: sentences that say what the page lacks of the trajectory. encoder: finished. Titles and names may hold any
// characters: they become text on the page and never code.
std::string view_page(const ViewStory& story, const ViewEncoder& encoder, const std::vector<std::string>& left_out);

}  // namespace carom
