// The three kinds of error that Carom tells apart, and the exit status of each.
#pragma once

#include <stdexcept>

namespace carom {

// Bad usage or a bad scene: the message is one line, "file:line: key: what is wrong, what was expected". Status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The world failed the run (disk full, tool missing): not the user's input. Status 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The physics left what the method can do (stalled time, inelastic collapse, a step far too long). Status 3.
class PhysicsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace carom
