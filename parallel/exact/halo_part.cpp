#include "parallel/exact/halo_part.hpp"

#include <algorithm>
#include <utility>

#include "core/disks/disk_columns.hpp"

namespace carom {

namespace {

// Room for ghosts that are still to come: one for this many disks.
constexpr std::size_t spare_share = 32;

template <class T>
void take(const std::vector<T>& all, const std::vector<std::uint32_t>& source, std::vector<T>& column) {
  column.resize(all.empty() ? 0 : source.size());
  for (std::size_t i = 0; i < column.size(); ++i) column[i] = all[source[i]];
}

template <class T>
void make_room(std::vector<T>& column) {
  if (!column.empty()) column.reserve(column.size() + column.size() / spare_share);
}

}  // namespace

template <class T>
void HaloPart::give(const std::vector<T>& column, std::vector<T>& all) const {
  if (column.empty()) return;
  for (const std::uint32_t i : own_) {
    if (i != none) all[slots_[i]] = column[i];
  }
}

void HaloPart::release_windows(const Disks& all) {
  if (all.size() > disks_of_much_memory) run_.release_memory();
}

void HaloPart::take_disks(const Disks& all, const BoxCut& cut, std::size_t part, DisksOfPart&& disks) {
  number_ = static_cast<std::uint16_t>(part);
  halo_ = cut.halo;
  own_count_ = disks.own;
  slots_ = std::move(disks.index);
  gather_disks(all, slots_, state_.disks);
}

void HaloPart::build(const WindowPlan& plan, const BoxCut& cut, State& all, const LargestRadius& radii,
                     std::size_t first, std::vector<std::uint32_t>& slots) {
  const auto along = [&](const AxisCut& axis, std::size_t piece, double& low, double& high) {
    if (axis.pieces() == 1) return;
    low = axis.low(piece) - cut.halo;
    high = axis.high(piece) + cut.halo;
  };
  Vec2 low, high;
  along(cut.x, cut.column(number_), low.x, high.x);
  along(cut.y, cut.row(number_), low.y, high.y);
  ListLayout layout = layout_of_part(state_.disks.size(), slots.size(), low, high);
  layout.largest_of_box = radii.now;
  layout.growth = radii.growth;
  run_.forget(Known::nothing);
  run_.build_lists(plan, layout, [&](const std::vector<std::uint32_t>& order, const std::vector<double>& /*scratch*/) {
    std::vector<std::uint32_t> sorted;
    take(slots_, order, sorted);
    slots_.swap(sorted);
  });
  run_.set_part(cut.ends_of(number_), own_, radii.now + radii.growth, all, slots_);
  find_own(cut, first, slots);
}

void HaloPart::find_own(const BoxCut& cut, std::size_t first, std::vector<std::uint32_t>& slots) {
  const Disks& d = state_.disks;
  own_.clear();
  own_.reserve(own_count_ + own_count_ / spare_share);
  ghosts_.clear();
  inside_.clear();
  offers_.clear();
  std::vector<OtherParts>& others = run_.window().others;
  others.assign(d.size(), {});
  for (std::uint32_t i = 0; i < slots_.size(); ++i) {
    const Vec2 at{d.x[i], d.y[i]};
    if (cut.part_at(at) == number_) {
      slots[slots_[i]] = static_cast<std::uint32_t>(first + own_.size());
      own_.push_back(i);
      others[i].known_to = known_to_at(cut, at);
    } else {
      ghosts_.push_back({i, 0, 0, 0});
    }
  }
  make_room(others);
}

std::uint8_t HaloPart::known_to_at(const BoxCut& cut, Vec2 at) const {
  unsigned bits = 0;
  cut.visit_parts_at(at, [&](std::size_t part) { bits |= neighbours().bit_of(part); });
  return static_cast<std::uint8_t>(bits);
}

void HaloPart::find_owners(const std::vector<std::size_t>& firsts, const std::vector<std::uint32_t>& slots) {
  for (std::uint32_t& slot : slots_) slot = slots[slot];
  for (Ghost& ghost : ghosts_) {
    const std::uint32_t slot = slots_[ghost.index];
    std::size_t k = 0;
    while (slot < firsts[neighbours().part(k)] || slot >= firsts[neighbours().part(k) + 1U]) ++k;
    ghost.part = neighbours().part(k);
    ghost.place = slot - static_cast<std::uint32_t>(firsts[ghost.part]);
  }
}

// The column of x stays, since its size is the number of disks.
void HaloPart::give_columns(Disks& all) {
  Disks& d = state_.disks;
  give_paths(d, all);
  give(d.id, all.id);
  give(d.radius, all.radius);
  give(d.mass, all.mass);
  for (std::vector<double>* column : {&d.y, &d.vx, &d.vy}) std::vector<double>().swap(*column);
  for (std::vector<double>* column : {&d.x, &d.radius, &d.mass, &d.spin}) make_room(*column);
  make_room(d.id);
  make_room(slots_);
}

void HaloPart::take_radii(const Disks& all) {
  std::vector<double>& radius = state_.disks.radius;
  for (std::size_t i = 0; i < radius.size(); ++i) radius[i] = all.radius[slots_[i]];
  see_radius(largest_radius(state_.disks));
}

// A new ghost may be larger than all disks for which the lists were built: then they are built anew.
void HaloPart::see_radius(double radius) {
  if (radius > run_.lists().largest_listed()) run_.forget(Known::nothing);
}

// Two disks further apart than twice the largest radius that is allowed do not affect each other's growth. Of the next
// part's own disks those within the halo are ghosts; a third part's are not, but they are at least a halo away. So if
// no own disk of any part is further beyond an end than half of what remains of a halo, none is near a disk that this
// part does not have.
bool HaloPart::has_all_near_own(const Disks& all) const {
  const double room = 0.5 * (halo_ - 2.0 * run_.largest_radius());
  return std::all_of(own_.begin(), own_.end(), [&](std::uint32_t i) {
    return i == none || std::max(ends().x.beyond(all.x[slots_[i]]), ends().y.beyond(all.y[slots_[i]])) < room;
  });
}

void HaloPart::visit_lists(const std::function<void(std::size_t, std::span<const std::uint32_t>)>& visit) const {
  std::vector<std::uint32_t> near;
  for (const std::uint32_t i : own_) {
    if (i == none) continue;
    near.clear();
    run_.lists().for_each_neighbour(i, [&](std::uint32_t j) { near.push_back(slots_[j]); });
    visit(slots_[i], near);
  }
}

// A disk whose next event is due now is predicted at the start of the next window, with all disks near it.
void HaloPart::change_velocities(const std::vector<unsigned char>& changed) {
  for (std::uint32_t i = 0; i < slots_.size(); ++i) {
    if (changed[slots_[i]] != 0) run_.window().set_next_event_time(i, run_.length());
  }
}

void HaloPart::visit_near(Vec2 centre, double half_width, double half_height,
                          const std::function<void(std::size_t)>& visit) const {
  const std::vector<DiskRecord>& record = run_.window().record;
  run_.lists().visit_near(centre, half_width, half_height, [&](std::uint32_t i) {
    if (!record[i].progress.has(DiskProgress::ghost)) visit(slots_[i]);
  });
}

void HaloPart::give_paths(const Disks& here, Disks& all) const {
  give(here.x, all.x);
  give(here.y, all.y);
  give(here.vx, all.vx);
  give(here.vy, all.vy);
  give(here.spin, all.spin);
}

}  // namespace carom
