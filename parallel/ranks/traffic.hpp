// Counts of the messages of a rank, and the time that they took. No result depends on them.
#pragma once

#include "core/base/types.hpp"
#include "core/base/wall_clock.hpp"

namespace carom {

struct Messages {
  Count messages = 0, bytes = 0;

  void add(const Messages& other) {
    messages += other.messages;
    bytes += other.bytes;
  }
};

// For one rank: messages to neighbours; and collective calls, each with the bytes of this rank's entry, however often
// MPI passes them on.
struct Traffic {
  Messages exchange, all_reduce, gather;
  double seconds = 0.0;  // in all of these, including the time spent waiting for other ranks

  Messages all() const {
    Messages sum = exchange;
    sum.add(all_reduce);
    sum.add(gather);
    return sum;
  }
};

// The difference between `now` and `before`.
inline Traffic traffic_since(const Traffic& before, const Traffic& now) {
  const auto more = [](const Messages& b, const Messages& n) {
    return Messages{n.messages - b.messages, n.bytes - b.bytes};
  };
  return {more(before.exchange, now.exchange), more(before.all_reduce, now.all_reduce), more(before.gather, now.gather),
          now.seconds - before.seconds};
}

// Adds the time from construction to destruction.
class TrafficTimer {
 public:
  explicit TrafficTimer(double& seconds) : seconds_(seconds) {}
  TrafficTimer(const TrafficTimer&) = delete;
  TrafficTimer& operator=(const TrafficTimer&) = delete;
  ~TrafficTimer() { seconds_ += seconds_since(start_); }

 private:
  double& seconds_;
  WallClock::time_point start_ = WallClock::now();
};

}  // namespace carom
