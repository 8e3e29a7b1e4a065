// The event calendar: one entry for each disk, the time of its next event. For all disks, or for those of a region.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/physics/exact_path.hpp"

namespace carom {

// A disk's next event: no event that is stored with the disk happens before `time`. This holds whether or not the entry
// is in a calendar.
struct CalendarEntry {
  double time = 0.0;
  // For the calendar: the disks before and after this one on its page, or marks. Meaningless between windows.
  std::uint32_t previous = 0, next = 0;
};
static_assert(sizeof(CalendarEntry) == 16);

// The entries of the disks [first, last), by storage index, and the one that ends all lists of their calendar.
struct CalendarEntries {
  CalendarEntry* entry = nullptr;
  std::uint32_t first = 0, last = 0;
  std::uint32_t end = 0;
};

// A calendar queue. The time from start to end is divided into pages; a page is a doubly linked, unordered list of the
// disks whose next event falls on it. The present page is searched for its first event each time; pages are so short
// that it holds one or two events. When a disk is predicted again its entry moves to another page, so there are no
// invalid entries. If too many events fall on a page, pages are shortened; if that does not help, the page is sorted.
//
// If there are many disks, neither a page nor the disks on it are in a cache. So an entry for a later page waits in
// transit for some moves, until the page has been prefetched, and disks on pages that come soon are announced, so that
// their data can be prefetched. The time is then divided into several parts one after another, so that pages take less
// memory than the disks' entries.
class EventCalendar {
 public:
  // How often a disk is announced before its event comes.
  static constexpr int stages = 3;

  // Empties the calendar, for events of these disks in [start, end]. expected: approximate number of events; 0 if not
  // known. many: there are so many disks that events that come soon are announced, unless few are expected. The entries
  // outlive the calendar's use.
  void begin(double start, double end, const CalendarEntries& disks, std::size_t expected, bool many);

  // Frees the memory of the pages; begin() must be called next.
  void release_memory();

  // Enters the disks with the times of their entries. Must be called before find_first. `never` and other times beyond
  // the end are allowed. A disk for which is_in(disk) is false is not in the calendar until it is moved.
  template <class IsIn>
  void insert_all(IsIn&& is_in) {
    // Copies in registers: stores to entries could change the members otherwise.
    const PageOfTime page_of = pages_of_times();
    Node* const node = node_;
    std::uint32_t* const first = first_.data();
    for (std::uint32_t disk = first_disk_; disk < last_disk_; ++disk) {
      if (is_in(disk)) {
        link(node, first, disk, page_of(node[disk].time));
      } else {
        node[disk].previous = node[disk].next = absent;
      }
    }
  }
  // Changes the time of the disk's next event; a disk that was taken out is entered again. comes_first: as in
  // find_first. Always inlined, with the functions that it calls: every collision calls it twice.
  template <class ComesFirst>
  [[gnu::always_inline]] void move(std::uint32_t disk, double time, ComesFirst comes_first) {
    unlink(disk);
    put(disk, time, comes_first);
  }
  // The same for a disk that is not in the calendar; with an event after the end it stays out.
  template <class ComesFirst>
  [[gnu::always_inline]] void enter(std::uint32_t disk, double time, ComesFirst comes_first) {
    if (time > end_) {
      node_[disk].time = time;
    } else {
      put(disk, time, comes_first);
    }
  }
  // Takes the disk out; it keeps its time.
  void take_out(std::uint32_t disk) {
    unlink(disk);
    node_[disk].previous = node_[disk].next = absent;
  }
  bool holds(std::uint32_t disk) const { return node_[disk].next != absent; }
  double time_of(std::uint32_t disk) const { return node_[disk].time; }
  [[gnu::always_inline]] void prefetch(std::uint32_t disk) const { __builtin_prefetch(&node_[disk]); }

  // Finds the disk whose event is the first one up to the end, and its time; false if there is none. The disk stays in
  // the calendar until it is moved. comes_first(a, b): of two disks with events at the same time, does that of a come
  // first? Announces disks on pages that come soon: soon(disk, stage), stage < stages. Inlined as move is.
  template <class ComesFirst, class Soon>
  [[gnu::always_inline]] bool find_first(std::uint32_t& disk, double& time, ComesFirst comes_first, Soon soon) {
    for (;;) {
      disk = first_[page_];
      if (disk == end_of_list_) {
        if (!turn_page(soon)) return false;
        continue;
      }
      const Node* const node = node_;
      time = node[disk].time;
      if (page_ < unsorted_from_) [[unlikely]]
        return true;
      std::uint32_t length = 1;
      for (std::uint32_t k = node[disk].next; k != end_of_list_; k = node[k].next, ++length) {
        const double its = node[k].time;
        if (its == time) [[unlikely]] {
          disk = comes_first(k, disk) ? k : disk;
        } else {
          disk = its < time ? k : disk;
          time = std::min(its, time);
        }
      }
      if (length <= crowd) [[likely]]
        return true;
      if (!shorten_pages()) sort_page(comes_first);
    }
  }

 private:
  using Node = CalendarEntry;
  // Values of Node::previous other than a disk: the page that begins with this disk, with page_bit; in_transit, with
  // the place in transit in `next`; absent, for a disk that is not in the calendar.
  static constexpr std::uint32_t page_bit = 0x80000000U;
  static constexpr std::uint32_t absent = 0xffffffffU;
  static constexpr std::uint32_t in_transit = 0xfffffffeU;  // an entry that waits to be written to its page
  // A page with more entries than this is not searched each time: pages are shortened, or it is sorted.
  static constexpr std::uint32_t crowd = 64;
  // The number of disks announced between two announcements of the same disk.
  static constexpr std::uint32_t disks_a_stage = 2;
  static constexpr std::uint32_t pages_ahead = 9;
  // Only entries for pages further ahead than this go into transit.
  static constexpr std::uint32_t pages_of_transit = 2 * pages_ahead;
  static constexpr std::uint32_t places_in_transit = 8;
  // The largest numbers of disks of a page that are announced, and of disks announced when a page is turned. More are
  // rare.
  static constexpr std::uint32_t announced_a_page = 4;
  static constexpr int announced_at_once = 3;

  // An entry of a page that comes soon, and the number of disks of its list, from this one on, that are to be
  // announced.
  struct Followed {
    std::uint32_t disk;
    std::uint32_t left;
  };

  // An entry that has not been written to its page yet.
  struct Transit {
    std::uint32_t disk;  // end_of_list_: none
    std::uint32_t page;
  };

  // The page of a time; for a time before the present page, the present page.
  struct PageOfTime {
    double start, end, pages_per_time, last_page;
    std::uint32_t present, pages;
    [[gnu::always_inline]] std::uint32_t operator()(double time) const {
      const double page = std::min((time - start) * pages_per_time, last_page);
      // A time long before the present page gives a number below 0. With the operands in this order, NaN does, too.
      const auto p = static_cast<std::int32_t>(std::max(-1.0, page));
      if (time <= end) [[likely]]
        return static_cast<std::uint32_t>(std::max(p, static_cast<std::int32_t>(present)));
      return pages;
    }
  };
  [[gnu::always_inline]] PageOfTime pages_of_times() const {
    return {start_, end_, pages_per_time_, last_page_, page_, pages_};
  }
  [[gnu::always_inline]] std::uint32_t page_of(double time) const { return pages_of_times()(time); }
  [[gnu::always_inline]] static void link(Node* node, std::uint32_t* first, std::uint32_t disk, std::uint32_t page) {
    const std::uint32_t next = first[page];
    node[disk].previous = page | page_bit;
    node[disk].next = next;
    node[next].previous = disk;
    first[page] = disk;
  }
  void link(std::uint32_t disk, std::uint32_t page) { link(node_, first_.data(), disk, page); }
  [[gnu::always_inline]] void unlink(std::uint32_t disk) {
    const Node left = node_[disk];
    if ((left.previous & page_bit) == 0) {
      node_[left.previous].next = left.next;
    } else if (left.previous < in_transit) {
      first_[left.previous & ~page_bit] = left.next;
    } else {
      if (left.previous == in_transit) transit_[left.next].disk = end_of_list_;
      return;
    }
    node_[left.next].previous = left.previous;
  }
  template <class ComesFirst>
  [[gnu::always_inline]] void put(std::uint32_t disk, double time, ComesFirst comes_first) {
    node_[disk].time = time;
    const std::uint32_t page = page_of(time);
    // One comparison in place of two: as a number without sign, a page before unsorted_from_ is larger than all others.
    if (page - unsorted_from_ > pages_written_at_once_) {
      page < unsorted_from_ ? link_in_order(disk, comes_first) : post(disk, page);
    } else {
      link(disk, page);
    }
  }
  // Puts an entry into transit, in the place of the one that has been there longest, which is written to its page.
  [[gnu::noinline]] void post(std::uint32_t disk, std::uint32_t page) {
    Transit& oldest = transit_[next_place_];
    if (oldest.disk != end_of_list_) link(oldest.disk, oldest.page);
    oldest = {disk, page};
    node_[disk].previous = in_transit;
    node_[disk].next = next_place_;
    __builtin_prefetch(&first_[page], 1);
    first_in_transit_ = std::min(first_in_transit_, page);
    // The page of this one has been prefetched by now.
    const Transit& half_way = transit_[(next_place_ + places_in_transit / 2) % places_in_transit];
    if (half_way.disk != end_of_list_) __builtin_prefetch(&node_[first_[half_way.page]], 1);
    next_place_ = (next_place_ + 1) % places_in_transit;
  }
  [[gnu::noinline]] void deliver_all() {
    for (Transit& t : transit_) {
      if (t.disk != end_of_list_) link(t.disk, t.page);
      t.disk = end_of_list_;
    }
    first_in_transit_ = absent;
  }
  // The list of a page that comes soon is read entry by entry, each some pages after it was prefetched. Whether there
  // is a next entry cannot be predicted: no branch depends on it.
  void follow(std::uint32_t disk, std::uint32_t left) {
    const bool is_one = (disk != end_of_list_) & (left > 0) & (followed_end_ - followed_begin_ < followed_.size() - 1);
    __builtin_prefetch(&node_[disk]);
    followed_[followed_end_ % followed_.size()] = {disk, left};
    followed_end_ += static_cast<std::uint32_t>(is_one);
  }
  // Turns to the next page, or, if no disks are announced, to the next one that is not empty; returns false if there is
  // none.
  template <class Soon>
  [[gnu::always_inline]] bool turn_page(Soon soon) {
    if (announces_) {
      if (page_ + 1 == pages_) [[unlikely]] {
        unsorted_from_ = page_;
        return begin_next_part();
      }
      unsorted_from_ = ++page_;
      if (page_ + pages_ahead >= first_in_transit_) [[unlikely]]
        deliver_all();
      announce(soon);
      return true;
    }
    std::uint32_t page = page_;
    do {
      ++page;
    } while (first_[page] == end_of_list_);
    unsorted_from_ = page_ = std::min(page, pages_ - 1);
    return page < pages_ || begin_next_part();
  }
  // Announces disks on pages that come soon for the first time, and earlier ones for their next stages. soon must be
  // inlined, since g++ 12 drops calls of functions that only prefetch.
  template <class Soon>
  [[gnu::noinline, gnu::hot]] void announce(Soon soon) {
    const std::uint32_t come = followed_end_;
    if (page_ + pages_ahead < pages_) follow(first_[page_ + pages_ahead], announced_a_page);
    for (int m = 0; m < announced_at_once && followed_begin_ != come; ++m) {
      const Followed f = followed_[followed_begin_++ % followed_.size()];
      const Node node = node_[f.disk];
      if (node.previous >= in_transit) continue;  // it has moved since
      follow(node.next, f.left - 1);
      announced_[next_announced_ % announced_.size()] = f.disk;
      const auto announced = [&](std::uint32_t stage) {
        return announced_[(next_announced_ - stage * disks_a_stage) % announced_.size()];
      };
      // One by one, so that the stage is a constant in each inlined call.
      soon(announced(0), 0);
      soon(announced(1), 1);
      soon(announced(2), 2);
      ++next_announced_;
    }
  }

  template <class ComesFirst>
  [[gnu::noinline]] void link_in_order(std::uint32_t disk, ComesFirst comes_first) {
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
  void begin_part(double start, double pages_per_time, std::size_t pages);
  bool begin_next_part();
  void enter_again();
  bool shorten_pages();
  void collect_page();
  void relink_page();
  template <class ComesFirst>
  [[gnu::noinline]] void sort_page(ComesFirst comes_first) {
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
  std::uint32_t page_ = 0;           // the present page
  std::uint32_t unsorted_from_ = 0;  // the present page, or the next one if the present one is sorted
  std::size_t pages_a_part_ = 1;
  std::size_t later_pages_ = 0;  // pages of the parts to come
  bool announces_ = false;
  // Entries for pages at most this far ahead are written at once; others go into transit first.
  static constexpr std::uint32_t all_pages = 0xfffffffeU;
  std::uint32_t pages_written_at_once_ = all_pages;
  std::uint32_t end_of_list_ = 0;  // the index of an entry that belongs to no disk
  std::array<Transit, places_in_transit> transit_{};
  std::uint32_t next_place_ = 0;
  std::uint32_t first_in_transit_ = absent;  // no entry in transit is for an earlier page
  std::array<Followed, 16> followed_{};      // used in turn: those from followed_begin_ to before followed_end_
  std::uint32_t followed_begin_ = 0, followed_end_ = 0;
  std::array<std::uint32_t, 8> announced_{};  // the last ones announced, in turn
  std::uint32_t next_announced_ = 0;
  Node* node_ = nullptr;  // of each disk, by storage index
  std::uint32_t first_disk_ = 0, last_disk_ = 0;
  // The first disk of each page, and of the events after the end; then an entry that is never empty.
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> crowded_;  // scratch
};

}  // namespace carom
