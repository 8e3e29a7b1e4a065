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
#include "core/step/step_clock.hpp"

namespace carom {

namespace {

// Runs of more steps than this are not offered: they would take days for a hundred disks.
constexpr double most_steps_offered = 1e9;

// Rounded to two digits, independently of the locale of a host program, which strtod would use.
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

// Terms of pairwise's error law.
struct ErrorLaw {
  double linear = 0.0;  // 1 / time
  double square = 0.0;  // 1 / time^2
  double at(double dt) const { return (linear + square * dt) * dt; }
};

ErrorLaw pairwise_law(const SceneScales& s) {
  const double gamma = s.collision_rate + s.wall_rate;
  const double grazing = s.diameter > 0.0 ? 0.5 * s.speed / s.diameter : 0.0;
  return {rates::second_collision * gamma + rates::stopped_in_crowd * s.stopping * s.collision_rate,
          rates::crowding * gamma * gamma + grazing * grazing + s.vibration * s.vibration};
}

double exact_collision_seconds(const SceneScales& s) {
  return rates::exact_collision + rates::exact_flight / std::max(s.packing_fraction, 0.01);
}

// The number of collisions, of two disks and of disks with walls or fixed disks, in the whole run.
double collisions_in(double t_end, const SceneScales& s) {
  return s.disks * (0.5 * s.collision_rate + s.wall_rate) * t_end;
}

// Are there inner walls or fixed disks, which cost time in every step?
bool has_obstacles(const Scene& scene) {
  const auto is_peg = [](const DiskGroup& group) { return group.fixed && group.count > 0; };
  return !scene.walls.empty() || std::any_of(scene.groups.begin(), scene.groups.end(), is_peg);
}

// The longest step in which no disk moves further than safe_travel.
double safe_step(const SceneScales& s) {
  return s.fastest > 0.0 ? safe_travel * s.smallest_radius / s.fastest : std::numeric_limits<double>::infinity();
}

std::string steps_text(double t_end, double dt) {
  return fmt::format("dt = {:.1e} would make {:.1e} steps, more than {:.0e}", dt, t_end / dt, most_steps_offered);
}

// The share of the run during which disks lie in a pile: a disk that falls through half the box comes to rest after (1
// + e) / (1 - e) times the time of its fall, since each bounce is shorter by the factor e.
double share_in_pile(const Scene& scene, const SceneScales& s) {
  if (!s.settles) return 0.0;
  double e = s.restitution;
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
  const double wanted = step_within(accuracy, law.linear, law.square);
  const double kicks = scene.physics.thermostat.acts() ? scene.physics.thermostat.dt : HUGE_VAL;
  const double safe = std::min(safe_step(s), kicks);
  offer.dt = tidy(std::min({wanted, safe, scene.run.t_end > 0.0 ? scene.run.t_end : 1.0}));
  offer.error = law.at(offer.dt);
  const double steps = std::max(1.0, scene.run.t_end / offer.dt);
  const double step = rates::pairwise_step + rates::pile_step * share_in_pile(scene, s) +
                      (has_obstacles(scene) ? rates::obstacle_step : 0.0);
  offer.seconds = step * s.disks * steps + rates::pairwise_collision * collisions_in(scene.run.t_end, s);
  offer.possible = steps <= most_steps_offered;
  offer.why =
      !offer.possible ? steps_text(scene.run.t_end, offer.dt)
      : safe < wanted
          ? (safe == kicks ? std::string("dt is the time between two kicks of the thermostat")
                           : std::string("dt is the longest step in which no disk moves more than half its radius"))
          : fmt::format("{:.2g} collisions of each disk per step", (s.collision_rate + s.wall_rate) * offer.dt);
  return offer;
}

MethodOffer offer_exact(const Scene& scene, const SceneScales& s, double accuracy) {
  MethodOffer offer;
  offer.method = Method::exact;
  double collisions = collisions_in(scene.run.t_end, s);
  offer.possible = true;
  offer.why = "its cost depends on the number of collisions, not of steps";
  const std::optional<double> tc = scene.physics.collapse_contact_time;
  if (s.may_collapse && !tc) {
    offer.possible = false;
    offer.why = s.settles ? "disks come to rest after infinitely many collisions (physics.collapse makes it possible)"
                          : "inelastic collapse is expected (physics.collapse makes it possible)";
  } else if (tc && disks_dissipate(scene)) {
    offer.error = 2.0 * s.collision_rate * *tc;
    if (s.settles) collisions += 0.5 * s.disks * rates::pile_collisions * scene.run.t_end / *tc;
    offer.possible = offer.error <= accuracy;
    offer.why = offer.possible ? "its error is that of the collapse model, 2 Gamma t_c"
                               : fmt::format("contact_time = {:g} alone causes an error of {:.1e} (2 Gamma t_c)", *tc,
                                             offer.error);
  }
  offer.seconds = collisions * exact_collision_seconds(s);
  return offer;
}

// In a scene with moving walls the speeds that disks reach cannot be known beforehand, and so neither the step that
// pairwise would need. Exact has no error at any speed.
void leave_driven_to_exact(const SceneScales& s, MethodOffer& pairwise, const MethodOffer& exact) {
  if (!s.driven || s.may_collapse || !exact.possible || exact.error > 0.0 || !pairwise.possible) return;
  pairwise.possible = false;
  pairwise.why = "moving walls give the disks speeds that are not known beforehand, nor is a step that is short enough";
}

// The error of a pairwise step in a sheared box is not known; exact has none.
void leave_shear_to_exact(const Scene& scene, MethodOffer& pairwise) {
  if (!scene.box.shear.acts() || !pairwise.possible) return;
  pairwise.possible = false;
  pairwise.why = "its errors in a shear flow (box.shear_rate) are not known";
}

// Brownian motion: both methods draw a displacement each dt, and both have the error of that interval. Without disks
// any dt will do, but a scene with Brownian motion must have one.
void offer_brownian(const Scene& scene, const SceneScales& s, double accuracy, MethodChoice& choice) {
  constexpr double any = std::numeric_limits<double>::infinity();
  const bool has_disks = s.disks > 0.0;
  // Collisions of a disk in an interval: the rate times dt, at a speed of sqrt(2 D / dt); that is x sqrt(dt).
  const double x = has_disks ? 4.0 * (compressibility(s.packing_fraction) - 1.0) *
                                   std::sqrt(2.0 * scene.physics.diffusion / std::numbers::pi) / s.diameter
                             : 0.0;
  const double travel = std::sqrt(2.0 * scene.physics.diffusion);
  const double safe_root = has_disks ? safe_travel * s.smallest_radius / (fastest_share * travel) : any;
  for (const Method method : {Method::pairwise, Method::exact}) {
    MethodOffer offer;
    offer.method = method;
    const bool stepping = method == Method::pairwise;
    const double linear = x * (rates::brownian_interval + (stepping ? rates::second_collision : 0.0));
    const double square = stepping ? rates::crowding * x * x : 0.0;
    const double root = std::min(step_within(accuracy, linear, square), safe_root);
    offer.dt = tidy(std::min(root * root, scene.run.t_end > 0.0 ? scene.run.t_end : 1.0));
    offer.error = linear * std::sqrt(offer.dt) + square * offer.dt;
    const double intervals = std::max(1.0, scene.run.t_end / offer.dt);
    const double collisions = 0.5 * s.disks * x * std::sqrt(offer.dt) * intervals;
    const double interval = rates::brownian_step + (stepping ? rates::pairwise_step : rates::exact_interval);
    offer.seconds = intervals * s.disks * interval +
                    collisions * (stepping ? rates::pairwise_collision : exact_collision_seconds(s));
    offer.possible = intervals <= most_steps_offered;
    offer.why = offer.possible
                    ? fmt::format("{:.2g} collisions of each disk between two draws", x * std::sqrt(offer.dt))
                    : steps_text(scene.run.t_end, offer.dt);
    choice.offers.push_back(offer);
  }
}

// Chooses the cheapest of the possible methods; of two that cost the same, the more accurate one.
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
    return fmt::format("no method reaches it: pairwise: {}; exact: {}", choice.offers[0].why, choice.offers[1].why);
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

MethodChoice choose_method(const Scene& scene, double accuracy) {
  MethodChoice choice;
  choice.scales = scales_of(scene);
  if (scene.physics.accumulate) {
    choice.why = "with physics.accumulate dt is part of the physics; state a method and its dt";
    return choice;
  }
  if (scene.physics.diffusion > 0.0) {
    offer_brownian(scene, choice.scales, accuracy, choice);
  } else {
    choice.offers.push_back(offer_pairwise(scene, choice.scales, accuracy));
    choice.offers.push_back(offer_exact(scene, choice.scales, accuracy));
    leave_driven_to_exact(choice.scales, choice.offers[0], choice.offers[1]);
    leave_shear_to_exact(scene, choice.offers[0]);
  }
  pick_best(choice);
  choice.why = reason_of(choice);
  const bool given = scene.run.automatic && scene.run.choice.empty() && scene.run.dt > 0.0;  // not chosen before
  if (given && choice.best >= 0) choice.why += fmt::format("; run.dt = {:g} of the scene is not used", scene.run.dt);
  return choice;
}

std::string choice_text(const Scene& scene) {
  const std::string dt = scene.run.dt > 0.0 ? fmt::format(", dt = {:g}", scene.run.dt) : "";
  return fmt::format("method auto, accuracy {:g}: {}{} ({})", scene.run.accuracy, name_of(scene.run.method), dt,
                     scene.run.choice);
}

}  // namespace carom
