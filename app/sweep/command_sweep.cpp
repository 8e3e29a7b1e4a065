#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "app/cli/start_ranks.hpp"
#include "app/sweep/sweep.hpp"
#include "app/sweep/sweep_scripts.hpp"
#include "io/files/output_file.hpp"
#include "io/files/shell_word.hpp"
#include "run/loop/stop_signals.hpp"

namespace carom {

int command_sweep(const SweepOptions& options) {
  if (options.emit.empty()) check_ranks_of_this_machine(options.ranks);
  Sweep sweep(options);
  sweep.open_folder();
  const std::size_t left = sweep.runs().size() - sweep.finished();
  if (!options.emit.empty() && left > 0) {
    const bool slurm = options.emit == "slurm";
    const std::string file = (sweep.folder() / (slurm ? "sweep.sbatch" : "sweep.sh")).string();
    write_file(file, slurm ? slurm_script(sweep) : parallel_script(sweep));
    print_note(fmt::format("{} of {} runs are left; run {} {}, and then this command without --emit for the table",
                           left, sweep.runs().size(), slurm ? "sbatch" : "sh", quoted_for_shell(file)));
    print_out(fmt::format("{}\n", file));
    return 0;
  }
  const SweepCount count = sweep.run_all();
  const SweepTableCount rows = sweep.write_table();
  const std::string table = (sweep.folder() / "sweep.csv").string();
  if (rows.warned > 0) {
    print_warning(fmt::format(
        "{} of {} runs have warnings about their method; see the column warnings, and summary.json of each run",
        rows.warned, sweep.finished()));
  }
  if (rows.versions.size() > 1) {
    print_warning(fmt::format("the runs are of several versions of Carom, which may differ in the last bits: {}",
                              fmt::join(rows.versions, ", ")));
  }
  if (count.stopped) {
    print_note(fmt::format("stopped by {} with {} of {} runs done; the same command continues the sweep",
                           stop_signal_name(), sweep.finished(), sweep.runs().size()));
    return 4;
  }
  print_out(fmt::format("{}\n", table));
  return count.failed > 0 ? 1 : 0;
}

}  // namespace carom
