#include "client/call.h"

namespace hl::client {

namespace {

// Known at compile time, so that reading it, as every hlVertex does, is one load.
constinit thread_local HLcontext* current = nullptr;

// Lets go of the context when its thread ends, so that another thread can have it.
struct LetGo {
  ~LetGo() {
    if (current != nullptr) current->current = false;
    current = nullptr;
  }
};

}  // namespace

HLcontext* currentContext() noexcept { return current; }

void setCurrentContext(HLcontext* context) {
  static thread_local LetGo let_go;
  if (context == current) return;
  if (context != nullptr && context->current.exchange(true))
    throw Fault(HL_INVALID_OPERATION, "the context is current on another thread");
  if (current != nullptr) current->current = false;
  current = context;
}

ErrorState& threadErrors() noexcept {
  static thread_local ErrorState errors;
  return errors;
}

ErrorState& currentErrors() noexcept { return current != nullptr ? current->errors : threadErrors(); }

void requireAllowed(const HLcontext& context, When when) {
  if (when == When::kAlways) return;
  const bool between = context.recorder.isOpen();
  if (when == When::kBetween && !between) throw Fault(HL_INVALID_OPERATION, "only after hlBegin");
  if (when != When::kBetween && between) throw Fault(HL_INVALID_OPERATION, "not between hlBegin and hlEnd");
  if (when == When::kNotInDefinition && context.definition)
    throw Fault(HL_INVALID_OPERATION, "not between hlNewObject and hlEndObject");
}

}  // namespace hl::client
