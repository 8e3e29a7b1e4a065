#include "app/sweep/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

// The keys of each run's summary in a row of sweep.csv, after the keys of the sweep and the seed. For a list, such as
// the warnings, the column is the number of entries.
constexpr std::array<const char*, 18> table_keys{
    "particles",    "steps",          "time",        "collisions",   "wall_collisions", "energy_initial",
    "energy_final", "momentum_drift", "max_overlap", "wall_overlap", "pressure",        "collision_rate",
    "removed",      "emitted",        "waiting",     "warnings",     "step_s",          "state_hash"};
// Keys that only some scenes have; those of sides, sinks and an analysis are objects.
constexpr std::array<const char*, 7> special_keys{"removed_by", "heat",       "thermostat_heat", "work",
                                                  "wall_work",  "shear_work", "analysis"};

struct SpecialColumn {
  std::string key, part;  // part: a side, a sink or a measured quantity; empty if the summary has a number
  bool operator==(const SpecialColumn&) const = default;
};

std::string cell_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_array()) return fmt::format("{}", value.size());
  return value.is_null() ? "" : value.dump();
}

// Quotes a value, with quotes in it doubled, if it would otherwise be read as several (RFC 4180).
std::string csv_cell(const std::string& value) {
  if (value.find_first_of(",\"") == std::string::npos) return value;
  std::string cell = "\"";
  for (const char c : value) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + '"';
}

// The special columns that any of the runs has.
std::vector<SpecialColumn> special_columns(const std::vector<SweepRow>& rows) {
  std::vector<SpecialColumn> columns;
  const auto add = [&](const SpecialColumn& column) {
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
  };
  for (const char* const key : special_keys) {
    for (const SweepRow& row : rows) {
      const auto value = row.summary.find(key);
      if (value == row.summary.end()) continue;
      if (value->is_object()) {
        for (const auto& part : value->items()) add({key, part.key()});
      } else {
        add({key, ""});
      }
    }
  }
  return columns;
}

std::string table_head(const std::vector<SweepAxis>& axes, const std::vector<SpecialColumn>& specials) {
  std::string text = "run";
  for (const SweepAxis& axis : axes) text += "," + axis.key;
  text += ",seed";
  for (const char* const key : table_keys) text += fmt::format(",{}", key);
  for (const SpecialColumn& c : specials) text += fmt::format(",{}{}{}", c.key, c.part.empty() ? "" : "_", c.part);
  return text + '\n';
}

std::string table_row(const SweepRow& row, std::size_t axes, const std::vector<SpecialColumn>& specials) {
  const std::vector<Override>& changes = row.run->overrides;
  std::string text = row.run->name;
  for (auto change = changes.end() - static_cast<std::ptrdiff_t>(axes + 1); change != changes.end(); ++change) {
    text += "," + csv_cell(change->value);
  }
  for (const char* const key : table_keys) text += "," + cell_of(row.summary.value(key, Json()));
  for (const SpecialColumn& c : specials) {
    const Json value = row.summary.value(c.key, Json());
    text += "," + cell_of(c.part.empty() || !value.is_object() ? value : value.value(c.part, Json()));
  }
  return text + "\n";
}

}  // namespace

std::string sweep_table(const std::vector<SweepAxis>& axes, const std::vector<SweepRow>& rows) {
  const std::vector<SpecialColumn> specials = special_columns(rows);
  std::string text = table_head(axes, specials);
  for (const SweepRow& row : rows) text += table_row(row, axes.size(), specials);
  return text;
}

}  // namespace carom
