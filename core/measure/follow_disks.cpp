#include "core/measure/follow_disks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

// In periods. Positions are noted when a disk may have moved by look_share; the rest of the quarter period that
// displacement.hpp allows is left for the step until the next check. The largest speed is computed anew each time the
// fastest disk has moved by check_share.
constexpr double look_share = 0.125, longest_share = 0.25, check_share = 1.0 / 64.0;
// With fewer disks the largest speed is computed every time.
constexpr std::size_t few_disks = 4096;
// Positions are noted at most so often within one step; a speed that would need more is not a sensible one.
constexpr double most_looks = 100'000.0;

// The shortest period of the axes along which crossings are counted: in a sheared box only y.
double shortest_period(const Domain& box) {
  if (box.shear.acts()) return box.height;
  return std::min(box.periodic_x() ? box.width : HUGE_VAL, box.periodic_y() ? box.height : HUGE_VAL);
}

// May disks get speeds that are not bounded by the present ones? Brownian motion, thermostats and thermal sides draw
// them, sources bring in new disks, and moving walls push.
bool gives_speed(const Scene& scene) {
  return scene.physics.diffusion > 0.0 || scene.physics.thermostat.acts() || !scene.sources.empty() ||
         scene.box.has_thermal_side() || scene.box.has_moving_wall();
}

}  // namespace

bool follow_disks(DisplacementTally& tally, const Engine& engine, const Scene& scene, double t) {
  const double period = shortest_period(scene.box);
  if (!tally.begun || period == HUGE_VAL) return false;
  Disks between;
  const auto now = engine.pieces_at(engine.progress().time, between);
  const double g = scene.physics.gravity.size;
  // A bound on the displacement of a disk in a time, given its largest speed.
  const auto reach = [g](double speed, double time) { return (speed + g * time) * time; };
  double speed = tally.fastest;
  const double checked = tally.checked_at;
  const bool ask =
      gives_speed(scene) || now->size() < few_disks || !(reach(speed, t - tally.checked_at) < check_share * period);
  if (ask) {
    // Within a window of exact a disk may have been fast for a while, for example between a hot wall and a cold one.
    tally.fastest = std::max(fastest_speed(*now), engine.fastest_within());
    tally.checked_at = t;
    speed = std::max(speed, tally.fastest);
  }
  const double span = t - tally.looked_at;
  const double travel = reach(speed, span);
  if (!(travel > look_share * period)) return false;
  // Up to the last check no disk had moved by more than look_share since positions were noted. If none has moved by
  // more than that since the check, their sum is within the quarter, and noting positions at t is enough.
  if (!(travel > longest_share * period) || !(reach(speed, t - checked) > look_share * period)) return true;
  const double looks = std::ceil(travel / (look_share * period));
  const double begin = tally.looked_at;
  for (double k = 1.0; k < looks; ++k) {
    const double wanted = begin + span * (k / looks);
    // Positions may have been noted before this step began; its start then comes first.
    if (wanted <= tally.looked_at) continue;
    const auto there = looks > most_looks ? nullptr : engine.pieces_at(wanted, between);
    if (!there || !(there->time() < t)) {
      ++tally.doubtful;
      break;
    }
    look_at(tally, *there, scene.box);
  }
  return true;
}

std::string doubt_text(const DisplacementTally& tally, const Scene& scene, std::string_view what,
                       std::string_view wrong, std::string_view every) {
  const bool looks_within = scene.run.method == Method::exact && !(scene.physics.diffusion > 0.0);
  return fmt::format(
      "{}: at t = {:g} disks moved too far within a step to count how often they cross periodic sides; {} may be wrong "
      "from then on; use a smaller {}",
      what, tally.looked_at, wrong, looks_within ? every : "dt");
}

}  // namespace carom
