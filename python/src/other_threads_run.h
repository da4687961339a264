// Gives up the interpreter's lock while C++ computes or waits.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

/// As pybind11::gil_scoped_release, but safe in a daemon thread: when the interpreter has ended meanwhile, CPython ends
/// a thread that takes the lock by unwinding it, which no destructor of C++ survives. Here such a thread waits until
/// the process is gone.
class OtherThreadsRun {
 public:
  OtherThreadsRun() : state_(PyEval_SaveThread()) {}
  OtherThreadsRun(const OtherThreadsRun&) = delete;
  OtherThreadsRun& operator=(const OtherThreadsRun&) = delete;
  ~OtherThreadsRun() {
    try {
      PyEval_RestoreThread(state_);
    } catch (...) {  // only the unwinding comes here, and it must not go on
      for (;;) pause();
    }
  }

 private:
  PyThreadState* state_;
};
