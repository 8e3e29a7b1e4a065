#include "core/reference/reference_window.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "core/reference/neighbourhood.hpp"

namespace carom {

namespace {

constexpr Count events_between_polls = 1024;

struct Event {
  double time;
  DiskId id1, id2;       // id2 may be a wall (a side of any kind) or an obstacle
  std::uint32_t i1, i2;  // storage; i2 == i1 for a side or an obstacle
  std::uint32_t version1, version2;
};

class EventLoop {
 public:
  EventLoop(const ExactRules& rules, const State& state, const WindowPlan& plan, const std::function<bool()>& go_on,
            double travel, WindowResult& result)
      : rules_(rules),
        disks_(state.disks),
        plan_(plan),
        go_on_(go_on),
        travel_(travel),
        near_(state.disks, rules.box, travel),
        result_(result),
        version_(disks_.size(), 0),
        travelled_(disks_.size(), 0.0),
        flight_(disks_.size()),
        burst_(disks_.size()) {
    for (std::uint32_t i = 0; i < disks_.size(); ++i) flight_[i] = flight_of(path(i));
  }

  // Returns the longest path length of any disk. If that is more than `travel`, the neighbourhood was too small and the
  // result is invalid.
  double run() {
    for (std::uint32_t i = 0; i < disks_.size(); ++i) predict(i, true);
    double end = plan_.length;
    for (Count taken = 1; !queue_.empty() && !result_.crowded && !collapse_; ++taken) {
      const Event e = queue_.top();
      queue_.pop();
      if (taken % events_between_polls == 0 && go_on_ && !go_on_()) {
        result_.given_up = true;
        return farthest_;
      }
      if (version_[e.i1] != e.version1 || version_[e.i2] != e.version2) continue;
      process(e);
      if (farthest_ > travel_) return farthest_;
      if (result_.crowded || collapse_) end = e.time;
    }
    for (std::uint32_t i = 0; i < disks_.size(); ++i) {
      if (result_.gone[i] == 0) add_travel(i, end);
    }
    if (collapse_ && !result_.crowded && farthest_ <= travel_) fail_collapse(rules_, *collapse_, plan_.start);
    return farthest_;
  }

 private:
  const PathSegment& path(std::uint32_t i) const { return result_.disks[i].path; }

  void predict(std::uint32_t i, bool each_pair_once) {
    for (const Side side : all_sides) {
      const double t = side_time(path(i), side, disks_.radius_of(i), rules_.box, rules_.gravity, plan_.length);
      if (t < never) queue_.push({t, disks_.id[i], wall_partner(side), i, i, version_[i], version_[i]});
    }
    if (rules_.box.obstacles != nullptr) {
      const ObstacleContact first =
          first_obstacle_contact(path(i), disks_.radius_of(i), rules_.box, rules_.gravity, plan_.length);
      if (first.time < never) {
        queue_.push({first.time, disks_.id[i], obstacle_partner(first.obstacle), i, i, version_[i], version_[i]});
      }
    }
    near_.visit(i, [&](std::uint32_t j) {
      if (result_.gone[j] != 0 || (each_pair_once && j < i)) return;
      const double contact_distance = disks_.radius_of(i) + disks_.radius_of(j);
      if (cannot_meet(flight_[i], flight_[j], contact_distance)) return;
      const bool in_order = disks_.id[i] < disks_.id[j];
      const std::uint32_t a = in_order ? i : j;
      const std::uint32_t b = in_order ? j : i;
      const double t = collision_time(path(a), path(b), contact_distance, rules_.box, rules_.gravity, plan_.length);
      if (t < never) queue_.push({t, disks_.id[a], disks_.id[b], a, b, version_[a], version_[b]});
    });
  }

  // The start of a path, and a bound on the distance from it until the window ends; length.
  struct Flight {
    double x, y, reach;
  };
  Flight flight_of(const PathSegment& p) const {
    const double rest = plan_.length - p.start;
    return {p.x, p.y, (std::sqrt(p.vx * p.vx + p.vy * p.vy) + 0.5 * rules_.gravity.size * rest) * rest};
  }

  // Are two paths so far apart that they cannot touch in the window? That is so for most neighbours, and saves
  // predictions; the margin is far above rounding, so no result changes. In a sheared box images move, and all pairs
  // are predicted.
  bool cannot_meet(const Flight& a, const Flight& b, double contact_distance) const {
    const Domain& box = rules_.box;
    if (box.shear.acts()) return false;
    double dx = std::abs(b.x - a.x);
    double dy = std::abs(b.y - a.y);
    if (box.periodic_x()) dx = std::min(dx, std::abs(box.width - dx));
    if (box.periodic_y()) dy = std::min(dy, std::abs(box.height - dy));
    const double reach = (contact_distance + a.reach + b.reach) * (1.0 + 1e-6);
    return dx * dx + dy * dy > reach * reach;
  }

  void process(const Event& e) {
    const bool pair = !is_wall(e.id2);
    add_travel(e.i1, e.time);
    if (pair) add_travel(e.i2, e.time);
    ExactDisk& first = result_.disks[e.i1];
    bool lost_energy = false;
    if (pair) {
      const PairImpact impact = collide_at(rules_, e.time, first, result_.disks[e.i2]);
      result_.tally.add_pair(impact);
      if (impact.happened) result_.collisions.emplace_back(e.id1, e.id2);
      lost_energy = impact.lost_energy;
    } else {
      const WallImpact impact = is_obstacle(e.id2) ? meet_obstacle_at(rules_, e.time, obstacle_of(e.id2), first)
                                                   : meet_side_at(rules_, e.time, wall_side(e.id2), first);
      result_.tally.add_wall(e.id2, impact);
      lost_energy = impact.lost_energy;
    }
    const SinkNumber sink = pair ? no_sink : sink_of(rules_.box, e.id2);
    if (sink != no_sink) {
      result_.gone[e.i1] = 1;
      result_.tally.add_taken(sink, plan_.length - e.time);
    }
    begin_segment(e, e.i1, lost_energy);
    if (pair) begin_segment(e, e.i2, lost_energy);
    if (pair) predict(e.i2, false);
    if (result_.gone[e.i1] == 0) predict(e.i1, false);
  }

  void begin_segment(const Event& e, std::uint32_t i, bool lost_energy) {
    ++version_[i];
    flight_[i] = flight_of(path(i));
    result_.paths.later.push_back({i, path(i), result_.gone[i] != 0, i == e.i1 ? e.id2 : e.id1, result_.disks[i].spin});
    const EventMark mark{e.time, e.id1, e.id2};
    const bool many = version_[i] > most_paths_of_disk || result_.paths.later.size() > most_paths(disks_.size());
    if (many) result_.crowded = mark;
    if (lost_energy && burst_[i].add(e.time, plan_.length)) collapse_ = mark;
  }

  // Adds the path length along the present segment up to time s; under gravity an upper bound. In a sheared box it
  // includes the motion of the images.
  void add_travel(std::uint32_t i, double s) {
    const PathSegment& p = path(i);
    const double t = s - p.start;
    travelled_[i] += (std::sqrt(p.vx * p.vx + p.vy * p.vy) + rules_.gravity.size * t) * t;
    if (rules_.box.shear.acts()) travelled_[i] += std::abs(rules_.box.shear.jump) * t;
    farthest_ = std::max(farthest_, travelled_[i]);
  }

  const ExactRules& rules_;
  const Disks& disks_;
  const WindowPlan& plan_;
  const std::function<bool()>& go_on_;
  const double travel_;
  const Neighbourhood near_;
  WindowResult& result_;
  std::priority_queue<Event, std::vector<Event>, LaterEvent> queue_;
  std::vector<std::uint32_t> version_;
  std::vector<double> travelled_;
  std::vector<Flight> flight_;  // of the present paths
  std::vector<Burst> burst_;
  std::optional<EventMark> collapse_;
  double farthest_ = 0.0;
};

WindowResult fresh_result(const State& state) {
  const Disks& d = state.disks;
  WindowResult result;
  result.gone.assign(d.size(), 0);
  result.disks.resize(d.size());
  result.paths.first.resize(d.size());
  for (std::size_t i = 0; i < d.size(); ++i) {
    ExactDisk& disk = result.disks[i];
    disk.path = {0.0, d.x[i], d.y[i], d.vx[i], d.vy[i]};
    disk.id = d.id[i];
    disk.mass = d.mass_of(i);
    if (d.spins()) {
      disk.spin = d.spin[i];
      disk.radius = d.radius_of(i);
    }
    if (!state.last_contact.empty()) disk.last_contact = state.last_contact[d.id[i]] - state.time;
    if (!state.thermal_hits.empty()) disk.thermal_hits = state.thermal_hits[d.id[i]];
    result.paths.first[i] = disk.path;
  }
  return result;
}

// A first guess at how far disks move: somewhat further than the fastest disk does without collisions.
double guess_travel(const ExactRules& rules, const Disks& d, double length) {
  double fastest2 = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) fastest2 = std::max(fastest2, d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
  return 1.25 * (std::sqrt(fastest2) + rules.gravity.size * length + std::abs(rules.box.shear.jump)) * length;
}

}  // namespace

WindowResult run_reference_window(const ExactRules& rules, const State& state, const WindowPlan& plan,
                                  const std::function<bool()>& go_on) {
  double travel = guess_travel(rules, state.disks, plan.length);
  for (;;) {
    WindowResult result = fresh_result(state);
    const double farthest = EventLoop(rules, state, plan, go_on, travel, result).run();
    if (farthest <= travel || result.given_up) return result;
    travel = 2.0 * farthest;
  }
}

}  // namespace carom
