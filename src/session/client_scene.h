// ClientScene: what the publisher keeps of one client. Only its own source file includes this.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "session/scene_publisher.h"

namespace hl {

class ScenePublisher::ClientScene {
 public:
  ClientScene(std::uint32_t session, const SceneLimits& limits, MemoryBudget memory, FrameCallbacks callbacks,
              std::shared_ptr<ClientScene> replaced)
      : session_(session),
        limits_(limits),
        memory_(std::move(memory)),
        scene_(session, limits, memory_),
        callbacks_(std::move(callbacks)),
        replaced_(std::move(replaced)) {}

 private:
  friend class ScenePublisher;
  enum class Work : std::uint8_t { kNone, kFrame, kHierarchies };
  struct Ready {
    std::uint64_t number;
    std::vector<std::string> warnings;
  };

  /// Calls back unless the client has gone.
  template <typename Call>
  void tell(Call call) {
    const std::lock_guard lock(call_mutex_);
    if (callbacks_.shown) call(callbacks_);
  }

  const std::uint32_t session_;
  const SceneLimits limits_;
  const MemoryBudget memory_;
  EditableScene scene_;  // of the builder that has set work_
  std::mutex call_mutex_;
  FrameCallbacks callbacks_;
  struct Shown {
    std::vector<const Instance*> instances;  // by rising key
    PlacedShapes placed;                     // what they were made from
  } shown_;                                  // of the publisher's thread
  // Under the publisher's mutex:
  std::deque<Waiting> waiting_;
  Work work_ = Work::kNone;  // of a builder
  bool removed_ = false;
  bool to_rebuild_ = false;           // a hierarchy of what was placed last is
  std::size_t bodies_ = 0;            // that move, of what was placed last
  std::uint64_t gravity_number_ = 0;  // of the last frame that set it, among those of all clients; 0: none did
  Vec3 gravity_m_s2_ = Vec3::Zero();
  std::int64_t last_arrived_ns_ = 0;
  std::int64_t move_ns_ = 0;               // that what is placed takes to get there
  PlacedShapes placed_;                    // what is to be shown next; null when it is as it was
  std::deque<Ready> ready_;                // frames that are built and not yet told to be shown
  std::shared_ptr<ClientScene> replaced_;  // goes with the first frame
};

struct ScenePublisher::Part {
  std::shared_ptr<ClientScene> client;
  bool gone;
  PlacedShapes placed;  // null: as it is
  std::int64_t move_ns;
  std::size_t frames;                  // of the client's ready ones
  std::size_t jumps;                   // Followed::jumps
  std::vector<const Instance*> shown;  // of the client, in the next scene
};

}  // namespace hl
