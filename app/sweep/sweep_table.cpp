#include "app/sweep/sweep_table.hpp"

#include <fmt/format.h>

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

}  // namespace

std::string table_head(const std::vector<SweepAxis>& axes) {
  std::string text = "run";
  for (const SweepAxis& axis : axes) text += "," + axis.key;
  text += ",seed";
  for (const char* const key : table_keys) text += fmt::format(",{}", key);
  return text + '\n';
}

std::string table_row(const SweepRun& run, std::size_t axes, const Json& summary) {
  std::string row = run.name;
  for (auto change = run.overrides.end() - static_cast<std::ptrdiff_t>(axes + 1); change != run.overrides.end();
       ++change) {
    row += "," + csv_cell(change->value);
  }
  for (const char* const key : table_keys) {
    const Json value = summary.value(key, Json());
    row += "," + cell_of(value);
  }
  return row + "\n";
}

}  // namespace carom
