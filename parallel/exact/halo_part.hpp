// A part of the box in the exact engine, run by one thread: its own disks, and a halo of other parts' disks around it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/base/phase_times.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "core/step/window_plan.hpp"
#include "parallel/exact/box_cut.hpp"
#include "parallel/exact/disks_of_parts.hpp"
#include "parallel/exact/halo_tuning.hpp"
#include "parallel/exact/window_run.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// The largest radius of all disks of the box, and the most by which each may grow while lists are in use. Lengths.
struct LargestRadius {
  double now = 0.0;
  double growth = 0.0;
};

class HaloPart;
using HaloParts = std::vector<std::unique_ptr<HaloPart>>;

// A part has a copy of its disks, with its own lists, calendar and records; one thread runs it as if there were no
// other disks. Since disks beyond the halo are missing, the paths of ghosts become wrong, from the halo's outer edge
// inwards, but hardly ever those of the part's own disks. HaloWindows checks that after each slice of a window. Unless
// stated otherwise, a function may be called for all parts at the same time.
class HaloPart {
 public:
  explicit HaloPart(const Scene& scene) : one_thread_(1), run_(scene, state_, one_thread_, times_) {}
  HaloPart(const HaloPart&) = delete;
  HaloPart& operator=(const HaloPart&) = delete;

  // If there are many disks, frees the memory of the last windows: building the part does not need it, and takes as
  // much.
  void release_windows(const Disks& all);
  // Takes its disks from those of the box: the disks of this part of the cut and of its halo.
  void take_disks(const Disks& all, const BoxCut& cut, std::size_t part, DisksOfPart&& disks);
  // Then sorts and lists them. all, radii: of all disks. first: the number of own disks of the parts before this one.
  // For each own disk, with index k in `all`, sets slots[k] to first + its place among the own disks.
  void build(const WindowPlan& plan, const BoxCut& cut, State& all, const LargestRadius& radii, std::size_t first,
             std::vector<std::uint32_t>& slots);
  // When all parts are built: finds the owners of its ghosts. firsts: `first` of each part, and then the number of all
  // disks.
  void find_owners(const std::vector<std::size_t>& firsts, const std::vector<std::uint32_t>& slots);

  // Then moves the columns of its own disks into those of all disks, each disk to its slot; only ids, radii and masses
  // are kept in the part.
  void give_columns(Disks& all);
  // Writes the positions, velocities and spins of its own disks to their slots. here: disks in the order of this part.
  void give_paths(const Disks& here, Disks& all) const;

  // Called before a window's first slice.
  void begin_window();
  // After a slice: compares the paths of its ghosts with those of the same disks in the parts that own them. Ghosts
  // whose paths differ take those of their owners.
  void compare_with(const HaloParts& parts);
  // After that: did all ghosts that concern its own disks move as in their owners?
  bool agrees() const { return agrees_; }
  const HaloUse& use() const { return use_; }

  // After a window: finds those of its own disks that have come so near to an end that the parts there must have them
  // as ghosts. all: the columns of all disks.
  void find_offers(const Disks& all);
  // When all parts have done that: takes the disks that others offer as ghosts. all: the columns of all disks.
  void take_offers(const Disks& all, const HaloParts& parts);
  // When all parts have taken theirs.
  void clear_offers() { offers_.clear(); }
  // Then, one part after the other: takes over the ghosts that have come inside as its own disks.
  void take_over(const HaloParts& parts);

  // Between windows, when all radii have grown, by no more than the lists allow for.
  void take_radii(const Disks& all);
  // When offers have been taken: does this part allow the conclusion, if all other parts do too, that each part has all
  // disks against which its own may grow? all: the columns of all disks.
  bool has_all_near_own(const Disks& all) const;
  // Calls visit(slot, near) for each own disk; near: the slots of the disks that it lists.
  void visit_lists(const std::function<void(std::size_t, std::span<const std::uint32_t>)>& visit) const;
  // The disks in slots for which `changed` is not 0 have new velocities: those of them in this part are predicted anew.
  void change_velocities(const std::vector<unsigned char>& changed);
  // Calls visit with the slots of own disks; otherwise as NeighbourLists::visit_near.
  void visit_near(Vec2 centre, double half_width, double half_height,
                  const std::function<void(std::size_t)>& visit) const;

  std::size_t own() const { return own_count_; }
  std::size_t size() const { return slots_.size(); }
  const std::vector<DiskId>& ids() const { return state_.disks.id; }
  WindowRun& run() { return run_; }
  const WindowRun& run() const { return run_; }

 private:
  // Stands for a disk that belongs to another part now, so that the others keep their places.
  static constexpr std::uint32_t none = 0xffffffffU;
  // A disk of the halo: its index in this part, and its place in the part that owns it.
  struct Ghost {
    std::uint32_t index;
    std::uint32_t place;
    std::uint16_t part;
    std::uint16_t more_paths;  // segments begun here minus those begun there in the window since its path was replaced,
                               // modulo 2^16
  };

  // An own disk that another part, `to`, must have as a ghost.
  struct Offer {
    std::uint32_t place;
    std::uint32_t slot;
    std::uint16_t to;
  };

  template <class T>
  void give(const std::vector<T>& column, std::vector<T>& all) const;
  void find_own(const BoxCut& cut, std::size_t first, std::vector<std::uint32_t>& slots);
  std::uint8_t known_to_at(const BoxCut& cut, Vec2 at) const;
  void see_radius(double radius);
  bool goes_as_there(const Ghost& ghost, const HaloPart& owner) const;
  void replace_path(Ghost& ghost, const HaloPart& owner);
  double beyond_end(const PathSegment& path) const;
  void offer(std::uint32_t place, Vec2 at);
  void add_ghost(const Disks& all, std::uint16_t owner, const Offer& offer);
  std::uint8_t known_once_owned(const Ghost& ghost, HaloPart& owner);
  void own_ghost(std::size_t number, const HaloParts& parts);
  void change_owner(std::uint16_t from, std::uint32_t place, std::uint16_t to, std::uint32_t new_place);
  DiskRecord& record(std::uint32_t i) { return run_.window().record[i]; }
  const PartEnds& ends() const { return run_.window().part; }
  const PartNeighbours& neighbours() const { return ends().neighbours; }
  OtherParts& other_parts(std::uint32_t i) { return run_.window().others[i]; }

  State state_;
  PhaseTimes times_;
  Executor one_thread_;
  WindowRun run_;
  std::uint16_t number_ = 0;
  double halo_ = 0.0;  // width of the halo; length
  std::size_t own_count_ = 0;
  std::vector<std::uint32_t> own_;    // indices of its own disks, by place
  std::vector<std::uint32_t> slots_;  // where each disk is in the columns of all; while the part is built, where it was
  std::vector<Ghost> ghosts_;
  std::vector<std::uint32_t> strays_;  // ghosts that moved otherwise in the slice than in their owners, by index
  std::vector<std::size_t> inside_;    // ghosts that are well inside after the slice, as places in ghosts_, in order
  std::vector<Offer> offers_;
  bool agrees_ = true;
  HaloUse use_;
};

}  // namespace carom
