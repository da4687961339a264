// ClientScene: the objects of one client, on their way from its frames to the scene that is shown. Each part is for one
// owner.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "scene/editable_scene.h"
#include "session/check_bodies.h"
#include "session/client_callbacks.h"
#include "session/client_frames.h"

namespace hl {

struct ClientScene;

/// Of the builder that ClientTable has given the client to.
struct BuiltObjects {
  EditableScene scene;
  std::int64_t last_arrived_ns = 0;  ///< of the frames that it was built from
};

/// What passes from thread to thread: of ClientTable, under its mutex.
struct ClientEntry {
  enum class Work : std::uint8_t { kNone, kFrame, kHierarchies };

  std::deque<WaitingFrame> waiting;
  Work work = Work::kNone;  ///< of a builder
  bool removed = false;
  std::deque<ReadyFrame> ready;  ///< not yet reported as shown

  PlacedShapes placed;       ///< what is to be shown next; null when it is as it was
  std::int64_t move_ns = 0;  ///< that it takes to get there
  WorldParts bodies;         ///< of what was placed last
  bool outdated = false;     ///< a hierarchy of it is
  /// With the number, of all frames that set it, of the one that did; 0: none did.
  std::pair<std::uint64_t, Vec3> gravity_m_s2{0, Vec3::Zero()};
  std::shared_ptr<ClientScene> replaced;  ///< goes with the first frame

  bool hasFrame() const { return isIdle() && !waiting.empty(); }
  /// All that it has is shown, so that no frame waits for what is built anew.
  bool mayRebuild() const { return isIdle() && outdated && waiting.empty() && !placed && ready.empty(); }
  /// Those that are submitted and neither shown nor refused.
  std::size_t frames() const { return waiting.size() + (work == Work::kFrame ? 1 : 0) + ready.size(); }

 private:
  bool isIdle() const { return work == Work::kNone && !removed; }
};

/// Of the publisher's thread.
struct ShownObjects {
  std::vector<const Instance*> instances;  ///< by rising key
  PlacedShapes placed;                     ///< what they were made from
};

/// Made by ClientTable::join(). Whoever joins keeps a pointer to it and does not look into it.
struct ClientScene {
  ClientScene(std::uint32_t its_session, const SceneLimits& its_limits, const MemoryBudget& its_memory,
              FrameCallbacks its_callbacks)
      : session(its_session),
        limits(its_limits),
        memory(its_memory),
        callbacks(std::move(its_callbacks)),
        built{EditableScene(session, limits, memory)} {}

  const std::uint32_t session;
  const SceneLimits limits;
  const MemoryBudget memory;  ///< what the client makes the server keep is counted here
  ClientCallbacks callbacks;
  BuiltObjects built;
  ClientEntry entry;
  ShownObjects shown;
};

}  // namespace hl
