#include "client/call.h"

#include <pthread.h>

namespace hl::client {

constinit thread_local HLcontext* current_context = nullptr;

namespace {

// Lets go of the context when its thread ends, so that another thread can have it.
struct LetGo {
  ~LetGo() {
    if (current_context != nullptr) current_context->current = false;
    current_context = nullptr;
  }
};

bool left_by_fork = false;  // of the thread that forked, which is the child's only one

// The threads and sockets behind the context stay with the parent: here its calls would wait for ever.
void leaveInChild() {
  left_by_fork = current_context != nullptr;
  current_context = nullptr;
}

}  // namespace

const char* whyNoContext() noexcept {
  return left_by_fork ? "the context is of the process that this one was forked from"
                      : "the thread has no current context";
}

void setCurrentContext(HLcontext* context) {
  static thread_local LetGo let_go;
  static const int leaves_at_fork = pthread_atfork(nullptr, nullptr, &leaveInChild);
  static_cast<void>(leaves_at_fork);
  if (context == current_context) return;
  if (context != nullptr && context->isOfAnotherProcess())
    throw Fault(HL_INVALID_OPERATION, "the context is of the process that this one was forked from");
  if (context != nullptr && context->current.exchange(true))
    throw Fault(HL_INVALID_OPERATION, "the context is current on another thread");
  if (current_context != nullptr) current_context->current = false;
  current_context = context;
  left_by_fork = false;
}

ErrorState& threadErrors() noexcept {
  static thread_local ErrorState errors;
  return errors;
}

ErrorState& currentErrors() noexcept { return current_context != nullptr ? current_context->errors : threadErrors(); }

void requireAllowed(const HLcontext& context, When when) {
  if (when == When::kAlways) return;
  const bool between = context.recorder.isOpen();
  if (when == When::kBetween && !between) throw Fault(HL_INVALID_OPERATION, "only after hlBegin");
  if (when != When::kBetween && between) throw Fault(HL_INVALID_OPERATION, "not between hlBegin and hlEnd");
  if (when == When::kNotInDefinition && context.definition)
    throw Fault(HL_INVALID_OPERATION, "not between hlNewObject and hlEndObject");
}

}  // namespace hl::client
