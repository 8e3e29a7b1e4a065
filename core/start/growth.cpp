#include "core/start/growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/base/random.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/reference/reference_exact.hpp"
#include "core/scene/disk_group.hpp"
#include "core/start/placement_grid.hpp"

namespace carom {

namespace {

// Random addition reaches this packing fraction in any box, even a narrow one, and quickly.
constexpr double start_packing = 0.25;

// A flight lasts until a typical disk has gone this far, in mean distances of the disks: some collisions of a fluid at
// packing fraction 0.7. So growth has a steady pace, as in the work of Lubachevsky and Stillinger. Measured as the best
// value for mixtures: with half of it bidisperse disks jam below 0.84, with twice of it they get no denser for three
// times the collisions.
constexpr double flight_travel = 0.02;
// Close to jamming the number of collisions in that time grows without bound; a flight ends after this number a disk.
constexpr double most_collisions = 16.0;

// Growth has stalled if this number of steps does not reduce the lacking area by a fiftieth.
constexpr Count stall_steps = 100;
constexpr double stall_share = 0.98;

State fly_plainly(const Scene& scene, State state, const std::function<void()>& look) {
  const auto engine = make_reference_exact(scene, std::move(state));
  while (engine->state().time < scene.run.t_end) {
    engine->step();
    look();
  }
  return engine->state();
}

// The scene of the flights: the box, without anything that they do not need.
Scene flight_scene(const Scene& scene) {
  Scene flight;
  flight.file = scene.file;
  flight.box = scene.box;
  flight.box.restitutions.fill(1.0);
  flight.box.temperatures.fill(0.0);
  flight.box.motions = {};
  flight.box.inner_walls_move = false;
  for (SideKind& side : flight.box.sides) side = side == SideKind::periodic ? side : SideKind::wall;
  flight.run.method = Method::exact;
  return flight;
}

// The obstacles among which disks grow, all of them solid and elastic.
std::vector<Obstacle> hard(std::vector<Obstacle> obstacles) {
  for (Obstacle& o : obstacles) {
    o.restitution = 1.0;
    o.moves = false;
    if (o.kind == ObstacleKind::sink) o.kind = ObstacleKind::wall;
  }
  return obstacles;
}

// The approximate share of the box that fixed disks leave; a tenth if they overlap each other or stick out a lot.
double share_left(const Domain& box, const std::vector<Obstacle>& obstacles) {
  double squares = 0.0;
  for (const Obstacle& o : obstacles) squares += o.radius * o.radius;
  return std::max(0.1, 1.0 - std::numbers::pi * squares / (box.width * box.height));
}

bool group_grows(const DiskGroup& group) {
  return group.positions.kind == PositionLaw::Kind::growth;
}

class Growth {
 public:
  Growth(const Scene& scene, const Disks& disks, const std::vector<Obstacle>& obstacles, const GrowthTools& tools)
      : scene_(scene),
        tools_(tools),
        flight_(flight_scene(scene)),
        box_(scene.box),
        given_(disks),
        target_(disks.size()),
        fixed_(disks.size(), 0) {
    state_.obstacles = hard(obstacles);
    obstacles_ = place_obstacles(state_.obstacles, box_);
    for (const Obstacle& o : obstacles) {
      if (!o.is_segment()) fixed_[o.id] = 1;
    }
    for (std::size_t i = 0; i < target_.size(); ++i) target_[i] = disks.radius_of(i);
    ExactSum squares;
    for (std::size_t i = 0; i < target_.size(); ++i) {
      if (fixed_[i] == 0) squares.add(target_[i] * target_[i]);
    }
    disks_ = target_.size() - static_cast<std::size_t>(std::count(fixed_.begin(), fixed_.end(), 1));
    progress_.final_packing_fraction = packing(squares);
    longest_flight_ = flight_travel * scene.growth.slowness;
    most_events_ = std::max(1.0, 0.5 * most_collisions * scene.growth.slowness * static_cast<double>(disks_));
  }

  // A disk that fills the room between two walls, except for rounding, cannot move there: growth approaches that size,
  // but never reaches it.
  void check_play() const {
    constexpr double rounding = 1e-12;
    const struct {
      bool periodic;
      double length;
      const char* word;
    } axes[] = {{box_.periodic_x(), box_.width, "wide"}, {box_.periodic_y(), box_.height, "high"}};
    for (std::size_t i = 0; i < target_.size(); ++i) {
      if (fixed_[i] != 0) continue;
      for (const auto& [periodic, length, word] : axes) {
        if (periodic || 2.0 * target_[i] < (1.0 - rounding) * length) continue;
        fail_input(place_in_group(scene_, group_of(scene_, static_cast<DiskId>(i)), "positions"),
                   fmt::format("\"growth\" never ends if a disk fills the box from wall to wall: disk {} has the "
                               "diameter {:g}, and the box is {:g} {}",
                               i, 2.0 * target_[i], length, word),
                   "expected a larger box, smaller disks, or a lattice, \"square\" or \"hexagonal\"");
      }
    }
  }

  void place_small(const PlaceAtRandom& place) {
    const double start = start_packing * share_left(box_, state_.obstacles);
    const double scale = std::min(1.0, std::sqrt(start / progress_.final_packing_fraction));
    Disks& d = state_.disks;
    const std::size_t n = target_.size();
    d.common_mass = 1.0;
    for (std::size_t i = 0; i < n; ++i) d.radius.push_back(fixed_[i] != 0 ? target_[i] : scale * target_[i]);
    for (std::vector<double>* column : {&d.x, &d.y, &d.vx, &d.vy}) column->resize(n);
    d.id.resize(n);
    std::iota(d.id.begin(), d.id.end(), DiskId{0});
    put_small(place);
    // The speed is in units of the mean distance, so that this is also the unit of time.
    const double speed = std::sqrt(scene_.box.width * scene_.box.height / static_cast<double>(d.size()));
    for (std::size_t i = 0; i < d.size(); ++i) {
      const Vec2 v = normals(scene_.seed, Stream::growth_velocity, d.id[i], 0);
      d.vx[i] = speed * v.x;
      d.vy[i] = speed * v.y;
    }
    state_.next_id = static_cast<DiskId>(n);
  }

  // Runs until all disks have their final radii and none overlap.
  void grow() {
    double length = longest_flight_;
    double lack_then = HUGE_VAL;
    for (Count& step = progress_.steps;; ++step) {
      const GrowthTally tally = tools_.step(state_.disks, box_, target_);
      progress_.packing_fraction = packing(tally.area);
      tell();
      if (tally.lacking == 0 && !tally.overlap) return;
      if (step == scene_.growth.steps) fail("ends", tally);
      if (step % stall_steps == 0) {
        const double lack = tally.lack.value();
        if (tally.lacking > 0 && lack > 0.0 && lack > stall_share * lack_then) fail("stalls", tally);
        lack_then = lack;
      }
      const auto events = static_cast<double>(fly(length, tally));
      const double wanted = length * (most_events_ / std::max(1.0, events));
      length = std::min(longest_flight_, std::clamp(wanted, 0.5 * length, 2.0 * length));
    }
  }

  const Disks& disks() const { return state_.disks; }

 private:
  void tell() const {
    if (tools_.watch) tools_.watch(progress_);
  }

  // Fixed disks have their places, and are removed when the others have found theirs among them.
  void put_small(const PlaceAtRandom& place) {
    Disks& d = state_.disks;
    PlacementGrid grid(box_, d);
    std::vector<std::uint32_t> members;
    for (const DiskId i : d.id) {
      if (fixed_[i] == 0) {
        members.push_back(i);
        continue;
      }
      d.x[i] = given_.x[i];
      d.y[i] = given_.y[i];
      grid.insert(i);
    }
    place(scene_, d, grid, std::move(members));
    if (disks_ < target_.size()) remove_marked(d, fixed_);
  }

  double packing(const ExactSum& squares) const {
    return std::numbers::pi * squares.value() / (scene_.box.width * scene_.box.height);
  }

  // Returns the number of events in the flight. Growth jams if disks are so close together that the flight's time no
  // longer advances.
  Count fly(double length, const GrowthTally& tally) {
    state_.time = 0.0;
    state_.counters = {};
    state_.stall = {};
    flight_.run.t_end = length;
    try {
      state_ = tools_.fly(flight_, std::move(state_), [this] { tell(); });
    } catch (const PhysicsError&) {
      fail("jams", tally);
    }
    const Count events = state_.counters.collisions + state_.counters.wall_collisions;
    progress_.collisions += events;
    return events;
  }

  [[noreturn]] void fail(std::string_view how, const GrowthTally& tally) const {
    const auto group = std::ranges::find_if(scene_.groups, group_grows) - scene_.groups.begin();
    const double each = 2.0 * static_cast<double>(progress_.collisions) / static_cast<double>(disks_);
    fail_input(
        place_in_group(scene_, static_cast<std::size_t>(group), "positions"),
        fmt::format("\"growth\" {} at packing fraction {:.4f} of {:.4f}: after {} steps and {:.0f} collisions of each "
                    "disk, {} of {} disks have not reached their radius",
                    how, progress_.packing_fraction, progress_.final_packing_fraction, progress_.steps, each,
                    tally.lacking, disks_),
        fmt::format("expected fewer disks or a larger box, a wider range of radii, or slower growth, as in "
                    "[growth] slowness = {:g}{}{}",
                    10.0 * scene_.growth.slowness, progress_.steps == scene_.growth.steps ? ", or more steps" : "",
                    obstacles_ == nullptr ? "" : ", or no fixed disks and walls that enclose others"));
  }

  const Scene& scene_;
  const GrowthTools& tools_;
  Scene flight_;
  Domain box_;  // with the obstacles
  std::unique_ptr<const ObstacleCells> obstacles_;
  const Disks& given_;
  std::vector<double> target_;  // by id; for fixed disks the radius that they have
  std::vector<unsigned char> fixed_;
  std::size_t disks_ = 0;  // number of disks that grow
  State state_;
  GrowthProgress progress_;
  double longest_flight_ = 0.0;  // mean distances of the disks, at thermal speed
  double most_events_ = 0.0;
};

}  // namespace

GrowthTools plain_growth() {
  return {fly_plainly, grow_step, {}};
}

bool grows(const Scene& scene) {
  return std::ranges::any_of(scene.groups, group_grows);
}

void place_by_growth(const Scene& scene, Disks& disks, const std::vector<Obstacle>& obstacles,
                     const PlaceAtRandom& place, const GrowthTools& tools) {
  Growth growth(scene, disks, obstacles, tools);
  growth.check_play();
  growth.place_small(place);
  growth.grow();
  const Disks& grown = growth.disks();
  for (std::size_t i = 0; i < grown.size(); ++i) {
    disks.x[grown.id[i]] = grown.x[i];
    disks.y[grown.id[i]] = grown.y[i];
  }
}

}  // namespace carom
