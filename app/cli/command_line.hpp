// Parses the command line, and checks every value that can be checked without the scene.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/load/scene_file.hpp"
#include "io/trajectory/trajectory_difference.hpp"

namespace carom {

class RankLead;

// The changes of the scene by the command line: first every --set, then --method, --dt, --t-end and --seed.
struct SceneChanges {
  std::vector<Override> overrides;
  std::size_t sets = 0;  // number of changes that come from --set
};

// How a run is carried out, from its start or from a checkpoint.
struct CarryOptions {
  std::optional<std::string> folder;                              // -o
  SceneChanges changes;                                           // of a resumed run: --t-end only
  std::string engine;                                             // empty: the default, or that of the resumed run
  std::optional<int> threads;                                     // >= 1; of each rank
  std::optional<int> ranks;                                       // >= 1; processes
  RankLead* lead = nullptr;                                       // set if ranks are running
  double max_walltime = std::numeric_limits<double>::infinity();  // seconds
  bool json = false;
  bool quiet = false;
  bool force = false;
  bool view = false;    // a page that plays the run, opened when it is done
  bool strict = false;  // the first warning of the physics ends the run
};

struct RunOptions : CarryOptions {
  std::string scene;
};

struct ResumeOptions : CarryOptions {
  std::string checkpoint;  // or the folder of a run
};

struct CheckOptions {
  std::string scene;
  SceneChanges changes;
  std::optional<double> accuracy;
  std::optional<int> threads, ranks;  // >= 1
  bool json = false;
};

struct CompareOptions {
  std::string a, b;
  std::optional<CompareRule> rule;  // absent: all bits, and the summaries as well
  bool json = false;
};

struct RenderOptions {
  std::string source;               // a folder with a trajectory, or such a file
  std::optional<std::string> file;  // -o
  std::optional<int> frame;         // counted from 1; absent: all, or of a picture the last
  std::optional<ColourBy> colour;
  std::optional<std::array<double, 2>> range;
  std::optional<std::array<int, 2>> size;
  std::optional<double> fps;
  bool quiet = false;
  bool force = false;
};

struct ViewOptions {
  std::string source;                   // a folder with a trajectory, or such a file
  std::optional<std::string> file;      // -o
  std::optional<std::size_t> max_size;  // bytes
  bool open = false;                    // in the browser, when it is made
  bool live = false;                    // served while the run goes on
  bool quiet = false;
  bool force = false;
};

struct SweepOptions {
  std::string scene;
  std::optional<std::string> folder;  // -o
  SceneChanges changes;
  std::vector<std::string> over;  // KEY=FROM:TO:COUNT or KEY=VALUE,...
  int seeds = 1;
  std::optional<int> jobs;  // runs at once
  int ranks = 1;            // processes of each run
  std::string emit;         // "slurm", "parallel", or empty: run
  bool force = false;
};

struct ChartOptions {
  std::optional<std::string> folder;  // -o
  std::string scene;                  // of the user's own; empty: those built in
  SceneChanges changes;               // of that
  bool quick = false;                 // fewer points, within a minute
  bool tiny = false;                  // for tests: numbers of no use, within seconds
  bool quiet = false;
  bool force = false;
};

struct DocsOptions {
  enum class Page { scene } page = Page::scene;
};

// What --help or --version print on standard output.
struct TextRequest {
  std::string text;
};

using Command = std::variant<RunOptions, CheckOptions, ResumeOptions, CompareOptions, RenderOptions, ViewOptions,
                             SweepOptions, ChartOptions, DocsOptions, TextRequest>;

// Throws InputError with one line that names the option, and the nearest one for a misspelt name.
Command parse_command_line(int argc, const char* const* argv);

// Returns load(overrides), which reads a scene with these changes. In its error messages "--set run.dt" is replaced by
// --dt, if that is what the user wrote.
Scene scene_as_told(const SceneChanges& changes, const std::function<Scene(const std::vector<Override>&)>& load);

// The same for the scene in a file.
Scene load_scene_as_told(const std::string& path, const SceneChanges& changes);

}  // namespace carom
