#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "app/commands.hpp"
#include "app/sweep_plan.hpp"
#include "core/check.hpp"
#include "core/csv.hpp"
#include "core/input_message.hpp"
#include "io/child_process.hpp"
#include "io/output_file.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// What a row of sweep.csv takes from each run's summary, after the keys of the sweep and the seed.
constexpr std::array<const char*, 17> table_keys{
    "particles",    "steps",          "time",        "collisions",   "wall_collisions", "energy_initial",
    "energy_final", "momentum_drift", "max_overlap", "wall_overlap", "pressure",        "collision_rate",
    "removed",      "emitted",        "waiting",     "step_s",       "state_hash"};

std::string own_path() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  if (error) throw RunError("cannot find this program's own file: " + error.message());
  return path.string();
}

// In a shell's single quotes.
std::string quoted_for_shell(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

class Sweep {
 public:
  explicit Sweep(const SweepOptions& options) : options_(options), folder_(folder_of(options)) {
    for (const std::string& text : options.over) axes_.push_back(parse_sweep_axis(text));
    const Scene scene = load_scene_as_told(options.scene, options.changes);
    seed_ = scene.seed;
    runs_ = sweep_runs(options.changes, axes_, seed_, options.seeds);
    // Every combination is read before anything runs: a bad key or value shows at once.
    for (const SweepRun& run : runs_) check_run(run);
  }

  // Makes the folder, or makes sure that it holds this very sweep.
  void open_folder() const {
    const std::string identity = sweep_identity(read_text_file(options_.scene, options_.scene), runs_);
    const fs::path plan = folder_ / "sweep.txt";
    std::error_code error;
    if (fs::exists(plan)) {
      if (read_text_file(plan.string(), plan.string()) == identity) return;
      if (!options_.force) {
        fail_input(folder_.string(), "holds another sweep, or the scene has changed since",
                   "choose another folder with -o, or replace it with --force");
      }
      fs::remove_all(folder_ / "runs", error);
      fs::remove(folder_ / "sweep.csv", error);
    } else if (fs::exists(folder_) && !fs::is_empty(folder_, error)) {
      fail_input(folder_.string(), "holds other files", "expected a new folder for the sweep (-o)");
    }
    fs::create_directories(folder_ / "runs", error);
    if (error) fail_input(folder_.string(), "cannot be made: " + error.message(), "expected a folder (-o)");
    write_file(plan.string(), identity);
  }

  bool finished(const SweepRun& run) const { return fs::exists(folder_of(run) / "summary.json"); }
  const std::vector<SweepRun>& runs() const { return runs_; }
  const fs::path& folder() const { return folder_; }

  std::vector<std::string> command_of(const SweepRun& run, int threads) const {
    std::vector<std::string> words{own_path(), "run", fs::absolute(options_.scene).string(), "--quiet",
                                   "--force",  "-o",  fs::absolute(folder_of(run)).string()};
    if (threads > 0) words.insert(words.end(), {"--threads", fmt::format("{}", threads)});
    for (const Override& change : run.overrides) {
      words.emplace_back("--set");
      words.push_back(fmt::format("{}={}", change.key, change.value));
    }
    return words;
  }

  std::string shell_line(const SweepRun& run) const {
    std::string line;
    for (const std::string& word : command_of(run, 0)) line += (line.empty() ? "" : " ") + quoted_for_shell(word);
    return line;
  }

  // Runs what is not there yet, several at once: runs are independent, so that nothing is lost between threads.
  void run_all() const {
    std::vector<const SweepRun*> rest;
    for (const SweepRun& run : runs_) {
      if (!finished(run)) rest.push_back(&run);
    }
    const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    const int jobs = options_.jobs.value_or(cores);
    const int threads = std::max(1, cores / jobs);
    print_note(fmt::format("{} of {} runs are left, {} at once", rest.size(), runs_.size(), jobs));
    std::atomic<std::size_t> next{0};
    std::vector<std::string> failures(rest.size());
    const auto work = [&] {
      for (std::size_t k = next++; k < rest.size(); k = next++) failures[k] = run_one(*rest[k], threads);
    };
    std::vector<std::thread> workers;
    for (int j = 1; j < jobs; ++j) workers.emplace_back(work);
    work();
    for (std::thread& worker : workers) worker.join();
    for (std::size_t k = 0; k < rest.size(); ++k) {
      if (!failures[k].empty()) print_warning(fmt::format("run {}: {}", rest[k]->name, failures[k]));
    }
    failed_ = std::any_of(failures.begin(), failures.end(), [](const auto& text) { return !text.empty(); });
  }

  bool failed() const { return failed_; }

  // One row a run that has come to its end.
  void write_table() const {
    std::string text = "run";
    for (const SweepAxis& axis : axes_) text += "," + axis.key;
    text += ",seed";
    for (const char* const key : table_keys) text += fmt::format(",{}", key);
    text += '\n';
    for (const SweepRun& run : runs_) {
      if (finished(run)) text += row_of(run);
    }
    const fs::path table = folder_ / "sweep.csv";
    write_file(table.string() + ".new", text);
    fs::rename(table.string() + ".new", table);
  }

 private:
  static fs::path folder_of(const SweepOptions& options) {
    return options.folder ? fs::path(*options.folder) : fs::path("out") / (fs::path(options.scene).stem() += "_sweep");
  }
  fs::path folder_of(const SweepRun& run) const { return folder_ / "runs" / run.name; }

  // Keys of the sweep are --set to the runs, and --over to whoever reads the message.
  void check_run(const SweepRun& run) const {
    try {
      load_scene_as_told(options_.scene, {run.overrides, run.overrides.size()});
    } catch (const InputError& error) {
      const std::string message = error.what();
      for (const SweepAxis& axis : axes_) {
        const std::string told = "--set " + axis.key;
        if (message.starts_with(told)) throw InputError("--over " + message.substr(std::string("--set ").size()));
      }
      throw;
    }
  }

  // Empty if all went well, else the run's own last words.
  std::string run_one(const SweepRun& run, int threads) const {
    const std::string log = fs::absolute(folder_ / "runs" / (run.name + ".log")).string();
    try {
      ChildProcess child(command_of(run, threads), fs::current_path().string(), log);
      const int status = child.wait();
      if (status == 0) {
        fs::remove(log);
        return "";
      }
      const std::string words = last_line(log);
      return words.empty() ? fmt::format("ended with status {}", status) : words;
    } catch (const std::exception& error) {
      return error.what();
    }
  }

  std::string row_of(const SweepRun& run) const {
    std::ifstream file(folder_of(run) / "summary.json");
    const Json summary = Json::parse(file, nullptr, false);
    if (!summary.is_object()) fail_input((folder_of(run) / "summary.json").string(), "is no JSON");
    std::string row = run.name;
    for (auto change = run.overrides.end() - static_cast<std::ptrdiff_t>(axes_.size() + 1);
         change != run.overrides.end(); ++change) {
      row += "," + (change->value.find(',') == std::string::npos ? change->value : '"' + change->value + '"');
    }
    for (const char* const key : table_keys) {
      const Json value = summary.value(key, Json());
      row += "," + (value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump());
    }
    return row + "\n";
  }

  const SweepOptions& options_;
  fs::path folder_;
  std::vector<SweepAxis> axes_;
  std::uint64_t seed_ = 1;
  std::vector<SweepRun> runs_;
  mutable bool failed_ = false;
};

// One line a run that is left, for GNU parallel; afterwards `carom sweep`, told the same, has only the table to write.
std::string parallel_script(const Sweep& sweep) {
  std::string text = "#!/bin/sh\n# Runs what is left of the sweep with GNU parallel, which must be installed.\n";
  text += "parallel --will-cite \"$@\" <<'RUNS'\n";
  for (const SweepRun& run : sweep.runs()) {
    if (!sweep.finished(run)) text += sweep.shell_line(run) + "\n";
  }
  return text + "RUNS\n";
}

std::string slurm_script(const Sweep& sweep) {
  std::size_t left = 0;
  std::string cases;
  for (const SweepRun& run : sweep.runs()) {
    if (sweep.finished(run)) continue;
    cases += fmt::format("  {}) exec {} --threads \"${{SLURM_CPUS_PER_TASK:-1}}\" ;;\n", ++left, sweep.shell_line(run));
  }
  return fmt::format(
      "#!/bin/sh\n#SBATCH --job-name=carom\n#SBATCH --array=1-{}\n#SBATCH --cpus-per-task=1\n"
      "# One task a run that is left of the sweep.\ncase \"$SLURM_ARRAY_TASK_ID\" in\n{}esac\n",
      std::max<std::size_t>(1, left), cases);
}

}  // namespace

int command_sweep(const SweepOptions& options) {
  Sweep sweep(options);
  sweep.open_folder();
  if (!options.emit.empty()) {
    const bool slurm = options.emit == "slurm";
    const std::string file = (sweep.folder() / (slurm ? "sweep.sbatch" : "sweep.sh")).string();
    write_file(file, slurm ? slurm_script(sweep) : parallel_script(sweep));
    print_out(fmt::format("{}\n", file));
    return 0;
  }
  sweep.run_all();
  sweep.write_table();
  print_out(fmt::format("{}\n", (sweep.folder() / "sweep.csv").string()));
  return sweep.failed() ? 1 : 0;
}

}  // namespace carom
