#include "app/cli/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "app/cli/command_words.hpp"
#include "app/cli/compare_rule.hpp"
#include "app/cli/option_complaints.hpp"
#include "app/cli/option_values.hpp"
#include "core/base/build_version.hpp"
#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/load/method_choice.hpp"
#include "core/scene/picture_look.hpp"
#include "core/scene/scene_names.hpp"
#include "io/trajectory/scene_frame_reader.hpp"

namespace carom {

namespace {

// Options that are changes to the scene, and the key that each changes.
struct SceneOption {
  const char* option;
  const char* key;
  const char* value;  // how --help calls it
  const char* help;
};
constexpr std::array<SceneOption, 4> scene_options{{
    {"--method", "run.method", "rollback|pairwise|exact|auto", "method, in place of the scene's"},
    {"--dt", "run.dt", "X", "time step"},
    {"--t-end", "run.t_end", "T", "simulated time at which the run ends"},
    {"--seed", "seed", "S", "seed of all random numbers"},
}};

constexpr std::size_t t_end_option = 2;  // its place among them

// What CLI11 reads; checked and turned into a Command afterwards, so that all messages are ours.
struct Words {
  std::string first, second, folder, engine, threads, frame, walltime, seeds, jobs, emit, accuracy, tolerance, fields,
      times, at, colour, range, size, fps, max_size;
  std::array<std::string, scene_options.size()> scene_values;
  std::vector<std::string> sets, over;
  bool json = false, quiet = false, force = false, strict = false, quick = false, tiny = false, open = false,
       live = false, view = false;
};

SceneChanges changes_of(const Words& words) {
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

// Adds an option with one value; given twice, the last one counts.
void add_value(CLI::App* command, const std::string& names, std::string& value, const std::string& placeholder,
               const std::string& help) {
  command->add_option(names, value, help)
      ->type_name(placeholder)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

void add_scene_changes(CLI::App* command, Words& words) {
  for (std::size_t k = 0; k < scene_options.size(); ++k) {
    const SceneOption& o = scene_options[k];
    add_value(command, o.option, words.scene_values[k], o.value, o.help);
  }
  command->add_option("--set", words.sets, "change any key of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_scene_options(CLI::App* command, Words& words) {
  command->add_option("SCENE", words.first, "scene file (TOML)")->type_name("");
  add_scene_changes(command, words);
}

constexpr const char* early_stop =
    "Ctrl-C, SIGTERM and --max-walltime write a checkpoint and stop with status 4; SIGUSR1 writes one and goes on. A "
    "second Ctrl-C quits at once.";

// What carrying a run out has, from its start or from a checkpoint.
void add_run_options(CLI::App* run, Words& words) {
  add_value(run, "--engine", words.engine, "parallel|reference", "default parallel; both give the same bits");
  add_value(run, "--threads", words.threads, "N", "threads of the parallel engine; default all cores");
  add_value(run, "--max-walltime", words.walltime, "TIME",
            "stop with a checkpoint after so long, such as 90 s, 30 min or 2h");
  run->add_flag("--json", words.json, "print the summary as JSON, and nothing else, on standard output");
  run->add_flag("--quiet", words.quiet, "print nothing but errors");
  run->add_flag("--force", words.force, "replace the results of an earlier run in the folder");
  run->add_flag("--view", words.view, "when done, make DIR/view.html, which plays the run, and open it in the browser");
  run->add_flag("--strict", words.strict, "end with status 3 at the first warning of a limit of the method");
}

void describe_run(CLI::App* run, Words& words) {
  add_scene_options(run, words);
  add_value(run, "-o,--output", words.folder, "DIR", "folder for the results; default out/<name of the scene>");
  add_run_options(run, words);
  run->footer(early_stop);
}

void describe_resume(CLI::App* resume, Words& words) {
  resume->add_option("CHECKPOINT", words.first, "checkpoint.carom, or the folder of the run that wrote it")
      ->type_name("");
  add_value(resume, "-o,--output", words.folder, "DIR", "another folder, which gets copies of the files so far");
  add_value(resume, "--t-end", words.scene_values[t_end_option], "T", "another simulated time at which the run ends");
  add_run_options(resume, words);
  resume->footer(early_stop);
}

void describe_compare(CLI::App* compare, Words& words) {
  compare->add_option("A", words.first, "folder of a run, or a trajectory")->type_name("");
  compare->add_option("B", words.second, "the other one")->type_name("");
  add_value(compare, "--tolerance", words.tolerance, "X", "values that differ by at most X count as the same");
  add_value(compare, "--fields", words.fields, "x,y,...", "only these of x, y, vx, vy, radius, mass");
  add_value(compare, "--times", words.times, "T0:T1", "only frames of these times; either may be left out");
  add_value(compare, "--at", words.at, "T", "only the frame of each that is nearest to this time");
  compare->add_flag("--json", words.json, "print the result as JSON");
  compare->footer(
      "Without these options every bit of the trajectories counts, and what the summaries say; with any of them only "
      "the trajectories do.\nExit status: 0 the same, 1 different, 2 they cannot be compared.");
}

void describe_render(CLI::App* render, Words& words) {
  render->add_option("DIR", words.first, "folder of a run with a trajectory, or a trajectory")->type_name("");
  add_value(
      render, "-o,--output", words.folder, "FILE",
      "a movie (.mp4, .webm, .gif) or a picture (.png, .svg); default DIR/movie.mp4, or DIR/frame_K.png with --frame");
  add_value(render, "--frame", words.frame, "K", "picture of the K-th frame, counted from 1; default the last");
  add_value(render, "--colour", words.colour, "speed|group|radius|mass|id", "what the colour of a disk stands for");
  add_value(render, "--range", words.range, "LOW:HIGH", "ends of the colour scale; default as all frames ask");
  add_value(render, "--size", words.size, "WIDTHxHEIGHT", "of the picture, in pixels");
  add_value(render, "--fps", words.fps, "N", "frames a second; default 25");
  render->add_flag("--quiet", words.quiet, "print nothing but errors");
  render->add_flag("--force", words.force, "replace an existing file");
}

void describe_view(CLI::App* view, Words& words) {
  view->add_option("DIR", words.first, "folder of a run with a trajectory, or a trajectory")->type_name("");
  add_value(view, "-o,--output", words.folder, "FILE", "the page; default DIR/view.html");
  add_value(view, "--max-size", words.max_size, "SIZE",
            "leave out frames, then disks, until the page is no longer than this; default 64MB");
  view->add_flag("--open", words.open, "open it in the browser");
  view->add_flag("--live", words.live,
                 "serve a run that is going on to this computer's own browsers, and write no file");
  view->add_flag("--quiet", words.quiet, "print nothing but errors");
  view->add_flag("--force", words.force, "replace an existing file");
  view->footer("One file that plays the run in any browser, and asks the network for nothing. See docs/viewer.md.");
}

void describe_sweep(CLI::App* sweep, Words& words) {
  add_scene_options(sweep, words);
  sweep->add_option("--over", words.over, "values of one key of the scene; may be repeated, for a grid")
      ->type_name("KEY=FROM:TO:COUNT|KEY=A,B,...")
      ->allow_extra_args(false);
  add_value(sweep, "--seeds", words.seeds, "N", "so many seeds for each combination, from the scene's on; default 1");
  add_value(sweep, "-o,--output", words.folder, "DIR", "folder of the sweep; default out/<name of the scene>_sweep");
  add_value(sweep, "--jobs", words.jobs, "N", "runs at the same time; default one a core");
  add_value(sweep, "--emit", words.emit, "slurm|parallel", "write a script that runs it elsewhere, and run nothing");
  sweep->add_flag("--force", words.force, "replace another sweep in the folder");
  sweep->footer("Called again, it goes on where it stopped. sweep.csv has a row a run.");
}

void describe_chart(CLI::App* chart, Words& words) {
  add_value(chart, "--scene", words.first, "SCENE.toml", "of this scene, in place of the seven built in");
  add_scene_changes(chart, words);
  add_value(chart, "-o,--output", words.folder, "DIR",
            "folder for chart.svg, .png, .csv and .json; default out/chart, or out/chart_<name of the scene>");
  chart->add_flag("--quick", words.quick, "fewer points, within a minute");
  chart->add_flag("--tiny", words.tiny, "a test of the command itself")->group("");
  chart->add_flag("--quiet", words.quiet, "print nothing but errors");
  chart->add_flag("--force", words.force, "replace an earlier chart in the folder");
  chart->footer(
      "--scene takes scenes whose disks stay, collide, and can be run by exact; their own --dt is one of the steps. "
      "See "
      "docs/chart.md.");
}

void require(const std::string& value, const char* where, const char* what, const char* example) {
  if (value.empty()) fail_input(where, what, example);
}

std::optional<std::string> file_option(const std::string& value) {
  if (value.starts_with("-")) fail_input("-o", fmt::format("{} is an option", in_quotes(value)), "expected a path");
  return value.empty() ? std::nullopt : std::optional(value);
}

void read_carry_options(const Words& words, CarryOptions& o) {
  o.folder = file_option(words.folder);
  o.changes = changes_of(words);
  o.engine = words.engine;
  if (!words.threads.empty()) o.threads = count_of("--threads", words.threads);
  o.max_walltime = walltime_of(words.walltime);
  o.json = words.json;
  o.quiet = words.quiet;
  o.force = words.force;
  o.strict = words.strict;
  o.view = words.view;
}

RunOptions run_options(const Words& words) {
  require(words.first, "run", "no scene file given", "expected carom run SCENE.toml");
  RunOptions o;
  o.scene = words.first;
  read_carry_options(words, o);
  return o;
}

ResumeOptions resume_options(const Words& words) {
  require(words.first, "resume", "no checkpoint given", "expected carom resume CHECKPOINT");
  ResumeOptions o;
  o.checkpoint = words.first;
  read_carry_options(words, o);
  return o;
}

CheckOptions check_options(const Words& words) {
  require(words.first, "check", "no scene file given", "expected carom check SCENE.toml");
  CheckOptions o{words.first, changes_of(words), std::nullopt, words.json};
  if (words.accuracy.empty()) return o;
  o.accuracy = number_of("--accuracy", words.accuracy);
  if (*o.accuracy > 0.0 && *o.accuracy <= most_accuracy) return o;
  fail_input("--accuracy", fmt::format("is {}", *o.accuracy),
             fmt::format("expected a relative error above 0 and at most {}", most_accuracy));
}

CompareOptions compare_options(const Words& words) {
  require(words.second, "compare", "two outputs are needed", "expected carom compare A B");
  return {words.first, words.second, compare_rule(words.tolerance, words.fields, words.times, words.at), words.json};
}

RenderOptions render_options(const Words& words) {
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

ViewOptions view_options(const Words& words) {
  require(words.first, "view", "no folder given", "expected carom view DIR");
  ViewOptions o{words.first, file_option(words.folder), std::nullopt, words.open, words.live, words.quiet, words.force};
  if (!words.max_size.empty()) o.max_size = size_of("--max-size", words.max_size);
  return o;
}

SweepOptions sweep_options(const Words& words) {
  require(words.first, "sweep", "no scene file given", "expected carom sweep SCENE.toml --over KEY=FROM:TO:COUNT");
  SweepOptions o;
  o.scene = words.first;
  o.folder = file_option(words.folder);
  o.changes = changes_of(words);
  o.over = words.over;
  if (!words.seeds.empty()) o.seeds = count_of("--seeds", words.seeds);
  if (!words.jobs.empty()) o.jobs = count_of("--jobs", words.jobs);
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

ChartOptions chart_options(const Words& words) {
  ChartOptions o{
      file_option(words.folder), words.first, changes_of(words), words.quick, words.tiny, words.quiet, words.force};
  if (!o.scene.empty() || o.changes.overrides.empty()) return o;
  fail_input("chart", "changes to a scene, and no scene", "expected --scene SCENE.toml with them");
}

DocsOptions docs_options(const Words& words) {
  constexpr std::array<std::string_view, 1> pages{"scene"};
  require(words.first, "docs", "no page given", "expected carom docs scene");
  if (words.first == pages[0]) return DocsOptions{DocsOptions::Page::scene};
  fail_input("docs", fmt::format("there is no page {}", in_quotes(words.first)), expected_one_of(pages, words.first));
}

}  // namespace

Command parse_command_line(int given, const char* const* given_words) {
  const std::vector<const char*> checked = checked_words(given, given_words);
  const int argc = static_cast<int>(checked.size());
  const char* const* const argv = checked.data();
  Words words;
  CLI::App app("Carom simulates hard disks in a rectangle.", "carom");
  app.set_version_flag("--version", std::string("carom ") + build_version());
  app.require_subcommand(1);
  CLI::App* const run = app.add_subcommand("run", "run a scene");
  CLI::App* const check = app.add_subcommand("check", "read a scene and say what it would model, and at what cost");
  CLI::App* const resume = app.add_subcommand("resume", "go on from a checkpoint, bit for bit as if never stopped");
  CLI::App* const compare =
      app.add_subcommand("compare", "two outputs: the same bits, or where and by how much they differ");
  CLI::App* const render = app.add_subcommand("render", "a movie or a picture from a trajectory");
  CLI::App* const view = app.add_subcommand("view", "one page that plays a run in any browser");
  CLI::App* const sweep = app.add_subcommand("sweep", "run a scene for every combination of values and seeds");
  CLI::App* const chart = app.add_subcommand("chart", "the speed-accuracy chart of all methods, from runs made now");
  CLI::App* const docs = app.add_subcommand("docs", "print a page of the documentation that is made from the program");
  for (CLI::App* const command : {run, check, resume, compare, render, view, sweep, chart, docs}) {
    command->allow_extras();
  }
  describe_run(run, words);
  add_scene_options(check, words);
  add_value(check, "--accuracy", words.accuracy, "X",
            "say which method and dt keep the error of averages (collision rate, pressure) below X");
  check->add_flag("--json", words.json, "print the result as JSON");
  describe_resume(resume, words);
  describe_compare(compare, words);
  describe_render(render, words);
  describe_view(view, words);
  describe_sweep(sweep, words);
  describe_chart(chart, words);
  docs->add_option("PAGE", words.first, "scene: every key of a scene, column of series.csv and key of --json")
      ->type_name("");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion&) {
    return TextRequest{fmt::format("carom {}\n", build_version())};
  } catch (const CLI::Success&) {
    const CLI::App* const shown = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
    return TextRequest{help_of(app, *shown)};
  } catch (const CLI::ParseError& error) {
    fail_as_one_line(error);
  }
  check_leftovers(app.get_subcommands().front());
  if (run->parsed()) return run_options(words);
  if (check->parsed()) return check_options(words);
  if (resume->parsed()) return resume_options(words);
  if (compare->parsed()) return compare_options(words);
  if (view->parsed()) return view_options(words);
  if (sweep->parsed()) return sweep_options(words);
  if (chart->parsed()) return chart_options(words);
  if (docs->parsed()) return docs_options(words);
  return render_options(words);
}

Scene load_scene_as_told(const std::string& path, const SceneChanges& changes) {
  std::error_code error;
  const std::filesystem::path folder = path;
  if (std::filesystem::is_directory(folder, error)) {
    const std::filesystem::path inside = folder / "scene.toml";
    fail_input(path, "is a directory",
               std::filesystem::exists(inside, error)
                   ? fmt::format("expected a scene file, such as the {} of the run that is there", inside.string())
                   : "expected a scene file");
  }
  return scene_as_told(
      changes, [&](const std::vector<Override>& overrides) { return load_scene(path, overrides, read_scene_frame); });
}

Scene scene_as_told(const SceneChanges& changes, const std::function<Scene(const std::vector<Override>&)>& load) {
  try {
    return load(changes.overrides);
  } catch (const InputError& error) {
    const std::string message = error.what();
    const auto options = changes.overrides.begin() + static_cast<std::ptrdiff_t>(changes.sets);
    for (const SceneOption& option : scene_options) {
      const std::string told = fmt::format("--set {}:", option.key);
      const auto same_key = [&](const Override& change) { return change.key == option.key; };
      if (!message.starts_with(told) || std::none_of(options, changes.overrides.end(), same_key)) continue;
      throw InputError(option.option + message.substr(told.size() - 1));
    }
    throw;
  }
}

}  // namespace carom
