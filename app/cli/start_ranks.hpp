// Starting a run on several ranks of this machine.
#pragma once

#include <string>

namespace carom {

// Throws InputError where so many ranks are more than the cores of this machine can take turns at.
void check_ranks_of_this_machine(int ranks);

// Runs mpiexec with so many processes of carom-mpi, which lies beside this program, and the same command line; returns
// its status, that of rank 0. Signals that ask for a checkpoint or the end go to rank 0. Throws InputError where
// there are too many ranks for this machine, and, with the packages that are missing, where MPI is not installed or the
// build was made without it; RunError where it cannot be started, or a rank did not live to the end.
int start_ranks(int ranks, int argc, const char* const* argv);

// What to say where mpirun or srun has started several processes of this program, which know nothing of each other, and
// not of carom-mpi. Empty elsewhere, and in all of them but one.
std::string warning_of_lone_ranks();

// Rank 0 takes signals from here on: those that came while the ranks were started are passed on to it now. Does nothing
// where mpirun was called by hand.
void tell_starter();

}  // namespace carom
