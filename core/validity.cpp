#include "core/validity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/step_clock.hpp"
#include "core/step_start.hpp"

namespace carom {

namespace {

// What went amiss with collisions, and the remedy.
std::string amiss_text(const Scene& scene) {
  if (scene.run.method == Method::exact) {
    return fmt::format(
        "were made elastic by the TC model, so that less energy is lost: contact_time = {:g} is long against the time "
        "between them; use a smaller one, or --method pairwise for a pile",
        scene.physics.collapse_contact_time.value_or(0.0));
  }
  return fmt::format(
      "were {}: dt = {:g} is long against the time between them; use a smaller dt or --method exact",
      scene.run.method == Method::rollback ? "bounced at one moment with another of the same disk" : "seen a step late",
      scene.run.dt);
}

}  // namespace

void Validity::see_split(State& state, double dt, Count parts) {
  if (std::exchange(state.validity.split_told, true)) return;
  warnings_.push_back(split_warning(state.time, dt, parts));
}

void Validity::see_step(const Scene& scene, const StepFigures& figures, State& state) {
  const bool rollback = scene.run.method == Method::rollback;
  if (figures.overlap > largest_overlap && !std::exchange(state.validity.overlap_told, true)) {
    warnings_.push_back(fmt::format(
        "at time {:g} two disks overlap by {:.2g} % of the sum of their radii, more than {:g} %: dt = {:g} is too long "
        "where disks are pressed together; use a smaller dt or --method exact",
        state.time, 100.0 * figures.overlap, 100.0 * largest_overlap, scene.run.dt));
  }
  // Supports keep a little overlap, so that a pile's impacts are often late without harm: its overlaps tell.
  const bool pile = scene.run.method == Method::pairwise && settles(scene);
  if (figures.amiss > 0 && !pile) see_amiss(scene, figures.amiss, state);
  if (rollback) see_advance(scene, state);
}

void Validity::see_amiss(const Scene& scene, Count count, State& state) {
  const Count amiss = state.validity.amiss += count;
  const Count all =
      state.counters.collisions + (scene.run.method == Method::exact ? state.counters.wall_collisions : Count{0});
  if (amiss <= least_amiss || static_cast<double>(amiss) <= largest_amiss_share * static_cast<double>(all)) return;
  if (std::exchange(state.validity.amiss_told, true)) return;
  warnings_.push_back(fmt::format("by time {:g} {} of {} collisions {}", state.time, amiss, all, amiss_text(scene)));
}

void Validity::see_advance(const Scene& scene, State& state) {
  ValidityCounts& seen = state.validity;
  if (++seen.frames < frames_watched) return;
  const double advance = (state.time - seen.since) / (static_cast<double>(seen.frames) * scene.run.dt);
  if (advance < least_advance && state.time < scene.run.t_end && !std::exchange(seen.slow_told, true)) {
    warnings_.push_back(fmt::format(
        "at time {:g} a frame advances time by {:.2g} dt, with {} disks: time stalls; use --method pairwise or exact",
        state.time, advance, state.disks.size()));
  }
  seen.frames = 0;
  seen.since = state.time;
}

std::vector<std::string> Validity::take_warnings() {
  return std::exchange(warnings_, {});
}

std::vector<std::string> validity_of(const Scene& scene, double smallest_radius) {
  std::vector<std::string> warnings;
  if (!(smallest_radius > 0.0)) return warnings;
  const double side = std::max(scene.box.width, scene.box.height);
  if (smallest_radius < least_radius_share * side) {
    warnings.push_back(
        fmt::format("in a box of {:g} places are known to {:.2g} of the smallest radius only; use a "
                    "smaller box or larger disks",
                    side, side * 0x1p-53 / smallest_radius));
  }
  const double step = std::sqrt(2.0 * scene.physics.diffusion * scene.run.dt) / smallest_radius;
  if (step > largest_brownian_step) {
    const double share = largest_brownian_step * smallest_radius;
    warnings.push_back(
        fmt::format("a Brownian disk moves by {:.2g} of the smallest radius in dt = {:g}: collisions are "
                    "wrong; use dt <= {:.2g}",
                    step, scene.run.dt, share * share / (2.0 * scene.physics.diffusion)));
  }
  return warnings;
}

}  // namespace carom
