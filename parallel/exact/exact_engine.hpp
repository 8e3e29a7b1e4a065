// The method `exact` in parallel: the same bits as core/reference/reference_exact.hpp with any number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "core/step/engine.hpp"
#include "parallel/exact/border_watch.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// Preconditions as for make_reference_exact. watch: for tests and measurements of regions, called at the end of each of
// their slices. If it is not empty, no window is run in parts, so that there are regions; it changes no bit.
std::unique_ptr<Engine> make_parallel_exact(const Scene& scene, State initial, const Threads& threads,
                                            const BorderWatch& watch = {});

// The same engine for successive flights between which radii grow: neighbour lists last from one flight to the next.
// They are built with room for a growth: two disks that do not list each other stay further apart than the sum of their
// radii of that time and twice the growth.
class ExactFlights : public Engine {
 public:
  // Begins a flight with this state, up to time t_end; if it is not the first one, after end_flight. growth: the
  // largest growth of any radius after this flight; length. keeps_lists: lists stay in use; then the disks must be in
  // the same order and at the same places as at the end of the last flight, and their radii must have grown by at most
  // growth() since the lists were built.
  virtual void begin_flight(State state, double t_end, double growth, bool keeps_lists) = 0;
  // Ends the flight and gives the state away.
  virtual State end_flight() = 0;

  // Between end_flight and begin_flight: the largest growth of radii since the lists were built that the lists allow
  // for; 0 if they do not include all disks that are so near.
  virtual double growth() const = 0;
  // If growth() is not 0: calls visit(disk, near) for every disk, by index in the state, on all threads. near: the
  // disks in its list.
  using VisitList = std::function<void(std::size_t, std::span<const std::uint32_t>)>;
  virtual void visit_lists(const VisitList& visit) const = 0;
};
std::unique_ptr<ExactFlights> make_exact_flights(const Scene& scene, State initial, const Threads& threads,
                                                 double growth);

}  // namespace carom
