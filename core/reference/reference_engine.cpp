#include "core/reference/reference_engine.hpp"

#include <utility>

#include "core/physics/sheared_crossing.hpp"
#include "core/reference/reference_exact.hpp"
#include "core/reference/reference_pairwise.hpp"
#include "core/reference/reference_rollback.hpp"
#include "core/reference/remove_taken.hpp"
#include "core/step/source.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_start.hpp"
#include "core/step/thermostat.hpp"

namespace carom {

ReferenceEngine::ReferenceEngine(const Scene& scene, State initial)
    : scene_(scene), state_(std::move(initial)), obstacles_(place_run_obstacles(scene_, state_)) {}

double ReferenceEngine::disks_at(double /*t*/, Disks& out) const {
  out = state_.disks;
  return state_.time;
}

std::vector<DiskContact> ReferenceEngine::contacts() const {
  std::vector<DiskContact> met;
  for (const ContactEvent& e : events_) {
    if (!is_wall(e.id2)) met.push_back({e.id1, e.id2, state_.time});
  }
  return met;
}

std::vector<std::string> ReferenceEngine::take_warnings() {
  return validity_.take_warnings();
}

void ReferenceEngine::start_interval(double t, double dt, Count step) {
  if (t == 0.0) remove_at_sinks();
  const PhaseTimer timer(times_, "start");
  emit_due(scene_, state_, t, step, [&](const Disk& disk) { return has_room(state_.disks, scene_.box, disk); });
  if (!(scene_.physics.diffusion > 0.0)) return;
  std::vector<SinkNumber> taken_by(state_.disks.size(), no_sink);
  with_view(state_.disks, [&](const auto& d) {
    draw_brownian(d, scene_, step, dt, 0, state_.disks.size());
    if (!has_brownian_sink(scene_)) return;
    for (std::size_t i = 0; i < taken_by.size(); ++i) taken_by[i] = sink_crossed(d, scene_, step, dt, i);
  });
  remove_taken(state_, taken_by);
}

void ReferenceEngine::kick_if_due() {
  carom::kick_if_due(scene_, state_);
}

Count ReferenceEngine::parts(double dt) {
  const double travel2 =
      with_view(state_.disks, [&](const auto& d) { return largest_travel2(d, 0, state_.disks.size()); });
  const double smallest = smallest_radius(state_.disks);
  const double fall = smallest > 0.0 ? common_travel(scene_, dt, smallest) : 0.0;
  const Count parts = parts_of_step(travel2, fall, dt);
  if (parts > 1) validity_.note_split(state_, dt, parts);
  return parts;
}

void ReferenceEngine::drift(double t) {
  const PhaseTimer timer(times_, "drift");
  const Gravity& g = scene_.physics.gravity;
  with_view(state_.disks, [&](const auto& d) {
    for (std::size_t i = 0; i < state_.disks.size(); ++i) {
      if (g.acts()) {
        carom::drift<true>(d.x[i], d.y[i], d.vx[i], d.vy[i], t, g);
      } else {
        carom::drift<false>(d.x[i], d.y[i], d.vx[i], d.vy[i], t, g);
      }
    }
  });
  wrap_all();
}

void ReferenceEngine::wrap_all() {
  Disks& d = state_.disks;
  if (scene_.box.shear.acts()) {
    ImpactTally tally;
    for (std::size_t i = 0; i < d.size(); ++i) cross_sheared(d, i, scene_.box, tally);
    tally.count_into(state_.counters);
    return;
  }
  for (std::size_t i = 0; i < d.size(); ++i) wrap(d.x[i], d.y[i], scene_.box);
}

void ReferenceEngine::remove_at_sinks() {
  if (!has_sinks(scene_.box)) return;
  const PhaseTimer timer(times_, "sinks");
  std::vector<SinkNumber> taken_by(state_.disks.size());
  with_view(state_.disks, [&](const auto& d) {
    for (std::size_t i = 0; i < taken_by.size(); ++i) taken_by[i] = sink_touched(d, scene_.box, i);
  });
  remove_taken(state_, taken_by);
}

std::unique_ptr<Engine> make_reference_engine(const Scene& scene, State initial, CollisionLog* log) {
  switch (scene.run.method) {
    case Method::rollback:
      return make_reference_rollback(scene, std::move(initial), log);
    case Method::pairwise:
      return make_reference_pairwise(scene, std::move(initial), log);
    case Method::exact:
      break;
  }
  return make_reference_exact(scene, std::move(initial), 1.0, log);
}

}  // namespace carom
