// The ghosts of a rank that runs `exact`: its neighbours' disks up to a depth beyond its slab's borders, with their
// complete motion. They are chosen when disks are sorted, and stay the same until the next time.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/disks/domain.hpp"
#include "core/disks/state.hpp"
#include "parallel/exact/window_ghosts.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/border_search.hpp"
#include "parallel/slabs/moving_disks.hpp"
#include "parallel/slabs/place_set.hpp"

namespace carom {

// The approach, in a window, of disks that a rank does not have; lengths.
struct Approach {
  double furthest = 0.0;  // no disk flies further in the window
  double taken = 0.0;     // assumed largest approach; at most `furthest`
  double thinnest = 0.0;  // of all slabs: beyond a neighbour's slab are disks of the next rank
};

class ExactGhosts final : public WindowGhosts {
 public:
  explicit ExactGhosts(Ranks& ranks) : ranks_(ranks) {}

  // Removes the ghosts from the columns, and the disks marked in `gone`, which is empty or has an entry for each disk.
  // Disks behind those of the last window are the rank's own.
  void drop(State& state, const std::vector<unsigned char>& gone = {});
  // May there be ghosts in the columns?
  bool any() const { return !marks_.empty(); }
  // The number of the rank's own disks among n.
  std::size_t own_among(std::size_t n) const {
    std::size_t own_disks = 0;
    visit_own(n, [&](std::size_t begin, std::size_t end) { own_disks += end - begin; });
    return own_disks;
  }
  // An entry for each of n disks, 1 for ghosts.
  std::vector<unsigned char> ghosts_among(std::size_t n) const;
  // The disks of the state are those in the rank's slab; adds the ghosts, up to this depth (length) beyond the slab's
  // borders. Collective. Preconditions: no slab is thinner than the depth, and in a periodic box the slab with its
  // ghosts is lower than the box.
  void see(const Slab& slab, const Domain& box, double depth, DiskColumns columns, State& state);
  std::size_t count() const { return below_.ghosts.ids.size() + above_.ghosts.ids.size(); }
  // After the ghosts have been sorted with the other disks.
  void find_places(const Disks& disks);

  // Before each window: finds how near the disks that this rank does not have have come. Collective.
  void look_beyond(const Disks& disks, const Approach& approach);
  // Is the band of ghosts between these and the slab so thin that new ghosts are due?
  bool are_few() const;

  // At the start of a window that is run, no disk of any rank has left its slab by more than this; length.
  double most_excursion() const;
  // No disk flew further than this in a slice of the last window; length. HUGE_VAL if there was none.
  double slice_flight() const { return slice_flight_; }

  // Calls visit(first, last, is_own) for runs of disks in [begin, end), by storage index; is_own: they are the rank's
  // own.
  template <class Visit>
  void visit_runs(std::size_t begin, std::size_t end, Visit&& visit) const {
    for (std::size_t i = begin; i < end;) {
      std::size_t last = i;
      const bool ghosts = is_marked(i);
      while (last < end && is_marked(last) == ghosts) ++last;
      visit(i, last, !ghosts);
      i = last;
    }
  }
  // Calls visit for the rank's own disks among the first n.
  template <class Visit>
  void visit_own(std::size_t n, Visit&& visit) const {
    visit_runs(0, n, [&](std::size_t first, std::size_t last, bool is_own) {
      if (is_own) visit(first, last);
    });
  }

  bool is_ghost(std::uint32_t i) const override { return is_marked(i); }
  Heights own_heights() const override { return {slab_.low, slab_.high}; }
  KnownBand band(double slice_flight) override;
  bool strangers_come_near(const WindowState& window) const override;
  double least_of_all(double here) override;
  SliceOutcome agree(SliceOutcome here, Count& events) override;
  void learn(WindowState& window, const std::vector<std::uint32_t>& unknown) override;

 private:
  // Marks of a disk, as bits.
  enum Mark : std::uint8_t { own = 0, ghost = 1, seen_below = 2, seen_above = 4 };
  // The disks that one of two neighbours has of the other, in the same order on both ranks: ids, and storage indices.
  struct Shared {
    std::vector<DiskId> ids;
    std::vector<std::uint32_t> places;
  };
  // Disks that this rank shows to a neighbour, and its ghosts, which the neighbour shows.
  struct Border {
    Shared shown, ghosts;
  };
  // Disks of this rank that a neighbour does not have, and which may come nearest to it in the window.
  struct Strangers {
    double nearest = HUGE_VAL;  // distance from the border at the window's start
    std::vector<std::uint32_t> places;
  };
  // A ghost by storage index: the border that it is beyond, and its number there.
  struct GhostPlace {
    std::uint32_t place, number;
    bool above;
  };

  bool is_marked(std::size_t i) const { return i < marks_.size() && (marks_[i] & ghost) != 0; }
  double from_centre(double y) const { return band_.from_centre(y); }
  double beyond_border(bool above, double y) const { return above ? half_ - from_centre(y) : from_centre(y) + half_; }
  void find_strangers(const Disks& disks, double furthest);
  bool come_near(const WindowState& window, bool above, const Strangers& strangers) const;
  static Bytes answer(const WindowState& window, const Shared& shown, const Bytes& request);
  static void take_answer(WindowState& window, const Shared& ghosts, const Bytes& message);

  Ranks& ranks_;
  Slab slab_;
  KnownBand band_;  // only centre and period are used
  double half_ = 0.0, depth_ = 0.0;
  double beyond_below_ = 0.0, beyond_above_ = 0.0;  // from the borders to the nearest disk that this rank does not have
  double excursion_ = 0.0;                          // largest distance of a disk of this rank from its slab
  double furthest_ = 0.0, taken_ = 0.0;             // of the window's Approach
  double slice_flight_ = HUGE_VAL;                  // of the last window, as given to band()
  Strangers of_below_, of_above_;
  Border below_, above_;
  std::vector<std::uint8_t> marks_;  // by storage index
  PlaceSet ghosts_;
  std::vector<GhostPlace> ghost_places_;  // in order of storage, in which ghosts_ numbers them
};

}  // namespace carom
