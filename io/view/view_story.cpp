#include "io/view/view_story.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/scene/disk_group.hpp"
#include "core/start/initial_state.hpp"

namespace carom {

namespace {

// Takes the next line off the text.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return cells;
}

double value_of(std::string_view cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool whole = error == std::errc() && end == cell.data() + cell.size();
  return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

bool has_number(const std::vector<double>& column) {
  for (const double value : column) {
    if (std::isfinite(value)) return true;
  }
  return false;
}

}  // namespace

ViewSeries read_view_series(std::string_view csv, std::size_t most_values, const std::string& name) {
  const std::vector<std::string_view> heads = cells_of(take_line(csv));
  csv = csv.substr(0, csv.rfind('\n') + 1);  // the last line of a run that was killed may lack digits
  std::vector<std::string_view> lines;
  while (!csv.empty()) {
    if (const std::string_view line = take_line(csv); !line.empty()) lines.push_back(line);
  }
  ViewSeries series;
  series.rows = lines.size();
  std::vector<std::vector<double>> columns(heads.size());
  const std::size_t most = std::max<std::size_t>(2, most_values / heads.size());
  const std::size_t stride = 1 + (lines.empty() ? 0 : (lines.size() - 1) / most);
  for (std::size_t row = 0; row < lines.size(); row += stride) {
    const std::vector<std::string_view> cells = cells_of(lines[row]);
    if (cells.size() != heads.size()) {
      fail_input(fmt::format("{}:{}", name, row + 2), "has " + counted(cells.size(), "column"),
                 fmt::format("expected {}", heads.size()));
    }
    for (std::size_t c = 0; c < heads.size(); ++c) columns[c].push_back(value_of(cells[c]));
  }
  for (std::size_t c = 0; c < heads.size(); ++c) {
    if (c > 0 && !has_number(columns[c])) continue;
    series.names.emplace_back(heads[c]);
    series.columns.push_back(std::move(columns[c]));
  }
  return series;
}

ViewStory view_story(const Scene& scene) {
  ViewStory story;
  story.title = scene.title;
  story.box = scene.box;
  for (const DiskGroup& group : scene.groups) story.groups.push_back(group.name);
  if (!scene.sources.empty()) story.groups.emplace_back(sources_name);
  for (const Source& source : scene.sources) {
    story.sources.push_back({source.side, source.region_low, source.region_high});
  }
  story.obstacles = obstacles_of(scene);
  story.wall_motions = motions_of(scene);
  story.colour = scene.output.look.colour;
  return story;
}

}  // namespace carom
