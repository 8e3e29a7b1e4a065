#include "app/cli/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <csignal>
#include <new>

#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "app/cli/start_ranks.hpp"
#include "core/base/check.hpp"
#include "core/base/input_file.hpp"
#include "core/base/input_message.hpp"
#include "core/base/kernel_set.hpp"
#include "io/files/child_process.hpp"
#include "run/engine/make_engine.hpp"

namespace carom {

namespace {

// If mpirun was called by hand, it alone decides the number of processes.
void check_started_ranks(int wanted, int started) {
  if (wanted == started) return;
  fail_input("--ranks", fmt::format("{} ranks are requested, but mpirun has started {}", wanted, started),
             "expected the number given to mpirun -n, or no --ranks");
}

void warn_of_lone_ranks(const CarryOptions& options) {
  const std::string warning = warning_of_lone_ranks();
  if (!warning.empty() && !options.quiet) print_warning(warning);
}

// A run on several ranks is started again through MPI, unless it was started that way.
struct Dispatch {
  int argc;
  char** argv;
  RankLead* lead;

  template <class Options>
  int on_ranks(Options options, int (*command)(const Options&)) const {
    if (lead == nullptr) warn_of_lone_ranks(options);
    if (options.ranks && lead == nullptr) return start_ranks(*options.ranks, argc, argv);
    if (options.ranks) check_started_ranks(*options.ranks, ranks_of(*lead));
    options.lead = lead;
    return command(options);
  }
  int operator()(const RunOptions& options) const {
    if (options.ranks) check_other_processes_have(options.scene);
    return on_ranks(options, command_run);
  }
  int operator()(const ResumeOptions& options) const { return on_ranks(options, command_resume); }
  int operator()(const CheckOptions& options) const { return command_check(options); }
  int operator()(const CompareOptions& options) const { return command_compare(options); }
  int operator()(const RenderOptions& options) const { return command_render(options); }
  int operator()(const ViewOptions& options) const { return command_view(options); }
  int operator()(const SweepOptions& options) const { return command_sweep(options); }
  int operator()(const ChartOptions& options) const { return command_chart(options); }
  int operator()(const DocsOptions& options) const { return command_docs(options); }
  int operator()(const TextRequest& request) const {
    print_out(request.text);
    return 0;
  }
};

// If the caller has closed a standard stream, the next file opened would get its descriptor, and messages would be
// written into a trajectory. So /dev/null takes the descriptor: writable for errors, which are lost silently, and
// read-only for the output, whose loss is an error.
void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) == -1) open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
  }
}

int fail(int status, const char* what) {
  print_note(fmt::format("error: {}", what));
  return status;
}

}  // namespace

void give_back_columns() {
#if defined(__GLIBC__)
  constexpr int column = 1 << 21;  // bytes
  mallopt(M_MMAP_THRESHOLD, column);
  // Smaller blocks, such as messages of ranks, are kept, not returned to the system and allocated again each time.
  mallopt(M_TRIM_THRESHOLD, 4 * column);
#endif
}

int program(int argc, char** argv, RankLead* lead) {
  occupy_standard_streams();
  end_with_parent();
  give_back_columns();
  // A write beyond a file size limit should return an error, which is reported, and not end the program.
  std::signal(SIGXFSZ, SIG_IGN);
  const auto at_gone_reader = std::signal(SIGPIPE, SIG_IGN);
  // SIGCHLD may be ignored by inheritance from the parent; waitpid() could then not return a child's status.
  std::signal(SIGCHLD, SIG_DFL);
  try {
    kernel_set();  // reports a wrong CAROM_KERNELS before any work
    return std::visit(Dispatch{argc, argv, lead}, parse_command_line(argc, argv));
  } catch (const InputError& error) {
    return fail(2, error.what());
  } catch (const PhysicsError& error) {
    return fail(3, error.what());
  } catch (const ReaderGone& error) {
    // All is cleaned up, so the program ends by the signal, as filters do, unless the caller ignores it, or mpiexec
    // would take that for the loss of a rank.
    if (lead == nullptr) {
      std::signal(SIGPIPE, at_gone_reader);
      std::raise(SIGPIPE);
    }
    return fail(error.status, error.what());
  } catch (const std::bad_alloc&) {
    return fail(1, "out of memory");
  } catch (const std::exception& error) {
    return fail(1, error.what());
  }
}

}  // namespace carom
