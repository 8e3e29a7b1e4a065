// The method `exact` in parallel: the bits of core/reference/reference_exact.hpp at any number of threads.
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
// their slices. Where it is not empty, no window is run in parts, so that there are regions; it changes no bit.
std::unique_ptr<Engine> make_parallel_exact(const Scene& scene, State initial, const Threads& threads,
                                            const BorderWatch& watch = {});

// The same for flights one after the other, between which radii grow: neighbour lists last from one to the next. They
// are built with room for a growth: two disks that do not list each other stay further apart than the sum of their
// radii of that time and twice the growth.
class ExactFlights : public Engine {
 public:
  // After end_flight: goes on with this state, up to time t_end of it. growth: by how much each radius may grow after
  // this flight; length. keeps_lists: if the disks are in the same order and places as at the end of the last flight,
  // and their radii have grown by no more than growth() since the lists were built, these stay.
  virtual void begin_flight(State state, double t_end, double growth, bool keeps_lists) = 0;
  // Gives the state away.
  virtual State end_flight() = 0;

  // Then, before the next flight: by how much radii may grow from what they were when the lists were built; 0 if lists
  // do not tell of all disks that are so near.
  virtual double growth() const = 0;
  // If that is not 0: visit(disk, near) for every disk, by index in the state, on all threads. near: the disks that it
  // lists.
  using VisitList = std::function<void(std::size_t, std::span<const std::uint32_t>)>;
  virtual void visit_lists(const VisitList& visit) const = 0;
};
std::unique_ptr<ExactFlights> make_exact_flights(const Scene& scene, State initial, const Threads& threads,
                                                 double growth);

}  // namespace carom
