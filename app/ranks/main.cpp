// carom-mpi: the program on several ranks, started by mpiexec. Rank 0 runs the program; the others follow it.
#include <fmt/format.h>

#include <csignal>
#include <exception>

#include "app/cli/messages.hpp"
#include "app/cli/program.hpp"
#include "app/cli/start_ranks.hpp"
#include "core/base/float_environment.hpp"
#include "parallel/ranks/mpi_ranks.hpp"
#include "parallel/slabs/leading_engine.hpp"
#include "run/engine/make_engine.hpp"
#include "run/loop/stop_signals.hpp"

namespace carom {

namespace {

// mpiexec passes SIGUSR2 on, but ends the ranks for SIGTERM; so for rank 0 SIGUSR2 means SIGTERM.
extern "C" void take_as_sigterm(int /*signal*/) {
  std::raise(SIGTERM);
}

// The signals that mpiexec passes on may come at any time; they are blocked (SIG_BLOCK) until the rank handles them
// (SIG_UNBLOCK).
void passed_signals(int what) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGUSR1, SIGUSR2}) sigaddset(&set, signal);
  pthread_sigmask(what, &set, nullptr);
}

// Only rank 0 handles signals that ask for a checkpoint or a stop; it tells the others.
void leave_signals_to_rank_0() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGUSR2}) std::signal(signal, SIG_IGN);
  passed_signals(SIG_UNBLOCK);
}

void take_signals() {
  std::signal(SIGUSR2, take_as_sigterm);
  catch_signals();
  passed_signals(SIG_UNBLOCK);
  tell_starter();
}

int lead(const MpiSession& session, Ranks& ranks, int argc, char** argv) {
  take_signals();
  RankLead lead(ranks);
  const int status = program(argc, argv, &lead);
  if (lead.lost()) session.abort(status);
  lead.end();
  return status;
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
  using namespace carom;
  passed_signals(SIG_BLOCK);
  const MpiSession session;
  const std::unique_ptr<Ranks> ranks = session.ranks();
  if (ranks->rank() == 0) return lead(session, *ranks, argc, argv);
  leave_signals_to_rank_0();
  give_back_columns();
  const FloatEnvironment environment;
  try {
    follow_lead(*ranks, {threads_of_rank(ranks->count())}, read_rank_start);
    return 0;
  } catch (const std::exception& error) {
    print_note(fmt::format("error: rank {}: {}", ranks->rank(), error.what()));
    session.abort(1);
  }
}
