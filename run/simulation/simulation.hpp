// A scene in the hands of a program: stepped as far as it likes, looked at, changed between steps, saved and loaded.
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

// Gives the bits of `carom run` of the same scene, whatever the host program's rounding mode. All calls are of one
// thread at a time; different simulations share nothing. Writes no files but where told to, prints nothing, and leaves
// signals alone. What a call throws leaves the simulation as it was before, but for step and run_until, which leave it
// at the end of the last step that was made; and where memory runs out within a step or a change the state is lost().
class Simulation {
 public:
  // A scene as load_scene reads it from a file and parse_scene from text. watch is told how placing the disks at
  // random and their growth go on, and may be empty; what it throws ends that. Throws InputError: disks that find no
  // place.
  explicit Simulation(Scene scene, EngineChoice engine = choose_engine("", std::nullopt),
                      const std::function<void(const GrowthProgress&)>& watch = {});

  // Goes on from a checkpoint: a file, or the folder of a run; or the bytes that save() gave, whose name is for
  // messages. Throws InputError where it is none.
  static Simulation resume(const std::string& name, EngineChoice engine = choose_engine("", std::nullopt));
  static Simulation from_bytes(std::string_view bytes, EngineChoice engine = choose_engine("", std::nullopt));

  // At most n steps; fewer where the end is reached (done()). Throws PhysicsError where the method cannot go on.
  void step(Count n = 1);

  // Steps until time() >= t, or to the end. A step is dt, a frame (rollback) or a window (exact), and none is cut short
  // for t, so that bits do not depend on where a program looks: disks_at(t) has the disks at t itself. go_on is asked
  // before each step and may be empty; it may look at the simulation and change it.
  void run_until(double t, const std::function<bool()>& go_on = {});

  // Has memory run out where the state was half changed? Then it is none: all that needs it throws RunError, and what
  // only shows a part of it is without meaning, until load() has taken up another.
  bool lost() const { return lost_; }
  void check_not_lost() const;

  double time() const { return state().time; }  // end of the last step
  bool done() const { return !(state().time < scene_.run.t_end); }
  const Scene& scene() const { return scene_; }
  const EngineChoice& engine_choice() const { return choice_; }

  // The disks in storage order, which any step may change. Valid until the next call that is not const.
  const State& state() const { return edited_ ? *edited_ : engine_->state(); }

  // Storage indices in order of id. Likewise.
  const std::vector<std::size_t>& order() const;

  // The disks in order of id: now, and at a time within the last step (time stepping: now). Returns their time.
  // Throws InputError for a time after that step, or before it.
  Disks disks() const;
  double disks_at(double t, Disks& out) const;

  // The pairs of disks that met in the last step, in order of time and ids: exact: those that collided in the window,
  // once for each collision; pairwise: those that touched or overlapped when the disks had drifted, before they were
  // pushed apart (of a step in parts, of its last part; in a pile, in the last round); rollback: those whose approach
  // ended the frame. Both disks are still there. Collisions with walls and fixed disks are not among them. None before
  // the first step, and after a change or load(). No step costs more for it.
  std::vector<DiskContact> contacts() const;

  std::uint64_t hash() const;  // state_hash of carom run
  Summary summary() const;     // as of carom run, but for wall times and files

  // Warnings of the physics since the last call, one line each.
  std::vector<std::string> take_warnings();

  // Everything from which to go on, bit for bit; the bytes are those of the file, which takes the place of an older
  // one. Throws InputError where another file has the name, RunError where it cannot be written; both leave what was
  // there.
  std::string save() const;
  void save(const std::string& file) const;

  // Takes up what save() gave, of this or of another simulation. Throws InputError where it is damaged.
  void load(std::string_view bytes);

  // Changes between two steps. add: its id is given, which no disk has had before; absent where the disk would overlap
  // another, a fixed one, an inner wall or sink, or a side that has moved in. The others: false where there is no such
  // disk. Throw InputError for numbers out of range, a disk that reaches out of the box, or one whose radius is more
  // than a quarter of a periodic width or height, an eighth in a sheared box.
  std::optional<DiskId> add(Disk disk);
  bool remove(DiskId id);
  bool set_velocity(DiskId id, Vec2 velocity);

  // Where a disk lies in storage now, if there is one of this id.
  std::optional<std::size_t> find(DiskId id) const;

  // See disk_queries.hpp. Fixed disks are seen too, with the ids that they have among the disks of the scene; inner
  // walls by rays alone.
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
  bool start_changed_ = false;                  // before the first step: it is that of the disks as they are then
  std::unique_ptr<const ObstacleCells> fixed_;  // for queries; null where no disk is fixed
  // Likewise, inner walls; those that move where they were at walls_time_.
  mutable std::unique_ptr<const ObstacleCells> walls_;
  mutable double walls_time_ = -1.0;
  std::unique_ptr<Engine> engine_;
  double step_start_ = 0.0;  // time of the state before the last step
  bool stepped_ = false;     // and nothing was changed or loaded since
  bool lost_ = false;
  std::optional<State> edited_;  // of which the engine is made anew before the next step
  std::vector<std::string> warnings_;
  mutable std::vector<std::size_t> order_;
  mutable bool order_known_ = false;
};

}  // namespace carom
