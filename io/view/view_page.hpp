// The page that plays a run: one HTML file that contains everything.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/view/view_encoder.hpp"
#include "io/view/view_story.hpp"

namespace carom {

// The page of viewer/, made at build time (cmake/EmbedViewer.cmake), with markers for a run's own text.
extern const char* const viewer_page;
// Replacements for them in the page of a run that goes on (viewer/live.js).
extern const char *const viewer_live_policy, *const viewer_live_script;

// left_out: sentences about the parts of the trajectory that the page lacks. encoder: finished. Titles and names may
// contain any characters: they become text on the page and never code.
std::string view_page(const ViewStory& story, const ViewEncoder& encoder, const std::vector<std::string>& left_out);

// The page of a run that goes on: without blocks, which it requests from its server, as it does news.
std::string live_page(const ViewStory& story, const ViewEncoder& encoder);

// Block k as text, as a page contains or requests it.
std::string block_text(const ViewEncoder& encoder, std::size_t k);

// The news for a page that has this number of blocks and disks, as JSON. state: a sentence about the run. Precondition:
// there are at least as many.
std::string view_news(const ViewStory& story, const ViewEncoder& encoder, std::size_t blocks, std::size_t disks,
                      std::string_view state, bool ended);

}  // namespace carom
