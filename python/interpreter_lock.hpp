// Python's interpreter lock, released while the engine works and taken again for calls into Python.
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

// When Python ends a daemon thread may still be at work. If it asked for the lock, Python would end it as if by
// pthread_exit, and with it the whole process, since the loops of the engine cannot be left in this way. So it waits
// here for the end of the process.
inline void stay_if_python_is_ending() {
  while (python_is_ending()) ::pause();
}

// During its life other threads run Python.
class LockGivenUp {
 public:
  LockGivenUp() : state_(PyEval_SaveThread()) {}
  LockGivenUp(const LockGivenUp&) = delete;
  LockGivenUp& operator=(const LockGivenUp&) = delete;
  // Lets pthread_exit through, in case Python begins to end while this waits for the lock.
  ~LockGivenUp() noexcept(false) {
    stay_if_python_is_ending();
    PyEval_RestoreThread(state_);
  }

 private:
  PyThreadState* state_;
};

// During its life this thread, which has released the lock before, may call Python.
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
