// The event calendar: one entry a disk, the time of its next event. For one queue of all disks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/physics/exact_path.hpp"

namespace carom {

// The time from start to end is divided into pages; a page is a doubly linked list of the disks whose next event falls
// on it, in no order. The present page is searched for the first event whenever it is asked for; pages are so short
// that it holds one or two. An entry that becomes invalid moves to its new page, so that none has to be recognised and
// dropped. Where events crowd, pages are made shorter, and a page on which they crowd all the same is put in order.
class EventCalendar {
 public:
  // Empties the calendar, for events in [start, end] of this many disks; about `expected` of them, if that is known.
  void begin(double start, double end, std::size_t disks, std::size_t expected);

  // Enters the disk, before any event is asked for; once for each. `never` and other times beyond the end are allowed.
  void insert(std::uint32_t disk, double time) {
    node_[disk].time = time;
    link(disk, page_of(time));
  }
  // The disk's next event is at another time. comes_first: as in find_first.
  template <class ComesFirst>
  void move(std::uint32_t disk, double time, ComesFirst&& comes_first) {
    const Node left = node_[disk];
    std::uint32_t& to_here =
        (left.previous & page_bit) != 0 ? first_[left.previous & ~page_bit] : node_[left.previous].next;
    to_here = left.next;
    node_[left.next].previous = left.previous;
    node_[disk].time = time;
    const std::uint32_t page = page_of(time);
    if (is_sorted_ && page == page_) [[unlikely]] {
      link_in_order(disk, comes_first);
    } else {
      link(disk, page);
    }
  }
  double time_of(std::uint32_t disk) const { return node_[disk].time; }

  // The disk whose event is the first one up to the end; false if there is none. It stays where it is until it is
  // moved. comes_first(a, b): of two disks with events at the same time, does that of a come first?
  // soon(disk) is called for a disk of a page that comes soon.
  template <class ComesFirst, class Soon>
  bool find_first(std::uint32_t& disk, ComesFirst&& comes_first, Soon&& soon) {
    for (;;) {
      const std::uint32_t begin = first_[page_];
      if (begin == end_of_list_) {
        is_sorted_ = false;
        if (page_ + 1 == pages_) return false;
        const std::uint32_t next = first_[std::min(++page_ + pages_ahead, pages_)];
        if (next != end_of_list_) soon(next);
        continue;
      }
      disk = begin;
      if (is_sorted_) return true;
      std::uint32_t length = 1;
      double first = node_[begin].time;
      for (std::uint32_t k = node_[begin].next; k != end_of_list_; k = node_[k].next, ++length) {
        const double time = node_[k].time;
        if (time == first) [[unlikely]] {
          disk = comes_first(k, disk) ? k : disk;
        } else {
          disk = time < first ? k : disk;
          first = time < first ? time : first;
        }
      }
      if (length <= crowd) [[likely]]
        return true;
      if (!shorten_pages()) sort_page(comes_first);
    }
  }

 private:
  struct Node {
    double time;
    std::uint32_t previous;  // disk; or page_bit and the page that begins with this one
    std::uint32_t next;      // disk, or end_of_list_
  };
  static_assert(sizeof(Node) == 16);
  static constexpr std::uint32_t page_bit = 0x80000000U;
  // More than so many entries on a page are not searched.
  static constexpr std::uint32_t crowd = 64;
  static constexpr std::uint32_t pages_ahead = 3;

  std::uint32_t page_of(double time) const {
    const double page = std::min(std::max((time - start_) * pages_per_time_, 0.0), last_page_);
    const auto p = static_cast<std::uint32_t>(static_cast<std::int32_t>(page));
    return time <= end_ ? std::max(p, page_) : pages_;
  }
  void link(std::uint32_t disk, std::uint32_t page) {
    const std::uint32_t next = first_[page];
    node_[disk].previous = page | page_bit;
    node_[disk].next = next;
    node_[next].previous = disk;
    first_[page] = disk;
  }
  template <class ComesFirst>
  void link_in_order(std::uint32_t disk, ComesFirst&& comes_first) {
    const double time = node_[disk].time;
    std::uint32_t previous = page_ | page_bit;
    std::uint32_t next = first_[page_];
    while (next != end_of_list_ &&
           (node_[next].time < time || (node_[next].time == time && !comes_first(disk, next)))) {
      previous = next;
      next = node_[next].next;
    }
    ((previous & page_bit) != 0 ? first_[page_] : node_[previous].next) = disk;
    node_[disk].previous = previous;
    node_[disk].next = next;
    node_[next].previous = disk;
  }
  void set_pages(double start, double pages_per_time, std::size_t pages);
  bool shorten_pages();
  void collect_page();
  void relink_page();
  template <class ComesFirst>
  void sort_page(ComesFirst&& comes_first) {
    collect_page();
    std::sort(crowded_.begin(), crowded_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return node_[a].time != node_[b].time ? node_[a].time < node_[b].time : comes_first(a, b);
    });
    relink_page();
  }

  double start_ = 0.0, end_ = 0.0;
  double pages_per_time_ = 0.0;
  double last_page_ = 0.0;
  std::uint32_t pages_ = 1;
  std::uint32_t page_ = 0;  // the present one
  bool is_sorted_ = false;  // the present page
  std::uint32_t end_of_list_ = 0;
  std::vector<Node> node_;              // of each disk, and one that ends all lists
  std::vector<std::uint32_t> first_;    // of each page, and of what comes after the end
  std::vector<std::uint32_t> crowded_;  // scratch
};

}  // namespace carom
