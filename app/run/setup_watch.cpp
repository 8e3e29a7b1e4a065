#include "app/run/setup_watch.hpp"

#include <fmt/format.h>

#include <condition_variable>
#include <mutex>
#include <stop_token>

#include "app/cli/messages.hpp"
#include "run/loop/checkpoint_keeper.hpp"
#include "run/loop/stop_signals.hpp"

namespace carom {

namespace {

constexpr std::chrono::milliseconds pause{10};
constexpr int stopped_early = 4;

// A shorter setup is not interrupted before the first step, where a checkpoint can be written. Seconds of processor
// time and of wall time.
constexpr double short_cpu = 1.0, short_wall = 60.0;

// Nothing has been written, and the thread that makes the state cannot be asked to stop, so the process ends here.
[[noreturn]] void stop(std::string_view what) {
  print_note(
      fmt::format("stopped by {} while the initial state was made; there is no checkpoint to resume from", what));
  std::_Exit(stopped_early);
}

void watch(const std::stop_token& done, WallClock::time_point started, double max_walltime) {
  const auto begun = WallClock::now();
  std::mutex mutex;
  std::condition_variable_any woken;
  std::unique_lock lock(mutex);
  while (!done.stop_requested()) {
    const Wish wish = take_wish();
    if (wish == Wish::stop) stop(stop_signal_name());
    if (wish == Wish::checkpoint) print_note("no checkpoint yet: the initial state is still being made");
    const bool is_long = cpu_seconds() > short_cpu || seconds_since(begun) > short_wall;
    if (is_long && seconds_since(started) > max_walltime) stop("--max-walltime");
    woken.wait_for(lock, done, pause, [] { return false; });
  }
}

}  // namespace

SetupWatch::SetupWatch(WallClock::time_point started, double max_walltime)
    : thread_([=](const std::stop_token& done) { watch(done, started, max_walltime); }) {}

SetupWatch::~SetupWatch() = default;

}  // namespace carom
