#include "app/sweep/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

// What a row of sweep.csv takes from each run's summary, after the keys of the sweep and the seed. Of a list, as the
// warnings are, it takes the number of entries.
constexpr std::array<const char*, 18> table_keys{
    "particles",    "steps",          "time",        "collisions",   "wall_collisions", "energy_initial",
    "energy_final", "momentum_drift", "max_overlap", "wall_overlap", "pressure",        "collision_rate",
    "removed",      "emitted",        "waiting",     "warnings",     "step_s",          "state_hash"};
// What only some scenes have; of sides an object.
constexpr std::array<const char*, 5> energy_keys{"heat", "thermostat_heat", "work", "wall_work", "shear_work"};

struct EnergyColumn {
  std::string key, side;  // side: empty where the summary has a number
  bool operator==(const EnergyColumn&) const = default;
};

std::string cell_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_array()) return fmt::format("{}", value.size());
  return value.is_null() ? "" : value.dump();
}

// In quotes, and quotes doubled, where it would be read as several (RFC 4180).
std::string csv_cell(const std::string& value) {
  if (value.find_first_of(",\"") == std::string::npos) return value;
  std::string cell = "\"";
  for (const char c : value) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + '"';
}

// Those that any run has.
std::vector<EnergyColumn> energy_columns(const std::vector<SweepRow>& rows) {
  std::vector<EnergyColumn> columns;
  const auto add = [&](const EnergyColumn& column) {
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
  };
  for (const char* const key : energy_keys) {
    for (const SweepRow& row : rows) {
      const auto value = row.summary.find(key);
      if (value == row.summary.end()) continue;
      if (value->is_object()) {
        for (const auto& side : value->items()) add({key, side.key()});
      } else {
        add({key, ""});
      }
    }
  }
  return columns;
}

std::string table_head(const std::vector<SweepAxis>& axes, const std::vector<EnergyColumn>& energies) {
  std::string text = "run";
  for (const SweepAxis& axis : axes) text += "," + axis.key;
  text += ",seed";
  for (const char* const key : table_keys) text += fmt::format(",{}", key);
  for (const EnergyColumn& e : energies) text += fmt::format(",{}{}{}", e.key, e.side.empty() ? "" : "_", e.side);
  return text + '\n';
}

std::string table_row(const SweepRow& row, std::size_t axes, const std::vector<EnergyColumn>& energies) {
  const std::vector<Override>& changes = row.run->overrides;
  std::string text = row.run->name;
  for (auto change = changes.end() - static_cast<std::ptrdiff_t>(axes + 1); change != changes.end(); ++change) {
    text += "," + csv_cell(change->value);
  }
  for (const char* const key : table_keys) text += "," + cell_of(row.summary.value(key, Json()));
  for (const EnergyColumn& e : energies) {
    const Json value = row.summary.value(e.key, Json());
    text += "," + cell_of(e.side.empty() || !value.is_object() ? value : value.value(e.side, Json()));
  }
  return text + "\n";
}

}  // namespace

std::string sweep_table(const std::vector<SweepAxis>& axes, const std::vector<SweepRow>& rows) {
  const std::vector<EnergyColumn> energies = energy_columns(rows);
  std::string text = table_head(axes, energies);
  for (const SweepRow& row : rows) text += table_row(row, axes.size(), energies);
  return text;
}

}  // namespace carom
