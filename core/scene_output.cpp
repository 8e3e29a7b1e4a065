#include "core/scene_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "core/input_message.hpp"
#include "core/scene_names.hpp"

namespace carom {

namespace {

constexpr std::string_view select_expected =
    "expected \"every 100th\" (disks by id), or a region [x0, y0, x1, y1] with x0 < x1, y0 < y1";

// The number in "every 100th"; 0 for any other text.
Count stride_of(std::string_view text) {
  constexpr std::string_view head = "every ";
  if (!text.starts_with(head)) return 0;
  text.remove_prefix(head.size());
  Count stride = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, stride);
  if (error != std::errc()) return 0;
  constexpr std::array<std::string_view, 5> endings{"th", "st", "nd", "rd", ""};
  const std::string_view ending(end, static_cast<std::size_t>(last - end));
  return std::find(endings.begin(), endings.end(), ending) == endings.end() ? 0 : stride;
}

}  // namespace

Selection read_selection(const TableReader& output) {
  Selection select;
  const toml::node* node = output.find("select");
  if (node == nullptr) return select;
  if (output.text("trajectory").value_or("none") == "none") {
    output.fail("select", "selects disks of no trajectory", "expected trajectory = \"xyz\" or \"h5md\" as well");
  }
  if (node->is_string()) {
    const std::string text = output.text("select").value();
    select.stride = stride_of(text);
    if (select.stride == 0) output.fail("select", fmt::format("is {}", in_quotes(text)), select_expected);
    return select;
  }
  if (!node->is_array()) output.fail("select", fmt::format("is {}", type_name(*node)), select_expected);
  const std::vector<double> corners = as_numbers(output.origin(), output.key("select"), *node);
  if (corners.size() != 4) output.fail("select", fmt::format("has {} numbers", corners.size()), select_expected);
  select.by_region = true;
  select.low = {corners[0], corners[1]};
  select.high = {corners[2], corners[3]};
  if (!(select.low.x < select.high.x && select.low.y < select.high.y)) {
    output.fail("select", "its corners are not in order", select_expected);
  }
  return select;
}

bool read_single_precision(const TableReader& output) {
  const std::size_t precision = output.choice_or_initial("precision");
  if (output.find("precision") != nullptr && output.text("trajectory").value_or("none") != "h5md") {
    output.fail("precision", "is a matter of trajectory.h5", "expected trajectory = \"h5md\" as well");
  }
  return precision == 1;
}

}  // namespace carom
