#include "parallel/exact/halo_part.hpp"

#include <algorithm>
#include <cmath>

#include "core/disks/disk_columns.hpp"

namespace carom {

namespace {

// Room for ghosts that are still to come: one for so many disks.
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

void HaloPart::take_disks(const Disks& all, const BoxCut& cut, std::size_t part) {
  // Nothing of a part's last windows is needed to build it, and building takes as much.
  if (all.size() > disks_of_much_memory) run_.release_memory();
  number_ = static_cast<std::uint16_t>(part);
  below_ = static_cast<std::uint16_t>(cut.part_below(part));
  above_ = static_cast<std::uint16_t>(cut.part_above(part));
  halo_ = cut.halo;
  const std::vector<double>& c = cut.coordinates(all);
  const auto is_here = [&](double at) { return cut.owns(part, at) || cut.in_halo(part, at); };
  own_count_ =
      static_cast<std::size_t>(std::count_if(c.begin(), c.end(), [&](double at) { return cut.owns(part, at); }));
  const auto count = static_cast<std::size_t>(std::count_if(c.begin(), c.end(), is_here));
  slots_.clear();
  slots_.reserve(count);
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (is_here(c[k])) slots_.push_back(static_cast<std::uint32_t>(k));
  }
  gather_disks(all, slots_, state_.disks);
}

void HaloPart::build(const WindowPlan& plan, const BoxCut& cut, State& all, const LargestRadius& radii,
                     std::size_t first, std::vector<std::uint32_t>& slots) {
  const double low = cut.along_x ? 0.0 : cut.low(number_) - cut.halo;
  const double high = cut.along_x ? 0.0 : cut.high(number_) + cut.halo;
  ListLayout layout = layout_of_part(state_.disks.size(), slots.size(), low, high);
  layout.largest_of_box = radii.now;
  layout.growth = radii.growth;
  run_.forget(Known::nothing);
  run_.build_lists(plan, layout, [&](const std::vector<std::uint32_t>& order, const std::vector<double>& /*scratch*/) {
    std::vector<std::uint32_t> sorted;
    take(slots_, order, sorted);
    slots_.swap(sorted);
  });
  find_own(cut, first, slots);
  set_ends(cut, all, radii);
}

void HaloPart::find_own(const BoxCut& cut, std::size_t first, std::vector<std::uint32_t>& slots) {
  const std::vector<double>& c = cut.coordinates(state_.disks);
  own_.clear();
  own_.reserve(own_count_ + own_count_ / spare_share);
  ghosts_.clear();
  inside_.clear();
  offers_below_.clear();
  offers_above_.clear();
  for (std::uint32_t i = 0; i < slots_.size(); ++i) {
    if (cut.owns(number_, c[i])) {
      slots[slots_[i]] = static_cast<std::uint32_t>(first + own_.size());
      own_.push_back(i);
    } else {
      ghosts_.push_back({i, 0, 0, 0});
    }
  }
}

void HaloPart::set_ends(const BoxCut& cut, State& all, const LargestRadius& radii) {
  PartEnds ends;
  ends.along_x = cut.along_x;
  ends.between.centre = 0.5 * (cut.low(number_) + cut.high(number_));
  ends.between.period = cut.periodic ? cut.side : HUGE_VAL;
  const double half = 0.5 * (cut.high(number_) - cut.low(number_));
  if (cut.has_below(number_)) ends.between.below = -half;
  if (cut.has_above(number_)) ends.between.above = half;
  // Where a third part begins.
  const auto width = [&](std::size_t part) { return cut.high(part) - cut.low(part); };
  const bool three_below = cut.has_below(number_) && cut.has_below(below_) && cut.part_below(below_) != number_;
  const bool three_above = cut.has_above(number_) && cut.has_above(above_) && cut.part_above(above_) != number_;
  if (three_below) ends.next_below = -half - width(below_);
  if (three_above) ends.next_above = half + width(above_);
  run_.set_part(ends, own_count_, radii.now + radii.growth, all, slots_, [this, cut](std::uint32_t i) {
    const PathSegment& path = record(i).path;
    const double at = cut.along_x ? path.x : path.y;
    DiskProgress progress;
    const bool below = cut.is_known_below(number_, at);
    const bool above = cut.is_known_above(number_, at);
    if (!cut.owns(number_, at)) progress.set(DiskProgress::ghost);
    if (below || (above && is_one_of_two())) progress.set(DiskProgress::known_below);
    if (above || (below && is_one_of_two())) progress.set(DiskProgress::known_above);
    return progress;
  });
}

void HaloPart::find_owners(const std::vector<std::size_t>& firsts, const std::vector<std::uint32_t>& slots) {
  for (std::uint32_t& slot : slots_) slot = slots[slot];
  for (Ghost& ghost : ghosts_) {
    const std::uint32_t slot = slots_[ghost.index];
    while (slot >= firsts[ghost.part + 1U]) ++ghost.part;
    ghost.place = slot - static_cast<std::uint32_t>(firsts[ghost.part]);
  }
}

// The column of x stays, as it says how many disks there are.
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

// A ghost that has come since may be larger than all disks for which the lists were built: they are built anew.
void HaloPart::see_radius(double radius) {
  if (radius > run_.lists().largest_listed()) run_.forget(Known::nothing);
}

// Two disks further apart than twice the largest radius that is allowed for leave each other's growth alone. Of the
// next part's own disks those within the halo are ghosts; a third part's are not, but that is a halo away at least. So
// if no own disk of any part is further beyond an end than half of what is left of a halo, none is near one that is not
// here.
bool HaloPart::has_all_near_own(const Disks& all) const {
  const double room = 0.5 * (halo_ - 2.0 * run_.largest_radius());
  const std::vector<double>& c = ends().along_x ? all.x : all.y;
  const KnownBand& between = ends().between;
  return std::all_of(own_.begin(), own_.end(), [&](std::uint32_t i) {
    if (i == none) return true;
    const double d = between.from_centre(c[slots_[i]]);
    return std::max(d - between.above, between.below - d) < room;
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

// A disk whose next event is now is predicted at the start of the next window, with all disks near it.
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
