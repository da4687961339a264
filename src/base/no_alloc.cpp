#include "base/no_alloc.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <new>

namespace {

thread_local int guard_depth = 0;
thread_local std::uint64_t allocation_count = 0;

// write(2), not stdio: printing must not allocate.
void check() {
  ++allocation_count;
  if (guard_depth == 0) return;
  const char message[] = "NoAlloc: a heap call inside a scope that must not allocate\n";
  (void)!::write(STDERR_FILENO, message, sizeof(message) - 1);
  std::abort();
}

void* allocate(std::size_t size) {
  check();
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void* allocateAligned(std::size_t size, std::align_val_t alignment) {
  check();
  const auto align = static_cast<std::size_t>(alignment);
  void* memory = std::aligned_alloc(align, (size + align - 1) / align * align);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void release(void* memory) {
  if (memory != nullptr && guard_depth != 0) check();
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

namespace hl {

NoAlloc::NoAlloc() { ++guard_depth; }
NoAlloc::~NoAlloc() { --guard_depth; }
std::uint64_t NoAlloc::allocations() { return allocation_count; }

}  // namespace hl
