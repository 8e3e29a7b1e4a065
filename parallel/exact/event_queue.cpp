#include "parallel/exact/event_queue.hpp"

namespace carom {

namespace {

// Few enough that searching for the first one is fast, enough that few pages are empty.
constexpr std::size_t events_per_page = 3;

}  // namespace

void EventQueue::begin(double start, double end, std::size_t expected) {
  const std::size_t pages = expected / events_per_page + 1;
  first_.assign(pages, none);
  chunks_.clear();
  now_.clear();
  is_heap_ = false;
  free_ = none;
  next_page_ = 0;
  start_ = start;
  last_page_ = static_cast<double>(pages - 1);
  pages_per_time_ = end > start ? static_cast<double>(pages) / (end - start) : 0.0;
}

void EventQueue::write(std::uint32_t page, const Entry& entry) {
  std::uint32_t c = first_[page];
  if (c == none || chunks_[c].count == entries_a_chunk) {
    std::uint32_t fresh = free_;
    if (fresh != none) {
      free_ = chunks_[fresh].next;
    } else {
      fresh = static_cast<std::uint32_t>(chunks_.size());
      chunks_.emplace_back();
    }
    chunks_[fresh].next = c;
    chunks_[fresh].count = 0;
    first_[page] = c = fresh;
  }
  Chunk& chunk = chunks_[c];
  chunk.entry[chunk.count++] = entry;
}

void EventQueue::turn_page() {
  std::uint32_t c = first_[next_page_++];
  while (c != none) {
    Chunk& chunk = chunks_[c];
    for (std::uint32_t k = 0; k < chunk.count; ++k) {
      now_.push_back({chunk.entry[k].time, 0, 0, chunk.entry[k].disk});
    }
    const std::uint32_t next = chunk.next;
    chunk.next = free_;
    free_ = c;
    c = next;
  }
}

}  // namespace carom
