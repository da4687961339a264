// Stands before the locks that can wait and before throw, for RealtimeGuard. Where a sanitizer watches them there is
// nothing here.
#ifndef HL_SANITIZED

#include <cxxabi.h>
#include <dlfcn.h>
#include <pthread.h>
#include <time.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <typeinfo>

#include "guard/realtime_guard.h"

namespace {

// The library's own function of this name; looked up when first called, which may be before any constructor has run.
template <typename Function>
Function* own(const char* name, std::atomic<Function*>& known) {
  Function* found = known.load(std::memory_order_relaxed);
  if (found == nullptr) {
    found = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
    if (found == nullptr) std::abort();
    known.store(found, std::memory_order_relaxed);
  }
  return found;
}

}  // namespace

// A function that the linker takes for the library's `name`; for the compiler it has a name of its own.
#define HL_HOOK(result, name, parameters, arguments)                                         \
  extern "C" [[gnu::visibility("default")]] result hl_hook_##name parameters __asm__(#name); \
  result hl_hook_##name parameters {                                                         \
    static constinit std::atomic<result(*) parameters> known{nullptr};                       \
    hl::RealtimeGuard::onCall(#name);                                                        \
    return own<result parameters>(#name, known) arguments;                                   \
  }

HL_HOOK(int, pthread_mutex_lock, (pthread_mutex_t * mutex), (mutex))
HL_HOOK(int, pthread_mutex_trylock, (pthread_mutex_t * mutex), (mutex))
HL_HOOK(int, pthread_mutex_timedlock, (pthread_mutex_t * mutex, const timespec* until), (mutex, until))
HL_HOOK(int, pthread_mutex_clocklock, (pthread_mutex_t * mutex, clockid_t clock, const timespec* until),
        (mutex, clock, until))
HL_HOOK(int, pthread_rwlock_rdlock, (pthread_rwlock_t * lock), (lock))
HL_HOOK(int, pthread_rwlock_tryrdlock, (pthread_rwlock_t * lock), (lock))
HL_HOOK(int, pthread_rwlock_wrlock, (pthread_rwlock_t * lock), (lock))
HL_HOOK(int, pthread_rwlock_trywrlock, (pthread_rwlock_t * lock), (lock))
HL_HOOK(int, pthread_cond_wait, (pthread_cond_t * condition, pthread_mutex_t* mutex), (condition, mutex))
HL_HOOK(int, pthread_cond_timedwait, (pthread_cond_t * condition, pthread_mutex_t* mutex, const timespec* until),
        (condition, mutex, until))
HL_HOOK(int, pthread_cond_clockwait,
        (pthread_cond_t * condition, pthread_mutex_t* mutex, clockid_t clock, const timespec* until),
        (condition, mutex, clock, until))
HL_HOOK(int, pthread_cond_signal, (pthread_cond_t * condition), (condition))
HL_HOOK(int, pthread_cond_broadcast, (pthread_cond_t * condition), (condition))
HL_HOOK(void*, __cxa_allocate_exception, (std::size_t size), (size))

extern "C" [[gnu::visibility("default"), noreturn]] void hl_hook_throw(void* thrown, std::type_info* type,
                                                                       void (*destroy)(void*)) __asm__("__cxa_throw");
void hl_hook_throw(void* thrown, std::type_info* type, void (*destroy)(void*)) {
  static constinit std::atomic<void (*)(void*, std::type_info*, void (*)(void*))> known{nullptr};
  hl::RealtimeGuard::onCall("__cxa_throw");
  own<void(void*, std::type_info*, void (*)(void*))>("__cxa_throw", known)(thrown, type, destroy);
  std::abort();
}

extern "C" [[gnu::visibility("default"), noreturn]] void hl_hook_rethrow() __asm__("__cxa_rethrow");
void hl_hook_rethrow() {
  static constinit std::atomic<void (*)()> known{nullptr};
  hl::RealtimeGuard::onCall("__cxa_rethrow");
  own<void()>("__cxa_rethrow", known)();
  std::abort();
}

#endif
