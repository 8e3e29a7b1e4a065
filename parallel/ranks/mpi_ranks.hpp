// Ranks that are processes of MPI, on one machine or many. In the library carom_mpi, which is built where CMake finds
// MPI.
#pragma once

#include <memory>

#include "parallel/ranks/ranks.hpp"

namespace carom {

// MPI from construction to destruction. Threads may run beside the one that made it; it alone calls MPI.
class MpiSession {
 public:
  // Throws RunError where this MPI does not allow threads.
  MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  ~MpiSession();

  // Ends all processes at once, with this status: some of them can go on, others cannot.
  [[noreturn]] void abort(int status) const;

  // All processes that were started together. The session outlives them.
  std::unique_ptr<Ranks> ranks() const;
};

}  // namespace carom
