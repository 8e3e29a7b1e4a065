#include "parallel/ranks/local_ranks.hpp"

#include <algorithm>
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

// What the threads share: a queue of messages for each rank and direction, and a table that all of them fill and read.
class Meeting {
 public:
  explicit Meeting(int count) : inboxes_(static_cast<std::size_t>(count)), tables_(2) {
    for (Table& table : tables_) table.entries.resize(inboxes_.size());
  }

  int count() const { return static_cast<int>(inboxes_.size()); }

  void send(int to, bool from_below, const Bytes& message) {
    const std::lock_guard lock(mutex_);
    queue_of(to, from_below).push_back(message);
    changed_.notify_all();
  }

  Bytes receive(int rank, bool from_below) {
    std::unique_lock lock(mutex_);
    std::deque<Bytes>& queue = queue_of(rank, from_below);
    wait(lock, [&] { return !queue.empty(); });
    Bytes message = std::move(queue.front());
    queue.pop_front();
    return message;
  }

  // The entries of all ranks. Two tables take turns: no rank fills the next one before all have filled this one, and
  // none fills this one again before all have read it, as they fill the next one afterwards.
  std::vector<Bytes> share(int rank, std::uint64_t turn, const Bytes& entry) {
    std::unique_lock lock(mutex_);
    Table& table = tables_[turn % 2];
    if (table.turn != turn) {
      table.turn = turn;
      table.filled = 0;
    }
    table.entries[static_cast<std::size_t>(rank)] = entry;
    ++table.filled;
    changed_.notify_all();
    wait(lock, [&] { return table.filled == table.entries.size(); });
    return table.entries;
  }

  // A rank has thrown.
  void fail(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::move(error);
    changed_.notify_all();
  }
  std::exception_ptr error() const { return error_; }

 private:
  struct Inbox {
    std::deque<Bytes> from_below, from_above;
  };
  struct Table {
    std::uint64_t turn = 0;
    std::size_t filled = 0;
    std::vector<Bytes> entries;  // of each rank
  };

  std::deque<Bytes>& queue_of(int rank, bool from_below) {
    Inbox& inbox = inboxes_[static_cast<std::size_t>(rank)];
    return from_below ? inbox.from_below : inbox.from_above;
  }

  template <class Ready>
  void wait(std::unique_lock<std::mutex>& lock, Ready&& ready) {
    changed_.wait(lock, [&] { return ready() || error_; });
    if (!ready()) throw std::runtime_error("another rank has failed");
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Inbox> inboxes_;
  std::vector<Table> tables_;
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
  Bytes share_first(const Bytes& first) override { return gather_from_all(rank_ == 0 ? first : Bytes())[0]; }

  template <class T, class Join>
  void reduce(std::span<T> values, Join&& join) {
    const std::vector<Bytes> all = gather_from_all(bytes_of<T>(values));
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
  std::uint64_t turn_ = 0;
};

}  // namespace

void run_on_local_ranks(int count, const std::function<void(Ranks&)>& body) {
  Meeting meeting(count);
  std::vector<std::thread> threads;
  for (int r = 0; r < count; ++r) {
    threads.emplace_back([&, r] {
      try {
        LocalRanks ranks(meeting, r);
        body(ranks);
      } catch (...) {
        meeting.fail(std::current_exception());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  if (meeting.error()) std::rethrow_exception(meeting.error());
}

}  // namespace carom
