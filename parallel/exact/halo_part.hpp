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

// Of all disks of the box: the largest radius, and by how much each may grow while lists are in use. Lengths.
struct LargestRadius {
  double now = 0.0;
  double growth = 0.0;
};

class HaloPart;
using HaloParts = std::vector<std::unique_ptr<HaloPart>>;

// A part has a copy of its disks, with its own lists, calendar and records; one thread runs it as if there were no
// other disks. Since disks beyond the halo are missing, ghosts become wrong, from the halo's outer edge inwards, but
// hardly ever the part's own disks. After each slice of a window that is checked (HaloWindows). Unless stated
// otherwise, a function may be called for all parts at the same time.
class HaloPart {
 public:
  explicit HaloPart(const Scene& scene) : one_thread_(1), run_(scene, state_, one_thread_, times_) {}
  HaloPart(const HaloPart&) = delete;
  HaloPart& operator=(const HaloPart&) = delete;

  // Of many disks, gives back what its last windows took: nothing of them is needed to build it, and building takes as
  // much.
  void release_windows(const Disks& all);
  // Takes its disks from all of them: those of this part of the cut, and of its halo.
  void take_disks(const Disks& all, const BoxCut& cut, std::size_t part, DisksOfPart&& disks);
  // Then sorts and lists them. all, radii: of all disks. first: how many own disks the parts before this one have. For
  // each own disk, of index k in `all`, sets slots[k] to first + its place among the own ones.
  void build(const WindowPlan& plan, const BoxCut& cut, State& all, const LargestRadius& radii, std::size_t first,
             std::vector<std::uint32_t>& slots);
  // When all parts are built, finds the owners of its ghosts. firsts: `first` of each part, and the number of all
  // disks.
  void find_owners(const std::vector<std::size_t>& firsts, const std::vector<std::uint32_t>& slots);

  // Then stores its own disks in the columns of all, each in its slot; only ids, radii and masses are kept here.
  void give_columns(Disks& all);
  // Own disks' positions, velocities and spins to their slots; here: in the same order as the disks of this part.
  void give_paths(const Disks& here, Disks& all) const;

  // Before a window's first slice.
  void begin_window();
  // After a slice: compares what its ghosts did with what the same disks did in the parts that own them. Ghosts that
  // went elsewhere there are put on their paths.
  void compare_with(const HaloParts& parts);
  // Then: did all ghosts that concern its own disks move as their owners say? And how near it was to that; lengths.
  bool agrees() const { return agrees_; }
  const HaloUse& use() const { return use_; }

  // After a window: which of its own disks have come so near to an end that parts there are to have them, too. all: the
  // columns.
  void find_offers(const Disks& all);
  // Then, when all have: takes what others offer as ghosts. all: the columns.
  void take_offers(const Disks& all, const HaloParts& parts);
  // Then, when all have taken theirs.
  void clear_offers() { offers_.clear(); }
  // Then, one part after the other: makes the ghosts that came inside disks of its own.
  void take_over(const HaloParts& parts);

  // Between windows. All radii have grown, by no more than lists allow for.
  void take_radii(const Disks& all);
  // When offers have been taken: are all own disks where, if that holds in all parts, whatever they may grow against is
  // here, too? all: the columns.
  bool has_all_near_own(const Disks& all) const;
  // Calls visit(slot, near) for each own disk; near: the slots of the disks that it lists.
  void visit_lists(const std::function<void(std::size_t, std::span<const std::uint32_t>)>& visit) const;
  // Disks in slots where `changed` is not 0 have other velocities: those that are here are predicted anew.
  void change_velocities(const std::vector<unsigned char>& changed);
  // Calls visit with the slots of own disks, as NeighbourLists::visit_near.
  void visit_near(Vec2 centre, double half_width, double half_height,
                  const std::function<void(std::size_t)>& visit) const;

  std::size_t own() const { return own_count_; }
  std::size_t size() const { return slots_.size(); }
  const std::vector<DiskId>& ids() const { return state_.disks.id; }
  WindowRun& run() { return run_; }
  const WindowRun& run() const { return run_; }

 private:
  // In place of the index of a disk that belongs to another part now, so that the others keep their places.
  static constexpr std::uint32_t none = 0xffffffffU;
  // A disk of the halo: its index here, and its place in the part that owns it.
  struct Ghost {
    std::uint32_t index;
    std::uint32_t place;
    std::uint16_t part;
    std::uint16_t more_paths;  // segments begun here in the window than there, modulo 2^16, since its path was replaced
  };

  // An own disk that another part, `to`, is to have as a ghost.
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
  double halo_ = 0.0;  // how wide it is; length
  std::size_t own_count_ = 0;
  std::vector<std::uint32_t> own_;    // indices of its own disks, by place
  std::vector<std::uint32_t> slots_;  // where each disk is in the columns of all; while the part is built, where it was
  std::vector<Ghost> ghosts_;
  std::vector<std::uint32_t> strays_;  // ghosts that moved otherwise than their owners say in the slice, by index
  std::vector<std::size_t> inside_;    // ghosts that are well inside after the slice, in ghosts_, in order
  std::vector<Offer> offers_;
  bool agrees_ = true;
  HaloUse use_;
};

}  // namespace carom
