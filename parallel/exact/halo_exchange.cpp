// The exchange between parts: the paths of ghosts after a slice; between windows, the disks that become ghosts, and the
// ghosts that become own disks.
#include <algorithm>

#include "core/base/same_bits.hpp"
#include "core/physics/exact_path.hpp"
#include "parallel/exact/halo_part.hpp"

namespace carom {

namespace {

// A ghost that is this far inside a part becomes one of its own disks; over the halo's width.
constexpr double inside_share = 0.05;

// Compares entries of columns that may be absent.
bool same_bits_at(const std::vector<double>& a, std::size_t i, const std::vector<double>& b, std::size_t k) {
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

// Changes only this part's ghosts and reads only other parts' own disks, so all parts may call it at the same time.
void HaloPart::compare_with(const HaloParts& parts) {
  strays_.clear();
  inside_.clear();
  agrees_ = true;
  use_ = {};
  for (std::size_t g = 0; g < ghosts_.size(); ++g) {
    Ghost& ghost = ghosts_[g];
    const HaloPart& owner = *parts[ghost.part];
    DiskRecord& here = record(ghost.index);
    const std::uint32_t i = owner.own_[ghost.place];
    const bool may_be_here = (owner.run_.window().others[i].may_reach & owner.neighbours().bit_of(number_)) != 0;
    const bool concerns = may_be_here || here.progress.has(DiskProgress::met_own);
    here.progress.clear(DiskProgress::met_own);
    const bool is_as_there = goes_as_there(ghost, owner);
    if (is_as_there && !concerns) [[likely]]
      continue;
    const double depth = beyond_end(owner.run_.window().record[i].path);
    if (concerns) use_.deepest = std::max(use_.deepest, depth);
    // It has come inside, so it concerns this part.
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
  return same_path(here.path, there.path) && same_bits_at(window.spin, g, others.spin, i) &&
         same_bits_at(window.last_contact, g, others.last_contact, i) &&
         (window.thermal_hits.empty() || window.thermal_hits[g] == others.thermal_hits[i]);
}

// The path gets a new version, so that no prediction made with an earlier one is valid. The ghost may be faster than
// all disks of this part: then crossing events and images beyond the nearest one matter from now on.
void HaloPart::replace_path(Ghost& ghost, const HaloPart& owner) {
  WindowState& window = run_.window();
  const WindowState& others = owner.run_.window();
  const std::uint32_t i = owner.own_[ghost.place];
  DiskRecord& here = window.record[ghost.index];
  ++here.version;
  ghost.more_paths = static_cast<std::uint16_t>(here.version - others.record[i].version);
  here.path = others.record[i].path;
  window.fastest2 = std::max(window.fastest2, here.path.vx * here.path.vx + here.path.vy * here.path.vy);
  if (!window.spin.empty()) window.spin[ghost.index] = others.spin[i];
  if (!window.last_contact.empty()) window.last_contact[ghost.index] = others.last_contact[i];
  if (!window.thermal_hits.empty()) window.thermal_hits[ghost.index] = others.thermal_hits[i];
  strays_.push_back(ghost.index);
}

// The distance of the disk outside the part at the slice's end; negative inside.
double HaloPart::beyond_end(const PathSegment& path) const {
  const WindowState& window = run_.window();
  const PathSegment p = carried_to(path, window.slice_stop(), window.rules.gravity);
  return std::max(ends().x.beyond(p.x), ends().y.beyond(p.y));
}

// A disk across a period seems to be far outside, and is checked as well.
void HaloPart::find_offers(const Disks& all) {
  offers_.clear();
  const KnownBand& x = ends().x.between;
  const KnownBand& y = ends().y.between;
  const auto is_inside = [this](const KnownBand& ends, double d) {
    return d > ends.below + halo_ && d < ends.above - halo_;
  };
  for (std::uint32_t place = 0; place < own_.size(); ++place) {
    if (own_[place] == none) continue;
    const std::uint32_t slot = slots_[own_[place]];
    const Vec2 at{all.x[slot], all.y[slot]};
    if (!is_inside(x, at.x - x.centre) || !is_inside(y, at.y - y.centre)) [[unlikely]]
      offer(place, at);
  }
}

// Also checks anew whether the disk may come beyond an end.
void HaloPart::offer(std::uint32_t place, Vec2 at) {
  const std::uint32_t i = own_[place];
  const auto steps = [this](const KnownBand& ends, double c) {
    const double d = ends.from_centre(c);
    return PieceSteps{d <= ends.below + halo_, true, d >= ends.above - halo_};
  };
  const unsigned near = ends().bits_of(steps(ends().x.between, at.x), steps(ends().y.between, at.y));
  OtherParts& others = other_parts(i);
  const unsigned fresh = near & ~unsigned{others.known_to};
  others.known_to = static_cast<std::uint8_t>(others.known_to | fresh);
  for (unsigned left = fresh; left != 0; left &= left - 1) {
    offers_.push_back({place, slots_[i], neighbours().part(static_cast<std::size_t>(std::countr_zero(left)))});
  }
  if (others.may_reach == 0) return;
  others.may_reach = 0;
  run_.note_listing(i);
}

void HaloPart::take_offers(const Disks& all, const HaloParts& parts) {
  for (std::size_t k = 0; k < neighbours().count(); ++k) {
    const std::uint16_t owner = neighbours().part(k);
    for (const Offer& offer : parts[owner]->offers_) {
      if (offer.to == number_) add_ghost(all, owner, offer);
    }
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
  run_.window().others.emplace_back();
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

// The bits of the parts that will have the disk as a ghost when it is this part's own: those that have it now, and its
// owner. None if one of them is not next to this part, since it would not learn of the disk's path.
std::uint8_t HaloPart::known_once_owned(const Ghost& ghost, HaloPart& owner) {
  unsigned known = neighbours().bit_of(ghost.part);
  const unsigned known_there = owner.other_parts(owner.own_[ghost.place]).known_to;
  for (std::size_t k = 0; k < owner.neighbours().count(); ++k) {
    const std::uint16_t part = owner.neighbours().part(k);
    if (part == number_ || (known_there >> k & 1U) == 0) continue;
    if (neighbours().bit_of(part) == 0) return 0;
    known |= neighbours().bit_of(part);
  }
  return static_cast<std::uint8_t>(known);
}

// The other parts that have the disk as a ghost are told.
void HaloPart::own_ghost(std::size_t number, const HaloParts& parts) {
  const Ghost ghost = ghosts_[number];
  HaloPart& owner = *parts[ghost.part];
  const std::uint8_t known = known_once_owned(ghost, owner);
  if (known == 0) return;
  const auto place = static_cast<std::uint32_t>(own_.size());
  for (std::size_t k = 0; k < neighbours().count(); ++k) {
    const std::uint16_t part = neighbours().part(k);
    if (part != ghost.part && (known >> k & 1U) != 0) {
      parts[part]->change_owner(ghost.part, ghost.place, number_, place);
    }
  }
  own_.push_back(ghost.index);
  record(ghost.index).progress = DiskProgress();
  other_parts(ghost.index) = {known, 0};
  run_.note_listing(ghost.index);
  ghosts_[number] = ghosts_.back();
  ghosts_.pop_back();
  std::uint32_t& there = owner.own_[ghost.place];
  DiskProgress& progress = owner.record(there).progress;
  progress = DiskProgress();
  progress.set(DiskProgress::ghost);
  owner.other_parts(there) = {};
  owner.ghosts_.push_back({there, place, number_, 0});
  there = none;
  run_.set_own(++own_count_);
  owner.run_.set_own(--owner.own_count_);
}

// Finds the ghost whose owner was part `from`, and gives it its new owner.
void HaloPart::change_owner(std::uint16_t from, std::uint32_t place, std::uint16_t to, std::uint32_t new_place) {
  const auto is_it = [&](const Ghost& ghost) { return ghost.part == from && ghost.place == place; };
  const auto ghost = std::find_if(ghosts_.begin(), ghosts_.end(), is_it);
  ghost->part = to;
  ghost->place = new_place;
}

}  // namespace carom
