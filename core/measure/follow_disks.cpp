#include "core/measure/follow_disks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

// In periods. A look is due after an eighth, which leaves the other half of the quarter that displacement.hpp allows
// for what happens between two samples; the speed is asked for as often as the fastest disk comes this far.
constexpr double look_share = 0.125, longest_share = 0.25, check_share = 1.0 / 64.0;
// So few disks are asked every time.
constexpr std::size_t few_disks = 4096;
// Looks within one step beyond which a speed is no speed any more.
constexpr double most_looks = 100'000.0;

// Of the axes along which rounds count: in a sheared box only y.
double shortest_period(const Domain& box) {
  if (box.shear.acts()) return box.height;
  return std::min(box.periodic_x() ? box.width : HUGE_VAL, box.periodic_y() ? box.height : HUGE_VAL);
}

// May disks get speeds that have nothing to do with those that there are? Brownian motion, thermostats and thermal
// sides draw them anew, sources bring in new ones, and what moves by itself hits disks.
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
  // No disk can come further in a time, if none is faster at both its ends, nor on a path in between.
  const auto reach = [g](double speed, double time) { return (speed + g * time) * time; };
  double speed = tally.fastest;
  const double checked = tally.checked_at;
  const bool ask =
      gives_speed(scene) || now->size() < few_disks || !(reach(speed, t - tally.checked_at) < check_share * period);
  if (ask) {
    // Within a window of exact a hot wall may have set a disk going that a cold one has stopped since.
    tally.fastest = std::max(fastest_speed(*now), engine.fastest_within());
    tally.checked_at = t;
    speed = std::max(speed, tally.fastest);
  }
  const double span = t - tally.looked_at;
  const double travel = reach(speed, span);
  if (!(travel > look_share * period)) return false;
  // Until speeds were last asked for no disk had come so far that a look was due.
  if (!(travel > longest_share * period) || !(reach(speed, t - checked) > look_share * period)) return true;
  const double looks = std::ceil(travel / (look_share * period));
  const double begin = tally.looked_at;
  for (double k = 1.0; k < looks; ++k) {
    const double wanted = begin + span * (k / looks);
    // The last look may lie before the step: at its end no look was due yet, so the start of this one comes next.
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
      "{}: at t = {:g} disks moved too far within a step to count how often they went round the periodic box; {} may "
      "be wrong from there on; use a smaller {}",
      what, tally.looked_at, wrong, looks_within ? every : "dt");
}

}  // namespace carom
