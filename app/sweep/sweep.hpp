// A sweep: the runs of a plan in one folder, which of them are done, and the start of the others.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/cli/command_line.hpp"
#include "app/sweep/sweep_lock.hpp"
#include "app/sweep/sweep_plan.hpp"
#include "core/scene/scene.hpp"
#include "io/files/child_process.hpp"

namespace carom {

struct SweepCount {
  std::size_t failed = 0;
  bool stopped = false;  // by a signal, before all had run
};

struct SweepTableCount {
  std::size_t warned = 0;          // rows of runs with warnings
  std::set<std::string> versions;  // of Carom, by which they were made
};

class Sweep {
 public:
  // Reads the scene of every run, so that a wrong key or value is found before anything runs; throws InputError. The
  // options outlive the sweep.
  explicit Sweep(const SweepOptions& options);

  // Makes the folder, or checks that it holds this sweep, or one that this one extends by more values or seeds. Throws
  // InputError if it holds anything else.
  void open_folder();

  bool finished(const SweepRun& run) const;
  std::size_t finished() const;  // number of runs that have come to their end
  const std::vector<SweepRun>& runs() const { return runs_; }
  const std::filesystem::path& folder() const { return folder_; }
  int ranks() const { return options_.ranks; }

  // The command that makes a run, or continues it if it was stopped, quoted for a shell. over_mpi: the command of each
  // process that mpirun starts.
  std::string shell_line(const SweepRun& run, bool over_mpi) const;

  // Runs what is missing, several runs at a time. Failures are reported as they occur.
  SweepCount run_all() const;

  // Writes sweep.csv: one row for each run that has come to its end.
  SweepTableCount write_table() const;

 private:
  struct Complaint {
    std::string what, remedy;
  };

  void add_axis(const SweepAxis& axis);
  Scene scene_of(const SweepRun& run) const;
  std::filesystem::path folder_of(const SweepRun& run) const { return folder_ / "runs" / run.name; }
  std::filesystem::path plan_file() const { return folder_ / "sweep.txt"; }
  std::string log_of(const SweepRun& run) const;
  bool resumable(const SweepRun& run) const;
  bool is_as_planned(const SweepRun& run) const;
  std::string against(const SweepRun& run) const;
  Complaint against_runs(const std::vector<SweepRun>& runs) const;
  Complaint go_on(const std::string& scene_text);
  void begin(const std::string& scene_text);
  std::string to_run_again(const SweepRun& run) const;
  std::vector<std::string> command_of(const SweepRun& run, int threads, const std::string& program) const;
  std::unique_ptr<ChildProcess> start(const SweepRun& run, int threads) const;
  std::string close(const SweepRun& run, int status) const;
  std::string last_words(const SweepRun& run, int status) const;
  nlohmann::ordered_json summary_of(const SweepRun& run) const;

  const SweepOptions& options_;
  std::filesystem::path folder_;
  std::optional<SweepLock> lock_;  // on the folder, once it is open
  std::vector<SweepAxis> axes_;
  std::vector<SweepRun> runs_;
};

}  // namespace carom
