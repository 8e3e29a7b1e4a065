// Starting a run on several ranks of this machine.
#pragma once

#include <string>

namespace carom {

// Throws InputError if there are too many ranks for the cores of this machine.
void check_ranks_of_this_machine(int ranks);

// Runs mpiexec with this number of processes of carom-mpi, which is beside this program, and the same command line;
// returns its status, that of rank 0. Signals that request a checkpoint or a stop are passed to rank 0. Throws
// InputError if there are too many ranks for this machine, or if MPI is not installed or not built in (naming the
// missing packages); RunError if mpiexec cannot be started, or a rank died.
int start_ranks(int ranks, int argc, const char* const* argv);

// The warning if mpirun or srun has started several processes of this program, which do not know each other, instead of
// carom-mpi. Empty otherwise, and in all of these processes but one.
std::string warning_of_lone_ranks();

// To be called by rank 0 when it can take signals: those that came while the ranks were started are then passed to it.
// Does nothing if mpirun was called by hand.
void tell_starter();

}  // namespace carom
