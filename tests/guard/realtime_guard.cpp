#include "guard/realtime_guard.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace hl {

namespace {

thread_local int guard_depth = 0;
thread_local std::uint64_t heap_calls = 0;

// write(2), not stdio: printing must not allocate.
void say(const char* text) { (void)!::write(STDERR_FILENO, text, std::strlen(text)); }

}  // namespace

RealtimeGuard::RealtimeGuard() { ++guard_depth; }
RealtimeGuard::~RealtimeGuard() { --guard_depth; }
std::uint64_t RealtimeGuard::heapCalls() { return heap_calls; }

void RealtimeGuard::onHeapCall() {
  ++heap_calls;
  onCall("the heap");
}

void RealtimeGuard::onCall(const char* what) {
  if (guard_depth == 0) return;
  guard_depth = 0;  // abort() may lock
  say("RealtimeGuard: a real-time scope calls ");
  say(what);
  say("\n");
  std::abort();
}

}  // namespace hl
