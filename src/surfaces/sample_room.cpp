#include "surfaces/sample_room.h"

#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/huge_pages.h"

namespace hl {

SampleRoom::SampleRoom(std::size_t bytes) : bytes_(bytes) {
  HugePageAllocator<std::byte> allocator;
  memory_ = {allocator.allocate(bytes),
             [bytes](std::byte* memory) { HugePageAllocator<std::byte>().deallocate(memory, bytes); }};
}

void SampleRoom::add(const void* samples, std::size_t bytes) {
  if (bytes > bytes_ - filled_) throw Error("it has more samples than it says");
  std::memcpy(memory_.get() + filled_, samples, bytes);
  filled_ += bytes;
}

std::shared_ptr<const void> SampleRoom::take() {
  if (!whole()) throw Error("it has fewer samples than it says");
  return std::move(memory_);
}

}  // namespace hl
