#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/chart/chart_figure.hpp"
#include "app/chart/chart_own.hpp"
#include "app/chart/chart_table.hpp"
#include "app/chart/chart_text.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "app/cli/progress.hpp"
#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/base/wall_clock.hpp"
#include "core/scene/scene_names.hpp"
#include "io/files/output_file.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 6> file_names{"chart.svg",     "chart.png", "chart_all.svg",
                                                "chart_all.png", "chart.csv", "chart.json"};

// Refuses a folder that cannot take the chart now, not after half an hour. Leaves nothing behind.
void check_folder(const fs::path& folder, bool force) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    fail_input(folder.string(), "is a file", "expected a folder for the chart (-o)");
  }
  for (const char* const name : file_names) {
    if (force || !fs::exists(folder / name, error)) continue;
    fail_input((folder / name).string(), "exists already", "expected another folder (-o), or --force to replace it");
  }
  fs::path made;  // the outermost folder that does not exist; a link exists, whatever it leads to
  for (fs::path p = fs::absolute(folder).lexically_normal();
       !p.empty() && fs::symlink_status(p, error).type() == fs::file_type::not_found; p = p.parent_path()) {
    made = p;
  }
  const bool there = fs::create_directories(folder, error) || fs::is_directory(folder, error);
  if (!there || access(folder.c_str(), W_OK) != 0) {
    fail_input(folder.string(), "cannot be made or written to", "expected a folder for the chart (-o)");
  }
  if (!made.empty()) fs::remove_all(made, error);
}

// The completed share, and the remaining time.
class ChartProgress {
 public:
  explicit ChartProgress(bool quiet) : line_(!quiet) {}

  void show(double share) {
    if (share <= 0.0 || !line_.due()) return;
    const double seconds = seconds_since(start_);
    line_.show(fmt::format("chart: {:3.0f} %, {} left", 100.0 * share, duration_text(seconds * (1.0 - share) / share)));
  }

  void clear() { line_.clear(); }

 private:
  StatusLine line_;
  WallClock::time_point start_ = WallClock::now();
};

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

// For each scene and error: the cost of each method at an error of 1e-2, 1e-3 and 1e-4, and the cheapest one.
Json verdicts_of(const chart::SceneResult& scene) {
  Json all = Json::array();
  for (const chart::Measure measure :
       {chart::Measure::path, chart::Measure::rate, chart::Measure::figure, chart::Measure::missed}) {
    for (const double error : {1e-2, 1e-3, 1e-4}) {
      Json verdict{{"measure", chart::measure_names[static_cast<std::size_t>(measure)]}, {"error", error}};
      std::optional<double> least;
      for (const chart::Curve& curve : scene.curves) {
        const std::string name(name_of(curve.method));
        const std::optional<double> cost = chart::cost_at(curve, measure, error);
        verdict[name] = number(cost);
        if (!cost || (least && *least <= *cost)) continue;
        least = cost;
        verdict["cheapest"] = name;
      }
      all.push_back(verdict);
    }
  }
  return all;
}

// For a user's own scene seeds begin with its own; one with the same start for every seed is run once.
std::string seeds_text(const chart::ChartScene& scene, const chart::Effort& effort) {
  const std::uint64_t first = scene.own ? scene.own->seed : 1;
  if (scene.same_start) return fmt::format("{}", first);
  return fmt::format("{} to {}", first, first + effort.most_seeds - 1);
}

Json json_of(const chart::ChartResult& result, const chart::Effort& effort, int threads, double seconds) {
  std::array<double, 3> load{};
  getloadavg(load.data(), 3);
  Json j;
  j["carom"] = CAROM_VERSION;
  j["compiler"] = __VERSION__;
  j["machine"] = {
      {"processor", processor()}, {"cores", std::thread::hardware_concurrency()}, {"load_average_at_the_end", load[0]}};
  j["effort"] = effort.name;
  j["threads"] = threads;
  j["seconds"] = seconds;
  j["seeds"] = seeds_text(result.scenes.front().scene, effort);
  for (const chart::SceneResult& scene : result.scenes) {
    Json s{{"scene", scene.scene.name},           {"title", scene.scene.title},     {"text", scene.scene.text},
           {"melting", scene.scene.melting},      {"flight", scene.scene.flight},   {"length", scene.scene.length},
           {"unit_of_time_of_costs", scene.unit}, {"figure_of_exact", scene.figure}};
    s["cost_at_error"] = verdicts_of(scene);
    for (const chart::Stop& stop : scene.stops) {
      s["stopped"].push_back({{"method", name_of(stop.method)}, {"dt", stop.dt}, {"why", stop.why}});
    }
    j["scenes"].push_back(std::move(s));
  }
  return j;
}

// Draws both pictures beside the destination, then moves them there.
bool draw(const LogFigure& figure, const fs::path& folder, const std::string& name) {
  const std::string svg = folder / (name + ".svg"), png = folder / (name + ".png");
  std::error_code error;
  try {
    if (!draw_log_figure(figure, svg + ".part", png + ".part")) return false;
  } catch (const RunError&) {
    fs::remove(svg + ".part", error);
    fs::remove(png + ".part", error);
    throw;
  }
  rename_file(svg + ".part", svg);
  rename_file(png + ".part", png);
  return true;
}

chart::Effort effort_of(const ChartOptions& options) {
  if (options.tiny) return chart::tiny_effort();
  return options.quick ? chart::quick_effort() : chart::full_effort();
}

}  // namespace

int command_chart(const ChartOptions& options) {
  const std::string name = options.scene.empty() ? "chart" : "chart_" + fs::path(options.scene).stem().string();
  const fs::path folder = options.folder.value_or((fs::path("out") / name).string());
  const bool own = !options.scene.empty();
  check_folder(folder, options.force);
  const auto start = WallClock::now();
  const int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const chart::Effort effort = own ? chart::for_own(effort_of(options)) : effort_of(options);
  ChartProgress progress(options.quiet);
  const auto watch = [&](double share) { progress.show(share); };
  const Scene scene = own ? load_scene_as_told(options.scene, options.changes) : Scene{};
  const chart::ChartResult result = own ? chart::measure_scenes({chart::own_scene(scene)}, effort, threads, watch)
                                        : chart::measure_chart(effort, threads, watch);
  progress.clear();
  fs::create_directories(folder);
  replace_file(folder / "chart.csv", chart::csv_of(result));
  // Bytes of a scene's file name that are not UTF-8 are replaced.
  replace_file(
      folder / "chart.json",
      json_of(result, effort, threads, seconds_since(start)).dump(2, ' ', false, Json::error_handler_t::replace) +
          "\n");
  const bool drawn =
      own ? draw(own_figure(result), folder, "chart")
          : draw(main_figure(result), folder, "chart") && draw(whole_figure(result), folder, "chart_all");
  if (!drawn && !options.quiet) print_warning("gnuplot is not installed: no pictures are drawn");
  if (options.quiet) return 0;
  if (own) print_out(own_chart_text(result.scenes.front(), scene));
  print_out(fmt::format("{} after {}\n", (folder / (drawn ? "chart.svg" : "chart.csv")).string(),
                        duration_text(seconds_since(start))));
  return 0;
}

}  // namespace carom
