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

Made by `carom docs scene` from the tables that read scenes and write results; not edited by hand.

A scene is a [TOML](https://toml.io) file: a title and a seed, tables (`[box]`), and lists of tables (`[[disks]]`). A key that is not on this page is an error, never ignored. No unit is built in: lengths, times and masses are
the scene's own, and all else follows from them (k_B = 1). Any key can be set on the command line, as in `--set
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
  std::string text =
      "| key | what it may be | unit | default | what it is | example |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const SceneKey& key : scene_keys()) {
    if (key.table != table) continue;
    text += fmt::format("| `{}` | {} | {} | {} | {} | `{}` |\n", key.name, allowed_text(key),
                        magnitudes_of(key.dimension).unit, initial_text(key.initial), key.meaning, key.example);
  }
  return text;
}

std::string range_rows() {
  std::string text =
      "\n## Ranges\n\nNumbers that would overflow or vanish in the formulas are refused. 0 is allowed where a key "
      "allows it.\n\n| what | unit | from | to | why |\n| --- | --- | --- | --- | --- |\n";
  for (const Magnitudes& m : magnitudes) {
    if (m.dimension == Dimension::none) continue;
    text += fmt::format("| {} | {} | {} | {} | {} |\n", m.noun, m.unit, m.least, m.most, m.why);
  }
  text += "\nAgainst each other:\n\n| what | at most | why |\n| --- | --- | --- |\n";
  for (const Proportion& p : proportions) text += fmt::format("| {} | {:g} | {} |\n", p.what, p.most, p.why);
  return text;
}

std::string series_rows() {
  std::string text =
      "\n## Columns of series.csv\n\n`series = true` in `[output]` writes one row a frame; trajectory.h5 has the same "
      "under `/observables`, without `displacement`, what each sink took, heat and work of sides, what inner walls "
      "and a thermostat give, and what there is only with `shear_rate`. Numbers have all digits that they need to be "
      "read back as they were. The state of a row is that of its time; what is counted or summed since the start, and "
      "means since the row before, are up to the end of the step or window that this time lies in, with `exact` about "
      "two collisions a disk later at most (32 in all where disks are few); rows within one window of it repeat the "
      "means. So their plain average over such rows is not that over time: take rows further apart than windows are "
      "long, or `[analysis]`, which counts pressure and collision rate by the length of intervals.\n\n"
      "| column | unit | what it is |\n| --- | --- | --- |\n| `t` | time | simulated time |\n";
  for (const SeriesColumn& column : series_columns) {
    text += fmt::format("| `{}` | {} | {} |\n", column.name, column.unit, column.meaning);
  }
  text += fmt::format(
      "| `{}` | length^2 | mean square displacement since the first sample, where `[analysis]` asks for it |\n",
      displacement_column);
  text += fmt::format("| `{}_left`, likewise of other sides, and `{}_walls.0`, ... | {} | {}; a column a sink |\n",
                      taken_column.name, taken_column.name, taken_column.unit, taken_column.meaning);
  text += fmt::format("| `{}_left`, likewise `_right`, `_bottom`, `_top` | {} | {}; a column a thermal side |\n",
                      heat_column.name, heat_column.unit, heat_column.meaning);
  text += fmt::format("| `{}_left`, likewise | {} | {}; a column a side that moves |\n", work_column.name,
                      work_column.unit, work_column.meaning);
  for (const ColumnText& column : wall_columns) {
    text += fmt::format("| `{}` | {} | {}; only with such walls |\n", column.name, column.unit, column.meaning);
  }
  text += fmt::format("| `{}` | {} | {}; only with one |\n", thermostat_column.name, thermostat_column.unit,
                      thermostat_column.meaning);
  for (const ColumnText& column : rotation_columns) {
    text += fmt::format("| `{}` | {} | {} |\n", column.name, column.unit, column.meaning);
  }
  for (const ColumnText& column : shear_columns) {
    text += fmt::format("| `{}` | {} | {}; only with `shear_rate` |\n", column.name, column.unit, column.meaning);
  }
  text +=
      "\nThen, for each `[[disks]]` block with a `name`, and beside such blocks for `sources` if there are any, "
      "these with `_` and the name behind, as in `temperature_tracer`:\n\n| column | unit | what it is |\n| --- | --- "
      "| --- |\n";
  for (const GroupColumn& column : group_column_kinds()) {
    text += fmt::format("| `{}_` | {} | {} |\n", column.name, column.unit, column.meaning);
  }
  return text;
}

std::string json_rows(std::string_view heading, std::string_view meaning, const std::vector<KeyText>& keys) {
  std::string text =
      fmt::format("\n## {}\n\n{}\n\n| key | unit | what it is |\n| --- | --- | --- |\n", heading, meaning);
  for (const KeyText& key : keys) text += fmt::format("| `{}` | {} | {} |\n", key.name, key.unit, key.meaning);
  return text;
}

std::string json_sections() {
  return json_rows(
             "Keys of `run --json` and summary.json",
             "`carom run --json` and `carom resume --json` print one object, and nothing else on standard output; "
             "summary.json in the results is the same. A number that is not finite is null.",
             summary_key_texts()) +
         json_rows("Keys of `check --json`", "What is predicted, without a run.", check_key_texts()) +
         json_rows("Keys of `compare --json`", "Two outputs against each other.", compare_key_texts());
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
