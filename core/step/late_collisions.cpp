#include "core/step/late_collisions.hpp"

#include <fmt/format.h>

#include "core/scene/drawn_velocities.hpp"
#include "core/step/step_start.hpp"
#include "core/step/validity.hpp"

namespace carom {

namespace {

// "seen a step late: dt = 0.1 is long ...; use a smaller dt".
std::string cause_and_remedy(const Scene& scene) {
  if (scene.run.method == Method::exact && settles(scene)) {
    return fmt::format(
        "made elastic by the TC model (contact_time = {:g}), as are all collisions of disks that rest on each other; "
        "use run.method = \"pairwise\" for a pile, or a smaller contact_time while disks still fly",
        scene.physics.collapse_contact_time.value_or(0.0));
  }
  if (scene.run.method == Method::exact) {
    return fmt::format(
        "made elastic by the TC model, so that too little energy is lost: contact_time = {:g} is long against the time "
        "between collisions; use a smaller one",
        scene.physics.collapse_contact_time.value_or(0.0));
  }
  return fmt::format("{}: dt = {:g} is long against the time between collisions; use a smaller dt{}",
                     scene.run.method == Method::rollback ? "treated as simultaneous with another one of the same disk"
                                                          : "seen a step late",
                     scene.run.dt, or_exact(scene));
}

const char* was_or_were(Count count) {
  return count == 1 ? "was" : "were";
}

}  // namespace

bool exceeds(Count inaccurate, Count all, double share) {
  return static_cast<double>(inaccurate) > share * static_cast<double>(all);
}

Count collisions_watched(const Scene& scene, const State& state) {
  return state.counters.collisions + (scene.run.method == Method::exact ? state.counters.wall_collisions : Count{0});
}

const char* or_exact(const Scene& scene) {
  return velocities_are_drawn(scene) ? "" : " or run.method = \"exact\"";
}

std::string inaccurate_text(const Scene& scene, const State& state) {
  return fmt::format("by time {:g} {} of {} collisions {} {}", state.time, state.validity.inaccurate,
                     collisions_watched(scene, state), was_or_were(state.validity.inaccurate), cause_and_remedy(scene));
}

std::string late_at_walls_text(const Scene& scene, const State& state) {
  return fmt::format(
      "by time {:g} {} of {} bounces off walls and obstacles {} seen a step late: dt = {:g} is long against the time "
      "between bounces, and others are missed; use a smaller dt{}",
      state.time, state.validity.inaccurate_at_walls, state.counters.wall_collisions,
      was_or_were(state.validity.inaccurate_at_walls), scene.run.dt, or_exact(scene));
}

std::vector<std::string> few_inaccurate_warnings(const Scene& scene, const State& state) {
  std::vector<std::string> warnings;
  // The TC model is meant to make a few collisions elastic.
  if (scene.run.method == Method::exact) return warnings;
  const ValidityCounts& seen = state.validity;
  // A single late collision may be that of two disks that touch at the start, up to rounding, and hardly move.
  if (!seen.inaccurate_told && seen.inaccurate > 1 &&
      exceeds(seen.inaccurate, collisions_watched(scene, state), largest_inaccurate_share)) {
    warnings.push_back(inaccurate_text(scene, state));
  }
  const Count bounces = state.counters.wall_collisions;
  if (!seen.late_at_walls_told && exceeds(seen.inaccurate_at_walls, bounces, largest_late_share_at_walls)) {
    warnings.push_back(late_at_walls_text(scene, state));
  }
  return warnings;
}

}  // namespace carom
