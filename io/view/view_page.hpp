// The page that plays a run: one HTML file with everything in it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/view/view_encoder.hpp"
#include "io/view/view_story.hpp"

namespace carom {

// The page of viewer/, made at build time (cmake/EmbedViewer.cmake), with markers where a run's own text goes.
extern const char* const viewer_page;
// What takes their places in the page of a run that goes on (viewer/live.js).
extern const char *const viewer_live_policy, *const viewer_live_script;

// left_out: sentences that say what the page lacks of the trajectory. encoder: finished. Titles and names may hold any
// characters: they become text on the page and never code.
std::string view_page(const ViewStory& story, const ViewEncoder& encoder, const std::vector<std::string>& left_out);

// The page of a run that goes on: without blocks, which it asks its server for, as it does for news.
std::string live_page(const ViewStory& story, const ViewEncoder& encoder);

// Block k as text, as a page holds it or asks for it.
std::string block_text(const ViewEncoder& encoder, std::size_t k);

// What is new since a page had so many blocks and disks, as JSON. state: a sentence about the run. Precondition: there
// are as many.
std::string view_news(const ViewStory& story, const ViewEncoder& encoder, std::size_t blocks, std::size_t disks,
                      std::string_view state, bool ended);

}  // namespace carom
