// A scene controlled by a program: stepped as far as it likes, read, changed between steps, saved and loaded.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/disks/disk_contact.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/run_start.hpp"
#include "core/start/growth.hpp"
#include "core/step/edit.hpp"
#include "core/step/engine.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "run/engine/make_engine.hpp"
#include "run/results/summary.hpp"
#include "run/simulation/disk_queries.hpp"

namespace carom {

// Gives the bits of `carom run` for the same scene, whatever the host program's rounding mode. Only one thread at a
// time may call it; different simulations share nothing. Writes files only where told to, prints nothing, and does not
// handle signals. A call that throws leaves the simulation as it was before, except that step and run_until leave it at
// the end of the last completed step, and that the state is lost() if memory runs out within a step or a change.
class Simulation {
 public:
  // Starts a scene, which load_scene reads from a file and parse_scene from text. watch is called with the progress of
  // placing the disks at random and of their growth, and may be empty; an exception from it ends this. Throws
  // InputError if there is no room for all disks.
  explicit Simulation(Scene scene, EngineChoice engine = choose_engine("", std::nullopt),
                      const std::function<void(const GrowthProgress&)>& watch = {});

  // Continues from a checkpoint: a file, or the folder of a run; or the bytes that save() returned, whose name is for
  // messages. Throws InputError if it is not a checkpoint.
  static Simulation resume(const std::string& name, EngineChoice engine = choose_engine("", std::nullopt));
  static Simulation from_bytes(std::string_view bytes, EngineChoice engine = choose_engine("", std::nullopt));

  // Makes at most n steps; fewer if the end is reached (done()). Throws PhysicsError if the method cannot go on.
  void step(Count n = 1);

  // Steps until time() >= t, or to the end. A step is dt, a frame (rollback) or a window (exact), and none is cut short
  // for t, so the bits do not depend on the times that a program asks for: disks_at(t) has the disks at t itself. go_on
  // is called before each step and may be empty; it may read and change the simulation.
  void run_until(double t, const std::function<bool()>& go_on = {});

  // Has memory run out when the state was half changed? Then there is no valid state: functions that need one throw
  // RunError, and others return values without meaning, until load() has replaced it.
  bool lost() const { return lost_; }
  void check_not_lost() const;

  double time() const { return state().time; }  // at the end of the last step
  bool done() const { return !(state().time < scene_.run.t_end); }
  const Scene& scene() const { return scene_; }
  const EngineChoice& engine_choice() const { return choice_; }

  // The disks in storage order, which any step may change. Valid until the next call that is not const.
  const State& state() const { return edited_ ? *edited_ : engine_->state(); }

  // Storage indices in order of id. Valid as state() is.
  const std::vector<std::size_t>& order() const;

  // The disks in order of id: now, and at a time within the last step (for time stepping: now). disks_at returns their
  // time, and throws InputError for a time after that step, or before it.
  Disks disks() const;
  double disks_at(double t, Disks& out) const;

  // The pairs of disks in contact in the last step, in order of time and ids. exact: those that collided in the window,
  // once for each collision; pairwise: those that touched or overlapped when the disks had drifted, before they were
  // pushed apart (in a step in several parts, in its last part; in a pile, in the last round); rollback: those whose
  // approach ended the frame. Both disks still exist. Collisions with walls and fixed disks are not included. Empty
  // before the first step, and after a change or load(). Steps do not become slower by it.
  std::vector<DiskContact> contacts() const;

  std::uint64_t hash() const;  // state_hash of carom run
  Summary summary() const;     // as of carom run, except for wall times and files

  // Warnings of the physics since the last call, one line each.
  std::vector<std::string> take_warnings();

  // Everything needed to continue, bit for bit; the bytes are those of the file, which replaces an older checkpoint.
  // Throws InputError if another file has the name, RunError if it cannot be written; both leave the existing file.
  std::string save() const;
  void save(const std::string& file) const;

  // Replaces the state by the one that save() returned, of this or of another simulation. Throws InputError if it is
  // damaged.
  void load(std::string_view bytes);

  // Changes between two steps. add: returns the id, which no disk has had before; absent if the disk would overlap
  // another, a fixed one, an inner wall or sink, or a side that has moved in. The others return false if there is no
  // such disk. All throw InputError for numbers out of range, a disk that reaches out of the box, or one whose radius
  // is more than a quarter of a periodic width or height, or an eighth in a sheared box.
  std::optional<DiskId> add(Disk disk);
  bool remove(DiskId id);
  bool set_velocity(DiskId id, Vec2 velocity);

  // The present storage index of the disk with this id, if there is one.
  std::optional<std::size_t> find(DiskId id) const;

  // See disk_queries.hpp. They include fixed disks, with their ids among the disks of the scene; only rays meet inner
  // walls.
  std::vector<DiskId> disks_in(Vec2 low, Vec2 high) const;
  std::optional<NearDisk> nearest(Vec2 place) const;
  std::optional<RayHit> cast_ray(Vec2 from, Vec2 direction, double length) const;

 private:
  Simulation(Checkpoint checkpoint, const std::string& name, EngineChoice engine);
  RunRecord record() const;
  RunStart start() const { return start_changed_ ? run_start(state(), scene_) : start_; }
  Engine& engine();
  template <class Work>
  auto or_lose(Work&& work);
  void change(Edit edit);
  void keep_warnings();
  void make_step();
  VisitNear visit_near() const;
  QueryScene query_scene() const;

  Scene scene_;
  std::string scene_text_;
  EngineChoice choice_;
  RunStart start_;
  bool start_changed_ = false;                  // before the first step: start_ must be made from the present disks
  std::unique_ptr<const ObstacleCells> fixed_;  // for queries; null if no disk is fixed
  // Inner walls, in the same way; those that move are at their places at walls_time_.
  mutable std::unique_ptr<const ObstacleCells> walls_;
  mutable double walls_time_ = -1.0;
  std::unique_ptr<Engine> engine_;
  double step_start_ = 0.0;  // time of the state before the last step
  bool stepped_ = false;     // and nothing was changed or loaded since
  bool lost_ = false;
  std::optional<State> edited_;  // from which the engine is made anew before the next step
  std::vector<std::string> warnings_;
  mutable std::vector<std::size_t> order_;
  mutable bool order_known_ = false;
};

}  // namespace carom
