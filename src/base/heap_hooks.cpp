// Stands before the heap's functions, for RealtimeGuard and FailingAllocation. Where a sanitizer has the C library's,
// only operator new and delete are ours.
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "base/failing_allocation.h"
#include "base/realtime_guard.h"

#define HL_HOOK extern "C" [[gnu::visibility("default")]]

#ifndef HL_SANITIZED

// The C library's own, by the names under which glibc keeps them for such as this.
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);
extern "C" void* __libc_realloc(void* memory, std::size_t size);
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t size);
extern "C" void __libc_free(void* memory);

HL_HOOK void* malloc(std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  return __libc_malloc(size);
}

HL_HOOK void* calloc(std::size_t count, std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  return __libc_calloc(count, size);
}

HL_HOOK void* realloc(void* memory, std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  return __libc_realloc(memory, size);
}

// Boost.Asio's way to memory.
HL_HOOK void* aligned_alloc(std::size_t alignment, std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  return hl::FailingAllocation::isNow() ? nullptr : __libc_memalign(alignment, size);
}

HL_HOOK void* memalign(std::size_t alignment, std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  return __libc_memalign(alignment, size);
}

HL_HOOK int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  hl::RealtimeGuard::onHeapCall();
  void* const found = __libc_memalign(alignment, size);
  if (found == nullptr) return ENOMEM;
  *memory = found;
  return 0;
}

HL_HOOK void free(void* memory) {
  if (memory != nullptr) hl::RealtimeGuard::onHeapCall();
  __libc_free(memory);
}

#endif

namespace {

void* allocate(std::size_t size) {
#ifdef HL_SANITIZED
  hl::RealtimeGuard::onHeapCall();
#endif
  void* const memory = hl::FailingAllocation::isNow() ? nullptr : std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void* allocateAligned(std::size_t size, std::align_val_t alignment) {
#ifdef HL_SANITIZED
  hl::RealtimeGuard::onHeapCall();
#endif
  const auto align = static_cast<std::size_t>(alignment);
  void* memory = nullptr;
  if (hl::FailingAllocation::isNow() || posix_memalign(&memory, align, size == 0 ? 1 : size) != 0)
    throw std::bad_alloc();
  return memory;
}

void release(void* memory) {
#ifdef HL_SANITIZED
  if (memory != nullptr) hl::RealtimeGuard::onHeapCall();
#endif
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return allocateAligned(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return allocateAligned(size, alignment); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
