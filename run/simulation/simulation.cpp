#include "run/simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/base/check.hpp"
#include "core/base/float_environment.hpp"
#include "core/base/input_message.hpp"
#include "core/disks/disk_columns.hpp"
#include "core/disks/fastest_speed.hpp"
#include "core/disks/state_hash.hpp"
#include "core/scene/scene_text.hpp"
#include "core/step/late_collisions.hpp"
#include "core/step/validity.hpp"
#include "io/checkpoint/checkpoint_place.hpp"
#include "io/files/output_file.hpp"
#include "run/simulation/newcomer.hpp"

namespace carom {

namespace {

Scene scene_in(const Checkpoint& checkpoint, const std::string& name) {
  const RunRecord& record = checkpoint.record;
  Scene scene = parse_scene(record.scene_text, record.scene_file, "");
  if (checkpoint.state.sources.size() != scene.sources.size()) {
    fail_input(name, "holds a state that does not belong to its scene", "expected a checkpoint as Carom wrote it");
  }
  return scene;
}

// Cells of the fixed disks, or of the inner walls at their present places.
std::unique_ptr<const ObstacleCells> cells_of(const Scene& scene, const State& state, bool segments) {
  std::vector<Obstacle> chosen;
  const std::vector<WallMotion> motions = motions_of(scene);
  for (const Obstacle& o : state.obstacles) {
    if (o.is_segment() == segments) chosen.push_back(at_time(o, motions, state.time, scene.box));
  }
  return chosen.empty() ? nullptr : std::make_unique<const ObstacleCells>(chosen, std::vector<WallMotion>{}, scene.box);
}

}  // namespace

Simulation::Simulation(Scene scene, EngineChoice engine, const std::function<void(const GrowthProgress&)>& watch)
    : scene_(std::move(scene)), scene_text_(resolved_toml(scene_)), choice_(std::move(engine)) {
  const FloatEnvironment environment;
  within_memory(scene_, [&] { engine_ = make_engine(choice_, scene_, make_initial_state(choice_, scene_, watch)); });
  fixed_ = cells_of(scene_, state(), false);
  walls_ = cells_of(scene_, state(), true);
  start_ = run_start(state(), scene_);
  warnings_ = validity_warnings_at_start(scene_, smallest_radius(state().disks), fastest_speed(state().disks));
}

Simulation::Simulation(Checkpoint checkpoint, const std::string& name, EngineChoice engine)
    : scene_(scene_in(checkpoint, name)),
      scene_text_(resolved_toml(scene_)),
      choice_(std::move(engine)),
      start_(checkpoint.record.start) {
  const FloatEnvironment environment;
  within_memory(scene_, [&] { engine_ = make_engine(choice_, scene_, std::move(checkpoint.state)); });
  fixed_ = cells_of(scene_, state(), false);
  walls_ = cells_of(scene_, state(), true);
  step_start_ = time();
}

Simulation Simulation::resume(const std::string& name, EngineChoice engine) {
  return {read_checkpoint_at(find_checkpoint(name)), name, std::move(engine)};
}

Simulation Simulation::from_bytes(std::string_view bytes, EngineChoice engine) {
  return {checkpoint_from_bytes(bytes, "saved state"), "saved state", std::move(engine)};
}

void Simulation::check_not_lost() const {
  if (lost_) throw RunError("memory has run out within a step or a change, and the state is lost: load a saved one");
}

// An exception of the method itself leaves the engine as it was; any other may come in the middle of its work.
template <class Work>
auto Simulation::or_lose(Work&& work) {
  try {
    return work();
  } catch (const PhysicsError&) {
    throw;
  } catch (...) {
    lost_ = true;
    stepped_ = false;
    throw;
  }
}

Engine& Simulation::engine() {
  if (edited_) {
    engine_ = make_engine(choice_, scene_, *edited_);
    edited_.reset();
  }
  return *engine_;
}

// Changes before the first step belong to the start; the energy of a later change counts as energy put into the run.
void Simulation::change(Edit edit) {
  const FloatEnvironment environment;
  check_not_lost();
  order_known_ = stepped_ = false;
  if (state().counters.steps == 0) {
    start_changed_ = true;
  } else {
    edit.energy = energy_brought(edit, state().disks, scene_.physics.gravity);
  }
  if (!edited_ && or_lose([&] { return engine_->edit(edit); })) return;
  if (!edited_) {
    keep_warnings();
    edited_ = engine_->state();
  }
  or_lose([&] { apply(edit, *edited_); });
}

// Called before the engine is made anew. At most this number is kept for a program that goes back again and again and
// never calls take_warnings.
void Simulation::keep_warnings() {
  constexpr std::size_t most_kept = 1000;
  for (std::string& text : engine_->take_warnings()) {
    const bool known = std::find(warnings_.begin(), warnings_.end(), text) != warnings_.end();
    if (!known && warnings_.size() < most_kept) warnings_.push_back(std::move(text));
  }
}

// A step that fails leaves no contacts. Changes since the step before are taken into the engine here, since run_until
// may let a program read the disks, change them or load another state before each step.
void Simulation::make_step() {
  check_not_lost();
  Engine& steps = engine();
  start_ = start();
  start_changed_ = false;
  order_known_ = stepped_ = false;
  step_start_ = time();
  or_lose([&] { steps.step(); });
  stepped_ = true;
}

void Simulation::step(Count n) {
  const FloatEnvironment environment;
  for (Count k = 0; k < n && !done(); ++k) make_step();
}

void Simulation::run_until(double t, const std::function<bool()>& go_on) {
  if (std::isnan(t)) fail_input("time", "is not a number", "expected a time");
  const FloatEnvironment environment;
  while (time() < t && !done() && (!go_on || go_on())) make_step();
}

const std::vector<std::size_t>& Simulation::order() const {
  check_not_lost();
  if (!order_known_) order_ = by_id(state().disks);
  order_known_ = true;
  return order_;
}

Disks Simulation::disks() const {
  Disks sorted;
  disks_at(time(), sorted);
  return sorted;
}

double Simulation::disks_at(double t, Disks& out) const {
  const FloatEnvironment environment;
  check_not_lost();
  if (!(t <= time())) fail_input("time", fmt::format("is {}", t), fmt::format("expected {} or less", time()));
  if (t < step_start_) {
    fail_input("time", fmt::format("is {}, before the last step", t),
               fmt::format("expected {} to {}", step_start_, time()));
  }
  Disks stored = state().disks;
  const double at = edited_ ? time() : engine_->disks_at(t, stored);
  gather_disks(stored, by_id(stored), out);  // also disks that a sink took in the last step
  return at;
}

std::vector<DiskContact> Simulation::contacts() const {
  if (!stepped_) return {};
  const FloatEnvironment environment;
  std::vector<DiskContact> met = engine_->contacts();
  if (state().counters.removed > 0) {
    std::vector<DiskId> there = state().disks.id;
    std::sort(there.begin(), there.end());
    const auto is_there = [&](DiskId id) { return std::binary_search(there.begin(), there.end(), id); };
    std::erase_if(met, [&](const DiskContact& c) { return !is_there(c.id1) || !is_there(c.id2); });
  }
  std::sort(met.begin(), met.end());
  return met;
}

std::uint64_t Simulation::hash() const {
  return state_hash(state().disks);
}

Summary Simulation::summary() const {
  const FloatEnvironment environment;
  check_not_lost();
  // After a change, a separate engine is used: making the next step's engine would move the disks that a caller is
  // reading.
  const std::unique_ptr<Engine> looks = edited_ ? make_engine(choice_, scene_, *edited_) : nullptr;
  Summary s = summarize(start(), looks ? *looks : *engine_, scene_, choice_);
  s.warnings = validity_warnings_so_far(scene_, state());
  if (!done()) return s;
  const std::vector<std::string> at_end = few_inaccurate_warnings(scene_, state());
  s.warnings.insert(s.warnings.end(), at_end.begin(), at_end.end());
  return s;
}

std::vector<std::string> Simulation::take_warnings() {
  if (!lost_) keep_warnings();
  return std::exchange(warnings_, {});
}

RunRecord Simulation::record() const {
  const FloatEnvironment environment;  // start() may sum energies
  check_not_lost();
  RunRecord record;
  record.version = CAROM_VERSION;
  record.scene_file = scene_.file;
  record.scene_text = scene_text_;
  record.engine = choice_.name;
  record.start = start();
  return record;
}

std::string Simulation::save() const {
  return checkpoint_bytes(record(), state());
}

void Simulation::save(const std::string& file) const {
  if (is_another_file(file)) fail_input(file, "is there, and is no checkpoint", "expected a name for a checkpoint");
  const std::string beside = file + ".new";
  try {
    write_checkpoint(beside, record(), state());
    rename_file(beside, file);
  } catch (const RunError&) {
    std::remove(beside.c_str());
    throw;
  }
}

void Simulation::load(std::string_view bytes) {
  Checkpoint checkpoint = checkpoint_from_bytes(bytes, "saved state");
  if (checkpoint.record.scene_text != scene_text_) {
    *this = Simulation(std::move(checkpoint), "saved state", choice_);
    return;
  }
  if (checkpoint.state.sources.size() != scene_.sources.size()) scene_in(checkpoint, "saved state");
  start_ = checkpoint.record.start;
  start_changed_ = false;
  if (!lost_) keep_warnings();
  lost_ = false;
  edited_ = std::move(checkpoint.state);
  step_start_ = time();
  order_known_ = stepped_ = false;
}

std::optional<DiskId> Simulation::add(Disk disk) {
  const FloatEnvironment environment;
  check_not_lost();
  check_newcomer(scene_, state(), disk);
  if (!has_room(scene_, state(), disk, visit_near(), fixed_.get())) return std::nullopt;
  disk.id = state().next_id;
  if (!state().disks.spins()) disk.spin = 0.0;
  change({Edit::Kind::add, disk});
  return disk.id;
}

std::optional<std::size_t> Simulation::find(DiskId id) const {
  check_not_lost();
  const std::vector<DiskId>& ids = state().disks.id;
  const auto at = std::find(ids.begin(), ids.end(), id);
  if (at == ids.end()) return std::nullopt;
  return static_cast<std::size_t>(at - ids.begin());
}

bool Simulation::remove(DiskId id) {
  const std::optional<std::size_t> i = find(id);
  if (!i) return false;
  change({Edit::Kind::remove, {}, *i});
  return true;
}

bool Simulation::set_velocity(DiskId id, Vec2 velocity) {
  check_velocity(velocity);
  const std::optional<std::size_t> i = find(id);
  if (!i) return false;
  Edit edit{Edit::Kind::set_velocity, {}, *i};
  edit.disk.vx = velocity.x;
  edit.disk.vy = velocity.y;
  change(edit);
  return true;
}

VisitNear Simulation::visit_near() const {
  return [this](Vec2 centre, double half_width, double half_height, const Visit& visit) {
    if (!edited_ && engine_->visit_near(centre, half_width, half_height, visit)) return;
    visit_all(state().disks)(centre, half_width, half_height, visit);
  };
}

QueryScene Simulation::query_scene() const {
  check_not_lost();
  if (scene_.box.shear.acts()) fail_input("box.shear_rate", "moves the images", "expected queries of other scenes");
  if (scene_.box.inner_walls_move && walls_time_ != state().time) {
    walls_ = cells_of(scene_, state(), true);
    walls_time_ = state().time;
  }
  return {state().disks, scene_.box, visit_near(), fixed_.get(), walls_.get()};
}

std::vector<DiskId> Simulation::disks_in(Vec2 low, Vec2 high) const {
  const FloatEnvironment environment;
  return carom::disks_in(query_scene(), low, high);
}

std::optional<NearDisk> Simulation::nearest(Vec2 place) const {
  const FloatEnvironment environment;
  return nearest_disk(query_scene(), place);
}

std::optional<RayHit> Simulation::cast_ray(Vec2 from, Vec2 direction, double length) const {
  const FloatEnvironment environment;
  return carom::cast_ray(query_scene(), from, direction, length);
}

}  // namespace carom
