// Ranks that are processes of MPI, on one machine or many. In the library carom_mpi, which is built where CMake finds
// MPI.
#pragma once

#include <memory>

#include "parallel/ranks/ranks.hpp"

namespace carom {

// MPI is initialised from construction to destruction. Only the thread that constructs the session may call MPI.
class MpiSession {
 public:
  // Throws RunError if this MPI does not support threads.
  MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  ~MpiSession();

  // Ends all processes at once, with this status: for errors after which only some of them could go on.
  [[noreturn]] void abort(int status) const;

  // All processes that were started together. The session must outlive the result.
  std::unique_ptr<Ranks> ranks() const;
};

}  // namespace carom
