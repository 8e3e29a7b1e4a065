// What a run drives: any method, reference or parallel, on one machine or several ranks.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/collision_log.hpp"
#include "core/base/phase_times.hpp"
#include "core/disks/disk_contact.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/state.hpp"
#include "core/disks/state_pieces.hpp"
#include "core/scene/scene.hpp"
#include "core/step/edit.hpp"

namespace carom {

class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  // One step of dt (pairwise), one frame (rollback) or one window (exact); the last one ends at scene.run.t_end.
  // Does nothing once time() has reached t_end. Throws PhysicsError when the method cannot go on.
  virtual void step() = 0;

  // The state at the end of the last step. Disks may be stored in any order.
  virtual const State& state() const = 0;

  // The same for all that asks for no disk: they may be a part only, that of one rank of several.
  virtual const State& progress() const { return state(); }

  // state() in pieces, for a program that writes it and need not have all disks at once. To be used before the next
  // step.
  virtual std::unique_ptr<StatePieces> pieces() const { return std::make_unique<WholeState>(state()); }

  // Writes to out the disks at time t <= state().time, and returns the time that they are of: t within the last step;
  // the start of that step where t is earlier; always state().time in time stepping, which knows the ends of steps
  // only. No bit of the state changes.
  virtual double disks_at(double t, Disks& out) const = 0;

  // The same in pieces, to be used before the next step. room: for disks that have to lie somewhere; it outlives what
  // is returned.
  virtual std::unique_ptr<DisksInPieces> pieces_at(double t, Disks& room) const {
    if (!(t < state().time)) return std::make_unique<WholeDisks>(state().disks, state().time);
    const double time = disks_at(t, room);
    return std::make_unique<WholeDisks>(room, time);
  }

  // The largest speed with which a disk set out on a path of the last step, however short: exact tells it of all paths
  // that it keeps. 0 in time stepping, which knows the ends of steps only.
  virtual double fastest_within() const { return 0.0; }

  // Says that no times within a step will be asked for: an exact engine then keeps no paths, and disks_at gives
  // state(). Changes no bit of the state.
  virtual void forget_paths() {}

  // Gives back memory that only steps need: disks_at then gives state(), and a further step makes all of it anew.
  // Changes no bit of the state.
  virtual void release_memory() {}

  // Asked now and then within long steps, from any thread: shall the step go on? Where not, step() may return with the
  // step not made, and state() that of its start. Empty: always. Changes no bit of the state.
  virtual void set_watch(const std::function<bool()>& /*go_on*/) {}

  // Makes a change between two steps, and keeps what it knows of the other disks; state() is then what apply() makes of
  // it, in any storage order. False, without a change, where the engine cannot, and another one is to be made of the
  // changed state: the bits of later steps are the same.
  virtual bool edit(const Edit& /*edit*/) { return false; }

  // Calls visit(i) for every disk of state() whose centre is within half_width and half_height of a place in the box
  // (nearest images); perhaps for others too, and for some twice. False, with no call, where the engine has no cells at
  // hand; then it may be any disk.
  virtual bool visit_near(Vec2 /*centre*/, double /*half_width*/, double /*half_height*/,
                          const std::function<void(std::size_t)>& /*visit*/) {
    return false;
  }

  // The pairs of disks that met in the last step, in any order. exact: those that collided, once for each collision,
  // unless forget_paths was called. pairwise: those that touched or overlapped after the drift (of a step in parts, of
  // its last part; in a pile, in the last round). rollback: those that touched and approached, which end a frame. A
  // disk that has left through a sink may be among them. Precondition: a step was made, and no edit since.
  virtual std::vector<DiskContact> contacts() const = 0;

  virtual const PhaseTimes& phase_times() const = 0;

  // Warnings raised since the last call, one line each (a step longer than the safe one, overlaps beyond a bound).
  virtual std::vector<std::string> take_warnings() = 0;
};

// The plain serial engine for scene.run.method. Precondition: initial is a state of scene (initial_state.hpp).
// Every collision of two disks is added to log, where one is given; it must outlive the engine.
std::unique_ptr<Engine> make_reference_engine(const Scene& scene, State initial, CollisionLog* log = nullptr);

}  // namespace carom
