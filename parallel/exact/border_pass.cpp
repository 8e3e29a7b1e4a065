#include "parallel/exact/border_pass.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace carom {

void BorderPass::lay_out(const std::vector<Region>& regions) {
  const std::size_t count = regions.size();
  borders_.resize(count);
  border_of_tile_.assign(lists_.tiles(), static_cast<std::uint16_t>(count == 0 ? 0 : count - 1));
  for (std::size_t b = 0; b < count; ++b) {
    Border& border = borders_[b];
    border.wraps = b + 1 == count;
    const std::uint32_t first = regions[border.wraps ? 0 : b].middle_tile;
    const std::uint32_t last = regions[border.wraps ? b : b + 1].middle_tile;
    border.region = lists_.region_of_tiles(first, last);
    if (border.wraps) continue;
    std::fill(border_of_tile_.begin() + first, border_of_tile_.begin() + last, static_cast<std::uint16_t>(b));
  }
  begin_window();
}

void BorderPass::begin_window() {
  for (Border& border : borders_) border.worker.begin_window();
  late_.begin_window();
}

bool BorderPass::ended() const {
  return std::any_of(borders_.begin(), borders_.end(), [](const Border& b) { return b.worker.ended; });
}

Count BorderPass::relisted() const {
  Count disks = late_.relisted;
  for (const Border& border : borders_) disks += border.worker.relisted;
  return disks;
}

void BorderPass::run(const std::vector<Region>& regions, double per_disk) {
  executor_.run(borders_.size(), [&](std::size_t b) { collect(static_cast<std::uint32_t>(b), regions); });
  join();
  executor_.run(borders_.size(), [&](std::size_t b) {
    if (borders_[b].leader == b) process(static_cast<std::uint32_t>(b), per_disk);
  });
  late_.begin_slice();
  if (!ended()) relist_late();
}

void BorderPass::collect(std::uint32_t b, const std::vector<Region>& regions) {
  Border& border = borders_[b];
  border.worker.begin_slice();
  border.disks.clear();
  border.touches.clear();
  const auto of_region = [&](const Region& region) {
    for (const std::uint32_t i : region.border) collect(border, i);
    for (const BlockedDisk& blocked : region.worker.blocked) collect(border, blocked.disk);
  };
  of_region(regions[b]);
  if (regions.size() > 1) of_region(regions[border.wraps ? 0 : b + 1]);
}

// Is it certain that the disk lists only disks of its own border?
bool BorderPass::lists_are_inside(const Border& border, std::uint32_t i) const {
  const auto [first, last] = std::pair(border.region.first_disk, border.region.last_disk);
  const ListRows& rows = lists_.rows();
  if (!border.wraps) return rows.surely_within(i, first, last);
  return i < first ? rows.surely_within(i, 0, first)
                   : rows.surely_within(i, last, static_cast<std::uint32_t>(rows.size()));
}

void BorderPass::collect(Border& border, std::uint32_t i) const {
  if (!border.holds(i)) return;
  border.disks.push_back(i);
  if (lists_are_inside(border, i)) return;
  lists_.for_each_neighbour(i, [&](std::uint32_t j) {
    if (!border.holds(j) && !window_.record[j].progress.is_active()) border.touches.push_back(border_of(j));
  });
}

std::uint32_t BorderPass::leader_of(std::uint32_t b) const {
  while (borders_[b].leader != b) b = borders_[b].leader;
  return b;
}

// The leader of joined borders is the first of them.
void BorderPass::join() {
  for (std::uint32_t b = 0; b < borders_.size(); ++b) {
    borders_[b].leader = b;
    borders_[b].is_alone = true;
  }
  for (std::uint32_t b = 0; b < borders_.size(); ++b) {
    for (const std::uint32_t other : borders_[b].touches) {
      const auto [first, second] = std::minmax({leader_of(b), leader_of(other)});
      borders_[second].leader = first;
      borders_[first].is_alone = borders_[first].is_alone && first == second;
    }
  }
  for (std::uint32_t b = 0; b < borders_.size(); ++b) borders_[b].leader = leader_of(b);
}

void BorderPass::process(std::uint32_t leader, double per_disk) {
  Worker& worker = borders_[leader].worker;
  worker.region = borders_[leader].region;
  std::size_t disks = 0;
  const auto for_each_joined = [&](auto&& visit) {
    for (const Border& border : borders_) {
      if (border.leader == leader) visit(border);
    }
  };
  for_each_joined([&](const Border& border) { disks += border.disks.size(); });
  if (disks == 0) return;
  const double time = window_.slice_stop() - window_.slice_start;
  worker.queue.begin(window_.slice_start, window_.slice_stop(),
                     static_cast<std::size_t>(per_disk * time * static_cast<double>(disks)));
  EventProcessor<Scope::border> events(window_, lists_, worker);
  for_each_joined([&](const Border& border) {
    for (const std::uint32_t i : border.disks) events.push_next_event(i);
  });
  events.run();
}

// First each thread relists the disks whose lists are within its border; then one thread relists the rest. One thread
// sets the marks, since they reach as far as the neighbours of neighbours.
void BorderPass::relist_late() {
  executor_.run(borders_.size(), [&](std::size_t b) {
    const Border& border = borders_[b];
    if (border.leader != b || border.wraps || !border.is_alone) return;
    EventProcessor<Scope::border>(window_, lists_, borders_[b].worker).relist_late(borders_[b].worker.late);
  });
  late_.region = ListRegion{};
  EventProcessor<Scope::border> everywhere(window_, lists_, late_);
  for (Border& border : borders_) everywhere.relist_late(border.worker.late);
  for (const Border& border : borders_) {
    for (const std::uint32_t i : border.worker.late) everywhere.mark_relisted(i);
  }
}

void BorderPass::relist_if_far(std::uint32_t i) {
  EventProcessor<Scope::border>(window_, lists_, late_).relist_if_far(i);
}

}  // namespace carom
