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
  command->add_option("--set", words.sets, "set any key of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_scene_options(CLI::App* command, OptionWords& words) {
  command->add_option("SCENE", words.first, "scene file (TOML)")->type_name("");
  add_scene_changes(command, words);
}

constexpr const char* early_stop =
    "Ctrl-C, SIGTERM and --max-walltime write a checkpoint and stop the run with status 4. SIGUSR1 writes a "
    "checkpoint, and the run continues. A second Ctrl-C quits at once.";

// Adds the options of runs, whether from the start or from a checkpoint.
void add_run_options(CLI::App* run, OptionWords& words, const std::string& engine) {
  add_value(run, "--engine", words.engine, "parallel|reference",
            fmt::format("default {}; both give the same bits", engine));
  add_value(run, "--threads", words.threads, "N", "number of threads of the parallel engine; default all cores");
  add_value(run, "--ranks", words.ranks, "N",
            "number of processes that share the box over MPI; for methods pairwise and exact");
  add_value(run, "--max-walltime", words.walltime, "TIME",
            "stop with a checkpoint after this wall time, such as 90 s, 30 min or 2h");
  run->add_flag("--json", words.json, "print the summary as JSON, and nothing else, on standard output");
  run->add_flag("--quiet", words.quiet, "print only errors, and the note of a stopped run");
  run->add_flag("--force", words.force, "replace the results of an earlier run in the folder");
  run->add_flag("--view", words.view,
                "at the end write DIR/view.html, which plays the run, and open it in the browser");
  run->add_flag("--strict", words.strict,
                "end the run with status 3 at the first warning about the validity of the method");
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
            "find the method and dt that keep the error of averages (collision rate, pressure) below X");
  add_value(check, "--threads", words.threads, "N", "number of threads of the run; default all cores");
  add_value(check, "--ranks", words.ranks, "N", "also predict memory and messages for this number of processes");
  check->add_flag("--json", words.json, "print the result as JSON");
}

void describe_resume(CLI::App* resume, OptionWords& words) {
  resume->add_option("CHECKPOINT", words.first, "checkpoint.carom, or the folder of the run that wrote it")
      ->type_name("");
  add_value(resume, "-o,--output", words.folder, "DIR",
            "write into another folder, which gets copies of the files so far");
  add_value(resume, "--t-end", words.scene_values[t_end_option], "T",
            "simulated time at which the run ends, if another than before");
  add_run_options(resume, words, "that of the run before");
  resume->footer(early_stop);
}

void describe_compare(CLI::App* compare, OptionWords& words) {
  compare->add_option("A", words.first, "folder of a run, or a trajectory")->type_name("");
  compare->add_option("B", words.second, "the other folder or trajectory")->type_name("");
  add_value(compare, "--tolerance", words.tolerance, "X", "take values that differ by at most X as the same");
  add_value(compare, "--fields", words.fields, "x,y,...",
            "compare only these of x, y, vx, vy, radius, mass, spin, group, image_x, image_y");
  add_value(compare, "--times", words.times, "T0:T1",
            "compare only frames within these times; T0 or T1 may be left out");
  add_value(compare, "--at", words.at, "T", "compare only the frame nearest to this time in each");
  compare->add_flag("--json", words.json, "print the result as JSON");
  compare->footer(
      "Without --tolerance, --fields, --times and --at all bits of the trajectories and the summaries are compared; "
      "with any of them only the trajectories are.\nExit status: 0 the same, 1 different, 2 cannot be compared.");
}

void describe_render(CLI::App* render, OptionWords& words) {
  render->add_option("DIR", words.first, "folder of a run with a trajectory, or a trajectory")->type_name("");
  add_value(
      render, "-o,--output", words.folder, "FILE",
      "a movie (.mp4, .webm, .gif) or a picture (.png, .svg); default DIR/movie.mp4, or DIR/frame_K.png with --frame");
  add_value(render, "--frame", words.frame, "K", "draw the K-th frame, counted from 1; default the last");
  add_value(render, "--colour", words.colour, "speed|group|radius|mass|id",
            "the quantity that the colour of a disk shows");
  add_value(render, "--range", words.range, "LOW:HIGH", "ends of the colour scale; default from all frames");
  add_value(render, "--size", words.size, "WIDTHxHEIGHT", "size of the picture in pixels");
  add_value(render, "--fps", words.fps, "N", "frames per second; default 25");
  render->add_flag("--quiet", words.quiet, "print only errors");
  render->add_flag("--force", words.force, "replace an existing file");
}

void describe_view(CLI::App* view, OptionWords& words) {
  view->add_option("DIR", words.first, "folder of a run with a trajectory, or a trajectory")->type_name("");
  add_value(view, "-o,--output", words.folder, "FILE", "file of the page; default DIR/view.html");
  add_value(view, "--max-size", words.max_size, "SIZE",
            "largest size of the page: frames, then disks, are left out to reach it; default 64MB");
  view->add_flag("--open", words.open, "open the page in the browser");
  view->add_flag("--live", words.live, "show a run in progress to browsers on this computer, and write no file");
  view->add_flag("--quiet", words.quiet, "print only errors");
  view->add_flag("--force", words.force, "replace an existing file");
  view->footer("The page is one file that plays the run in any browser, without a network. See docs/viewer.md.");
}

void describe_sweep(CLI::App* sweep, OptionWords& words) {
  add_scene_options(sweep, words);
  sweep->add_option("--over", words.over, "values of one key of the scene; may be repeated, for a grid")
      ->type_name("KEY=FROM:TO:COUNT|KEY=A,B,...")
      ->allow_extra_args(false);
  add_value(sweep, "--seeds", words.seeds, "N",
            "number of seeds for each combination, counted from the seed of the scene; default 1");
  add_value(sweep, "-o,--output", words.folder, "DIR", "folder of the sweep; default out/<name of the scene>_sweep");
  add_value(sweep, "--jobs", words.jobs, "N", "number of runs at the same time; default one for each core");
  add_value(sweep, "--ranks", words.ranks, "N", "number of processes that share the box of each run over MPI");
  add_value(sweep, "--emit", words.emit, "slurm|parallel",
            "write a script that runs the sweep elsewhere, and run nothing");
  sweep->add_flag("--force", words.force, "replace another sweep in the folder");
  sweep->footer("The same command continues a sweep that was stopped. sweep.csv has a row for each run.");
}

void describe_chart(CLI::App* chart, OptionWords& words) {
  add_value(chart, "--scene", words.first, "SCENE.toml", "make the chart of this scene, instead of the built-in ones");
  add_scene_changes(chart, words);
  add_value(chart, "-o,--output", words.folder, "DIR",
            "folder for chart.svg, .png, .csv and .json; default out/chart, or out/chart_<name of the scene>");
  chart->add_flag("--quick", words.quick, "fewer points, in less than a minute");
  chart->add_flag("--tiny", words.tiny, "a test of the command itself")->group("");
  chart->add_flag("--quiet", words.quiet, "print only errors");
  chart->add_flag("--force", words.force, "replace an earlier chart in the folder");
  chart->footer(
      "--scene needs a scene in which the number of disks stays the same, disks collide, and method exact does not "
      "stop. The dt of the scene is one of the steps. See docs/chart.md.");
}

void describe_docs(CLI::App* docs, OptionWords& words) {
  docs->add_option("PAGE", words.first, "scene: all keys of a scene, columns of series.csv and keys of --json")
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
    {"check", "read a scene, and print what it would model, and at what cost", describe_check,
     command_of<check_options>},
    {"resume", "continue a run from a checkpoint, with the same bits as without the stop", describe_resume,
     command_of<resume_options>},
    {"compare", "compare two outputs: the same bits, or where and by how much they differ", describe_compare,
     command_of<compare_options>},
    {"render", "make a movie or a picture of a trajectory", describe_render, command_of<render_options>},
    {"view", "make a page that plays a run in any browser", describe_view, command_of<view_options>},
    {"sweep", "run a scene for every combination of values and seeds", describe_sweep, command_of<sweep_options>},
    {"chart", "measure the speed-accuracy chart of all methods", describe_chart, command_of<chart_options>},
    {"docs", "print the page of the documentation that the program makes", describe_docs, command_of<docs_options>},
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
