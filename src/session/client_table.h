// ClientTable: where the clients' objects pass from thread to thread: from those who submit frames to a builder, and
// from builders to the publisher. It alone locks what they share; no thread builds or waits for the loops meanwhile.
#pragma once

#include <hl.pb.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "base/memory_budget.h"
#include "scene/placed_shape.h"
#include "scene/scene_limits.h"
#include "session/body_admission.h"
#include "session/client_callbacks.h"
#include "session/client_frames.h"
#include "session/client_list.h"
#include "session/scene_parts.h"

namespace hl {

/// Hierarchies of clients' shapes since the start.
struct HierarchyCounts {
  std::uint64_t refits = 0;    ///< of redefined objects
  std::uint64_t rebuilds = 0;  ///< of those that were outdated
};

/// For a builder.
struct BuilderWork {
  std::shared_ptr<ClientScene> client;
  std::optional<WaitingFrame> frame;  ///< absent: an outdated hierarchy is to be built anew
};

class ClientTable {
 public:
  /// `base`: what the scene beside the clients has. `devices`: how many touch it.
  ClientTable(const WorldParts& base, std::size_t devices) : admission_(base, devices) {}

  // Any thread.
  /// What the client makes the server keep is counted against `memory`. `replaced`, if any, goes in the very scene that
  /// shows the first frame.
  std::shared_ptr<ClientScene> join(std::uint32_t session, const SceneLimits& limits, const MemoryBudget& memory,
                                    FrameCallbacks callbacks, std::shared_ptr<ClientScene> replaced = {});
  /// Returns at once. `uploads`: those that the frame refers to. `memory`: what both take, until it is built.
  void submit(const std::shared_ptr<ClientScene>& client, proto::Frame frame, Uploads uploads, MemoryShare memory,
              bool answers_force = false);
  /// For a client within this process, which submits no frames: its objects from now on, in the place of those before;
  /// they take `move_ns` to get there. Throws hl::Error, and changes nothing, for bodies and joints that cannot be
  /// made. One at a time for a client; it may take long where bodies are new.
  void place(const std::shared_ptr<ClientScene>& client, PlacedShapes placed, std::int64_t move_ns);
  /// Frames that are submitted and not yet shown or refused.
  std::size_t waiting(const std::shared_ptr<ClientScene>& client) const;
  /// No callback is under way or comes after this. The objects stay where they are until remove().
  void detach(const std::shared_ptr<ClientScene>& client);
  void remove(const std::shared_ptr<ClientScene>& client);
  /// The one that was to be replaced, when no frame has been built yet: now it stays. Else null.
  std::shared_ptr<ClientScene> takeReplaced(const std::shared_ptr<ClientScene>& client);
  /// Throws hl::Error where the bodies and joints of another base and those of all clients, also of those that have
  /// gone and left their objects, would be more than a world can have.
  /// When it does not throw, there is room for that base until setBase(), whoever comes meanwhile.
  void admitBase(const WorldParts& base);
  /// This base is shown.
  void setBase(const WorldParts& base);
  /// There is something else that the next scene is to show.
  void change();
  HierarchyCounts counts() const;

  void start();
  void stop();  ///< whoever waits here returns
  const std::atomic<bool>& running() const { return running_; }

  // A builder.
  /// Waits for work, and gives it to this builder alone until done(). Nothing: the table has stopped.
  std::optional<BuilderWork> awaitWork();
  void done(ClientScene& client);
  /// The frame happens now: its objects are for the next scene. Throws hl::Error, and nothing has happened, when the
  /// world has no room for its bodies. Afterwards `frame` has the objects before.
  void apply(ClientScene& client, BuiltFrame& frame);
  /// The same objects, with a hierarchy that was built anew.
  void applyRebuilt(ClientScene& client, EditableScene::Next& objects);
  /// There is no memory to build it anew: it serves as it is until the next frame.
  void leaveOutdated(ClientScene& client);

  // The publisher's thread.
  /// Waits until the next scene is another one. False: the table has stopped.
  bool awaitChange();
  /// As ClientList::take() and giveBack().
  SceneParts take();
  void giveBack(SceneParts& parts);
  /// Those that have gone are shown no more.
  void eraseGone(const SceneParts& shown);
  /// The frame of this client that has been ready longest; there is one.
  ReadyFrame takeReady(ClientScene& client);
  /// All that was taken is shown and reported: what is outdated may be built anew.
  void wakeBuilder() { work_.notify_one(); }

 private:
  mutable std::mutex mutex_;  // of what follows, and of the clients' entries
  std::condition_variable work_, changed_;
  ClientList clients_;
  BodyAdmission admission_;
  std::atomic<bool> running_{false};
  bool dirty_ = false;  // the next scene is another one
  HierarchyCounts counts_;
  std::uint64_t gravities_ = 0;  // frames that have set it
};

}  // namespace hl
