#include "app/cli/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "app/cli/command_options.hpp"
#include "app/cli/command_words.hpp"
#include "app/cli/option_complaints.hpp"
#include "app/cli/option_words.hpp"
#include "core/base/build_version.hpp"
#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "io/trajectory/scene_frame_reader.hpp"

namespace carom {

namespace {

// Adds an option with one value; given twice, the last one counts.
void add_value(CLI::App* command, const std::string& names, std::string& value, const std::string& placeholder,
               const std::string& help) {
  command->add_option(names, value, help)
      ->type_name(placeholder)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

void add_scene_changes(CLI::App* command, OptionWords& words) {
  for (std::size_t k = 0; k < scene_options.size(); ++k) {
    const SceneOption& o = scene_options[k];
    add_value(command, o.option, words.scene_values[k], o.value, o.help);
  }
  command->add_option("--set", words.sets, "change any key of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_scene_options(CLI::App* command, OptionWords& words) {
  command->add_option("SCENE", words.first, "scene file (TOML)")->type_name("");
  add_scene_changes(command, words);
}

constexpr const char* early_stop =
    "Ctrl-C, SIGTERM and --max-walltime write a checkpoint and stop with status 4; SIGUSR1 writes one and goes on. A "
    "second Ctrl-C quits at once.";

// Adds the options of runs, whether from the start or from a checkpoint.
void add_run_options(CLI::App* run, OptionWords& words, const std::string& engine) {
  add_value(run, "--engine", words.engine, "parallel|reference",
            fmt::format("default {}; both give the same bits", engine));
  add_value(run, "--threads", words.threads, "N", "threads of the parallel engine; default all cores");
  add_value(run, "--ranks", words.ranks, "N", "processes that share the box, over MPI; methods pairwise and exact");
  add_value(run, "--max-walltime", words.walltime, "TIME",
            "stop with a checkpoint after so long, such as 90 s, 30 min or 2h");
  run->add_flag("--json", words.json, "print the summary as JSON, and nothing else, on standard output");
  run->add_flag("--quiet", words.quiet, "print nothing but errors, and where a run was stopped");
  run->add_flag("--force", words.force, "replace the results of an earlier run in the folder");
  run->add_flag("--view", words.view, "when done, make DIR/view.html, which plays the run, and open it in the browser");
  run->add_flag("--strict", words.strict, "end with status 3 at the first warning of a limit of the method");
}

void describe_run(CLI::App* run, OptionWords& words) {
  add_scene_options(run, words);
  add_value(run, "-o,--output", words.folder, "DIR", "folder for the results; default out/<name of the scene>");
  add_run_options(run, words, "parallel");
  run->footer(early_stop);
}

void describe_check(CLI::App* check, OptionWords& words) {
  add_scene_options(check, words);
  add_value(check, "--accuracy", words.accuracy, "X",
            "say which method and dt keep the error of averages (collision rate, pressure) below X");
  add_value(check, "--ranks", words.ranks, "N", "memory and messages of each of so many processes as well");
  check->add_flag("--json", words.json, "print the result as JSON");
}

void describe_resume(CLI::App* resume, OptionWords& words) {
  resume->add_option("CHECKPOINT", words.first, "checkpoint.carom, or the folder of the run that wrote it")
      ->type_name("");
  add_value(resume, "-o,--output", words.folder, "DIR", "another folder, which gets copies of the files so far");
  add_value(resume, "--t-end", words.scene_values[t_end_option], "T", "another simulated time at which the run ends");
  add_run_options(resume, words, "that of the run so far");
  resume->footer(early_stop);
}

void describe_compare(CLI::App* compare, OptionWords& words) {
  compare->add_option("A", words.first, "folder of a run, or a trajectory")->type_name("");
  compare->add_option("B", words.second, "the other one")->type_name("");
  add_value(compare, "--tolerance", words.tolerance, "X", "values that differ by at most X count as the same");
  add_value(compare, "--fields", words.fields, "x,y,...",
            "only these of x, y, vx, vy, radius, mass, spin, group, image_x, image_y");
  add_value(compare, "--times", words.times, "T0:T1", "only frames of these times; either may be left out");
  add_value(compare, "--at", words.at, "T", "only the frame of each that is nearest to this time");
  compare->add_flag("--json", words.json, "print the result as JSON");
  compare->footer(
      "Without these options every bit of the trajectories counts, and what the summaries say; with any of them only "
      "the trajectories do.\nExit status: 0 the same, 1 different, 2 they cannot be compared.");
}

void describe_render(CLI::App* render, OptionWords& words) {
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

void describe_view(CLI::App* view, OptionWords& words) {
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

void describe_sweep(CLI::App* sweep, OptionWords& words) {
  add_scene_options(sweep, words);
  sweep->add_option("--over", words.over, "values of one key of the scene; may be repeated, for a grid")
      ->type_name("KEY=FROM:TO:COUNT|KEY=A,B,...")
      ->allow_extra_args(false);
  add_value(sweep, "--seeds", words.seeds, "N", "so many seeds for each combination, from the scene's on; default 1");
  add_value(sweep, "-o,--output", words.folder, "DIR", "folder of the sweep; default out/<name of the scene>_sweep");
  add_value(sweep, "--jobs", words.jobs, "N", "runs at the same time; default one a core");
  add_value(sweep, "--ranks", words.ranks, "N", "processes that share the box of each run, over MPI");
  add_value(sweep, "--emit", words.emit, "slurm|parallel", "write a script that runs it elsewhere, and run nothing");
  sweep->add_flag("--force", words.force, "replace another sweep in the folder");
  sweep->footer("Called again, it goes on where it stopped. sweep.csv has a row a run.");
}

void describe_chart(CLI::App* chart, OptionWords& words) {
  add_value(chart, "--scene", words.first, "SCENE.toml", "of this scene, in place of those built in");
  add_scene_changes(chart, words);
  add_value(chart, "-o,--output", words.folder, "DIR",
            "folder for chart.svg, .png, .csv and .json; default out/chart, or out/chart_<name of the scene>");
  chart->add_flag("--quick", words.quick, "fewer points, within a minute");
  chart->add_flag("--tiny", words.tiny, "a test of the command itself")->group("");
  chart->add_flag("--quiet", words.quiet, "print nothing but errors");
  chart->add_flag("--force", words.force, "replace an earlier chart in the folder");
  chart->footer(
      "--scene takes scenes whose disks stay, collide, and can be run by exact; their own --dt is one of the steps. "
      "See docs/chart.md.");
}

void describe_docs(CLI::App* docs, OptionWords& words) {
  docs->add_option("PAGE", words.first, "scene: every key of a scene, column of series.csv and key of --json")
      ->type_name("");
}

template <auto options_of>
Command command_of(const OptionWords& words) {
  return options_of(words);
}

// A new command is a row here.
struct CommandRow {
  const char* name;
  const char* help;
  void (*describe)(CLI::App* command, OptionWords& words);
  Command (*read)(const OptionWords& words);
};

constexpr CommandRow commands[] = {
    {"run", "run a scene", describe_run, command_of<run_options>},
    {"check", "read a scene and say what it would model, and at what cost", describe_check, command_of<check_options>},
    {"resume", "go on from a checkpoint, bit for bit as if never stopped", describe_resume, command_of<resume_options>},
    {"compare", "two outputs: the same bits, or where and by how much they differ", describe_compare,
     command_of<compare_options>},
    {"render", "a movie or a picture from a trajectory", describe_render, command_of<render_options>},
    {"view", "one page that plays a run in any browser", describe_view, command_of<view_options>},
    {"sweep", "run a scene for every combination of values and seeds", describe_sweep, command_of<sweep_options>},
    {"chart", "the speed-accuracy chart of all methods, from runs made now", describe_chart, command_of<chart_options>},
    {"docs", "print a page of the documentation that is made from the program", describe_docs,
     command_of<docs_options>},
};

void add_commands(CLI::App& app, OptionWords& words) {
  for (const CommandRow& row : commands) {
    CLI::App* const command = app.add_subcommand(row.name, row.help);
    command->allow_extras();
    row.describe(command, words);
    // Flags take no value: --strict=0 would silently switch --strict off.
    for (CLI::Option* const option : command->get_options()) option->disable_flag_override();
  }
}

Command read_command(const CLI::App* command, const OptionWords& words) {
  check_leftovers(command);
  const auto* const row = std::find_if(std::begin(commands), std::end(commands),
                                       [&](const CommandRow& r) { return r.name == command->get_name(); });
  return row->read(words);
}

}  // namespace

Command parse_command_line(int given, const char* const* given_words) {
  const std::vector<const char*> checked = checked_words(given, given_words);
  OptionWords words;
  CLI::App app("Carom simulates hard disks in a rectangle.", "carom");
  app.set_version_flag("--version", std::string("carom ") + build_version());
  app.require_subcommand(1);
  add_commands(app, words);
  try {
    app.parse(static_cast<int>(checked.size()), checked.data());
  } catch (const CLI::CallForVersion&) {
    return TextRequest{fmt::format("carom {}\n", build_version())};
  } catch (const CLI::Success&) {
    const CLI::App* const shown = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
    return TextRequest{help_of(app, *shown)};
  } catch (const CLI::ParseError& error) {
    fail_as_one_line(error);
  }
  return read_command(app.get_subcommands().front(), words);
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
