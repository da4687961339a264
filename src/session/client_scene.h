// ClientScene: what the publisher of scenes keeps of one client.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "scene/editable_scene.h"
#include "session/check_bodies.h"
#include "session/decode_frame.h"

namespace hl {

/// What becomes of a client's frames; all three are needed. Called by the publisher's threads, one call at a time for
/// one client.
struct FrameCallbacks {
  std::function<void(std::uint64_t number, double part)> progress;
  std::function<void(std::uint64_t number, std::size_t primitives, const std::vector<std::string>& warnings)> shown;
  std::function<void(std::uint64_t number, const std::string& why)> refused;
};

class ScenePublisher;

/// A client's objects. Made by ScenePublisher::join(), shared with the publisher, which alone sees into it.
class ClientScene {
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
  struct Waiting {
    proto::Frame frame;
    Uploads uploads;
    MemoryShare memory;
    bool answers_force = false;  ///< see SceneEdit
    std::int64_t arrived_ns = 0;
  };
  enum class Work : std::uint8_t { kNone, kFrame, kHierarchies };
  struct Ready {
    std::uint64_t number;
    std::vector<std::string> warnings;
  };

  /// Calls back unless the client has gone.
  template <typename Call>
  void callBack(Call call) {
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
  bool to_rebuild_ = false;  // a hierarchy of what was placed last is
  struct Bodies {
    WorldParts parts;                                         // of what was placed last
    std::pair<std::uint64_t, Vec3> gravity{0, Vec3::Zero()};  // which of all clients' frames that set it; 0: none did
  } bodies_;
  struct Pace {
    std::int64_t last_arrived_ns = 0;  // of frames
    std::int64_t move_ns = 0;          // that what is placed takes to get there
  } pace_;
  PlacedShapes placed_;                    // what is to be shown next; null when it is as it was
  std::deque<Ready> ready_;                // frames that are built and not yet reported as shown
  std::shared_ptr<ClientScene> replaced_;  // goes with the first frame
};

}  // namespace hl
