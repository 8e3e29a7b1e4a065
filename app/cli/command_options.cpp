#include "app/cli/command_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "app/cli/compare_rule.hpp"
#include "app/cli/option_values.hpp"
#include "core/base/input_message.hpp"
#include "core/load/method_choice.hpp"
#include "core/scene/picture_look.hpp"
#include "core/scene/scene_names.hpp"
#include "run/engine/make_engine.hpp"

namespace carom {

namespace {

SceneChanges changes_of(const OptionWords& words) {
  SceneChanges changes;
  for (const std::string& set : words.sets) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos || equals == 0) {
      fail_input("--set", fmt::format("is {}", in_quotes(set)), "expected KEY=VALUE, as in --set physics.gravity=0.1");
    }
    changes.overrides.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  changes.sets = changes.overrides.size();
  for (std::size_t k = 0; k < scene_options.size(); ++k) {
    if (words.scene_values[k].empty()) continue;
    changes.overrides.push_back({scene_options[k].key, toml_value(scene_options[k].option, words.scene_values[k])});
  }
  return changes;
}

void require(const std::string& value, const char* where, const char* what, const char* example) {
  if (value.empty()) fail_input(where, what, example);
}

std::optional<std::string> file_option(const std::string& value) {
  if (value.starts_with("-")) fail_input("-o", fmt::format("{} is an option", in_quotes(value)), "expected a path");
  return value.empty() ? std::nullopt : std::optional(value);
}

void read_carry_options(const OptionWords& words, CarryOptions& o) {
  o.folder = file_option(words.folder);
  o.changes = changes_of(words);
  o.engine = words.engine;
  if (!words.threads.empty()) o.threads = count_of("--threads", words.threads, most_threads);
  if (!words.ranks.empty()) o.ranks = count_of("--ranks", words.ranks);
  o.max_walltime = walltime_of(words.walltime);
  o.json = words.json;
  o.quiet = words.quiet;
  o.force = words.force;
  o.strict = words.strict;
  o.view = words.view;
}

}  // namespace

RunOptions run_options(const OptionWords& words) {
  require(words.first, "run", "no scene file given", "expected carom run SCENE.toml");
  RunOptions o;
  o.scene = words.first;
  read_carry_options(words, o);
  return o;
}

ResumeOptions resume_options(const OptionWords& words) {
  require(words.first, "resume", "no checkpoint given", "expected carom resume CHECKPOINT");
  ResumeOptions o;
  o.checkpoint = words.first;
  read_carry_options(words, o);
  return o;
}

CheckOptions check_options(const OptionWords& words) {
  require(words.first, "check", "no scene file given", "expected carom check SCENE.toml");
  CheckOptions o;
  o.scene = words.first;
  o.changes = changes_of(words);
  o.json = words.json;
  if (!words.threads.empty()) o.threads = count_of("--threads", words.threads, most_threads);
  if (!words.ranks.empty()) o.ranks = count_of("--ranks", words.ranks);
  if (words.accuracy.empty()) return o;
  o.accuracy = number_of("--accuracy", words.accuracy);
  if (*o.accuracy > 0.0 && *o.accuracy <= most_accuracy) return o;
  fail_input("--accuracy", fmt::format("is {}", *o.accuracy),
             fmt::format("expected a relative error above 0 and at most {}", most_accuracy));
}

CompareOptions compare_options(const OptionWords& words) {
  require(words.second, "compare", "two outputs are needed", "expected carom compare A B");
  return {words.first, words.second, compare_rule(words.tolerance, words.fields, words.times, words.at), words.json};
}

RenderOptions render_options(const OptionWords& words) {
  require(words.first, "render", "no folder given", "expected carom render DIR");
  RenderOptions o;
  o.source = words.first;
  o.file = file_option(words.folder);
  o.quiet = words.quiet;
  o.force = words.force;
  if (!words.frame.empty()) o.frame = count_of("--frame", words.frame);
  if (!words.colour.empty()) {
    const auto* const name = std::find(colour_names.begin(), colour_names.end(), words.colour);
    if (name == colour_names.end()) {
      fail_input("--colour", fmt::format("there is no {}", in_quotes(words.colour)),
                 expected_one_of(colour_names, words.colour));
    }
    o.colour = static_cast<ColourBy>(name - colour_names.begin());
  }
  if (!words.range.empty()) o.range = pair_of("--range", words.range, ':', "expected LOW:HIGH, as in 0:2");
  if (!words.size.empty()) {
    const auto size = pair_of("--size", words.size, 'x', "expected WIDTHxHEIGHT, as in 1280x720");
    const std::string complaint = complaint_of_size(size[0], size[1]);
    if (!complaint.empty()) fail_input("--size", fmt::format("is {}", in_quotes(words.size)), complaint);
    o.size = {static_cast<int>(size[0]), static_cast<int>(size[1])};
  }
  if (!words.fps.empty()) {
    o.fps = number_of("--fps", words.fps);
    const std::string complaint = complaint_of_fps(*o.fps);
    if (!complaint.empty()) fail_input("--fps", fmt::format("is {}", in_quotes(words.fps)), complaint);
  }
  return o;
}

ViewOptions view_options(const OptionWords& words) {
  require(words.first, "view", "no folder given", "expected carom view DIR");
  ViewOptions o{words.first, file_option(words.folder), std::nullopt, words.open, words.live, words.quiet, words.force};
  if (!words.max_size.empty()) o.max_size = size_of("--max-size", words.max_size);
  return o;
}

SweepOptions sweep_options(const OptionWords& words) {
  require(words.first, "sweep", "no scene file given", "expected carom sweep SCENE.toml --over KEY=FROM:TO:COUNT");
  SweepOptions o;
  o.scene = words.first;
  o.folder = file_option(words.folder);
  o.changes = changes_of(words);
  o.over = words.over;
  if (!words.seeds.empty()) o.seeds = count_of("--seeds", words.seeds);
  if (!words.jobs.empty()) o.jobs = count_of("--jobs", words.jobs);
  if (!words.ranks.empty()) o.ranks = count_of("--ranks", words.ranks);
  constexpr std::array<std::string_view, 2> scripts{"slurm", "parallel"};
  if (!words.emit.empty() && std::find(scripts.begin(), scripts.end(), words.emit) == scripts.end()) {
    fail_input("--emit", fmt::format("is {}", in_quotes(words.emit)), expected_one_of(scripts, words.emit));
  }
  o.emit = words.emit;
  o.force = words.force;
  if (o.over.empty() && words.seeds.empty()) {
    fail_input("sweep", "nothing to sweep over", "expected --over KEY=FROM:TO:COUNT, or --seeds N");
  }
  return o;
}

ChartOptions chart_options(const OptionWords& words) {
  ChartOptions o{
      file_option(words.folder), words.first, changes_of(words), words.quick, words.tiny, words.quiet, words.force};
  if (!o.scene.empty() || o.changes.overrides.empty()) return o;
  fail_input("chart", "changes of a scene are given, but no scene", "expected --scene SCENE.toml with them");
}

DocsOptions docs_options(const OptionWords& words) {
  constexpr std::array<std::string_view, 1> pages{"scene"};
  require(words.first, "docs", "no page given", "expected carom docs scene");
  if (words.first == pages[0]) return DocsOptions{DocsOptions::Page::scene};
  fail_input("docs", fmt::format("there is no page {}", in_quotes(words.first)), expected_one_of(pages, words.first));
}

}  // namespace carom
