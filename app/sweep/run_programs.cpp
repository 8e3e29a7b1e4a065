#include "app/sweep/run_programs.hpp"

#include <chrono>
#include <csignal>
#include <thread>
#include <utility>
#include <vector>

#include "run/loop/stop_signals.hpp"

namespace carom {

namespace {

// Short compared with a program's own start, long compared with the work of looking.
constexpr std::chrono::milliseconds pause{5};

struct Running {
  std::size_t number;
  std::unique_ptr<ChildProcess> child;
};

}  // namespace

bool run_programs(const Programs& programs) {
  std::vector<Running> running;
  std::size_t next = 0;
  std::size_t ended = 0;
  bool stopping = false;
  while (!running.empty() || (!stopping && next < programs.count)) {
    const Wish wish = take_wish();
    if (wish == Wish::checkpoint || (wish == Wish::stop && !stopping)) {
      for (const Running& r : running) r.child->tell(wish == Wish::stop ? SIGTERM : SIGUSR1);
    }
    stopping = stopping || wish == Wish::stop;
    for (; !stopping && next < programs.count && running.size() < programs.at_once; ++next) {
      std::unique_ptr<ChildProcess> child = programs.start(next);
      if (child) {
        running.push_back({next, std::move(child)});
      } else {
        ++ended;
      }
    }
    std::erase_if(running, [&](const Running& r) {
      const std::optional<int> status = r.child->poll();
      if (!status) return false;
      ++ended;
      programs.ended(r.number, *status);
      return true;
    });
    programs.pulse(ended);
    std::this_thread::sleep_for(pause);
  }
  return !stopping;
}

}  // namespace carom
