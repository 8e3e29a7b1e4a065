#include "core/load/method_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/load/method_rates.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/size_law.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_start.hpp"

namespace carom {

namespace {

// A run of more steps than this is refused: it would take days for a hundred disks.
constexpr double most_steps_offered = 1e9;

// The density at which disks of a settling scene meet, when they have come down.
constexpr double settled_fraction = 0.6;

// Some disk is this much faster than the root mean square of one component: sqrt(2 ln N) for N up to 10^6.
constexpr double fastest_share = 5.3;

// Mean of v_x^2 that a law gives disks of mean mass m.
double mean_square_speed(const VelocityLaw& law, double mass) {
  switch (law.kind) {
    case VelocityLaw::Kind::maxwell:
      return law.temperature / mass;
    case VelocityLaw::Kind::uniform:
      return law.limit * law.limit / 3.0;
    case VelocityLaw::Kind::list: {
      double sum = 0.0;
      for (const Vec2& v : law.list) sum += 0.5 * (v.x * v.x + v.y * v.y);
      return law.list.empty() ? 0.0 : sum / static_cast<double>(law.list.size());
    }
    default:
      return 0.0;
  }
}

// Mean of I w^2 of rough disks of this mass and radius; 0 of smooth ones.
double mean_spin_energy(const Scene& scene, const SpinLaw& law, double mass, double radius) {
  if (!scene.physics.surfaces.are_rough()) return 0.0;
  if (law.temperature > 0.0) return law.temperature;
  double sum = 0.0;
  for (const double w : law.list) sum += w * w;
  const double mean = law.list.empty() ? law.value * law.value : sum / static_cast<double>(law.list.size());
  return scene.physics.surfaces.inertia * mass * radius * radius * mean;
}

// Sums over the disks of the scene.
struct Tally {
  double disks = 0.0, radius2 = 0.0, speed2 = 0.0;
  double temperature = 0.0;   // of what collisions share out: sum of m v_x^2, and of spins a third of I w^2
  double inverse_mass = 0.0;  // sum of 1 / m
  double smallest = std::numeric_limits<double>::infinity();  // radius
  double lightest = std::numeric_limits<double>::infinity();  // mass

  void add(double count, double sum_radius2, double smallest_radius, double mass, double mean_speed2,
           double spin_energy) {
    if (!(count > 0.0)) return;
    temperature += count * (mass * mean_speed2 + spin_energy / 3.0);
    inverse_mass += count / mass;
    lightest = std::min(lightest, mass);
    disks += count;
    radius2 += sum_radius2;
    speed2 += count * mean_speed2;
    smallest = std::min(smallest, smallest_radius);
  }
};

// The least and the largest mass stand for all.
double middle(double low, double high) {
  return 0.5 * (low + high);
}

Tally tally_of(const Scene& scene) {
  Tally tally;
  DiskId first_id = 0;
  for (const DiskGroup& group : scene.groups) {
    if (group.fixed) {
      first_id += static_cast<DiskId>(group.count);
      continue;
    }
    const SizeSummary sizes = summarise_sizes(group, scene.seed, first_id);
    const double mass = middle(sizes.smallest.mass, sizes.largest.mass);
    const double drift2 = 0.5 * (group.drift.x * group.drift.x + group.drift.y * group.drift.y);
    const double speed2 = group.count > 0 ? mean_square_speed(group.velocities, mass) + drift2 : 0.0;
    const double spin_energy = mean_spin_energy(scene, group.spins, mass, sizes.largest.radius);
    tally.add(static_cast<double>(group.count), sizes.radius_squared, sizes.smallest.radius, mass, speed2, spin_energy);
    first_id += static_cast<DiskId>(group.count);
  }
  for (const Source& source : scene.sources) {
    double count = source.rate * scene.run.t_end;
    if (source.limit) count = std::min(count, static_cast<double>(*source.limit));
    const DiskSize size =
        draw_size(source.radius, source.mass, scene.seed, Stream::source_radius, Stream::source_mass, 0, 0);
    tally.add(count, count * size.radius * size.radius, size.radius, size.mass,
              mean_square_speed(source.velocities, size.mass),
              mean_spin_energy(scene, source.spins, size.mass, size.radius));
  }
  return tally;
}

// The gas comes to have the temperature of its thermostat or of its sides, or one between them; 0 where none is
// thermal.
double hottest_bath(const Scene& scene) {
  const double hottest = *std::max_element(scene.box.temperatures.begin(), scene.box.temperatures.end());
  return std::max(hottest, scene.physics.thermostat.temperature);
}

// The speed of the fastest wall, a side or an inner one, and the largest angular frequency of those that vibrate.
struct WallDrive {
  bool moves = false;
  double speed = 0.0, vibration = 0.0;  // length / time, 1 / time

  void see(const SideMotion& pace, double fastest) {
    moves |= pace.moves();
    speed = std::max(speed, fastest);
    if (pace.vibrates()) vibration = std::max(vibration, pace.angular_frequency());
  }
};

WallDrive wall_drive(const Scene& scene) {
  WallDrive drive;
  for (const SideMotion& motion : scene.box.motions) drive.see(motion, motion.largest_speed());
  for (const InnerWall& wall : scene.walls) drive.see(wall.motion.pace, wall.motion.largest_speed());
  return drive;
}

// Compressibility of hard disks, good to 0.1 % up to packing fraction 0.65 (virial series resummed; docs/methods.md).
double compressibility(double eta) {
  const double free = 1.0 - eta;
  return (1.0 + eta * eta / 8.0) / (free * free) - eta * eta * eta * eta / (64.0 * free * free * free * free);
}

// Of two disks; slow_too: also by laws that tend to 1 for slow ones.
double least_restitution(const Scene& scene, bool slow_too) {
  const RestitutionLaw& law = scene.physics.law;
  double e = slow_too || law.viscosity == 0.0 ? scene.physics.restitution : 1.0;
  for (const GroupPair& pair : law.pairs) {
    if (slow_too || pair.restitution.viscosity == 0.0) e = std::min(e, pair.restitution.least);
  }
  return e;
}

// Does gravity press disks against something in the box that takes energy from them? e: of two disks.
bool rests_on_obstacles(const Scene& scene, double e) {
  const Gravity& g = scene.physics.gravity;
  for (const InnerWall& wall : scene.walls) {
    if (wall.sink || wall.restitution >= 1.0) continue;
    for (std::size_t k = 1; k < wall.points.size(); ++k) {
      const Vec2 along{wall.points[k].x - wall.points[k - 1].x, wall.points[k].y - wall.points[k - 1].y};
      if (along.x * g.down - along.y * g.left != 0.0) return true;
    }
  }
  const auto is_peg = [](const DiskGroup& group) { return group.fixed && group.count > 0; };
  return e < 1.0 && std::any_of(scene.groups.begin(), scene.groups.end(), is_peg);
}

// Collapse in two dimensions is seen for e <= 0.6 (McNamara and Young 1996); under gravity any ball on a floor, an
// inner wall or between fixed disks that dissipate does it, and so does a pile of more disks than a column that
// collapses has, ln(4 / (1 - e)) / (1 - e). A restitution that tends to 1 for slow disks keeps a gas from it (Goldman
// et al. 1998), but not a pile, whose bounces become shorter and shorter all the same.
bool may_collapse(const Scene& scene, double disks, bool settles) {
  const double e = least_restitution(scene, settles);
  constexpr double two_dimensions = 0.6;
  if (!settles) return e <= two_dimensions && disks > 2.0;
  for (const Side side : all_sides) {
    const bool presses = outward_acceleration(side, scene.physics.gravity) > 0.0;
    if (presses && scene.box.side(side) == SideKind::wall && scene.box.restitution(side) < 1.0) return true;
  }
  if (rests_on_obstacles(scene, e)) return true;
  return e < 1.0 && disks > std::log(4.0 / (1.0 - e)) / (1.0 - e);
}

// To two digits, whatever the locale of the host program, which strtod would go by.
double two_digits(double number) {
  const std::string text = fmt::format("{:.1e}", number);
  double rounded = number;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return rounded;
}

// Rounded down to two digits: a step needs no more.
double tidy(double dt) {
  const double digits = two_digits(dt);
  return digits > dt ? two_digits(0.95 * digits) : digits;
}

// dt with linear dt + square dt^2 = accuracy; infinite where neither term exists.
double step_for(double accuracy, double linear, double square) {
  return 2.0 * accuracy / (linear + std::sqrt(linear * linear + 4.0 * square * accuracy));
}

// Terms of pairwise's error law.
struct ErrorLaw {
  double linear = 0.0;  // 1 / time
  double square = 0.0;  // 1 / time^2
  double at(double dt) const { return (linear + square * dt) * dt; }
};

ErrorLaw pairwise_law(const SceneScales& s) {
  const double gamma = s.collision_rate;
  const double grazing = s.diameter > 0.0 ? 0.5 * s.speed / s.diameter : 0.0;
  return {(rates::second_collision + rates::stopped_in_crowd * s.stopping) * gamma,
          rates::crowding * gamma * gamma + grazing * grazing + s.vibration * s.vibration};
}

double exact_collision_seconds(const SceneScales& s) {
  return rates::exact_collision + rates::exact_flight / std::max(s.packing_fraction, 0.01);
}

// The longest step in which no disk moves further than it safely may.
double safe_step(const SceneScales& s) {
  return s.speed > 0.0 ? safe_travel * s.smallest_radius / (fastest_share * s.speed)
                       : std::numeric_limits<double>::infinity();
}

std::string steps_text(double t_end, double dt) {
  return fmt::format("dt = {:.1e} would make {:.1e} steps, more than {:.0e}", dt, t_end / dt, most_steps_offered);
}

// For which share of the run disks lie in a pile: a disk that falls through half the box comes to rest after
// (1 + e) / (1 - e) times its fall, as its bounces become shorter by e each.
double share_in_pile(const Scene& scene, const SceneScales& s) {
  if (!s.settles) return 0.0;
  double e = least_restitution(scene, true);
  for (const Side side : all_sides) {
    if (scene.box.side(side) == SideKind::wall) e = std::min(e, scene.box.restitution(side));
  }
  const Gravity& g = scene.physics.gravity;
  const double fall = std::sqrt(std::abs(g.down) * scene.box.height + std::abs(g.left) * scene.box.width) / g.size;
  const double rest = fall * (1.0 + e) / std::max(1.0 - e, 1e-6);
  return scene.run.t_end / (scene.run.t_end + rest);
}

MethodOffer offer_pairwise(const Scene& scene, const SceneScales& s, double accuracy) {
  MethodOffer offer;
  offer.method = Method::pairwise;
  const ErrorLaw law = pairwise_law(s);
  const double wanted = step_for(accuracy, law.linear, law.square);
  const double kicks = scene.physics.thermostat.acts() ? scene.physics.thermostat.dt : HUGE_VAL;
  const double safe = std::min(safe_step(s), kicks);
  offer.dt = tidy(std::min({wanted, safe, scene.run.t_end > 0.0 ? scene.run.t_end : 1.0}));
  offer.error = law.at(offer.dt);
  const double steps = std::max(1.0, scene.run.t_end / offer.dt);
  const double collisions = 0.5 * s.disks * s.collision_rate * scene.run.t_end;
  const double step = rates::pairwise_step + rates::pile_step * share_in_pile(scene, s);
  offer.seconds = step * s.disks * steps + rates::pairwise_collision * collisions;
  offer.possible = steps <= most_steps_offered;
  offer.why = !offer.possible ? steps_text(scene.run.t_end, offer.dt)
              : safe < wanted
                  ? (safe == kicks ? std::string("dt is the time between two kicks of the thermostat")
                                   : std::string("dt is the longest in which no disk moves half its radius"))
                  : fmt::format("{:.2g} collisions of a disk in a step", s.collision_rate * offer.dt);
  return offer;
}

MethodOffer offer_exact(const Scene& scene, const SceneScales& s, double accuracy) {
  MethodOffer offer;
  offer.method = Method::exact;
  double collisions = 0.5 * s.disks * s.collision_rate * scene.run.t_end;
  offer.possible = true;
  offer.why = "pays for each collision, not for time";
  const std::optional<double> tc = scene.physics.collapse_contact_time;
  if (s.may_collapse && !tc) {
    offer.possible = false;
    offer.why = s.settles ? "disks come to rest, with infinitely many collisions (physics.collapse would allow it)"
                          : "inelastic collapse is to be expected (physics.collapse would allow it)";
  } else if (tc && disks_dissipate(scene)) {
    offer.error = 2.0 * s.collision_rate * *tc;
    if (s.settles) collisions += 0.5 * s.disks * rates::pile_collisions * scene.run.t_end / *tc;
    offer.possible = offer.error <= accuracy;
    offer.why = offer.possible
                    ? "its error is that of the collapse model, 2 Gamma t_c"
                    : fmt::format("contact_time = {:g} alone is wrong by {:.1e} (2 Gamma t_c)", *tc, offer.error);
  }
  offer.seconds = collisions * exact_collision_seconds(s);
  return offer;
}

// Where exact has no error at all, what walls that move make of the disks' speeds is no matter; a step would have to be
// short against speeds that the scene does not tell.
void leave_driven_to_exact(const SceneScales& s, MethodOffer& pairwise, const MethodOffer& exact) {
  if (!s.driven || s.may_collapse || !exact.possible || exact.error > 0.0 || !pairwise.possible) return;
  pairwise.possible = false;
  pairwise.why = "how fast walls that move make the disks, and so which step is short, is not known before";
}

// Brownian motion: both methods draw a displacement each dt, and both are wrong by it.
void offer_brownian(const Scene& scene, const SceneScales& s, double accuracy, MethodChoice& choice) {
  // Collisions of a disk in an interval: rate dt, with a speed of sqrt(2 D / dt), so x sqrt(dt).
  const double x = 4.0 * (compressibility(s.packing_fraction) - 1.0) *
                   std::sqrt(2.0 * scene.physics.diffusion / std::numbers::pi) / s.diameter;
  const double travel = std::sqrt(2.0 * scene.physics.diffusion);
  const double safe_root = safe_travel * s.smallest_radius / (fastest_share * travel);
  for (const Method method : {Method::pairwise, Method::exact}) {
    MethodOffer offer;
    offer.method = method;
    const bool stepping = method == Method::pairwise;
    const double linear = x * (rates::brownian_interval + (stepping ? rates::second_collision : 0.0));
    const double square = stepping ? rates::crowding * x * x : 0.0;
    const double root = std::min(step_for(accuracy, linear, square), safe_root);
    offer.dt = tidy(std::min(root * root, scene.run.t_end > 0.0 ? scene.run.t_end : 1.0));
    offer.error = linear * std::sqrt(offer.dt) + square * offer.dt;
    const double intervals = std::max(1.0, scene.run.t_end / offer.dt);
    const double collisions = 0.5 * s.disks * x * std::sqrt(offer.dt) * intervals;
    const double interval = rates::brownian_step + (stepping ? rates::pairwise_step : rates::exact_interval);
    offer.seconds = intervals * s.disks * interval +
                    collisions * (stepping ? rates::pairwise_collision : exact_collision_seconds(s));
    offer.possible = intervals <= most_steps_offered;
    offer.why = offer.possible ? fmt::format("{:.2g} collisions of a disk between two draws", x * std::sqrt(offer.dt))
                               : steps_text(scene.run.t_end, offer.dt);
    choice.offers.push_back(offer);
  }
}

// The cheapest of the possible ones; the more accurate of two that cost the same.
void pick_best(MethodChoice& choice) {
  for (std::size_t k = 0; k < choice.offers.size(); ++k) {
    const MethodOffer& offer = choice.offers[k];
    if (!offer.possible) continue;
    const bool better =
        choice.best < 0 || offer.seconds <= choice.offers[static_cast<std::size_t>(choice.best)].seconds;
    if (better) choice.best = static_cast<int>(k);
  }
}

std::string reason_of(const MethodChoice& choice) {
  if (choice.best < 0) {
    return fmt::format("out of reach: pairwise: {}; exact: {}", choice.offers[0].why, choice.offers[1].why);
  }
  const MethodOffer& best = choice.offers[static_cast<std::size_t>(choice.best)];
  const MethodOffer& other = choice.offers[choice.best == 0 ? 1 : 0];
  const std::string_view name = name_of(other.method);
  const std::string against = other.possible ? fmt::format("{} would cost {:.2g} times as much", name,
                                                           other.seconds / std::max(best.seconds, 1e-12))
                                             : fmt::format("not {}: {}", name, other.why);
  return fmt::format("{}; {}", best.why, against);
}

}  // namespace

SceneScales scales_of(const Scene& scene) {
  const Tally tally = tally_of(scene);
  SceneScales s;
  s.disks = tally.disks;
  if (!(s.disks > 0.0)) return s;
  s.settles = settles(scene);
  s.smallest_radius = tally.smallest;
  s.diameter = 2.0 * std::sqrt(tally.radius2 / tally.disks);
  s.packing_fraction = std::min(0.9, std::numbers::pi * tally.radius2 / (scene.box.width * scene.box.height));
  // Collisions share energy out, so that light disks become faster than heavy ones.
  const double shared2 = tally.temperature / tally.disks * tally.inverse_mass / tally.disks;
  const double thermal2 = std::max({tally.speed2 / tally.disks, shared2, hottest_bath(scene) / tally.lightest});
  // A wall that moves sends a disk at rest off at twice its speed.
  const WallDrive drive = wall_drive(scene);
  s.driven = drive.moves;
  s.vibration = drive.vibration;
  const double speed2 = thermal2 + 4.0 * drive.speed * drive.speed;
  // A disk falls through half the box in the mean: v^2 = g H, of which half for each component.
  const Gravity& g = scene.physics.gravity;
  s.speed = std::sqrt(speed2 + 0.5 * (std::abs(g.down) * scene.box.height + std::abs(g.left) * scene.box.width));
  const double eta = s.settles ? std::max(settled_fraction, s.packing_fraction) : s.packing_fraction;
  s.collision_rate =
      s.disks > 1.0 ? 4.0 * (compressibility(eta) - 1.0) * s.speed / (std::sqrt(std::numbers::pi) * s.diameter) : 0.0;
  s.may_collapse = may_collapse(scene, s.disks, s.settles);
  const double e = least_restitution(scene, true);
  s.stopping = s.settles && e < 1.0 ? 1.0 / (1.0 - e * e) : 0.0;
  return s;
}

MethodChoice choose_method(const Scene& scene, double accuracy) {
  MethodChoice choice;
  choice.scales = scales_of(scene);
  if (scene.physics.accumulate) {
    choice.why = "with physics.accumulate the step is part of the physics; name a method and its dt";
    return choice;
  }
  if (scene.physics.diffusion > 0.0 && choice.scales.disks > 0.0) {
    offer_brownian(scene, choice.scales, accuracy, choice);
  } else {
    choice.offers.push_back(offer_pairwise(scene, choice.scales, accuracy));
    choice.offers.push_back(offer_exact(scene, choice.scales, accuracy));
    leave_driven_to_exact(choice.scales, choice.offers[0], choice.offers[1]);
  }
  pick_best(choice);
  choice.why = reason_of(choice);
  return choice;
}

std::string choice_text(const Scene& scene) {
  const std::string dt = scene.run.dt > 0.0 ? fmt::format(", dt = {:g}", scene.run.dt) : "";
  return fmt::format("method auto, accuracy {:g}: {}{} ({})", scene.run.accuracy, name_of(scene.run.method), dt,
                     scene.run.choice);
}

}  // namespace carom
