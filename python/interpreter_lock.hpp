// Python's lock, given up while the engine works and taken again to speak with Python.
#pragma once

#include <Python.h>
#include <unistd.h>

namespace carom {

inline bool python_is_ending() {
#if PY_VERSION_HEX >= 0x030D0000
  return Py_IsFinalizing() != 0;
#else
  return _Py_IsFinalizing() != 0;
#endif
}

// A daemon thread may still be at work when Python ends. Were it to ask for the lock, Python would end it as if by
// pthread_exit, and the whole process with it, since no loop of the engine can be left so. It waits for the process's
// end here instead.
inline void stay_if_python_is_ending() {
  while (python_is_ending()) ::pause();
}

// As long as it lives, other threads run Python.
class LockGivenUp {
 public:
  LockGivenUp() : state_(PyEval_SaveThread()) {}
  LockGivenUp(const LockGivenUp&) = delete;
  LockGivenUp& operator=(const LockGivenUp&) = delete;
  // Lets pthread_exit through, should Python begin to end while this waits for the lock.
  ~LockGivenUp() noexcept(false) {
    stay_if_python_is_ending();
    PyEval_RestoreThread(state_);
  }

 private:
  PyThreadState* state_;
};

// As long as it lives, this thread may speak with Python. It has given up the lock before.
class LockTaken {
 public:
  LockTaken() {
    stay_if_python_is_ending();
    state_ = PyGILState_Ensure();
  }
  LockTaken(const LockTaken&) = delete;
  LockTaken& operator=(const LockTaken&) = delete;
  ~LockTaken() { PyGILState_Release(state_); }

 private:
  PyGILState_STATE state_{};
};

}  // namespace carom
