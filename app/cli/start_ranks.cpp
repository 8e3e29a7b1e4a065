#include "app/cli/start_ranks.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "io/files/child_process.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

struct Setting {
  const char *name, *value;
};
// Settings for Open MPI, unless the user has set them: more ranks than cores are allowed, and sleep while they wait; no
// rank is bound to a core, since Open MPI would bind one or two ranks to a core each, with all their threads and the
// programs that rank 0 starts; no reading of other processes' memory, which containers forbid; and when a rank has
// died, the others have this number of seconds to end.
constexpr std::array<Setting, 5> mpi_settings{{{"OMPI_MCA_rmaps_base_oversubscribe", "1"},
                                               {"OMPI_MCA_mpi_yield_when_idle", "1"},
                                               {"OMPI_MCA_hwloc_base_binding_policy", "none"},
                                               {"OMPI_MCA_btl_vader_single_copy_mechanism", "none"},
                                               {"OMPI_MCA_odls_base_sigkill_timeout", "1"}}};

// The path of carom-mpi, which lies beside the program.
std::string path_of_ranks() {
  std::string path = (fs::read_symlink("/proc/self/exe").parent_path() / "carom-mpi").string();
  if (fs::exists(path)) return path;
  fail_input("--ranks", "this build of Carom cannot run on several ranks",
             "expected a build with Open MPI, Debian's packages openmpi-bin and libopenmpi-dev");
}

// If Open MPI is an environment module, it has to be loaded.
std::string path_of_mpiexec() {
  std::string path = find_program("mpiexec");
  if (!path.empty()) return path;
  fail_input("--ranks", "there is no mpiexec in PATH", "expected mpiexec of Open MPI, Debian's package openmpi-bin");
}

// The environment variable with the process id of the starter, for rank 0.
constexpr const char* starter_name = "CAROM_STARTER";

// The signal by which rank 0 announces that it takes signals now; no other process sends it.
int ready_signal() {
  return SIGRTMIN;
}

// The data of a signal handler have to be static: it is called with a number and nothing else.
std::atomic<int> mpiexec_process = 0, rank_0_process = 0;
std::atomic<int> stop_asked = 0, stop_passed = 0, checkpoint_asked = 0;
static_assert(std::atomic<int>::is_always_lock_free);  // as a handler needs

// Passes a signal to rank 0 directly, so that it can report which signal stopped the run: mpiexec passes on only a few,
// and ends the ranks for others (as is wanted for a second stop). While ranks start, signals would be lost, or end a
// rank that does not handle them yet; so they are kept until rank 0 has announced that it is ready.
extern "C" void pass_on(int signal, siginfo_t* info, void* /*context*/) {
  if (signal == ready_signal()) {
    rank_0_process = info->si_pid;
  } else if (signal == SIGUSR1) {
    checkpoint_asked = 1;
  } else if (stop_asked.exchange(signal) != 0) {
    kill(mpiexec_process, SIGTERM);
  }
  if (rank_0_process == 0) return;
  if (checkpoint_asked.exchange(0) != 0) kill(rank_0_process, SIGUSR1);
  if (stop_asked != 0 && stop_passed.exchange(1) == 0) kill(rank_0_process, stop_asked);
}

sigset_t passed_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, ready_signal()}) sigaddset(&set, signal);
  return set;
}

void pass_signals_on() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, ready_signal()}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN && signal != ready_signal()) continue;
    struct sigaction action {};
    action.sa_sigaction = pass_on;
    action.sa_flags = SA_RESTART | SA_SIGINFO;
    action.sa_mask = passed_signals();  // one after the other
    sigaction(signal, &action, nullptr);
  }
}

// In the child: a process group of its own, so that Ctrl-C reaches only the parent; no standard input; and it ends with
// the parent.
[[noreturn]] void become(const std::vector<char*>& words) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  execv(words[0], words.data());
  constexpr int cannot_be_started = 127;
  _exit(cannot_be_started);
}

// Converts the status of mpiexec to that of the run: the status of rank 0, which has reported its error; or an error
// because a rank died.
int status_of(int wait_status) {
  const int status = WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
  if (status < 127) return status;
  const std::string why =
      status > 128 ? fmt::format("was killed by signal {}", status - 128) : std::string("could not be started");
  throw RunError(
      fmt::format("one of the ranks {}; the last checkpoint, if the run has written one, is intact: use carom resume "
                  "with its folder",
                  why));
}

// More ranks than cores are useful only for trials. Each needs some 31 MB without disks, so thousands would bring the
// machine down.
constexpr int most_ranks_a_core = 8;

}  // namespace

void check_ranks_of_this_machine(int ranks) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int most = cores * most_ranks_a_core;
  if (ranks <= most) return;
  fail_input("--ranks",
             fmt::format("{} processes are too many for this machine's {} core{}", ranks, cores, cores == 1 ? "" : "s"),
             fmt::format("expected at most {}, {} for each core; on several machines start carom-mpi with mpirun", most,
                         most_ranks_a_core));
}

int start_ranks(int ranks, int argc, const char* const* argv) {
  check_ranks_of_this_machine(ranks);
  const std::string program = path_of_ranks();
  for (const auto& [name, value] : mpi_settings) setenv(name, value, 0);
  std::vector<std::string> words{path_of_mpiexec(), "-q", "-n", fmt::format("{}", ranks)};
  if (geteuid() == 0) words.emplace_back("--allow-run-as-root");
  words.push_back(program);
  words.insert(words.end(), argv + 1, argv + argc);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  setenv(starter_name, fmt::format("{}", getpid()).c_str(), 1);
  // Blocks signals until mpiexec is started and the handlers know it.
  const sigset_t passed = passed_signals();
  sigset_t before;
  sigprocmask(SIG_BLOCK, &passed, &before);
  const pid_t child = fork();
  if (child == 0) {
    sigprocmask(SIG_SETMASK, &before, nullptr);
    become(pointers);
  }
  if (child > 0) {
    mpiexec_process = child;
    pass_signals_on();
  }
  sigprocmask(SIG_SETMASK, &before, nullptr);
  if (child < 0) throw RunError(fmt::format("cannot start {}: {}", words[0], std::strerror(errno)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return status_of(status);
}

std::string warning_of_lone_ranks() {
  // Of Open MPI, and of all others that start processes by PMI.
  constexpr std::array<std::array<const char*, 2>, 2> launchers{
      {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"}, {"PMI_SIZE", "PMI_RANK"}}};
  for (const auto& [size, rank] : launchers) {
    const char* const processes = std::getenv(size);
    const char* const own = std::getenv(rank);
    if (processes == nullptr || std::atoi(processes) < 2) continue;
    if (own != nullptr && std::atoi(own) != 0) return "";
    return fmt::format(
        "{} = {}: each of these processes does the whole run by itself; expected carom-mpi instead of carom, which "
        "shares the run among them",
        size, processes);
  }
  return "";
}

void tell_starter() {
  const char* const starter = std::getenv(starter_name);
  if (starter == nullptr) return;
  const int process = std::atoi(starter);
  if (process > 1) kill(process, ready_signal());
}

}  // namespace carom
