// The events to come of a window, in order of time: a calendar whose pages are heaps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/types.hpp"

namespace carom {

// What is to happen to a disk at a time.
struct QueuedEvent {
  double time = 0.0;
  DiskId id1 = 0, id2 = 0;  // of the two that meet; 0, 0: the disk has to look, which comes before what meets
  std::uint32_t disk = 0;   // storage index, perhaps with a mark in its first bit

  // The canonical order, backwards.
  bool after(const QueuedEvent& e) const {
    if (time != e.time) return time > e.time;
    if (id1 != e.id1) return id1 > e.id1;
    return id2 > e.id2;
  }
};

// Events are put on the page of their time, in any order; the first of a page is looked for when its time comes, in a
// heap if there are many. So an event costs the same however many there are, and little memory is touched but the page
// at hand. What became void meanwhile stays in the queue; whoever takes it out has to see that.
class ExactQueue {
 public:
  // Empty, for about `expected` events in [start, end). Others are welcome too, at some cost.
  void begin(double start, double end, std::size_t expected);

  void push(const QueuedEvent& e) {
    const std::uint32_t page = page_of(e.time);
    if (page < next_page_) {
      now_.push_back(e);
      if (is_heap_) std::push_heap(now_.begin(), now_.end(), after);
      if (!is_heap_ && now_.size() > few_events) make_heap();
    } else {
      write(page, {e.time, e.disk});
    }
  }

  // Takes out the first event; false if there is none. name(e) sets the ids of an event; soon(disk) hears of those
  // whose time will come before long.
  template <class Name, class Soon>
  bool pop(QueuedEvent& e, Name&& name, Soon&& soon) {
    while (now_.empty()) {
      if (next_page_ == first_.size()) return false;
      turn_page();
      const std::uint32_t next = next_page_ < first_.size() ? first_[next_page_] : none;
      if (next != none) {
        const Chunk& chunk = chunks_[next];
        for (std::uint32_t k = 0; k < chunk.count; ++k) soon(chunk.note[k].disk);
      }
      for (QueuedEvent& event : now_) name(event);
      is_heap_ = false;
      if (now_.size() > few_events) make_heap();
    }
    if (is_heap_) {
      std::pop_heap(now_.begin(), now_.end(), after);
    } else {
      std::swap(now_[first_of_few()], now_.back());
    }
    e = now_.back();
    now_.pop_back();
    return true;
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;
  struct Note {
    double time;
    std::uint32_t disk;
  };
  static constexpr std::uint32_t chunk_notes = 7;
  // Two cache lines of a page.
  struct alignas(64) Chunk {
    Note note[chunk_notes];
    std::uint32_t next;
    std::uint32_t count;
  };
  static_assert(sizeof(Chunk) == 128);

  // So many are looked through faster than a heap is kept.
  static constexpr std::size_t few_events = 12;

  static bool after(const QueuedEvent& a, const QueuedEvent& b) { return a.after(b); }
  void make_heap() {
    std::make_heap(now_.begin(), now_.end(), after);
    is_heap_ = true;
  }
  // Which of them comes first is as good as random: no branch depends on times, but for equal ones.
  std::size_t first_of_few() const {
    std::size_t first = 0;
    for (std::size_t k = 1; k < now_.size(); ++k) {
      const bool tie = now_[k].time == now_[first].time;
      if (tie) [[unlikely]] {
        first = now_[first].after(now_[k]) ? k : first;
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
  void write(std::uint32_t page, const Note& note);
  void turn_page();

  double start_ = 0.0;
  double pages_per_time_ = 0.0;
  double last_page_ = 0.0;
  std::uint32_t next_page_ = 0;
  std::uint32_t free_ = none;         // chunks that hold nothing, chained
  std::vector<std::uint32_t> first_;  // chunk of each page
  std::vector<Chunk> chunks_;
  std::vector<QueuedEvent> now_;  // what is left of the pages turned
  bool is_heap_ = false;
};

}  // namespace carom
