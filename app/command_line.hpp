// From argv to what the user asked for, with every value checked that can be checked without the scene.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/scene_file.hpp"

namespace carom {

// What the command line changes in the scene: first every --set, then --method, --dt, --t-end and --seed.
struct SceneChanges {
  std::vector<Override> overrides;
  std::size_t sets = 0;  // how many of them come from --set
};

struct RunOptions {
  std::string scene;
  std::optional<std::string> folder;  // -o
  SceneChanges changes;
  std::string engine;          // empty: the default
  std::optional<int> threads;  // >= 1
  bool json = false;
  bool quiet = false;
  bool force = false;
};

struct CheckOptions {
  std::string scene;
  SceneChanges changes;
  std::optional<double> accuracy;
  bool json = false;
};

struct CompareOptions {
  std::string a, b;
  bool json = false;
};

struct RenderOptions {
  std::string source;               // a folder with trajectory.xyz, or such a file
  std::optional<std::string> file;  // -o
  std::optional<int> frame;         // counted from 1; absent: all, as a movie
  bool quiet = false;
  bool force = false;
};

struct ChartOptions {
  std::optional<std::string> folder;  // -o
  bool quick = false;                 // fewer points, within a minute
  bool tiny = false;                  // for tests: numbers of no use, within seconds
  bool quiet = false;
  bool force = false;
};

// What --help or --version print on standard output.
struct TextRequest {
  std::string text;
};

using Command = std::variant<RunOptions, CheckOptions, CompareOptions, RenderOptions, ChartOptions, TextRequest>;

// Throws InputError with one line that names the option, and the nearest one for a misspelt name.
Command parse_command_line(int argc, const char* const* argv);

// load_scene with these changes; what it says of "--set run.dt" is said of --dt where that is what the user wrote.
Scene load_scene_as_told(const std::string& path, const SceneChanges& changes);

}  // namespace carom
