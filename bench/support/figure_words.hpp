// The command-line arguments of carom_figures.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"

namespace carom::bench {

// In the order of measuring. Memory comes first, as the peak of a child process includes that of this process so far.
inline constexpr std::array<std::string_view, 8> figure_parts{"memory",   "gas",   "scaling",      "special",
                                                              "features", "exact", "exact_growth", "borders"};

struct FigureWords {
  std::string folder;              // for the results
  std::vector<std::string> parts;  // to be measured; none: all parts

  bool wants(std::string_view part) const {
    return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
  }
};

// words: without the program's name. Throws InputError for an unknown one, before minutes of measuring.
inline FigureWords figure_words(std::span<const std::string> words) {
  const auto is_part = [](std::string_view word) {
    return std::find(figure_parts.begin(), figure_parts.end(), word) != figure_parts.end();
  };
  if (words.empty()) throw InputError("no folder given; expected one for the results");
  const std::string& folder = words.front();
  // An option, or a part's name because the folder was forgotten.
  if (folder.empty() || folder.starts_with('-') || is_part(folder)) {
    fail_input(in_quotes(folder), "stands where the folder is expected",
               "expected a folder for the results, such as ./" + folder);
  }
  for (const std::string& part : words.subspan(1)) {
    if (!is_part(part)) fail_input(in_quotes(part), "is no part of the figures", expected_one_of(figure_parts, part));
  }
  return {folder, {words.begin() + 1, words.end()}};
}

}  // namespace carom::bench
