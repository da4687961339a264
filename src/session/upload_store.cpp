#include "session/upload_store.h"

#include <utility>

namespace hl {

namespace {

constexpr std::size_t kUpload_bytes = 512;  // of memory, for each besides its parts
constexpr std::size_t kPart_bytes = 64;     // for each part besides its message

}  // namespace

// In memory a message may be many times what it was on the wire: an empty polygon is two bytes there.
std::uint64_t UploadStore::bytesOf(const proto::Upload& upload) const {
  const bool fresh = !uploads_.contains(upload.id());
  return (fresh ? kUpload_bytes : 0) + kPart_bytes + bytesOfMessage(upload.part().SpaceUsedLong());
}

void UploadStore::add(proto::Upload upload) {
  const std::uint64_t bytes = bytesOf(upload);
  MemoryShare memory(memory_);
  memory.take(bytes);
  uploads_[upload.id()].push_back(std::move(*upload.mutable_part()));
  shares_.try_emplace(upload.id(), memory_).first->second.add(std::move(memory));
  bytes_ += bytes;
}

void UploadStore::refuse(std::uint64_t id) {
  const auto share = shares_.extract(id);
  if (share) bytes_ -= share.mapped().bytes();
  uploads_.erase(id);
  refused_.insert(id);
}

template <typename Items>
void UploadStore::take(const Items& items, Uploads& used, MemoryShare& memory) {
  for (const auto& item : items) {
    if (!item.has_upload()) continue;
    refused_.erase(item.upload());
    auto parts = uploads_.extract(item.upload());
    if (!parts) continue;
    auto share = shares_.extract(item.upload());
    bytes_ -= share.mapped().bytes();
    memory.add(std::move(share.mapped()));
    used.insert(std::move(parts));
  }
}

Uploads UploadStore::take(const proto::Frame& frame, MemoryShare& memory) {
  Uploads used;
  for (const proto::ObjectDefinition& object : frame.objects()) take(object.items(), used, memory);
  take(frame.world().items(), used, memory);
  take(frame.moved(), used, memory);
  return used;
}

}  // namespace hl
