// NoAlloc: a guard for tests. While it lives, any heap allocation by this thread aborts with a message.
// Works only in programs that link the object library hl_no_alloc, which replaces malloc's callers.
#pragma once

#include <cstdint>

namespace hl {

/// Scope in which the calling thread must not allocate or free; the first that does prints and aborts.
class NoAlloc {
 public:
  NoAlloc();
  ~NoAlloc();
  NoAlloc(const NoAlloc&) = delete;
  NoAlloc& operator=(const NoAlloc&) = delete;
  /// Allocations by this thread so far, guarded or not: proves in a test that the hooks are alive.
  static std::uint64_t allocations();
};

}  // namespace hl
