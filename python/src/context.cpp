// Contexts in Python: who is current, errors as exceptions, events as callbacks on the thread that polls.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <unistd.h>
#include <hl/hl.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "base/flag.h"
#include "bindings.h"
#include "calls.h"
#include "errors.h"
#include "other_threads_run.h"
#include "signals.h"

namespace py = pybind11;

namespace {

/// The first error that a call has made on this thread since the last one that was thrown.
struct Failure {
  HLenum code = HL_NO_ERROR;
  std::string text;
};
thread_local Failure failure;

void keepFailure(HLenum code, const char* text, void* lost) {
  if (failure.code == HL_NO_ERROR) failure = {code, text};
  if (code == HL_CONNECTION_LOST) *static_cast<std::string*>(lost) = text;
}

/// The thread may be without a context then, and its error is kept elsewhere.
[[noreturn]] void throwOfThread(HLenum otherwise, const char* text) {
  throwFailure();
  const HLenum code = hlGetError();
  throw CallFailed(code != HL_NO_ERROR ? code : otherwise, text);
}

/// Python's threads can be joined before C++ has destroyed their variables, where HL lets go of a thread's context; so
/// it goes with Python's own variables of the thread.
void letGoWithThread() {
  constexpr const char* kName = "hl.context";
  const auto variables = py::reinterpret_borrow<py::dict>(PyThreadState_GetDict());
  if (variables && !variables.contains(kName)) variables[kName] = py::capsule([] { hlMakeCurrent(nullptr); });
}

class Context {
 public:
  explicit Context(const std::string& url) : context_(open(url)) {
    hlErrorFunc(&keepFailure, &lost_);
    letGoWithThread();
    current_ = this;
  }
  /// A context that is current on another thread cannot be destroyed here; it ends with the process.
  ~Context() {
    try {
      close();
    } catch (const CallFailed&) {
      static_cast<void>(context_.release());
    }
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  bool isOpen() const { return context_ != nullptr; }
  bool isCurrent() const { return context_ && hlGetCurrentContext() == context_->get(); }
  void makeCurrent() {
    if (!context_) throw CallFailed(HL_INVALID_OPERATION, "the connection is closed");
    if (!isCurrent()) takeOver();
    current_ = this;
  }
  /// As makeCurrent(), for a call that needs the server.
  void makeCurrentAndLive() {
    makeCurrent();
    requireLive();
  }
  /// hl.h reports the end of a conversation once; here every call after it throws it, so that no loop goes on with what
  /// was felt last.
  void requireLive() const {
    if (!lost_.empty()) throw CallFailed(HL_CONNECTION_LOST, lost_);
  }
  /// The thread's; null: it has none.
  static const Context* current() { return current_ != nullptr && current_->isCurrent() ? current_ : nullptr; }
  /// Twice is allowed. Within a callback of poll() it throws, and the connection stays open.
  void close() {
    if (!context_) return;
    if (polls_) throw CallFailed(HL_INVALID_OPERATION, "close: not in a callback of poll; close it afterwards");
    if (!isOfAnotherProcess()) makeCurrent();
    current_ = nullptr;
    const OtherThreadsRun other_threads_run;
    context_.reset();
  }
  void onEvent(HLenum kind, std::function<void(const HLevent&)> function) {
    makeCurrentAndLive();
    context_->onEvent(kind, std::move(function));
    throwFailure();
  }
  int poll() {
    makeCurrentAndLive();
    if (polls_) throw CallFailed(HL_INVALID_OPERATION, "hlPoll: not in a callback of hlPoll");
    const hl::Flag polls(polls_);  // a callback may throw
    const int delivered = context_->poll();
    throwFailure();
    return delivered;
  }

 private:
  bool isOfAnotherProcess() const { return made_in_ != getpid(); }

  void takeOver() {
    if (isOfAnotherProcess())
      throw CallFailed(HL_INVALID_OPERATION,
                       "the connection is of the process that this one was forked from; use multiprocessing's spawn");
    if (hlMakeCurrent(context_->get()) == HL_FALSE)
      throwOfThread(HL_INVALID_OPERATION, "the context is current on another thread");
    letGoWithThread();
  }

  static std::unique_ptr<hl::Context> open(const std::string& url) {
    try {
      const OtherThreadsRun other_threads_run;
      return std::make_unique<hl::Context>(url);
    } catch (const hl::CallError& error) {
      throw CallFailed(HL_NO_CONTEXT, error.what());
    }
  }

  inline static thread_local Context* current_ = nullptr;  // may be that of a context that is current no more

  const pid_t made_in_ = getpid();
  bool polls_ = false;  ///< within poll(), where callbacks run
  std::string lost_;    ///< why the conversation has ended; empty: it has not
  std::unique_ptr<hl::Context> context_;
};

bool finishTimeout(double seconds) {
  requireContext();
  const double slice_s = std::chrono::duration<double>(kHearingPeriod).count();
  for (double left_s = seconds;; left_s -= slice_s) {
    bool all_is_shown = false;
    {
      const OtherThreadsRun other_threads_run;
      all_is_shown = hlFinishTimeout(std::min(left_s, slice_s)) != HL_FALSE;
    }
    throwFailure();
    if (all_is_shown || left_s <= slice_s) return all_is_shown;
    hearSignals();
  }
}

void finish() { finishTimeout(std::numeric_limits<double>::max()); }

void bindEvent(py::module_& module) {
  py::class_<HLevent>(module, "Event")
      .def_readonly("kind", &HLevent::kind)
      .def_readonly("time", &HLevent::time)
      .def_readonly("object", &HLevent::object)
      .def_readonly("name", &HLevent::name)
      .def_property_readonly("position", [](const HLevent& event) { return py::array_t<double>(3, event.position); })
      .def_readonly("button", &HLevent::button)
      .def_property_readonly("down", [](const HLevent& event) { return event.down != HL_FALSE; })
      .def_readonly("impulse", &HLevent::impulse);
}

}  // namespace

void throwFailure() {
  if (failure.code == HL_NO_ERROR) return;
  const Failure first = std::exchange(failure, {});
  throw CallFailed(first.code, first.text);
}

void requireContext() {
  if (hlGetCurrentContext() == nullptr)
    throw CallFailed(HL_INVALID_OPERATION, "this thread has no current context; hl.connect makes one");
  if (const Context* const context = Context::current()) context->requireLive();
}

void bindContext(py::module_& module) {
  bindEvent(module);
  py::class_<Context>(module, "Context")
      .def(py::init<const std::string&>(), py::arg("url"))
      .def_property_readonly("is_open", &Context::isOpen)
      .def_property_readonly("is_current", &Context::isCurrent)
      .def("make_current", &Context::makeCurrentAndLive)
      .def("close", &Context::close)
      .def("on_event", &Context::onEvent, py::arg("kind"), py::arg("function"))
      .def("poll", &Context::poll);
}

void bindWaitingCalls(py::module_& module) {
  module.def("hlFinish", &finish);
  module.def("hlFinishTimeout", &finishTimeout, py::arg("seconds"));
}

void bindCalls(py::module_& module) {
  bindContext(module);
  py::module_ calls = module.def_submodule("calls");
  bindWaitingCalls(calls);
  bindPlainCalls(calls);
  bindArrayCalls(calls);
  bindConstants(calls);
}
