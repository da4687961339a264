// Ctrl-C while a call of C++ computes or waits: Python hears signals only when it is asked to.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>
#include <optional>

#include "other_threads_run.h"

/// How late Ctrl-C is heard.
inline constexpr std::chrono::milliseconds kHearingPeriod{50};

/// Throws what a handler of a signal has raised, such as KeyboardInterrupt. With the interpreter's lock; only Python's
/// main thread has something to hear.
inline void hearSignals() {
  if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
}

/// Whether this is the thread that hears signals. Another one must not take the interpreter's lock on the way: when the
/// interpreter has ended meanwhile, a thread that asks for it is ended too, in the middle of C++.
inline bool isMainThread() {
  const pybind11::object main = pybind11::module_::import("threading").attr("main_thread")();
  return main.attr("ident").cast<unsigned long>() == PyThread_get_thread_ident();
}

/// Runs `call` on a thread of its own, without the interpreter's lock, while this one hears signals. When a handler
/// raises, `stop` becomes true, so that `call` ends early, and what was raised is thrown; else what `call` throws. For
/// the main thread.
template <typename Call>
void runHearingSignals(std::atomic<bool>& stop, const Call& call) {
  std::optional<pybind11::error_already_set> raised;
  std::future<void> ended = std::async(std::launch::async, call);
  {
    const OtherThreadsRun other_threads_run;
    while (!raised && ended.wait_for(kHearingPeriod) != std::future_status::ready) {
      const pybind11::gil_scoped_acquire lock;
      if (PyErr_CheckSignals() == 0) continue;
      raised.emplace();
      stop = true;
    }
    ended.wait();
  }
  if (raised) throw pybind11::error_already_set(*raised);
  ended.get();
}
