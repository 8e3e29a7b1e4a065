#include "io/files/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/base/check.hpp"

namespace carom {

std::string find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "/usr/bin:/bin";
  while (!rest.empty()) {
    const std::size_t end = rest.find(':');
    const std::string candidate = fmt::format("{}/{}", rest.substr(0, end), name);
    std::error_code error;
    const bool is_file = std::filesystem::is_regular_file(candidate, error);  // folders can be "executed", too
    // PATH may have relative folders, which the child, started in another folder, would not find.
    if (is_file && access(candidate.c_str(), X_OK) == 0) return std::filesystem::absolute(candidate).string();
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
  }
  return {};
}

namespace {

// The settings of a new child. Its descriptor 0 is our pipe, 1 and 2 are the log; all of ours are close-on-exec.
struct SpawnSettings {
  SpawnSettings(int input, const std::string& folder, const std::string& log_path, ChildSignals signals) {
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    sigset_t blocked;
    sigemptyset(&blocked);
    if (signals == ChildSignals::held_back) {
      for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) sigaddset(&blocked, signal);
    }
    posix_spawnattr_setsigmask(&attributes, &blocked);
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, 0);
    posix_spawn_file_actions_addopen(&actions, 1, log_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
};

// Of a child that does not start there is one error, whether it is the program or the log that cannot be opened.
void check_log(const std::string& path) {
  const int log = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (log < 0) throw RunError(fmt::format("cannot write {}: {}", path, std::strerror(errno)));
  ::close(log);
}

constexpr const char* parent_name = "CAROM_PARENT";

// The environment of this process, and its process id, for a child that must not outlive it.
std::vector<std::string> environment_for(ChildSignals signals) {
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) environment.emplace_back(*entry);
  if (signals == ChildSignals::reach_it) environment.push_back(fmt::format("{}={}", parent_name, getpid()));
  return environment;
}

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

void end_with_parent() {
  const char* const parent = std::getenv(parent_name);
  if (parent == nullptr) return;
  const std::string wanted = parent;
  unsetenv(parent_name);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  // The parent may have died before; then no signal would come.
  if (fmt::format("{}", getppid()) != wanted) std::raise(SIGTERM);
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::string& folder,
                           const std::string& log_path, ChildSignals signals) {
  std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw RunError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  input_ = ends[1];
  const std::vector<char*> argv = pointers_to(arguments);
  const std::vector<std::string> environment = environment_for(signals);
  const SpawnSettings spawn(ends[0], folder, log_path, signals);
  const int error =
      posix_spawn(&pid_, argv[0], &spawn.actions, &spawn.attributes, argv.data(), pointers_to(environment).data());
  ::close(ends[0]);
  if (error != 0) {
    close_input();
    check_log(log_path);
    throw RunError(fmt::format("cannot start {}: {}", arguments[0], std::strerror(error)));
  }
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) kill(pid_, SIGKILL);
  wait();
}

bool ChildProcess::write(const void* data, std::size_t bytes) {
  const char* next = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t written = ::write(input_, next, bytes);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    next += written;
    bytes -= static_cast<std::size_t>(written);
  }
  return true;
}

namespace {

int exit_status(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

std::optional<int> ChildProcess::poll() {
  int status = 0;
  if (pid_ > 0 && waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = -1;
  return exit_status(status);
}

void ChildProcess::tell(int signal) const {
  if (pid_ > 0) kill(pid_, signal);
}

int ChildProcess::wait() {
  close_input();
  if (pid_ <= 0) return 0;
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return exit_status(status);
}

void ChildProcess::close_input() {
  if (input_ >= 0) ::close(input_);
  input_ = -1;
}

std::string last_line(const std::string& log_path) {
  std::ifstream log(log_path);
  std::string last;
  for (std::string line; std::getline(log, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

}  // namespace carom
