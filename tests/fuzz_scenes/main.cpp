// carom_fuzz_scenes N [SEED]: N random scenes, each in a process of its own, so that a scene that crashes or never ends
// counts as a failure like others. docs/faults.md describes its use.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/fuzz_scenes/random_scene.hpp"
#include "tests/fuzz_scenes/trial.hpp"
#include "tests/fuzz_scenes/wide_scene.hpp"

namespace carom::fuzz {
namespace {

constexpr std::uint32_t most_attempts = 50;
constexpr int fault_status = 1;
constexpr rlim_t gigabyte = rlim_t{1} << 30U;

struct Options {
  std::uint32_t scenes = 0;
  std::uint64_t seed = 1;
  std::uint32_t from = 0;
  bool oracle = false, wide = false, ranks = false, verbose = false, print = false;
  unsigned cpu_seconds = 300, gigabytes = 4;
  std::string folder = "fuzz_scenes", scene;
};

std::string text_of(const Options& options, std::uint32_t number, std::uint32_t attempt) {
  const auto make = options.wide ? (options.oracle ? wide_oracle_scene : wide_scene)
                                 : (options.oracle ? random_oracle_scene : random_scene);
  return make(options.seed, number, attempt);
}

Trial try_text(const Options& options, const std::string& text, const std::string& folder) {
  if (options.ranks) return try_on_ranks(text, "scene", folder);
  return options.oracle ? try_against_oracle(text, "scene") : try_scene(text, "scene", folder);
}

struct Result {
  std::uint32_t attempt = 0;
  std::string account;
  std::vector<std::string> faults;
  bool refused = false;
};

// In the child process: reports what it is about to do, does it, and reports the result.
void try_number(const Options& options, std::uint32_t number, std::FILE* out) {
  for (std::uint32_t attempt = 0; attempt < most_attempts; ++attempt) {
    fmt::print(out, "attempt {}\n", attempt);
    std::fflush(out);
    const Trial trial = try_text(options, text_of(options, number, attempt), "");
    for (const std::string& fault : trial.faults) fmt::print(out, "fault {}\n", fault);
    if (!trial.refusal.empty()) fmt::print(out, "refused {}\n", trial.refusal);
    if (trial.refusal.empty()) fmt::print(out, "account {}\n", trial.account);
    if (trial.refusal.empty() || !trial.faults.empty()) return;
  }
}

std::string read_all(int pipe) {
  std::string all;
  char buffer[4096];
  for (ssize_t n = 0; (n = ::read(pipe, buffer, sizeof buffer)) > 0;) all.append(buffer, static_cast<std::size_t>(n));
  return all;
}

Result read_result(const std::string& said, int status) {
  Result result;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    const std::string word = line.substr(0, line.find(' '));
    const std::string rest = line.substr(std::min(line.size(), word.size() + 1));
    if (word == "attempt") result.attempt = static_cast<std::uint32_t>(std::stoul(rest));
    if (word == "fault") result.faults.push_back(rest);
    if (word == "account") result.account = rest;
  }
  if (WIFSIGNALED(status)) {
    const bool endless = WTERMSIG(status) == SIGXCPU;
    result.faults.push_back(endless ? "does not end" : fmt::format("died of signal {}", WTERMSIG(status)));
  } else if (WEXITSTATUS(status) != 0) {
    result.faults.push_back(fmt::format("ended with status {}: {}", WEXITSTATUS(status), said));
  }
  result.refused = result.account.empty() && result.faults.empty();
  return result;
}

Result in_a_process(const Options& options, std::uint32_t number) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    ::close(ends[0]);
    const rlimit limit{options.cpu_seconds, options.cpu_seconds + 10};
    ::setrlimit(RLIMIT_CPU, &limit);
    const rlimit memory{options.gigabytes * gigabyte, options.gigabytes * gigabyte};
    if (options.gigabytes > 0) ::setrlimit(RLIMIT_AS, &memory);
    std::FILE* const out = ::fdopen(ends[1], "w");
    int status = 0;
    try {
      try_number(options, number, out);
    } catch (const std::exception& error) {
      fmt::print(out, "fault exception: {}\n", error.what());
    }
    std::fclose(out);
    ::_exit(status);
  }
  ::close(ends[1]);
  const std::string said = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  return read_result(said, status);
}

// Saves the scene, with its faults in a comment at the top. Returns the file's name.
std::string save(const Options& options, std::uint32_t number, const Result& result) {
  std::filesystem::create_directories(options.folder);
  const std::string path = fmt::format("{}/{}{}_{}_{}.toml", options.folder, options.wide ? "wide_" : "",
                                       options.oracle  ? "oracle"
                                       : options.ranks ? "ranks"
                                                       : "scene",
                                       options.seed, number);
  std::ofstream file(path);
  for (const std::string& fault : result.faults) file << "# " << fault << "\n";
  file << text_of(options, number, result.attempt);
  return path;
}

int run_many(const Options& options) {
  std::uint32_t failed = 0;
  std::uint32_t refused = 0;
  for (std::uint32_t k = options.from; k < options.from + options.scenes; ++k) {
    const Result result = in_a_process(options, k);
    if (result.refused) ++refused;
    if (options.verbose) fmt::print("{}.{}: {}\n", k, result.attempt, result.account);
    std::fflush(stdout);
    if (result.faults.empty()) continue;
    ++failed;
    fmt::print("{}: {}\n", save(options, k, result), result.faults.front());
  }
  fmt::print("{} random {} of seed {}: {} failed, {} could not be made\n", options.scenes,
             options.oracle  ? "scenes against the oracle"
             : options.ranks ? "scenes on ranks"
                             : "scenes",
             options.seed, failed, refused);
  return failed == 0 ? 0 : fault_status;
}

int run_one(const Options& options) {
  std::ostringstream text;
  text << std::ifstream(options.scene).rdbuf();
  const Trial trial = try_text(options, text.str(), std::filesystem::path(options.scene).parent_path().string());
  for (const std::string& fault : trial.faults) fmt::print("{}\n", fault);
  fmt::print("{}: {}\n", options.scene, trial.refusal.empty() ? trial.account : trial.refusal);
  return trial.faults.empty() ? 0 : fault_status;
}

}  // namespace
}  // namespace carom::fuzz

int main(int argc, char** argv) {
  carom::fuzz::Options options;
  CLI::App app("Random scenes of all features: every engine has the reference's bits, and they make sense.");
  app.add_option("N", options.scenes, "number of scenes");
  app.add_option("SEED", options.seed, "of the scenes");
  app.add_option("--from", options.from, "number of the first scene");
  app.add_flag("--oracle", options.oracle, "method exact against an all-pairs simulation");
  app.add_flag("--ranks", options.ranks, "on two and three ranks, against one machine");
  app.add_flag("--wide", options.wide, "flat boxes, clusters, cold flows, long walls, very unequal obstacles");
  app.add_option("-o", options.folder, "folder for the scenes that fail");
  app.add_option("--scene", options.scene, "tries this file instead");
  app.add_option("--cpu-seconds", options.cpu_seconds, "a scene that needs more fails");
  app.add_option("--gigabytes", options.gigabytes, "likewise of memory; 0: no limit, which sanitizers need");
  app.add_flag("--print", options.print, "only prints scene number N");
  app.add_flag("--verbose", options.verbose, "a line a scene");
  CLI11_PARSE(app, argc, argv);
  if (options.print) {
    fmt::print("{}", carom::fuzz::text_of(options, options.scenes, 0));
    return 0;
  }
  return options.scene.empty() ? carom::fuzz::run_many(options) : carom::fuzz::run_one(options);
}
