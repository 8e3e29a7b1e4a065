#include "app/tools/scene_page.hpp"

#include <fmt/format.h>

#include "app/cli/commands.hpp"
#include "app/run/check_report.hpp"
#include "core/scene/scene_keys.hpp"
#include "core/scene/scene_ranges.hpp"
#include "io/tables/series.hpp"
#include "run/results/summary.hpp"

namespace carom {

namespace {

constexpr std::string_view beginning =
    R"(# The scene file

`carom docs scene` prints this page, from the tables that read scenes and write results. Do not edit it by hand.

A scene is a [TOML](https://toml.io) file with a title and a seed, tables (`[box]`), and lists of tables (`[[disks]]`).
A key that is not on this page is an error; it is never ignored. No unit is built in: choose the units of length, time
and mass, and all others follow from them (k_B = 1). Any key can be set on the command line, as in `--set
physics.gravity=0.5` or `--set disks.0.count=100`. The smallest scene:

```toml
[box]
width = 100.0
height = 100.0

[[disks]]
count = 1000
positions = "random"
velocities = { maxwell = 1.0 }
radius = 0.5
mass = 1.0

[run]
t_end = 10.0
```
)";

std::string kind_text(const SceneKey& key) {
  switch (key.kind) {
    case KeyKind::number:
      return "a number";
    case KeyKind::positive:
      return "a number above 0";
    case KeyKind::non_negative:
      return "a number, 0 or more";
    case KeyKind::unit_interval:
      return "a number from 0 to 1";
    case KeyKind::count:
      return "a whole number, 0 or more";
    case KeyKind::ordinal:
      return "a whole number, 1 or more";
    case KeyKind::flag:
      return "`true` or `false`";
    default:
      return "text";
  }
}

std::string names_text(const SceneKey& key) {
  std::string text;
  for (const std::string_view name : key.names) text += fmt::format("{}`\"{}\"`", text.empty() ? "" : ", ", name);
  return text;
}

// The allowed values; NAMES in the text stands for the row's names.
std::string allowed_text(const SceneKey& key) {
  constexpr std::string_view place = "NAMES";
  std::string text(key.allowed);
  if (text.empty()) return key.names.empty() ? kind_text(key) : names_text(key);
  const std::size_t at = text.find(place);
  return at == std::string::npos ? text : text.replace(at, place.size(), names_text(key));
}

// A default is set as code if it is TOML, but not if it is words.
std::string initial_text(std::string_view initial) {
  constexpr std::string_view code = "0123456789\"[";
  if (initial.empty()) return "";
  const bool value = code.find(initial.front()) != std::string_view::npos || initial == "true" || initial == "false";
  return value ? fmt::format("`{}`", initial) : std::string(initial);
}

std::string key_rows(std::string_view table) {
  std::string text = "| key | values | unit | default | meaning | example |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const SceneKey& key : scene_keys()) {
    if (key.table != table) continue;
    text += fmt::format("| `{}` | {} | {} | {} | {} | `{}` |\n", key.name, allowed_text(key),
                        magnitudes_of(key.dimension).unit, initial_text(key.initial), key.meaning, key.example);
  }
  return text;
}

std::string range_rows() {
  std::string text =
      "\n## Ranges\n\nNumbers that would overflow or vanish in the formulas are refused. 0 is allowed if the key "
      "allows it.\n\n| what | unit | from | to | why |\n| --- | --- | --- | --- | --- |\n";
  for (const Magnitudes& m : magnitudes) {
    if (m.dimension == Dimension::none) continue;
    text += fmt::format("| {} | {} | {} | {} | {} |\n", m.noun, m.unit, m.least, m.most, m.why);
  }
  text += "\nRatios and products are bounded, too:\n\n| what | at most | why |\n| --- | --- | --- |\n";
  for (const Proportion& p : proportions) text += fmt::format("| {} | {:g} | {} |\n", p.what, p.most, p.why);
  return text;
}

std::string series_rows() {
  std::string text =
      "\n## Columns of series.csv\n\n`series = true` in `[output]` writes one row for each frame.\n\n- Numbers have "
      "all the digits that are needed to read them back unchanged.\n- trajectory.h5 has the same quantities under "
      "`/observables`, except for `displacement`, the disks removed by each sink, heat and work of sides, inner walls "
      "and a thermostat, and the quantities of a shear flow.\n- The state in a row is the state at its time. Counts "
      "and sums since the start, and means since the row before, extend to the end of the step or window that contains "
      "this time. With `exact` that is later by at most about two collisions of each disk (32 in all if there are few "
      "disks).\n- Rows within one window of `exact` repeat the means. The plain average of such rows is not the "
      "average over time. For averages, take rows further apart than the length of a window, or use `[analysis]`, "
      "which weights pressure and collision rate by the length of the intervals.\n\n| column | unit | meaning |\n| --- "
      "| --- | --- |\n| `t` | time | simulated time |\n";
  for (const SeriesColumn& column : series_columns) {
    text += fmt::format("| `{}` | {} | {} |\n", column.name, column.unit, column.meaning);
  }
  text += fmt::format(
      "| `{}` | length^2 | mean square displacement since the first sample; only if `[analysis]` measures it |\n",
      displacement_column);
  text += fmt::format("| `{}_left`, ..., `{}_walls.0`, ... | {} | {}; one column for each sink |\n", taken_column.name,
                      taken_column.name, taken_column.unit, taken_column.meaning);
  text += fmt::format("| `{}_left`, ... | {} | {}; one column for each thermal side |\n", heat_column.name,
                      heat_column.unit, heat_column.meaning);
  text += fmt::format("| `{}_left`, ... | {} | {}; one column for each moving side |\n", work_column.name,
                      work_column.unit, work_column.meaning);
  for (const ColumnText& column : wall_columns) {
    text += fmt::format("| `{}` | {} | {}; only with such walls |\n", column.name, column.unit, column.meaning);
  }
  text += fmt::format("| `{}` | {} | {}; only with a thermostat |\n", thermostat_column.name, thermostat_column.unit,
                      thermostat_column.meaning);
  for (const ColumnText& column : rotation_columns) {
    text += fmt::format("| `{}` | {} | {} |\n", column.name, column.unit, column.meaning);
  }
  for (const ColumnText& column : shear_columns) {
    text += fmt::format("| `{}` | {} | {}; only with `shear_rate` |\n", column.name, column.unit, column.meaning);
  }
  text +=
      "\nThen follow these columns for each `[[disks]]` block with a `name`; if there is one, also for `sources`, if "
      "the scene has any. The name of the group is appended, as in `temperature_tracer`:\n\n| column | unit | meaning "
      "|\n| --- | --- | --- |\n";
  for (const GroupColumn& column : group_column_kinds()) {
    text += fmt::format("| `{}_` | {} | {} |\n", column.name, column.unit, column.meaning);
  }
  return text;
}

std::string json_rows(std::string_view heading, std::string_view meaning, const std::vector<KeyText>& keys) {
  std::string text = fmt::format("\n{}\n\n{}\n\n| key | unit | meaning |\n| --- | --- | --- |\n", heading, meaning);
  for (const KeyText& key : keys) text += fmt::format("| `{}` | {} | {} |\n", key.name, key.unit, key.meaning);
  return text;
}

std::string json_sections() {
  return json_rows("## Keys of `run --json` and summary.json",
                   "`carom run --json` and `carom resume --json` print one object, and nothing else on standard "
                   "output. summary.json in the results is the same object. A number that is not finite is null.",
                   summary_key_texts()) +
         json_rows("### The object `traffic`", "Only with several ranks.", traffic_key_texts()) +
         json_rows("## Keys of `check --json`",
                   "The predictions of `carom check`, which does not run the scene to its end.", check_key_texts()) +
         json_rows("### The object `ranks`", "Only with `--ranks`.", check_rank_key_texts()) +
         json_rows("## Keys of `compare --json`", "The result of the comparison of two outputs.", compare_key_texts());
}

}  // namespace

std::string scene_page() {
  std::string text(beginning);
  for (const SceneTable& table : scene_tables()) {
    text += fmt::format("\n## {}\n\n", table.heading);
    if (!table.meaning.empty()) text += fmt::format("{}\n\n", table.meaning);
    text += key_rows(table.name);
  }
  return text + range_rows() + series_rows() + json_sections();
}

}  // namespace carom
