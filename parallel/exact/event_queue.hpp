// The event queue: a calendar queue whose pages are heaps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/types.hpp"
#include "core/physics/event_order.hpp"

namespace carom {

struct QueuedEvent {
  double time = 0.0;
  // The ids of the two disks of a contact; 0 and 0 for any other event of the disk, so that it comes before contacts at
  // the same time.
  DiskId id1 = 0, id2 = 0;
  std::uint32_t disk = 0;  // storage index
};

// An event is written on the page of its time, in no order; when the time of a page comes, the page is made a heap if
// it holds many events. So the cost of an event does not depend on their number, and hardly any memory but that of the
// present page is touched. Invalidated events stay in the queue; the caller recognises and drops them.
class EventQueue {
 public:
  // Empties the queue, for about `expected` events in [start, end). More events or other times are allowed, but slower.
  void begin(double start, double end, std::size_t expected);

  void push(const QueuedEvent& e) {
    const std::uint32_t page = page_of(e.time);
    if (page < next_page_) {
      now_.push_back(e);
      if (is_heap_) std::push_heap(now_.begin(), now_.end(), LaterEvent{});
      if (!is_heap_ && now_.size() > few_events) make_heap();
    } else {
      write(page, {e.time, e.disk});
    }
  }

  // Takes out the first event; returns false if there is none. name(e) is called to set the ids of the events of a page
  // that is turned; prefetch(disk) is called for events of the next page.
  template <class Name, class Prefetch>
  bool pop(QueuedEvent& e, Name&& name, Prefetch&& prefetch) {
    while (now_.empty()) {
      if (next_page_ == first_.size()) return false;
      turn_page();
      const std::uint32_t next = next_page_ < first_.size() ? first_[next_page_] : none;
      if (next != none) {
        const Chunk& chunk = chunks_[next];
        for (std::uint32_t k = 0; k < chunk.count; ++k) prefetch(chunk.entry[k].disk);
      }
      for (QueuedEvent& event : now_) name(event);
      is_heap_ = false;
      if (now_.size() > few_events) make_heap();
    }
    if (is_heap_) {
      std::pop_heap(now_.begin(), now_.end(), LaterEvent{});
    } else {
      std::swap(now_[first_of_few()], now_.back());
    }
    e = now_.back();
    now_.pop_back();
    return true;
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;
  struct Entry {
    double time;
    std::uint32_t disk;
  };
  static constexpr std::uint32_t entries_a_chunk = 7;
  // A piece of a page: two cache lines.
  struct alignas(64) Chunk {
    Entry entry[entries_a_chunk];
    std::uint32_t next;
    std::uint32_t count;
  };
  static_assert(sizeof(Chunk) == 128);

  // Up to this number of events, searching is faster than keeping a heap.
  static constexpr std::size_t few_events = 12;

  void make_heap() {
    std::make_heap(now_.begin(), now_.end(), LaterEvent{});
    is_heap_ = true;
  }
  // The position of the first event cannot be predicted, so no branch depends on the times unless two are equal.
  std::size_t first_of_few() const {
    std::size_t first = 0;
    for (std::size_t k = 1; k < now_.size(); ++k) {
      const bool tie = now_[k].time == now_[first].time;
      if (tie) [[unlikely]] {
        first = event_order(now_[k], now_[first]) ? k : first;
      } else {
        first = now_[k].time < now_[first].time ? k : first;
      }
    }
    return first;
  }

  std::uint32_t page_of(double time) const {
    const double page = (time - start_) * pages_per_time_;
    if (!(page > 0.0)) return 0;
    return page < last_page_ ? static_cast<std::uint32_t>(page) : static_cast<std::uint32_t>(first_.size() - 1);
  }
  void write(std::uint32_t page, const Entry& entry);
  void turn_page();

  double start_ = 0.0;
  double pages_per_time_ = 0.0;
  double last_page_ = 0.0;
  std::uint32_t next_page_ = 0;
  std::uint32_t free_ = none;         // unused chunks, chained
  std::vector<std::uint32_t> first_;  // the first chunk of each page
  std::vector<Chunk> chunks_;
  std::vector<QueuedEvent> now_;  // the remaining events of the pages turned
  bool is_heap_ = false;
};

}  // namespace carom
