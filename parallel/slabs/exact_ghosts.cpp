#include "parallel/slabs/exact_ghosts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "parallel/ranks/message.hpp"
#include "parallel/slabs/disk_pieces.hpp"

namespace carom {

namespace {

// New ghosts are due when disks that this rank does not have have come nearer than least_share_left of the depth, or
// one of the rank's own has left its slab by excursion_share of the depth.
constexpr double least_share_left = 0.7;
constexpr double excursion_share = 0.1;
// Disks that this rank does not have are assumed to come nearer by at least the flight of the fastest disk in this
// number of slices.
constexpr double slices_ahead = 2.0;

// A ghost whose motion in the slice is not known: its number among those that the neighbour shows, and the number of
// paths that it is known to have begun.
struct Question {
  std::uint32_t number;
  std::uint16_t version;
};

// The ghost's present path, if it has begun more paths than that.
struct Answer {
  std::uint32_t number;
  std::uint32_t thermal_hits;
  PathSegment path;
  double last_contact, spin;
  std::uint16_t version;
};

std::vector<DiskId> ids_of(const Disks& d, const std::vector<std::uint32_t>& places) {
  std::vector<DiskId> ids(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) ids[k] = d.id[places[k]];
  return ids;
}

}  // namespace

void ExactGhosts::drop(State& state, const std::vector<unsigned char>& gone) {
  if (marks_.empty() && gone.empty()) return;
  if (gone.empty() && !ghost_places_.empty()) {
    DiskHoles holes;
    for (const GhostPlace& at : ghost_places_) holes.add({&at.place, 1});
    holes.close(state.disks);
  } else {
    std::vector<unsigned char> leaves = ghosts_among(state.disks.size());
    for (std::size_t i = 0; i < gone.size(); ++i) leaves[i] |= gone[i];
    remove_marked(state.disks, leaves);
  }
  marks_.clear();
  ghost_places_.clear();
}

std::vector<unsigned char> ExactGhosts::ghosts_among(std::size_t n) const {
  std::vector<unsigned char> ghosts(n, 0);
  for (std::size_t i = 0; i < std::min(n, marks_.size()); ++i) ghosts[i] = marks_[i] & ghost;
  return ghosts;
}

void ExactGhosts::see(const Slab& slab, const Domain& box, double depth, DiskColumns columns, State& state) {
  slab_ = slab;
  depth_ = depth;
  half_ = 0.5 * (slab.high - slab.low);
  band_ = {slab.low + half_, box.periodic_y() ? box.height : 0.0};
  below_ = above_ = {};
  ForNeighbours shown;
  for (std::uint32_t i = 0; i < state.disks.size(); ++i) {
    const double y = from_centre(state.disks.y[i]);
    if (slab.has_lower && y + half_ < depth) shown.below.push_back(i);
    if (slab.has_upper && half_ - y < depth) shown.above.push_back(i);
  }
  below_.shown.ids = ids_of(state.disks, shown.below);
  above_.shown.ids = ids_of(state.disks, shown.above);
  const std::size_t own_disks = state.disks.size();
  auto most = static_cast<double>(shown.most());
  ranks_.maximum({&most, 1});
  exchange_disks(
      ranks_, state, shown, static_cast<std::size_t>(most),
      [&](std::size_t from_below, std::size_t from_above) {
        reserve_amply(state.disks, own_disks + from_below + from_above, columns);
        below_.ghosts.ids.reserve(from_below);
        above_.ghosts.ids.reserve(from_above);
      },
      [](std::span<const std::uint32_t>) {},
      [&](const MovingDisk& disk, bool is_from_above) {
        take_in(state, disk, columns);
        (is_from_above ? above_ : below_).ghosts.ids.push_back(disk.disk.id);
      });
  marks_.assign(own_disks, own);
  marks_.resize(state.disks.size(), ghost);
}

void ExactGhosts::find_places(const Disks& d) {
  // The places of all disks that another rank has, too.
  std::vector<std::pair<DiskId, std::uint32_t>> place_of;
  place_of.reserve(below_.shown.ids.size() + above_.shown.ids.size() + count());
  for (std::uint32_t i = 0; i < d.size(); ++i) {
    const double y = from_centre(d.y[i]);
    if (half_ - std::abs(y) < depth_ * (1.0 + 1e-9)) place_of.emplace_back(d.id[i], i);
  }
  std::sort(place_of.begin(), place_of.end());
  marks_.assign(d.size(), own);
  ghost_places_.clear();
  ghost_places_.reserve(count());
  const auto find = [&](Shared& shared, std::uint8_t mark) {
    shared.places.clear();
    shared.places.reserve(shared.ids.size());
    for (const DiskId id : shared.ids) {
      const auto at = std::lower_bound(place_of.begin(), place_of.end(), std::pair<DiskId, std::uint32_t>(id, 0));
      shared.places.push_back(at->second);
      marks_[at->second] |= mark;
    }
  };
  find(below_.shown, seen_below);
  find(above_.shown, seen_above);
  for (const bool above : {false, true}) {
    Shared& ghosts = above ? above_.ghosts : below_.ghosts;
    find(ghosts, ghost);
    for (std::uint32_t k = 0; k < ghosts.places.size(); ++k) ghost_places_.push_back({ghosts.places[k], k, above});
  }
  std::sort(ghost_places_.begin(), ghost_places_.end(),
            [](const GhostPlace& a, const GhostPlace& b) { return a.place < b.place; });
  ghosts_.clear(d.size());
  for (const GhostPlace& g : ghost_places_) ghosts_.insert(g.place);
  ghosts_.count();
}

void ExactGhosts::look_beyond(const Disks& d, const Approach& approach) {
  find_strangers(d, approach.furthest);
  furthest_ = approach.furthest;
  taken_ = approach.taken;
  Bytes to_below;
  Bytes to_above;
  put(to_below, of_below_.nearest);
  put(to_above, of_above_.nearest);
  const auto [from_below, from_above] = ranks_.exchange(to_below, to_above);
  // Further away there may be disks of the ranks beyond the neighbours, which are not watched: they are assumed to be
  // as near as they can have come.
  const double behind = std::min(depth_, approach.thinnest - most_excursion() - (approach.furthest - approach.taken));
  beyond_below_ = slab_.has_lower ? std::min(MessageReader(from_below).get<double>(), behind) : HUGE_VAL;
  beyond_above_ = slab_.has_upper ? std::min(MessageReader(from_above).get<double>(), behind) : HUGE_VAL;
}

// Strangers further away than that cannot become the nearest ones.
void ExactGhosts::find_strangers(const Disks& d, double furthest) {
  double below = HUGE_VAL;
  double above = HUGE_VAL;
  double lowest = 0.0;
  double highest = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const std::uint8_t mark = marks_[i];
    const double y = from_centre(d.y[i]);
    below = std::min(below, (mark & (ghost | seen_below)) == 0 ? y : HUGE_VAL);
    above = std::min(above, (mark & (ghost | seen_above)) == 0 ? -y : HUGE_VAL);
    lowest = std::min(lowest, (mark & ghost) == 0 ? y : 0.0);
    highest = std::max(highest, (mark & ghost) == 0 ? y : 0.0);
  }
  of_below_ = {below + half_, {}};
  of_above_ = {above + half_, {}};
  excursion_ = 0.0;
  if (slab_.has_lower) excursion_ = std::max(excursion_, -lowest - half_);
  if (slab_.has_upper) excursion_ = std::max(excursion_, highest - half_);
  below += furthest;
  above += furthest;
  for (std::uint32_t i = 0; i < d.size(); ++i) {
    const double y = from_centre(d.y[i]);
    if (y > below && -y > above) [[likely]]
      continue;
    if (y <= below && (marks_[i] & (ghost | seen_below)) == 0) of_below_.places.push_back(i);
    if (-y <= above && (marks_[i] & (ghost | seen_above)) == 0) of_above_.places.push_back(i);
  }
}

bool ExactGhosts::strangers_come_near(const WindowState& window) const {
  return (slab_.has_lower && come_near(window, false, of_below_)) ||
         (slab_.has_upper && come_near(window, true, of_above_));
}

bool ExactGhosts::come_near(const WindowState& window, bool above, const Strangers& strangers) const {
  double nearest = HUGE_VAL;
  for (const std::uint32_t i : strangers.places) {
    const double y = carried_to(window.record[i].path, window.slice_start, window.rules.gravity).y;
    if (!std::isnan(y)) nearest = std::min(nearest, beyond_border(above, y));
  }
  const double flight = window.speed_bound * (window.slice_stop() - window.slice_start);
  return nearest - flight < strangers.nearest - taken_;
}

bool ExactGhosts::are_few() const {
  return std::min(beyond_below_, beyond_above_) < least_share_left * depth_ || excursion_ > most_excursion();
}

double ExactGhosts::most_excursion() const {
  return excursion_share * depth_;
}

KnownBand ExactGhosts::band(double slice_flight) {
  slice_flight_ = slice_flight;
  taken_ = std::min(furthest_, std::max(taken_, slices_ahead * slice_flight));
  KnownBand known = band_;
  known.below = -(half_ + beyond_below_) + taken_;
  known.above = half_ + beyond_above_ - taken_;
  return known;
}

double ExactGhosts::least_of_all(double here) {
  double most = -here;
  ranks_.maximum({&most, 1});
  return -most;
}

SliceOutcome ExactGhosts::agree(SliceOutcome here, Count& events) {
  constexpr auto outcomes = static_cast<std::size_t>(SliceOutcome::given_up) + 1;
  std::array<std::int64_t, outcomes> said{};
  said[0] = static_cast<std::int64_t>(events);
  if (here != SliceOutcome::done) said[static_cast<std::size_t>(here)] = 1;
  ranks_.sum(said);
  events = static_cast<Count>(said[0]);
  for (std::size_t k = outcomes - 1; k > 0; --k) {
    if (said[k] > 0) return static_cast<SliceOutcome>(k);
  }
  return SliceOutcome::done;
}

void ExactGhosts::learn(WindowState& window, const std::vector<std::uint32_t>& unknown) {
  std::vector<Question> of_below;
  std::vector<Question> of_above;
  for (const std::uint32_t i : unknown) {
    const GhostPlace& at = ghost_places_[ghosts_.number_of(i)];
    (at.above ? of_above : of_below).push_back({at.number, window.record[i].version});
  }
  Bytes to_below;
  Bytes to_above;
  put_all(to_below, of_below);
  put_all(to_above, of_above);
  const auto asked = ranks_.exchange(to_below, to_above);
  const auto answers =
      ranks_.exchange(answer(window, below_.shown, asked.below), answer(window, above_.shown, asked.above));
  take_answer(window, below_.ghosts, answers.below);
  take_answer(window, above_.ghosts, answers.above);
}

Bytes ExactGhosts::answer(const WindowState& window, const Shared& shown, const Bytes& request) {
  std::vector<Answer> answers;
  for (const Question& q : MessageReader(request).get_all<Question>()) {
    const std::uint32_t i = shown.places.at(q.number);
    const DiskRecord& record = window.record[i];
    if (record.version == q.version) continue;
    answers.push_back({q.number, window.thermal_hits.empty() ? 0 : window.thermal_hits[i], record.path,
                       window.last_contact.empty() ? 0.0 : window.last_contact[i],
                       window.spin.empty() ? 0.0 : window.spin[i], record.version});
  }
  Bytes message;
  put_all(message, answers);
  return message;
}

void ExactGhosts::take_answer(WindowState& window, const Shared& ghosts, const Bytes& message) {
  for (const Answer& a : MessageReader(message).get_all<Answer>()) {
    const std::uint32_t i = ghosts.places.at(a.number);
    window.record[i].path = a.path;
    window.record[i].version = a.version;
    window.fastest2 = std::max(window.fastest2, a.path.vx * a.path.vx + a.path.vy * a.path.vy);
    if (!window.thermal_hits.empty()) window.thermal_hits[i] = a.thermal_hits;
    if (!window.last_contact.empty()) window.last_contact[i] = a.last_contact;
    if (!window.spin.empty()) window.spin[i] = a.spin;
  }
}

}  // namespace carom
