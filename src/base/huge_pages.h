// HugeVector: a vector whose memory, when it is large, lies in pages of 2 MiB where Linux grants them. A walk through a
// hierarchy of gigabytes jumps: with pages of 4 KiB each jump costs a walk through the page tables beside the miss.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace hl {

/// Large pieces of memory come from Linux and go back to it: what malloc() keeps for later lies in small pages, and
/// filling it anew then takes three times as long as the whole refit of a hierarchy.
class HugePages {
 public:
  /// At least this large, bytes: then it is worth a page of its own.
  static constexpr std::size_t kPage = std::size_t{1} << 21;

  /// Starts at a huge page; zero until written. Throws bad_alloc.
  ///
  /// Asked for without access first: where memory is locked (mlockall), Linux fills what can be accessed at once, with
  /// small pages unless it has been set otherwise before.
  static void* allocate(std::size_t bytes) {
    const std::size_t size = rounded(bytes), room = size + kPage;
    void* mapped = mmap(nullptr, room, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();  // NOLINT: the system's macro casts
    auto* first = static_cast<std::byte*>(mapped);
    const std::size_t before = (kPage - reinterpret_cast<std::uintptr_t>(first) % kPage) % kPage;
    if (before > 0) munmap(first, before);
    std::byte* memory = first + before;
    munmap(memory + size, kPage - before);
    madvise(memory, size, MADV_HUGEPAGE);  // refused where there are none: then small ones have to do
    if (mprotect(memory, size, PROT_READ | PROT_WRITE) == 0) return memory;
    munmap(memory, size);
    throw std::bad_alloc();
  }
  static void free(void* memory, std::size_t bytes) { munmap(memory, rounded(bytes)); }
  /// Moves what another allocator holds into huge pages, where it stays in place for all who use it. Where Linux has no
  /// room for that, or is older than 6.1, nothing changes.
  static void collapse(const void* memory, std::size_t bytes) {
    constexpr int kMadvCollapse = 25;  // MADV_COLLAPSE, which libraries older than it do not name
    const auto begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t first = rounded(begin), end = (begin + bytes) / kPage * kPage;
    if (first < end) madvise(reinterpret_cast<void*>(first), end - first, kMadvCollapse);  // NOLINT: an address
  }

 private:
  static std::size_t rounded(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }
};

/// Small pieces as std::allocator. What is made without arguments stays unwritten, so that the threads that fill it are
/// the first to touch its pages.
template <typename T>
class HugePageAllocator {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;  // NOLINT(readability-identifier-naming): named by the standard
  HugePageAllocator() = default;
  template <typename Other>
  HugePageAllocator(const HugePageAllocator<Other>&) {}  // NOLINT: implicit, as the standard wants it

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    return bytes < HugePages::kPage ? std::allocator<T>().allocate(count) : static_cast<T*>(HugePages::allocate(bytes));
  }
  void deallocate(T* memory, std::size_t count) {
    if (count * sizeof(T) < HugePages::kPage) return std::allocator<T>().deallocate(memory, count);
    HugePages::free(memory, count * sizeof(T));
  }
  template <typename Made, typename... Arguments>
  void construct(Made* at, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) == 0) {
      ::new (static_cast<void*>(at)) Made;
    } else {
      ::new (static_cast<void*>(at)) Made(std::forward<Arguments>(arguments)...);
    }
  }
  bool operator==(const HugePageAllocator&) const { return true; }
};

template <typename T>
using HugeVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace hl
