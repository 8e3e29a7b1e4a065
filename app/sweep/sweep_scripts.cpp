#include "app/sweep/sweep_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace carom {

std::string parallel_script(const Sweep& sweep) {
  std::string text = R"(#!/bin/sh
# Runs what is left of the sweep with GNU parallel, which must be installed: a process a core, each on one thread.
# Its own options may follow, such as -j 4 for four runs at once; THREADS=2 before it gives each process two.
)";
  text += fmt::format("parallel --will-cite --jobs {}% \"$@\" <<'RUNS'\n", std::max(1, 100 / sweep.ranks()));
  for (const SweepRun& run : sweep.runs()) {
    if (!sweep.finished(run)) text += sweep.shell_line(run, false) + " --threads \"${THREADS:-1}\"\n";
  }
  return text + "RUNS\n";
}

std::string slurm_script(const Sweep& sweep) {
  const bool alone = sweep.ranks() == 1;
  // Slurm itself does not start several ranks of a run: mpirun does, on the nodes of the task. Without --bind-to none
  // it would bind two ranks to a core each, with all their threads.
  const std::string starter = alone ? "" : fmt::format("mpirun -n {} --bind-to none ", sweep.ranks());
  std::size_t left = 0;
  std::string cases;
  for (const SweepRun& run : sweep.runs()) {
    if (sweep.finished(run)) continue;
    cases += fmt::format("  {}) exec {}{} --threads \"${{SLURM_CPUS_PER_TASK:-1}}\" ;;\n", ++left, starter,
                         sweep.shell_line(run, !alone));
  }
  return fmt::format(
      "#!/bin/sh\n#SBATCH --job-name=carom\n#SBATCH --array=1-{}\n{}#SBATCH --cpus-per-task=1\n"
      "# One task a run that is left of the sweep.\ncase \"$SLURM_ARRAY_TASK_ID\" in\n{}esac\n",
      std::max<std::size_t>(1, left), alone ? "" : fmt::format("#SBATCH --ntasks={}\n", sweep.ranks()), cases);
}

}  // namespace carom
