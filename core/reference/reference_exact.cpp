#include "core/reference/reference_exact.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/physics/wall_overlap.hpp"
#include "core/reference/reference_window.hpp"
#include "core/reference/remove_taken.hpp"
#include "core/step/source.hpp"
#include "core/step/step_start.hpp"
#include "core/step/thermostat.hpp"
#include "core/step/validity.hpp"
#include "core/step/window_plan.hpp"
#include "core/step/window_start.hpp"

namespace carom {

namespace {

class ReferenceExact final : public Engine {
 public:
  ReferenceExact(const Scene& scene, State initial, double window_scale, CollisionLog* log)
      : scene_(scene),
        state_(std::move(initial)),
        obstacles_(place_run_obstacles(scene_, state_)),
        scale_(window_scale),
        log_(log) {}

  void step() override {
    if (!(state_.time < scene_.run.t_end)) return;
    start_window();
    SpeedTally speeds;
    const std::size_t n = state_.disks.size();
    speeds.add(state_.disks, scene_.box, 0, n);
    WindowPlan plan = plan_window(scene_, state_, n, summarise_speeds(speeds, n), scale_);
    if (obstacles_) obstacles_->follow(plan.start, plan.end);
    const PhaseTimer timer(times_, "window");
    const ExactRules rules = exact_rules(scene_, state_.disks, plan.start);
    has_paths_ = false;
    WindowResult result = run_reference_window(rules, state_, plan, go_on_);
    while (result.crowded && !result.given_up) {
      plan = shortened(plan, rules, *result.crowded);
      result = run_reference_window(rules, state_, plan, go_on_);
    }
    if (result.given_up) return;
    last_plan_ = plan;
    if (log_ != nullptr) log_->insert(log_->end(), result.collisions.begin(), result.collisions.end());
    paths_ = std::move(result.paths);
    at_start_ = state_.disks;
    has_paths_ = true;
    finish(plan, result);
  }

  const State& state() const override { return state_; }

  double disks_at(double t, Disks& out) const override {
    if (!(t < state_.time) || !has_paths_) {
      out = state_.disks;
      return state_.time;
    }
    const double at = std::max(t, last_plan_.start);
    const double s = at - last_plan_.start;
    std::vector<PathSegment> path = paths_.first;
    std::vector<unsigned char> gone(path.size(), 0);
    out = at_start_;
    for (const WindowPaths::Piece& p : paths_.later) {
      if (p.path.start > s) break;
      path[p.disk] = p.path;
      gone[p.disk] = p.gone ? 1 : 0;
      if (out.spins()) out.spin[p.disk] = p.spin;
    }
    const Domain box = box_at(scene_.box, last_plan_.start);
    for (std::size_t i = 0; i < path.size(); ++i) place(path[i], s, box, out, i);
    remove_marked(out, gone);
    return at;
  }

  double fastest_within() const override {
    if (!has_paths_) return 0.0;
    double fastest = 0.0;
    for (const PathSegment& path : paths_.first) fastest = std::max(fastest, speed_at_start(path));
    for (const WindowPaths::Piece& p : paths_.later) fastest = std::max(fastest, speed_at_start(p.path));
    return fastest;
  }

  std::vector<DiskContact> contacts() const override {
    std::vector<DiskContact> met;
    if (!has_paths_) return met;
    for (const WindowPaths::Piece& p : paths_.later) {
      const DiskId id = at_start_.id[p.disk];
      if (!is_wall(p.partner) && id < p.partner) met.push_back({id, p.partner, last_plan_.start + p.path.start});
    }
    return met;
  }

  void set_watch(const std::function<bool()>& go_on) override { go_on_ = go_on; }
  const PhaseTimes& phase_times() const override { return times_; }
  std::vector<std::string> take_warnings() override { return validity_.take_warnings(); }

 private:
  // Sources emit, Brownian disks draw their velocities, and those that cross a sink within the interval are removed.
  void start_window() {
    const PhaseTimer timer(times_, "start");
    emit_at_window_start(scene_, state_, [&](const Disk& d) { return has_room(state_.disks, scene_.box, d); });
    if (scene_.physics.collapse_contact_time) state_.last_contact.resize(state_.next_id, -never);
    count_thermal_hits(scene_, state_);
    kick_if_due(scene_, state_);
    if (!brownian_interval_begins(scene_, state_)) return;
    const BrownianInterval interval = begin_brownian_interval(scene_, state_);
    std::vector<SinkNumber> taken_by(state_.disks.size(), no_sink);
    with_view(state_.disks, [&](const auto& d) {
      draw_brownian(d, scene_, interval.number, interval.length, 0, taken_by.size());
      if (!has_brownian_sink(scene_)) return;
      for (std::size_t i = 0; i < taken_by.size(); ++i) {
        taken_by[i] = sink_crossed(d, scene_, interval.number, interval.length, i);
      }
    });
    remove_taken(state_, taken_by);
  }

  // Sets disk i of d to its place on the path at time s. box: at the start of the window. Returns the work of the shear
  // if the disk crosses the bottom or the top of a sheared box.
  double place(const PathSegment& path, double s, const Domain& box, Disks& d, std::size_t i) const {
    PathSegment p = carried_to(path, s, scene_.physics.gravity);
    const double work = wrap_with_work(p, d.mass_of(i), box);
    d.x[i] = p.x;
    d.y[i] = p.y;
    d.vx[i] = p.vx;
    d.vy[i] = p.vy;
    return work;
  }

  void finish(const WindowPlan& plan, WindowResult& result) {
    Disks& d = state_.disks;
    const Domain box = box_at(scene_.box, plan.start);
    for (std::size_t i = 0; i < d.size(); ++i) {
      const double work = place(result.disks[i].path, plan.length, box, d, i);
      if (work != 0.0) result.tally.add_shear(0.0, work);
      if (d.spins()) d.spin[i] = result.disks[i].spin;
      if (!state_.last_contact.empty()) state_.last_contact[d.id[i]] = plan.start + result.disks[i].last_contact;
      if (!state_.thermal_hits.empty()) state_.thermal_hits[d.id[i]] = result.disks[i].thermal_hits;
    }
    state_.counters.removed += remove_marked(d, result.gone);
    finish_window(state_, state_.disks.size(), plan, result.tally, scale_);
    Overlap wall;
    if (walls_are_watched(scene_)) wall = deepest_wall_overlap(d, box_at(scene_.box, state_.time), 0, d.size());
    validity_.note_step(scene_, {.wall = wall, .inaccurate = result.tally.all_inaccurate()}, state_);
    check_pace(scene_, state_, plan, result.tally);
  }

  Scene scene_;
  State state_;
  std::unique_ptr<ObstacleCells> obstacles_;  // of scene_.box
  double scale_;
  Validity validity_;
  CollisionLog* log_;
  std::function<bool()> go_on_;
  PhaseTimes times_;
  WindowPlan last_plan_;
  WindowPaths paths_;
  bool has_paths_ = false;
  Disks at_start_;  // of the last window; columns other than positions and velocities are read
};

}  // namespace

std::unique_ptr<Engine> make_reference_exact(const Scene& scene, State initial, double window_scale,
                                             CollisionLog* log) {
  return std::make_unique<ReferenceExact>(scene, std::move(initial), window_scale, log);
}

}  // namespace carom
