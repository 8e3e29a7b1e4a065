#include "parallel/exact/halo_part.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

template <class T>
void take(const std::vector<T>& all, const std::vector<std::uint32_t>& source, std::vector<T>& column) {
  column.resize(all.empty() ? 0 : source.size());
  for (std::size_t i = 0; i < column.size(); ++i) column[i] = all[source[i]];
}

}  // namespace

template <class T>
void HaloPart::give(const std::vector<T>& column, std::vector<T>& all) const {
  if (column.empty()) return;
  for_each_own([&](const Own& own) { all[own.slot] = column[own.index]; });
}

void HaloPart::take_disks(const Disks& all, const BoxCut& cut, std::size_t part) {
  number_ = static_cast<std::uint16_t>(part);
  const std::size_t last = cut.parts() - 1;
  below_ = static_cast<std::uint16_t>(!cut.has_below(part) ? part : part == 0 ? last : part - 1);
  above_ = static_cast<std::uint16_t>(!cut.has_above(part) ? part : part == last ? 0 : part + 1);
  halo_ = cut.halo;
  const std::vector<double>& c = cut.coordinates(all);
  source_.clear();
  own_count_ = 0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const bool is_own = cut.owns(part, c[k]);
    if (is_own || cut.in_halo(part, c[k])) source_.push_back(static_cast<std::uint32_t>(k));
    own_count_ += is_own ? 1 : 0;
  }
  Disks& d = state_.disks;
  take(all.x, source_, d.x);
  take(all.y, source_, d.y);
  take(all.vx, source_, d.vx);
  take(all.vy, source_, d.vy);
  take(all.id, source_, d.id);
  take(all.radius, source_, d.radius);
  take(all.mass, source_, d.mass);
  take(all.spin, source_, d.spin);
  d.common_radius = all.common_radius;
  d.common_mass = all.common_mass;
  d.inertia = all.inertia;
}

void HaloPart::build(const WindowPlan& plan, const BoxCut& cut, State& all, double largest_radius, std::size_t first,
                     std::vector<std::uint32_t>& slots) {
  const double low = cut.along_x ? 0.0 : cut.low(number_) - cut.halo;
  const double high = cut.along_x ? 0.0 : cut.high(number_) + cut.halo;
  std::vector<std::uint32_t> sorted;
  run_.forget(Known::nothing);
  run_.build_lists(plan, layout_of_part(state_.disks.size(), slots.size(), low, high),
                   [&](const std::vector<std::uint32_t>& order, const std::vector<double>& /*scratch*/) {
                     take(source_, order, sorted);
                   });
  source_.swap(sorted);
  find_own(cut, first, slots);
  set_ends(cut, all, largest_radius);
}

void HaloPart::find_own(const BoxCut& cut, std::size_t first, std::vector<std::uint32_t>& slots) {
  const std::vector<double>& c = cut.coordinates(state_.disks);
  own_.clear();
  ghosts_.clear();
  inside_.clear();
  offers_below_.clear();
  offers_above_.clear();
  for (std::uint32_t i = 0; i < source_.size(); ++i) {
    if (cut.owns(number_, c[i])) {
      const auto slot = static_cast<std::uint32_t>(first + own_.size());
      slots[source_[i]] = slot;
      own_.push_back({i, slot});
    } else {
      ghosts_.push_back({i, 0, 0, 0});
    }
  }
}

void HaloPart::set_ends(const BoxCut& cut, State& all, double largest_radius) {
  PartEnds ends;
  ends.along_x = cut.along_x;
  ends.between.centre = 0.5 * (cut.low(number_) + cut.high(number_));
  ends.between.period = cut.periodic ? cut.side : HUGE_VAL;
  const double half = 0.5 * (cut.high(number_) - cut.low(number_));
  if (cut.has_below(number_)) ends.between.below = -half;
  if (cut.has_above(number_)) ends.between.above = half;
  run_.set_part(ends, own_count_, largest_radius, all, [this, cut](std::uint32_t i) {
    const double at = cut.coordinates(state_.disks)[i];
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
  for (Ghost& ghost : ghosts_) {
    const std::uint32_t slot = slots[source_[ghost.index]];
    while (slot >= firsts[ghost.part + 1U]) ++ghost.part;
    ghost.place = slot - static_cast<std::uint32_t>(firsts[ghost.part]);
  }
  std::vector<std::uint32_t>().swap(source_);
}

void HaloPart::store_all_columns(Disks& all) const {
  store_paths(all);
  give(state_.disks.id, all.id);
  give(state_.disks.radius, all.radius);
  give(state_.disks.mass, all.mass);
}

void HaloPart::give_paths(const Disks& here, Disks& all) const {
  give(here.x, all.x);
  give(here.y, all.y);
  give(here.vx, all.vx);
  give(here.vy, all.vy);
  give(here.spin, all.spin);
}

void HaloPart::copy_path(const Disks& from, std::size_t k, std::uint32_t i) {
  Disks& d = state_.disks;
  d.x[i] = from.x[k];
  d.y[i] = from.y[k];
  d.vx[i] = from.vx[k];
  d.vy[i] = from.vy[k];
  if (!d.spin.empty()) d.spin[i] = from.spin[k];
}

void HaloPart::load_paths(const Disks& all, const HaloParts& parts) {
  for_each_own([&](const Own& own) { copy_path(all, own.slot, own.index); });
  for (const Ghost& ghost : ghosts_) copy_path(all, parts[ghost.part]->own_[ghost.place].slot, ghost.index);
}

}  // namespace carom
