// HugeVector: a vector whose memory, when it is large, lies in pages of 2 MiB where Linux grants them. A walk through a
// hierarchy of gigabytes jumps: with pages of 4 KiB each jump costs a walk through the page tables beside the miss.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace hl {

/// What std::allocator does, for small pieces; large ones begin at a huge page and ask for more of them.
template <typename T>
class HugePageAllocator {
 public:
  using value_type = T;  // NOLINT(readability-identifier-naming): named by the standard
  HugePageAllocator() = default;
  template <typename Other>
  HugePageAllocator(const HugePageAllocator<Other>&) {}  // NOLINT: implicit, as the standard wants it

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kHuge) return std::allocator<T>().allocate(count);
    void* memory = std::aligned_alloc(kHuge, (bytes + kHuge - 1) / kHuge * kHuge);
    if (memory == nullptr) throw std::bad_alloc();
    madvise(memory, bytes, MADV_HUGEPAGE);  // refused where there are none: then small pages have to do
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    if (count * sizeof(T) < kHuge) return std::allocator<T>().deallocate(memory, count);
    std::free(memory);  // NOLINT: from aligned_alloc
  }
  bool operator==(const HugePageAllocator&) const { return true; }

 private:
  static constexpr std::size_t kHuge = std::size_t{1} << 21;
};

template <typename T>
using HugeVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace hl
