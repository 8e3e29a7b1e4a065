#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

#include "bench/figures/figures.hpp"

namespace carom::bench {

namespace {

// The largest resident memory of `program run scene` until t_end, in bytes.
double peak_of_run(const std::string& program, const std::string& scene, const std::string& method,
                   const std::string& t_end) {
  const std::vector<std::string> words{program,  "run",     scene,      "--t-end", t_end,
                                       "--json", "--quiet", "--method", method};
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  rusage usage{};
  if (failed != 0 || wait4(child, &status, 0, &usage) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error("could not run " + program + " run " + scene);
  }
  return static_cast<double>(usage.ru_maxrss) * 1024.0;
}

}  // namespace

std::vector<Figure> measure_memory(const std::string& program, const std::string& scene) {
  constexpr double disks = 1e6;
  // The runs take ten steps, or a few windows.
  return {{"G: memory at peak of carom run",
           peak_of_run(program, scene, "pairwise", "0.05") / disks,
           "bytes per disk",
           100.0,
           {}},
          {"G, exact: memory at peak of carom run",
           peak_of_run(program, scene, "exact", "0.3") / disks,
           "bytes per disk",
           160.0,
           {}}};
}

}  // namespace carom::bench
