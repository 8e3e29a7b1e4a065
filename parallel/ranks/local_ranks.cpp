#include "parallel/ranks/local_ranks.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

namespace carom {

namespace {

// The data shared by the threads: a queue of messages for each rank and direction, and a table that all ranks fill and
// read. Each rank has its own condition to sleep on: a message wakes only its receiver, and a full table wakes every
// other rank once. Tests have more ranks than cores, and then threads that wake in vain, or wait for a common lock,
// would cost more than everything else.
class Meeting {
 public:
  explicit Meeting(int count) : places_(static_cast<std::size_t>(count)) {
    for (Table& table : tables_) table.entries.resize(places_.size());
  }

  int count() const { return static_cast<int>(places_.size()); }

  void send(int to, bool from_below, const Bytes& message) {
    Place& place = places_[static_cast<std::size_t>(to)];
    {
      const std::lock_guard lock(place.mutex);
      place.queue(from_below).push_back(message);
    }
    place.changed.notify_one();
  }

  Bytes receive(int rank, bool from_below) {
    Place& place = places_[static_cast<std::size_t>(rank)];
    std::deque<Bytes>& queue = place.queue(from_below);
    std::unique_lock lock(place.mutex);
    place.wait(lock, [&] { return !queue.empty() || full_ == failed; });
    if (queue.empty()) fail_too();
    Bytes message = std::move(queue.front());
    queue.pop_front();
    return message;
  }

  // Returns the entries of all ranks, valid until this rank calls again. turn: 1 at the first call, 2 at the second,
  // and so on. Two tables are used in turn: no rank fills the next table before all have filled this one, and none
  // fills this one again before all have read it, since they then fill the next one.
  const std::vector<Bytes>& share(int rank, int turn, const Bytes& entry) {
    Table& table = tables_[static_cast<std::size_t>(turn % 2)];
    table.entries[static_cast<std::size_t>(rank)] = entry;
    if (++table.filled == count()) {
      table.filled = 0;
      int before = turn - 1;
      if (full_.compare_exchange_strong(before, turn)) wake_all();
    }
    Place& place = places_[static_cast<std::size_t>(rank)];
    std::unique_lock lock(place.mutex);
    place.wait(lock, [&] { return full_ == turn || full_ == failed; });
    if (full_ == failed) fail_too();
    return table.entries;
  }

  // To be called when a rank has thrown.
  void fail(std::exception_ptr error) {
    {
      const std::lock_guard lock(error_mutex_);
      if (!error_) error_ = std::move(error);
    }
    full_ = failed;
    wake_all();
  }
  // Precondition: all ranks have ended.
  std::exception_ptr error() const { return error_; }

 private:
  struct Place {
    std::deque<Bytes>& queue(bool of_below) { return of_below ? from_below : from_above; }

    // A message usually comes within microseconds, once its sender has a core. To sleep and be woken takes longer, on a
    // virtual machine ten times as long; so the thread first yields to others a few times.
    template <class Come>
    void wait(std::unique_lock<std::mutex>& lock, Come&& come) {
      constexpr int turns = 50;
      for (int turn = 0; turn < turns && !come(); ++turn) {
        lock.unlock();
        std::this_thread::yield();
        lock.lock();
      }
      changed.wait(lock, come);
    }

    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Bytes> from_below, from_above;
  };
  struct Table {
    std::vector<Bytes> entries;  // of each rank
    std::atomic<int> filled = 0;
  };

  // The lock is needed for a rank that has checked but does not wait yet.
  void wake_all() {
    for (Place& place : places_) {
      { const std::lock_guard lock(place.mutex); }
      place.changed.notify_one();
    }
  }
  [[noreturn]] static void fail_too() { throw std::runtime_error("another rank has failed"); }

  static constexpr int failed = -1;
  std::vector<Place> places_;  // of each rank
  std::array<Table, 2> tables_;
  std::atomic<int> full_ = 0;  // the turn whose table was filled last, or failed
  std::mutex error_mutex_;
  std::exception_ptr error_;
};

template <class T>
Bytes bytes_of(std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  return {bytes.begin(), bytes.end()};
}

class LocalRanks final : public Ranks {
 public:
  LocalRanks(Meeting& meeting, int rank) : meeting_(meeting), rank_(rank) {}

  int rank() const override { return rank_; }
  int count() const override { return meeting_.count(); }

 private:
  FromNeighbours send_and_receive(const Bytes& to_below, const Bytes& to_above) override {
    meeting_.send(below(), false, to_below);
    meeting_.send(above(), true, to_above);
    FromNeighbours from;
    from.below = meeting_.receive(rank_, true);
    from.above = meeting_.receive(rank_, false);
    return from;
  }

  void reduce_to_sum(std::span<std::int64_t> values) override {
    reduce(values, [](std::int64_t a, std::int64_t b) { return a + b; });
  }
  void reduce_to_maximum(std::span<double> values) override {
    reduce(values, [](double a, double b) { return std::max(a, b); });
  }
  std::vector<Bytes> gather_from_all(const Bytes& here) override { return meeting_.share(rank_, ++turn_, here); }

  std::vector<Bytes> gather_at_first(const Bytes& here) override {
    std::vector<Bytes> all = gather_from_all(here);
    if (rank_ != 0) all.clear();
    return all;
  }
  Bytes share_first(const Bytes& first) override {
    return meeting_.share(rank_, ++turn_, rank_ == 0 ? first : Bytes())[0];
  }

  template <class T, class Join>
  void reduce(std::span<T> values, Join&& join) {
    const std::vector<Bytes>& all = meeting_.share(rank_, ++turn_, bytes_of<T>(values));
    for (std::size_t r = 0; r < all.size(); ++r) {
      if (all[r].size() != values.size_bytes()) throw std::logic_error("ranks reduce different numbers of values");
      for (std::size_t k = 0; k < values.size(); ++k) {
        T value{};
        std::memcpy(&value, all[r].data() + k * sizeof(T), sizeof(T));
        values[k] = r == 0 ? value : join(values[k], value);
      }
    }
  }

  Meeting& meeting_;
  int rank_;
  int turn_ = 0;
};

}  // namespace

void run_on_local_ranks(int count, const std::function<void(Ranks&)>& body) {
  Meeting meeting(count);
  std::vector<std::thread> threads;
  const auto run_rank = [&](int r) {
    try {
      LocalRanks ranks(meeting, r);
      body(ranks);
    } catch (...) {
      meeting.fail(std::current_exception());
    }
  };
  try {
    for (int r = 0; r < count; ++r) threads.emplace_back(run_rank, r);
  } catch (...) {  // a thread could not be started: the others would wait for it for ever
    meeting.fail(std::current_exception());
  }
  for (std::thread& thread : threads) thread.join();
  if (meeting.error()) std::rethrow_exception(meeting.error());
}

}  // namespace carom
