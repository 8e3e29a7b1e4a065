#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "core/base/input_message.hpp"
#include "io/files/output_folder.hpp"
#include "io/files/shell_word.hpp"
#include "io/trajectory/trajectory_difference.hpp"
#include "io/trajectory/trajectory_reader.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

// The results of a run that depend neither on the engine nor on the machine.
constexpr std::array<const char*, 17> compared_keys{
    "state_hash",   "method",          "seed",           "particles",    "steps",          "time",
    "collisions",   "wall_collisions", "energy_initial", "energy_final", "momentum_drift", "max_overlap",
    "wall_overlap", "pressure",        "collision_rate", "removed",      "emitted"};

// More such results, which an earlier version may not have written, or which only some scenes have.
constexpr std::array<const char*, 15> compared_where_both_have{"heat",
                                                               "thermostat_heat",
                                                               "work",
                                                               "wall_work",
                                                               "wall_push",
                                                               "shear_work",
                                                               "waiting",
                                                               "removed_by",
                                                               "analysis",
                                                               "worst_overlap",
                                                               "worst_overlap_time",
                                                               "worst_overlap_ids",
                                                               "worst_wall_overlap",
                                                               "worst_wall_overlap_time",
                                                               "worst_wall_overlap_ids"};

// The files of one output that are compared: those of a folder, or a single trajectory.
struct Output {
  std::string name;
  fs::path trajectory;  // empty if there is none
  Json summary;         // null if there is none
};

// From a run's folder; null if it has none.
Json summary_in(const std::string& name) {
  std::ifstream file(fs::path(name) / "summary.json");
  if (!file) return nullptr;
  Json summary = Json::parse(file, nullptr, false);
  if (summary.is_object()) return summary;
  fail_input(name + "/summary.json", summary.is_discarded() ? "is not JSON" : "is not a JSON object",
             "expected the summary of a run");
}

Output open_output(const std::string& name) {
  check_present(name);
  std::error_code error;
  if (!fs::is_directory(name, error)) return {name, name, nullptr};
  Output output{name, trajectory_in(name), summary_in(name)};
  if (output.trajectory.empty() && output.summary.is_null()) {
    if (fs::exists(fs::path(name) / unfinished_name, error)) {
      fail_input(name, "holds a run that is not finished",
                 fmt::format("expected a finished run (carom resume {}), or a trajectory in {}", shell_word(name),
                             (fs::path(name) / unfinished_name).string()));
    }
    fail_input(name, "holds neither trajectory.xyz, trajectory.h5 nor summary.json", "expected a folder of a run");
  }
  return output;
}

// The keys with different values in the summaries; empty unless both outputs have one.
std::vector<std::string> different_keys(const Json& a, const Json& b) {
  std::vector<std::string> keys;
  if (a.is_null() || b.is_null()) return keys;
  for (const char* const key : compared_keys) {
    if (a.value(key, Json()) != b.value(key, Json())) keys.emplace_back(key);
  }
  for (const char* const key : compared_where_both_have) {
    if (a.contains(key) && b.contains(key) && a[key] != b[key]) keys.emplace_back(key);
  }
  return keys;
}

std::string text_of(const Difference& d) {
  const std::string place = fmt::format("frame {} (t = {})", d.frame, d.time);
  const std::string_view quantity = d.quantity;
  if (quantity == "frames") return fmt::format("{}: only one has it; {} frames against {}", place, d.a, d.b);
  if (quantity == "disks") return fmt::format("{}: only one has disk {}; {} disks against {}", place, d.id, d.a, d.b);
  if (quantity == "time") return fmt::format("{}: its time is {} against {}", place, d.a, d.b);
  if (quantity == "width" || quantity == "height") {
    return fmt::format("{}: the {} of its box is {} against {}", place, quantity, d.a, d.b);
  }
  if (quantity.starts_with("periodic")) {
    const char* const sides = quantity == "periodic_x" ? "left and right" : "bottom and top";
    return fmt::format("{}: the {} sides of its box are {}, and {} in the other", place, sides,
                       d.a > 0.0 ? "periodic" : "not periodic", d.b > 0.0 ? "are" : "are not");
  }
  return fmt::format("{}, disk {}, {}: {} against {}", place, d.id, d.quantity, d.a, d.b);
}

// The largest difference of each quantity, also within the tolerance.
std::string largest_text(const TrajectoryDifference& d) {
  std::string text;
  for (const auto& largest : d.largest) {
    if (!largest) continue;
    text += fmt::format("  {:<8}differs by at most {:.6g}, in frame {} (t = {}), disk {}\n", largest->quantity,
                        largest->by, largest->frame, largest->time, largest->id);
  }
  return text;
}

// Is the first difference one of times that is larger than rounding? Then the differences that follow are not those of
// the paths.
bool are_of_other_times(const TrajectoryDifference& d) {
  const Difference& first = *d.first;
  return std::string_view(first.quantity) == "time" && std::max(d.frames_a, d.frames_b) > 1 &&
         first.by > 1e-9 * std::max(std::abs(first.a), std::abs(first.b));
}

std::string text_of(const TrajectoryDifference& d) {
  std::string text = fmt::format("different: first in {}\n", text_of(*d.first)) + largest_text(d);
  if (are_of_other_times(d)) {
    text +=
        "  Frames are compared in their order, and from this one on their times differ: --times or --at selects "
        "frames.\n";
  }
  if (d.frames_a != d.frames_b) text += fmt::format("  frames  {} against {}\n", d.frames_a, d.frames_b);
  return text;
}

std::string same_text(const TrajectoryDifference& d, const CompareRule& rule) {
  const std::string how = rule.tolerance ? fmt::format("the same to {:g}", *rule.tolerance) : "same bits";
  std::vector<std::string> fields;
  for (std::size_t q = 0; q < rule.fields.size(); ++q) {
    if (rule.fields[q]) fields.emplace_back(compared_quantities[q]);
  }
  const bool all = fields.size() == rule.fields.size();
  return fmt::format("{} in {} frame{}{}\n", how, d.frames_a, d.frames_a == 1 ? "" : "s",
                     all ? "" : fmt::format(", of {}", fmt::join(fields, ", "))) +
         largest_text(d);
}

std::string text_of(const std::vector<std::string>& keys, const Json& a, const Json& b) {
  std::string text = "different: summary.json\n";
  for (const std::string& key : keys)
    text += fmt::format("  {:<15} {} against {}\n", key, a.value(key, Json()).dump(), b.value(key, Json()).dump());
  return text;
}

Json json_of(const Difference& d) {
  return {{"frame", d.frame}, {"time", d.time}, {"disk", d.id}, {"quantity", d.quantity},
          {"a", d.a},         {"b", d.b},       {"by", d.by}};
}

struct Comparison {
  bool same;
  std::vector<std::string> keys;  // of the summaries, with different values
  std::optional<CompareRule> rule;
  std::optional<TrajectoryDifference> frames;
};

Json largest_json(const TrajectoryDifference& d) {
  Json j = Json::object();
  for (const auto& largest : d.largest) {
    if (largest) j[largest->quantity] = json_of(*largest);
  }
  return j;
}

// For a new key, add a row here.
const JsonKey<Comparison> compare_keys[] = {
    {"same", "", "true if the outputs are the same", [](const Comparison& c) -> Json { return c.same; }},
    {"different_keys", "", "keys of the two summaries that differ", [](const Comparison& c) -> Json { return c.keys; }},
    {"tolerance", "",
     "only with `--tolerance`, `--fields`, `--times` or `--at`: the tolerance, or null if the bits are compared",
     [](const Comparison& c) -> Json {
       if (!c.rule) return absent();
       return c.rule->tolerance ? Json(*c.rule->tolerance) : Json(nullptr);
     }},
    {"frames", "", "only for trajectories: a list of the numbers of frames",
     [](const Comparison& c) -> Json {
       return c.frames ? Json{c.frames->frames_a, c.frames->frames_b} : absent();
     }},
    {"first", "",
     "only for trajectories: the first difference (`frame`, `time`, `disk`, `quantity`, `a`, `b`, `by`), or null",
     [](const Comparison& c) -> Json {
       if (!c.frames) return absent();
       return c.frames->first ? json_of(*c.frames->first) : Json(nullptr);
     }},
    {"largest", "", "only for trajectories: an object with the largest difference of each quantity that differs",
     [](const Comparison& c) -> Json { return c.frames ? largest_json(*c.frames) : absent(); }},
};

int compare(const CompareOptions& options) {
  const Output a = open_output(options.a), b = open_output(options.b);
  const bool both_trajectories = !a.trajectory.empty() && !b.trajectory.empty();
  if (!both_trajectories && (a.summary.is_null() || b.summary.is_null())) {
    fail_input(fmt::format("{} and {}", a.name, b.name), "have nothing in common to compare",
               "expected two trajectories or two summaries");
  }
  if (options.rule && !both_trajectories) {
    fail_input((a.trajectory.empty() ? a : b).name, "holds no trajectory",
               "expected a trajectory: --tolerance, --fields, --times and --at compare trajectories");
  }
  std::optional<TrajectoryDifference> frames;
  if (both_trajectories) {
    frames = compare_trajectories(a.trajectory, b.trajectory, options.rule.value_or(CompareRule{}));
  }
  const std::vector<std::string> keys =
      options.rule ? std::vector<std::string>{} : different_keys(a.summary, b.summary);
  const bool same = keys.empty() && !(frames && frames->first);
  if (options.json) {
    print_out(json_object(compare_keys, {same, keys, options.rule, frames}));
    return same ? 0 : 1;
  }
  if (frames && frames->first) print_out(text_of(*frames));
  if (!keys.empty()) print_out(text_of(keys, a.summary, b.summary));
  if (same && options.rule) print_out(same_text(*frames, *options.rule));
  if (same && frames && !options.rule) print_out(fmt::format("same bits in all {} frames\n", frames->frames_a));
  if (same && !frames) print_out("same summary, state hash included\n");
  return same ? 0 : 1;
}

}  // namespace

// A file that cannot be read, or an answer that cannot be printed, has another status than a difference, which has 1.
int command_compare(const CompareOptions& options) {
  constexpr int not_compared = 2;
  try {
    return compare(options);
  } catch (ReaderGone& error) {
    error.status = not_compared;
    throw;
  } catch (const std::bad_alloc&) {
    print_note("error: out of memory");
  } catch (const std::exception& error) {
    print_note(fmt::format("error: {}", error.what()));
  }
  return not_compared;
}

std::vector<KeyText> compare_key_texts() {
  return key_texts(compare_keys);
}

}  // namespace carom
