// Piles on slabs: the contacts of a step in rounds that ranks process together (border_rounds.hpp), and the check
// whether resolving them has pressed disks of different slabs together.
#include <algorithm>
#include <array>

#include "parallel/ranks/message.hpp"
#include "parallel/slabs/other_slabs.hpp"
#include "parallel/slabs/slab_stepping.hpp"
#include "parallel/stepping/settle_phases.hpp"

namespace carom {

namespace {

// Disks that a rank sends to all ranks at a time.
constexpr std::size_t disks_a_piece = std::size_t{1} << 14;

}  // namespace

// Returns the largest squared speed of disks that had contacts.
double SlabStepping::settle_here(const StepRules& rules, ImpactTally& tally) {
  lists_.figures = {};
  if (ranks_.count() == 1) return settle_contacts(state_, rules, found_, executor_, lists_, tally);
  border_rounds_.begin(found_.buffers[found_.used - 1], state_.disks, ghosts_);
  OtherSlabs others(ranks_, border_rounds_);
  return settle_with(state_, rules, found_, ghosts_.own(), executor_, lists_, tally, others);
}

// Pairs of disks of two slabs are checked on both ranks, each of which knows which of its own disks were displaced.
bool SlabStepping::presses_others() {
  if (disks_ == 0) return false;
  const PhaseTimer timer(times_, "resolve");
  Disks& d = state_.disks;
  const double far = find_displaced(d, scene_.box, executor_, displaced_);
  const double slack = found_.furthest + far;
  const bool pressed = any_pressed(d, scene_.box, cells_, slack, executor_, displaced_);
  std::array<double, 3> most{far, displaced_.all.empty() ? 0.0 : 1.0, pressed ? 1.0 : 0.0};
  ranks_.maximum(most);
  if (most[1] == 0.0 || most[2] > 0.0 || ranks_.count() == 1) return most[2] > 0.0;
  return ranks_.any(presses_disks_of_others(excursion_ + most[0], slack));
}

// Is a displaced disk of another rank pressed into one of this rank? excursion: the largest distance of any disk from
// its slab; slack: that of a disk of this rank from its cell; length.
bool SlabStepping::presses_disks_of_others(double excursion, double slack) {
  if (excursion <= room_beyond(cut_, largest_radius_)) {
    std::vector<std::uint32_t>& near = displaced_.all;
    find_seen_beyond(slab_, scene_.box, state_.disks, near, largest_radius_, excursion, seen_);
    const SeenBeyond theirs = exchange_seen(ranks_, seen_);
    return is_pressed_by(theirs.below, slack) || is_pressed_by(theirs.above, slack);
  }
  // Disks are so far from their slabs that they may touch disks beyond the next slab: all ranks check all of them.
  auto most = static_cast<double>(displaced_.all.size());
  ranks_.maximum({&most, 1});
  bool pressed = false;
  for (std::size_t begin = 0; begin < static_cast<std::size_t>(most); begin += disks_a_piece) {
    std::vector<Disk> piece;
    const std::size_t end = std::min(displaced_.all.size(), begin + disks_a_piece);
    for (std::size_t k = begin; k < end; ++k) piece.push_back(disk_at(state_.disks, displaced_.all[k]));
    Bytes message;
    put_all(message, piece);
    const std::vector<Bytes> pieces = ranks_.gather(message);
    for (int r = 0; r < ranks_.count(); ++r) {
      if (r == ranks_.rank()) continue;
      pressed = is_pressed_by(MessageReader(pieces[static_cast<std::size_t>(r)]).get_all<Disk>(), slack) || pressed;
    }
  }
  return pressed;
}

// Is one of these disks, of another rank, pressed into one of this rank? They are stored behind the own disks
// meanwhile.
bool SlabStepping::is_pressed_by(const std::vector<Disk>& disks, double slack) {
  const std::size_t own = state_.disks.size();
  for (const Disk& disk : disks) push_back(state_.disks, disk, columns_);
  bool pressed = false;
  for (std::size_t i = own; i < state_.disks.size() && !pressed; ++i) {
    pressed = is_pressed(state_.disks, scene_.box, cells_, slack, i);
  }
  truncate(state_.disks, own);
  return pressed;
}

}  // namespace carom
