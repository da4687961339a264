// The C boundary: finds the thread's context, checks that the call is allowed now, and turns every exception into an
// error of the context. No exception leaves an hl call.
#pragma once

#include <hl/hl_types.h>

#include <algorithm>
#include <type_traits>
#include <vector>

#include "client/context.h"
#include "client/fault.h"

namespace hl::client {

/// Set by setCurrentContext only. constinit: reading it, as every hlVertex does, is one load.
extern constinit thread_local HLcontext* current_context;
/// The context that is current on this thread; null: none.
inline HLcontext* currentContext() noexcept { return current_context; }
/// Throws Fault when it is current on another thread, or of another process.
void setCurrentContext(HLcontext* context);
/// Why the thread has none, for errors.
const char* whyNoContext() noexcept;
/// Errors of calls without a context.
ErrorState& threadErrors() noexcept;
/// Errors of the current context; where there is none, those of calls without a context.
ErrorState& currentErrors() noexcept;

enum class When {
  kAlways,           ///< also between hlBegin and hlEnd
  kBetween,          ///< only between hlBegin and hlEnd
  kOutside,          ///< only outside of hlBegin and hlEnd: most calls
  kNotInDefinition,  ///< only outside of hlBegin and hlEnd, and of hlNewObject and hlEndObject
};

/// Throws Fault HL_INVALID_OPERATION.
void requireAllowed(const HLcontext& context, When when);

/// Runs `body` on the thread's context and returns what it returns; at an error `otherwise`. `function`: for the
/// error's text.
template <typename Result, typename Body>
Result callOr(Result otherwise, const char* function, When when, Body body) noexcept {
  HLcontext* context = currentContext();
  if (context == nullptr) {
    threadErrors().note(HL_NO_CONTEXT, function, whyNoContext());
    return otherwise;
  }
  try {
    requireAllowed(*context, when);
    return body(*context);
  } catch (...) {
    noteCurrentException(context->errors, function);
    return otherwise;
  }
}

template <typename Body>
void call(const char* function, When when, Body body) noexcept {
  callOr(0, function, when, [&](HLcontext& context) {
    body(context);
    return 0;
  });
}

template <typename Body>
void call(const char* function, Body body) noexcept {
  call(function, When::kOutside, body);
}

/// Writes up to `most` of what `list` gives of the context, and returns how many; 0 at an error.
template <typename Row>
HLsizei getList(const char* function, HLsizei most, Row* rows, std::vector<Row> (*list)(const HLcontext&)) noexcept {
  return callOr<HLsizei>(0, function, When::kOutside, [&](HLcontext& context) {
    requireList(most, rows);
    const std::vector<Row> all = list(context);
    const std::size_t count = std::min(static_cast<std::size_t>(most), all.size());
    std::copy_n(all.begin(), count, rows);
    return static_cast<HLsizei>(count);
  });
}

}  // namespace hl::client
