// Stands before the heap's functions, for RealtimeGuard and FailingAllocation. Where a sanitizer has the C library's,
// only operator new and delete are ours.
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "guard/failing_allocation.h"
#include "guard/realtime_guard.h"

#define HL_HEAP_HOOK extern "C" [[gnu::visibility("default")]]

#ifndef HL_SANITIZED

// The C library's own, by the names under which glibc keeps them for such as this.
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);
extern "C" void* __libc_realloc(void* memory, std::size_t size);
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t size);
extern "C" void __libc_free(void* memory);

HL_HEAP_HOOK void* malloc(std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  return __libc_malloc(size);
}

HL_HEAP_HOOK void* calloc(std::size_t count, std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  return __libc_calloc(count, size);
}

HL_HEAP_HOOK void* realloc(void* memory, std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  return __libc_realloc(memory, size);
}

// Boost.Asio's way to memory.
HL_HEAP_HOOK void* aligned_alloc(std::size_t alignment, std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  return hl::FailingAllocation::isNow() ? nullptr : __libc_memalign(alignment, size);
}

HL_HEAP_HOOK void* memalign(std::size_t alignment, std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  return __libc_memalign(alignment, size);
}

HL_HEAP_HOOK int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  void* const found = __libc_memalign(alignment, size);
  if (found == nullptr) return ENOMEM;
  *memory = found;
  return 0;
}

HL_HEAP_HOOK void free(void* memory) {
  if (memory != nullptr) hl::RealtimeGuard::onHeapCall();
  __libc_free(memory);
}

#endif

namespace {

// Null: there is none.
void* tryToAllocate(std::size_t size) noexcept {
#ifdef HL_SANITIZED
  hl::RealtimeGuard::onHeapCall();
#endif
  return hl::FailingAllocation::isNow() ? nullptr : std::malloc(size == 0 ? 1 : size);
}

void* tryToAllocate(std::size_t size, std::align_val_t alignment) noexcept {
#ifdef HL_SANITIZED
  hl::RealtimeGuard::onHeapCall();
#endif
  const auto align = static_cast<std::size_t>(alignment);
  void* memory = nullptr;
  if (hl::FailingAllocation::isNow() || posix_memalign(&memory, align, size == 0 ? 1 : size) != 0) return nullptr;
  return memory;
}

void* orThrow(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void release(void* memory) {
#ifdef HL_SANITIZED
  if (memory != nullptr) hl::RealtimeGuard::onHeapCall();
#endif
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return orThrow(tryToAllocate(size)); }
void* operator new[](std::size_t size) { return orThrow(tryToAllocate(size)); }
void* operator new(std::size_t size, std::align_val_t align) { return orThrow(tryToAllocate(size, align)); }
void* operator new[](std::size_t size, std::align_val_t align) { return orThrow(tryToAllocate(size, align)); }
// Of algorithms that do with less: sanitizers would answer these themselves, and not know the memory when it is freed.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return tryToAllocate(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return tryToAllocate(size); }
void* operator new(std::size_t size, std::align_val_t align, const std::nothrow_t&) noexcept {
  return tryToAllocate(size, align);
}
void* operator new[](std::size_t size, std::align_val_t align, const std::nothrow_t&) noexcept {
  return tryToAllocate(size, align);
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t, const std::nothrow_t&) noexcept { release(memory); }
