#include "parallel/exact/event_calendar.hpp"

#include <cmath>

#include "core/base/huge_pages.hpp"

namespace carom {

namespace {

// Pages for each expected event. An entry is moved two or three times a collision, so with this number one or two
// entries are on the present page.
constexpr double pages_per_event = 1.6;
constexpr std::size_t most_pages_a_disk = 8;
constexpr std::size_t few_pages = 64;
// With many disks: the number of parts of the time that are divided into pages one after the other.
constexpr std::size_t parts = 4;
// With fewer pages than one for this many disks (an event for eight of them) the time is not divided into parts, unless
// pages are shortened, and nothing is announced: visiting all disks again, page by page, would take longer.
constexpr std::size_t disks_of_few_pages = 5;
// Pages are shortened if the events of a page with too many are spread over at least this share of it.
constexpr double spread_share = 0.125;
constexpr double events_a_page = 2.0;

}  // namespace

void EventCalendar::begin(double start, double end, const CalendarEntries& entries, std::size_t expected, bool many) {
  node_ = entries.entry;
  first_disk_ = entries.first;
  last_disk_ = entries.last;
  end_of_list_ = entries.end;
  end_ = end;
  const std::size_t disks = last_disk_ - first_disk_;
  const std::size_t most = most_pages_a_disk * disks + few_pages;
  const std::size_t wanted =
      expected == 0 ? 2 * disks : static_cast<std::size_t>(pages_per_event * static_cast<double>(expected));
  const std::size_t pages = std::clamp(wanted, few_pages, most);
  const bool few = expected > 0 && pages < disks / disks_of_few_pages;
  announces_ = many && !few;
  pages_written_at_once_ = announces_ ? pages_of_transit : all_pages;
  pages_a_part_ = !many ? most : few ? disks / disks_of_few_pages : pages / parts + 1;
  begin_part(start, end > start ? static_cast<double>(pages) / (end - start) : 0.0, pages);
}

// pages: the number of pages of this part and of those to come. Events beyond this part stay on the list of those after
// the end.
void EventCalendar::begin_part(double start, double pages_per_time, std::size_t pages) {
  const std::size_t here = std::min(pages, pages_a_part_);
  set_pages(start, pages_per_time, here);
  later_pages_ = pages - here;
  if (later_pages_ > 0) last_page_ = static_cast<double>(here);
}

// Returns false, without a change, if this is the last part.
bool EventCalendar::begin_next_part() {
  if (later_pages_ == 0) return false;
  begin_part(start_ + last_page_ / pages_per_time_, pages_per_time_, later_pages_);
  enter_again();
  return true;
}

// Enters all disks of the calendar again, also those whose entries are in transit.
void EventCalendar::enter_again() {
  insert_all([this](std::uint32_t disk) { return holds(disk); });
}

void EventCalendar::release_memory() {
  std::vector<std::uint32_t>().swap(first_);
}

void EventCalendar::set_pages(double start, double pages_per_time, std::size_t pages) {
  if (first_.capacity() < pages + 2) resize_in_huge_pages(first_, pages + 2);
  first_.assign(pages + 2, end_of_list_);
  first_.back() = absent;
  start_ = start;
  pages_per_time_ = pages_per_time;
  pages_ = static_cast<std::uint32_t>(pages);
  last_page_ = static_cast<double>(pages - 1);
  page_ = unsorted_from_ = 0;
  transit_.fill({end_of_list_, 0});
  first_in_transit_ = absent;
  announced_.fill(first_disk_);
  followed_begin_ = followed_end_ = 0;
}

// Divides the remaining time anew, so that the events of the present page are spread over many pages. Events beyond the
// largest number of pages stay together on the last one until that is divided in turn. Returns false, without a change,
// if it would not help.
bool EventCalendar::shorten_pages() {
  collect_page();
  const auto earlier = [&](std::uint32_t a, std::uint32_t b) { return node_[a].time < node_[b].time; };
  const auto [first, last] = std::minmax_element(crowded_.begin(), crowded_.end(), earlier);
  const double page_start = node_[*first].time;
  const double spread = node_[*last].time - page_start;
  const double page_length = page_ + 1 == pages_ ? end_ - page_start : 1.0 / pages_per_time_;
  const double pages_per_time = static_cast<double>(crowded_.size()) / (events_a_page * spread);
  if (!(spread >= spread_share * page_length) || !(pages_per_time < HUGE_VAL)) return false;
  const std::size_t most = most_pages_a_disk * (last_disk_ - first_disk_) + few_pages;
  const double pages = (end_ - page_start) * pages_per_time + 1.0;
  const std::size_t left = pages < static_cast<double>(most) ? static_cast<std::size_t>(pages) : most;
  begin_part(page_start, pages_per_time, left);
  enter_again();
  return true;
}

// No entry of the present page is in transit: only entries for later pages are, and turn_page() delivers them in time.
void EventCalendar::collect_page() {
  crowded_.clear();
  for (std::uint32_t k = first_[page_]; k != end_of_list_; k = node_[k].next) crowded_.push_back(k);
}

void EventCalendar::relink_page() {
  std::uint32_t previous = page_ | page_bit;
  first_[page_] = crowded_.front();
  for (const std::uint32_t disk : crowded_) {
    node_[disk].previous = previous;
    if ((previous & page_bit) == 0) node_[previous].next = disk;
    previous = disk;
  }
  node_[previous].next = end_of_list_;
  unsorted_from_ = page_ + 1;
}

}  // namespace carom
