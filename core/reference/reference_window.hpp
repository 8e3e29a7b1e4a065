// One window of the exact method by a plain event loop: all events of all disks, earliest first.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/collision_log.hpp"
#include "core/disks/state.hpp"
#include "core/physics/exact_event.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/step/window_plan.hpp"

namespace carom {

// The paths of the disks through a window, from which frames are computed.
struct WindowPaths {
  struct Piece {
    std::uint32_t disk;  // storage index at the window's start
    PathSegment path;
    bool gone;       // left through a sink at path.start
    DiskId partner;  // partner of the collision at path.start: a disk, or a wall (contact_event.hpp)
    double spin;     // of a rough disk
  };
  std::vector<PathSegment> first;  // one a disk
  std::vector<Piece> later;        // in order of their starts
};

struct WindowResult {
  WindowPaths paths;
  std::vector<ExactDisk> disks;     // last segments
  std::vector<unsigned char> gone;  // left through a sink
  ImpactTally tally;
  CollisionLog collisions;
  // Set if the result is invalid: the window was crowded and has to be shortened (the event says where), or go_on
  // stopped it.
  std::optional<EventMark> crowded;
  bool given_up = false;
};

// Finds and resolves every event in [0, plan.length]. state: at the window's start. go_on: as in Engine::set_watch.
// Throws PhysicsError at inelastic collapse.
WindowResult run_reference_window(const ExactRules& rules, const State& state, const WindowPlan& plan,
                                  const std::function<bool()>& go_on);

}  // namespace carom
