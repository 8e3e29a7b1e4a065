#include "core/scene/scene_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/picture_look.hpp"
#include "core/scene/scene_group_name.hpp"

namespace carom {

namespace {

constexpr std::string_view select_expected =
    "expected \"every 100th\" (disks by id), the name of a group, or a region [x0, y0, x1, y1] with x0 < x1, y0 < y1";

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

Selection read_selection(const TableReader& output, const Scene& scene) {
  Selection select;
  const toml::node* node = output.find("select");
  if (node == nullptr) return select;
  if (output.text("trajectory").value_or("none") == "none") {
    output.fail("select", "selects disks, but there is no trajectory",
                "expected trajectory = \"xyz\" or \"h5md\" as well");
  }
  if (node->is_string()) {
    const std::string text = output.text("select").value();
    select.stride = stride_of(text);
    if (select.stride > 0) return select;
    if (text.find(' ') != std::string::npos || named_groups(scene).empty()) {
      output.fail("select", fmt::format("is {}", in_quotes(text)), select_expected);
    }
    select.stride = 1;
    select.group = text;
    select.ids = find_group(output, "select", text, scene);
    return select;
  }
  if (!node->is_array()) output.fail("select", fmt::format("is {}", type_name(*node)), select_expected);
  const std::vector<double> corners = as_numbers(output.origin(), output.key("select"), *node);
  if (corners.size() != 4) output.fail("select", "has " + counted(corners.size(), "number"), select_expected);
  select.by_region = true;
  select.low = {corners[0], corners[1]};
  select.high = {corners[2], corners[3]};
  if (!(select.low.x < select.high.x && select.low.y < select.high.y)) {
    output.fail("select", "its corners are not in order", select_expected);
  }
  return select;
}

void check_selection(const Scene& scene, const PlaceOfKey& place) {
  const Selection& select = scene.output.select;
  if (!select.by_region) return;
  const Domain& box = scene.box;
  if (select.low.x < box.width && select.high.x > 0.0 && select.low.y < box.height && select.high.y > 0.0) return;
  fail_input(place("output.select"),
             fmt::format("the rectangle from ({}, {}) to ({}, {}) is outside the box of {} x {}", select.low.x,
                         select.low.y, select.high.x, select.high.y, short_number(box.width), short_number(box.height)),
             "expected a rectangle that overlaps the box");
}

bool read_single_precision(const TableReader& output) {
  const std::size_t precision = output.choice_or_initial("precision");
  if (output.find("precision") != nullptr && output.text("trajectory").value_or("none") == "none") {
    output.fail("precision", "is given, but there is no trajectory",
                "expected trajectory = \"xyz\" or \"h5md\" as well");
  }
  return precision == 1;
}

bool read_third_dimension(const TableReader& output) {
  const Count dimensions = output.count_or_initial("dimensions");
  if (dimensions != 2 && dimensions != 3)
    output.fail("dimensions", fmt::format("is {}", dimensions), "expected 2 or 3");
  if (output.find("dimensions") != nullptr && output.text("trajectory").value_or("none") != "h5md") {
    output.fail("dimensions", "belongs to trajectory.h5 only", "expected trajectory = \"h5md\" as well");
  }
  return dimensions == 3;
}

bool read_view(const TableReader& output) {
  const bool view = output.flag_or_initial("view");
  if (view && output.text("trajectory").value_or("none") == "none") {
    output.fail("view", "is true, but there is no trajectory to play",
                "expected trajectory = \"xyz\" or \"h5md\" as well");
  }
  return view;
}

namespace {

// The two numbers of a key, if it is there.
std::optional<std::array<double, 2>> two_numbers(const TableReader& movie, std::string_view name) {
  const toml::node* const node = movie.find(name);
  if (node == nullptr) return {};
  const std::vector<double> values = as_numbers(movie.origin(), movie.key(name), *node);
  if (values.size() != 2) movie.fail(name, "has " + counted(values.size(), "number"), "expected two numbers");
  return std::array{values[0], values[1]};
}

}  // namespace

void read_movie(const TableReader& output, OutputPlan& plan) {
  const toml::node* const node = output.find("movie");
  if (node == nullptr) return;
  const toml::table* const table = node->as_table();
  if (table == nullptr && !node->is_boolean()) {
    output.fail("movie", fmt::format("is {}", type_name(*node)),
                "expected true or false, or a table such as { fps = 30 }");
  }
  plan.movie = table != nullptr || as_flag(output.origin(), output.key("movie"), *node);
  if (table == nullptr) return;
  const TableReader movie(output.origin(), "output.movie", *table);
  PictureLook& look = plan.look;
  look.colour = static_cast<ColourBy>(movie.choice_or_initial("colour"));
  look.fps = movie.number_or_initial("fps");
  const auto check = [&movie](const char* name, const std::string& value, const std::string& complaint) {
    if (!complaint.empty()) movie.fail(name, fmt::format("is {}", value), complaint);
  };
  const auto listed = [](const std::array<double, 2>& p) { return fmt::format("[{}, {}]", p[0], p[1]); };
  check("fps", fmt::format("{}", look.fps), complaint_of_fps(look.fps));
  if (const auto size = two_numbers(movie, "size")) {
    check("size", listed(*size), complaint_of_size((*size)[0], (*size)[1]));
    look.width = static_cast<int>((*size)[0]);
    look.height = static_cast<int>((*size)[1]);
  }
  look.range = two_numbers(movie, "range");
  if (look.range) {
    const auto [low, high] = *look.range;
    check("range", listed(*look.range), complaint_of_range(look.colour, low, high));
  }
}

bool wants_frames(const OutputPlan& plan) {
  return plan.trajectory != TrajectoryFormat::none || plan.series || plan.movie || !plan.plots.empty();
}

}  // namespace carom
