// What parts tell each other: after a slice where ghosts went, and between windows which disks become ghosts, and which
// ghosts become own disks.
#include <algorithm>
#include <bit>

#include "core/physics/exact_path.hpp"
#include "parallel/exact/halo_part.hpp"

namespace carom {

namespace {

// A ghost that is this far inside a part becomes one of its own disks; over the halo's width.
constexpr double inside_share = 0.05;

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

// Of columns that a scene may not have.
bool same_bits(const std::vector<double>& a, std::size_t i, const std::vector<double>& b, std::size_t k) {
  return a.empty() || same_bits(a[i], b[k]);
}

bool same_path(const PathSegment& a, const PathSegment& b) {
  return same_bits(a.start, b.start) && same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.vx, b.vx) &&
         same_bits(a.vy, b.vy);
}

template <class T>
void append_from(const std::vector<T>& all, std::size_t slot, std::vector<T>& column) {
  if (!all.empty()) column.push_back(all[slot]);
}

}  // namespace

void HaloPart::begin_window() {
  for (Ghost& ghost : ghosts_) ghost.more_paths = 0;
}

// Only this part's ghosts are changed, and only other parts' own disks are read, so that all parts may do it at once.
void HaloPart::compare_with(const HaloParts& parts) {
  strays_.clear();
  inside_.clear();
  agrees_ = true;
  use_ = {};
  for (std::size_t g = 0; g < ghosts_.size(); ++g) {
    Ghost& ghost = ghosts_[g];
    const HaloPart& owner = *parts[ghost.part];
    DiskRecord& here = record(ghost.index);
    const DiskRecord& there = owner.run_.window().record[owner.own_[ghost.place]];
    const bool concerns = here.progress.has(DiskProgress::met_own) || there.progress.has(DiskProgress::crosses);
    here.progress.clear(DiskProgress::met_own);
    const bool is_as_there = goes_as_there(ghost, owner);
    if (is_as_there && !concerns) [[likely]]
      continue;
    const double depth = beyond_end(there.path);
    if (concerns) use_.deepest = std::max(use_.deepest, depth);
    // It has come beyond its owner's end, so that it concerns this part.
    if (depth < -inside_share * halo_) inside_.push_back(g);
    if (is_as_there) continue;
    agrees_ = agrees_ && !concerns;
    use_.nearest = std::min({use_.nearest, depth, beyond_end(here.path)});
    replace_path(ghost, owner);
  }
  run_.replace_paths(strays_);
}

bool HaloPart::goes_as_there(const Ghost& ghost, const HaloPart& owner) const {
  const WindowState& window = run_.window();
  const WindowState& others = owner.run_.window();
  const std::uint32_t g = ghost.index;
  const std::uint32_t i = owner.own_[ghost.place];
  const DiskRecord& here = window.record[g];
  const DiskRecord& there = others.record[i];
  if (static_cast<std::uint16_t>(here.version - ghost.more_paths) != there.version) return false;
  return same_path(here.path, there.path) && same_bits(window.spin, g, others.spin, i) &&
         same_bits(window.last_contact, g, others.last_contact, i) &&
         (window.thermal_hits.empty() || window.thermal_hits[g] == others.thermal_hits[i]);
}

// The version becomes a new one, so that no prediction made here with an earlier one is valid.
void HaloPart::replace_path(Ghost& ghost, const HaloPart& owner) {
  WindowState& window = run_.window();
  const WindowState& others = owner.run_.window();
  const std::uint32_t i = owner.own_[ghost.place];
  DiskRecord& here = window.record[ghost.index];
  ++here.version;
  ghost.more_paths = static_cast<std::uint16_t>(here.version - others.record[i].version);
  here.path = others.record[i].path;
  if (!window.spin.empty()) window.spin[ghost.index] = others.spin[i];
  if (!window.last_contact.empty()) window.last_contact[ghost.index] = others.last_contact[i];
  if (!window.thermal_hits.empty()) window.thermal_hits[ghost.index] = others.thermal_hits[i];
  strays_.push_back(ghost.index);
}

// How far outside of the part the disk is at the slice's end; negative inside.
double HaloPart::beyond_end(const PathSegment& path) const {
  const WindowState& window = run_.window();
  const PathSegment p = carried_to(path, window.slice_stop(), window.rules.gravity);
  const KnownBand& between = window.part.between;
  const double d = between.from_centre(window.part.coordinate({p.x, p.y}));
  return std::max(d - between.above, between.below - d);
}

void HaloPart::find_offers(const Disks& all) {
  offers_below_.clear();
  offers_above_.clear();
  const std::vector<double>& c = ends().along_x ? all.x : all.y;
  const KnownBand& between = ends().between;
  const double low = between.below + halo_;
  const double high = between.above - halo_;
  for (std::uint32_t place = 0; place < own_.size(); ++place) {
    if (own_[place] == none) continue;
    const double at = c[slots_[own_[place]]];
    const double d = at - between.centre;
    if (d <= low || d >= high) [[unlikely]]
      offer(place, between.from_centre(at));
  }
}

// Also asks anew whether the disk may come beyond an end.
void HaloPart::offer(std::uint32_t place, double from_centre) {
  const std::uint32_t i = own_[place];
  DiskRecord& disk = record(i);
  const bool known_below = disk.progress.has(DiskProgress::known_below);
  const bool known_above = disk.progress.has(DiskProgress::known_above);
  const bool below = from_centre <= ends().between.below + halo_ && !known_below;
  const bool above = from_centre >= ends().between.above - halo_ && !known_above;
  if (below || (above && is_one_of_two())) {
    disk.progress.set(DiskProgress::known_below);
    offers_below_.push_back({place, slots_[i]});
  }
  if (above || (below && is_one_of_two())) {
    disk.progress.set(DiskProgress::known_above);
    if (!is_one_of_two()) offers_above_.push_back({place, slots_[i]});
  }
  if (!disk.progress.has(DiskProgress::crosses)) return;
  disk.progress.clear(DiskProgress::crosses);
  run_.note_listing(i);
}

void HaloPart::take_offers(const Disks& all, const HaloParts& parts) {
  if (above_ != number_) {
    for (const Offer& offer : parts[above_]->offers_below_) add_ghost(all, above_, offer);
  }
  if (below_ != number_) {
    for (const Offer& offer : parts[below_]->offers_above_) add_ghost(all, below_, offer);
  }
}

// Reads nothing else of the owner, which takes in ghosts at the same time.
void HaloPart::add_ghost(const Disks& all, std::uint16_t owner, const Offer& offer) {
  const std::uint32_t slot = offer.slot;
  Disks& d = state_.disks;
  slots_.push_back(slot);
  d.x.push_back(all.x[slot]);
  append_from(all.id, slot, d.id);
  append_from(all.radius, slot, d.radius);
  append_from(all.mass, slot, d.mass);
  append_from(all.spin, slot, d.spin);
  run_.append_last_disk({all.x[slot], all.y[slot]});
  see_radius(all.radius_of(slot));
  const auto i = static_cast<std::uint32_t>(d.size() - 1);
  record(i).progress = DiskProgress();
  record(i).progress.set(DiskProgress::ghost);
  ghosts_.push_back({i, offer.place, owner, 0});
}

// Backwards, since the last ghost takes the place of one that has become an own disk.
void HaloPart::take_over(const HaloParts& parts) {
  for (std::size_t k = inside_.size(); k-- > 0;) own_ghost(inside_[k], parts);
  inside_.clear();
}

// Not where a third part has the disk as a ghost, too, and would have to be told who owns it.
void HaloPart::own_ghost(std::size_t number, const HaloParts& parts) {
  const Ghost ghost = ghosts_[number];
  HaloPart& owner = *parts[ghost.part];
  std::uint32_t& there = owner.own_[ghost.place];
  DiskProgress& progress = owner.record(there).progress;
  if (progress.has(DiskProgress::known_below) && progress.has(DiskProgress::known_above) && !is_one_of_two()) return;
  const auto place = static_cast<std::uint32_t>(own_.size());
  own_.push_back(ghost.index);
  DiskRecord& disk = record(ghost.index);
  disk.progress = DiskProgress();
  if (ghost.part == below_) disk.progress.set(DiskProgress::known_below);
  if (ghost.part == above_) disk.progress.set(DiskProgress::known_above);
  run_.note_listing(ghost.index);
  ghosts_[number] = ghosts_.back();
  ghosts_.pop_back();
  progress = DiskProgress();
  progress.set(DiskProgress::ghost);
  owner.ghosts_.push_back({there, place, number_, 0});
  there = none;
  run_.set_own(++own_count_);
  owner.run_.set_own(--owner.own_count_);
}

}  // namespace carom
