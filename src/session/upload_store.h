// UploadStore: the parts of large meshes and textures that a client has sent ahead, until a frame uses them.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <set>
#include <unordered_map>

#include "base/memory_budget.h"
#include "session/decode_frame.h"

namespace hl {

/// One thread.
class UploadStore {
 public:
  /// What is kept is counted against `memory`, and may take `most_bytes` of it.
  UploadStore(const MemoryBudget& memory, std::uint64_t most_bytes) : memory_(memory), most_bytes_(most_bytes) {}

  /// Whether it is beyond what a client may send ahead.
  bool tooLarge(const proto::Upload& upload) const { return bytes_ + bytesOf(upload) > most_bytes_; }
  /// Throws hl::Error when there is no memory for it; its other parts then stay.
  void add(proto::Upload upload);
  /// Drops what there is of it, and what comes: a frame that refers to it will not find it.
  void refuse(std::uint64_t id);
  bool refused(std::uint64_t id) const { return refused_.contains(id); }
  std::size_t refusals() const { return refused_.size(); }
  /// Those that the frame refers to; their memory goes over to `memory`.
  Uploads take(const proto::Frame& frame, MemoryShare& memory);

 private:
  std::uint64_t bytesOf(const proto::Upload& upload) const;
  template <typename Items>
  void take(const Items& items, Uploads& used, MemoryShare& memory);

  const MemoryBudget memory_;
  const std::uint64_t most_bytes_;
  Uploads uploads_;
  std::unordered_map<std::uint64_t, MemoryShare> shares_;  // by the id of the upload
  std::uint64_t bytes_ = 0;                                // of all of them
  std::set<std::uint64_t> refused_;                        // of which no part is kept
};

}  // namespace hl
