// The interface of every method, reference or parallel, on one machine or several ranks.
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

  // The same without complete disks: one rank of several may hold only its part of them. For time and counters.
  virtual const State& progress() const { return state(); }

  // state() in pieces, for a program that writes it without gathering all disks. Valid until the next step.
  virtual std::unique_ptr<StatePieces> pieces() const { return std::make_unique<WholeState>(state()); }

  // Writes the disks at time t <= state().time to out, and returns their time: t if it lies within the last step, the
  // start of that step if t is earlier. Time stepping knows only the ends of steps and always gives state().time.
  // Changes no bit of the state.
  virtual double disks_at(double t, Disks& out) const = 0;

  // The same in pieces, valid until the next step. room: memory for disks that are computed; it must outlive the
  // result.
  virtual std::unique_ptr<DisksInPieces> pieces_at(double t, Disks& room) const {
    if (!(t < state().time)) return std::make_unique<WholeDisks>(state().disks, state().time);
    const double time = disks_at(t, room);
    return std::make_unique<WholeDisks>(room, time);
  }

  // The largest speed at which a disk began any path of the last step, if the engine keeps paths (exact); otherwise 0.
  virtual double fastest_within() const { return 0.0; }

  // Promises that no times within a step will be asked for: an exact engine then keeps no paths, and disks_at gives
  // state(). Changes no bit of the state.
  virtual void forget_paths() {}

  // Frees memory that only steps need; disks_at then gives state(), and a further step allocates anew. Changes no bit
  // of the state.
  virtual void release_memory() {}

  // go_on is called now and then within long steps, from any thread. Once it returns false, step() may return without
  // having made the step; state() is then that of its start. Empty: steps are never interrupted. Changes no bit of the
  // state.
  virtual void set_watch(const std::function<bool()>& /*go_on*/) {}

  // Makes a change between two steps without starting anew; state() is then as apply() leaves it, in any storage order.
  // Returns false, without a change, if the engine cannot: then apply() has to change the state and a new engine be
  // made from it. The bits of later steps are the same either way.
  virtual bool edit(const Edit& /*edit*/) { return false; }

  // Calls visit(i) for every disk of state() whose centre is within half_width and half_height of a place in the box
  // (nearest images); perhaps for others too, and for some twice. Returns false, without a call, if the engine has no
  // cells at present; the caller then has to search all disks.
  virtual bool visit_near(Vec2 /*centre*/, double /*half_width*/, double /*half_height*/,
                          const std::function<void(std::size_t)>& /*visit*/) {
    return false;
  }

  // The pairs of disks that were in contact in the last step, in any order. exact: pairs that collided, once for each
  // collision; none after forget_paths. pairwise: pairs that touched or overlapped after the drift (of the last part,
  // if the step was split; of the last round, in a pile). rollback: pairs that touched and approached, and so ended the
  // frame. Disks that have left through a sink may be among them. Precondition: a step was made, and no edit since.
  virtual std::vector<DiskContact> contacts() const = 0;

  virtual const PhaseTimes& phase_times() const = 0;

  // Warnings raised since the last call, one line each (a step longer than the safe one, overlaps beyond a bound).
  virtual std::vector<std::string> take_warnings() = 0;
};

// The plain serial engine for scene.run.method. Precondition: initial is a state of scene (initial_state.hpp). log: if
// not null, every collision of two disks is added to it; it must outlive the engine.
std::unique_ptr<Engine> make_reference_engine(const Scene& scene, State initial, CollisionLog* log = nullptr);

}  // namespace carom
