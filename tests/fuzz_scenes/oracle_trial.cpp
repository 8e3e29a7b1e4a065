// How long runs can be compared: beside the oracle two more run whose disks are slightly displaced. Runs can be
// compared as long as these stay together, and the distance between them bounds the effect of rounding. There are two,
// since one displacement may by chance be along a direction that hardly grows: a fast vibrating side makes others a
// thousand times as large.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/load/scene_file.hpp"
#include "core/load/wall_warnings.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "tests/fuzz_scenes/dice.hpp"
#include "tests/fuzz_scenes/trial.hpp"
#include "tests/support/event_oracle.hpp"

namespace carom::fuzz {

namespace {

// All lengths are in units of the smallest radius, and velocities in units of the largest speed.
constexpr double displaced = 1e-10;  // displacement of the other oracles' disks, at the start and after each comparison
constexpr double horizon = 1e-4;     // beyond this distance runs cannot be compared
constexpr double rounding = 1e-7;    // a difference that is always allowed
constexpr double unit = 3e-14;       // rounding, relative to the ways of disks and the box's length
constexpr double vanishing = 1e-9;   // time between two events, or of a window, relative to t_end
constexpr double no_gap = 1e-14;     // a gap opened by a rebound, relative to the box's length
constexpr int looks = 24;
constexpr std::size_t most_events = 4000;

struct Scales {
  double radius = 0.0, speed = 0.0;
};

double period(double d, double length, bool periodic) {
  return periodic ? d - std::round(d / length) * length : d;
}

// The largest difference of two runs that should be equal, in positions and velocities.
template <class A, class B>
double distance(const A& a, const B& b, std::size_t disks, const Domain& box, const Scales& scales) {
  double largest = 0.0;
  for (std::size_t i = 0; i < disks; ++i) {
    const oracle::Ball p = a(i);
    const oracle::Ball q = b(i);
    const double dx = period(static_cast<double>(p.x - q.x), box.width, box.periodic_x());
    const double dy = period(static_cast<double>(p.y - q.y), box.height, box.periodic_y());
    const auto du = static_cast<double>(p.vx - q.vx);
    const auto dv = static_cast<double>(p.vy - q.vy);
    const double far = std::max({std::abs(dx), std::abs(dy)}) / scales.radius;
    largest = std::max({largest, far, std::max(std::abs(du), std::abs(dv)) / scales.speed});
  }
  return largest;
}

double fastest(const oracle::System& system, double speed) {
  for (const oracle::Ball& b : system.balls) {
    speed = std::max(speed, static_cast<double>(std::sqrt(b.vx * b.vx + b.vy * b.vy)));
  }
  return speed;
}

// Disks are displaced repeatedly, like by rounding: collisions without rebound put disks on one line, which removes a
// displacement.
void displace(oracle::System& system, double radius, int look, std::uint32_t which) {
  Dice dice(1, static_cast<std::uint32_t>(look), which);
  for (oracle::Ball& b : system.balls) {
    b.x += displaced * radius * dice.in(-1.0, 1.0);
    b.y += displaced * radius * dice.in(-1.0, 1.0);
  }
}

// Compares the engine with the oracles again and again.
class Comparison {
 public:
  Comparison(const Scene& scene, const State& start, Trial& trial)
      : scene_(scene),
        trial_(trial),
        disks_(start.disks.size()),
        first_(oracle::make_system(scene, start)),
        scales_{smallest_radius(start.disks), 0.0},
        others_{first_, first_},
        engine_(make_parallel_engine(scene, start, {1 + static_cast<int>(disks_ % 3), disks_ % 2 == 0 ? 1U : 1024U})),
        elastic_(!disks_dissipate(scene) && !scene.box.walls_dissipate() && !inner_walls_dissipate(scene)) {}

  // After chaos has made the runs differ: compares each window, starting from the state at the end of the one before.
  void run_windows() {
    constexpr std::size_t most_windows = 300;
    std::size_t compared = 0;
    std::size_t window = 0;
    std::size_t events = 0;
    for (; window < most_windows && events < most_events && trial_.faults.empty() && ended_.empty(); ++window) {
      const State before = engine_->state();
      if (!(before.time < scene_.run.t_end)) break;
      advance_engine(std::nextafter(before.time, HUGE_VAL));
      begin_at(before);
      displace_others(0);
      // On the way to a collapse windows are only a few roundings of time long, and then an event may fall on the time
      // of a comparison.
      const bool is_long = engine_->state().time - before.time > vanishing * scene_.run.t_end;
      if (ended_.empty() && is_long && follow_window(before.time)) ++compared;
      events +=
          first_.collisions + first_.wall_collisions - before.counters.collisions - before.counters.wall_collisions;
    }
    trial_.account += fmt::format(", then {} events, {} of {} windows", events, compared, window);
  }

  void run() {
    if (!elastic_) first_.no_gap = no_gap * std::max(scene_.box.width, scene_.box.height);
    displace_others(0);
    int look = 1;  // at the start itself a contact may or may not have happened
    for (; look <= looks && trial_.faults.empty(); ++look) {
      const double t = look < looks ? scene_.run.t_end * look / looks : scene_.run.t_end;
      if (!advance_oracles(t)) break;
      advance_engine(t);
      if (!ended_.empty() && ended_at_ < t && decided()) {
        trial_.faults.push_back(fmt::format("ended by [{}] where the oracle goes on to t = {}", ended_, t));
      }
      if (ended_.empty()) hold_against(t);
      displace_others(look);
    }
    trial_.account = fmt::format("{} disks, {} + {} events, {} of {} looks", disks_, first_.collisions,
                                 first_.wall_collisions, look - 1, looks);
  }

 private:
  // Compares up to the window's end, or as far as chaos allows. Returns whether it came to the end.
  bool follow_window(double begin) {
    constexpr int parts = 8;
    const double end = engine_->state().time;
    for (int part = 1; part <= parts; ++part) {
      const double t = part < parts ? begin + (end - begin) * part / parts : end;
      if (!advance_oracles(t)) return false;
      hold_against(t);
    }
    return true;
  }

  void begin_at(const State& state) {
    first_ = oracle::make_system(scene_, state);
    first_.time = state.time;
    first_.collisions = state.counters.collisions;
    first_.wall_collisions = state.counters.wall_collisions;
    if (!elastic_) first_.no_gap = no_gap * std::max(scene_.box.width, scene_.box.height);
    others_ = {first_, first_};
  }

  void displace_others(int look) {
    for (std::uint32_t k = 0; k < others_.size(); ++k) displace(others_[k], scales_.radius, look, k);
  }

  // Is the outcome independent of rounding? If rebounds die away, rounding decides their number, and whether they are a
  // collapse.
  bool decided() const {
    const bool bounces =
        scene_.physics.restitution > 0.0 && *std::ranges::min_element(scene_.box.restitutions) > 0.0 &&
        std::ranges::none_of(scene_.walls, [](const InnerWall& wall) { return wall.restitution == 0.0; }) &&
        std::ranges::none_of(scene_.physics.law.pairs,
                             [](const GroupPair& pair) { return pair.restitution.least == 0.0; });
    return elastic_ || (bounces && first_.undecided == 0.0L &&
                        first_.shortest > vanishing * static_cast<oracle::Real>(scene_.run.t_end));
  }

  // Returns false if what follows cannot be compared: because of chaos, or of so many events in a short time that they
  // may be a collapse.
  bool advance_oracles(double t) {
    if (!oracle::run(first_, t, most_events)) return false;
    scales_.speed = std::max(fastest(first_, scales_.speed), 1e-300);
    apart_ = 0.0;
    for (oracle::System& other : others_) {
      if (!oracle::run(other, t, most_events)) return false;
      const double apart = distance([&](std::size_t i) { return first_.balls[i]; },
                                    [&](std::size_t i) { return other.balls[i]; }, disks_, scene_.box, scales_);
      apart_ = std::max(apart_, apart);
      if (first_.collisions != other.collisions || first_.wall_collisions != other.wall_collisions) return false;
    }
    // Disks whose rebounds rounding decides have the speed of the first of them, or not.
    const auto undecided = static_cast<double>(first_.undecided);
    apart_ += undecided * std::max(1.0 / scales_.speed, t / scales_.radius);
    return apart_ < horizon;
  }

  // A window may reach beyond t: if it fails, its time is in the error message.
  void advance_engine(double t) {
    try {
      while (ended_.empty() && engine_->state().time < t) engine_->step();
    } catch (const PhysicsError& error) {
      ended_ = error.what();
      const std::size_t at = ended_.find("t = ");
      ended_at_ = at == std::string::npos ? engine_->state().time : std::strtod(ended_.c_str() + at + 4, nullptr);
    }
  }

  void hold_against(double t) {
    Disks now;
    const double at = engine_->disks_at(t, now);
    const std::vector<std::size_t> order = by_id(now);
    const auto ball = [&](std::size_t i) {
      const std::size_t k = order[i];
      return oracle::Ball{now.x[k], now.y[k], now.vx[k], now.vy[k], 0.0L, 0.0L};
    };
    const double off = at == t && now.size() == disks_
                           ? distance(
                                 ball, [&](std::size_t i) { return first_.balls[i]; }, disks_, scene_.box, scales_)
                           : HUGE_VAL;
    const double way = std::max(scene_.box.width, scene_.box.height) + scales_.speed * t;
    const double noise = unit * way / scales_.radius;
    const double allowed = rounding + noise + apart_ * (4.0 + noise / displaced);
    const std::string events = fmt::format("{} + {}", first_.collisions, first_.wall_collisions);
    if (!(off <= allowed)) {
      trial_.faults.push_back(fmt::format(
          "at t = {} of {} it is {} radii or speeds off, after {} events; an oracle displaced by {} is {} off", at, t,
          off, events, displaced, apart_));
    }
    const Counters& c = engine_->state().counters;
    if (engine_->state().time != t || !decided()) return;
    if (c.collisions == first_.collisions && c.wall_collisions == first_.wall_collisions) return;
    trial_.faults.push_back(
        fmt::format("by t = {} {} + {} events, not {}", t, c.collisions, c.wall_collisions, events));
  }

  const Scene& scene_;
  Trial& trial_;
  std::size_t disks_;
  oracle::System first_;
  Scales scales_;
  std::array<oracle::System, 2> others_;
  std::unique_ptr<Engine> engine_;
  bool elastic_;
  double apart_ = 0.0;
  std::string ended_;      // the reason why the engine stopped; empty if it did not
  double ended_at_ = 0.0;  // the time in that message
};

}  // namespace

Trial try_against_oracle(const std::string& text, const std::string& name) {
  Trial trial;
  try {
    const Scene scene = parse_scene(text, name, "");
    const std::vector<std::string> by_rounding =
        wall_warnings(scene);  // scenes in which rounding decides which wall acts
    if (!by_rounding.empty()) fail_input(name, by_rounding.front());
    Comparison comparison(scene, initial_state(scene), trial);
    comparison.run();
    comparison.run_windows();
  } catch (const InputError& error) {
    trial.refusal = error.what();
  }
  return trial;
}

}  // namespace carom::fuzz
