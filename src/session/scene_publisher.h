// ScenePublisher: from the frames of all clients to the one scene that the devices touch.
//
//   builders   decode frames and build their shapes, each client's in order, several clients at once; where a refitted
//              hierarchy has become slow they build it anew, one at a time, once it is shown and its client has no
//              frame waiting
//   publisher  puts what is ready together and shows it to the loops when they have taken the scene before
// The old scene stays touchable meanwhile.
#pragma once

#include <hl.pb.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/memory_budget.h"
#include "scene/placed_shape.h"
#include "scene/scene_limits.h"
#include "session/base_scene.h"
#include "session/client_scene.h"
#include "session/touching_loops.h"

namespace hl {

/// Hierarchies of clients' shapes since the start.
struct HierarchyCounts {
  std::uint64_t refits = 0;    ///< of redefined objects
  std::uint64_t rebuilds = 0;  ///< of those that were outdated
};

class ScenePublisher {
 public:
  static constexpr int kBuilders = 2;

  using ClientScene = hl::ClientScene;

  /// `base` is touchable besides what clients bring. `hands`: of several devices; null: there is one. All must outlive
  /// the publisher.
  ScenePublisher(std::shared_ptr<const Snapshot> base, std::vector<TouchSession*> devices, HandGroup* hands = nullptr);
  ~ScenePublisher();
  void start();
  void stop();  ///< what is not shown by then never is; safe to call twice

  /// What the client makes the publisher keep is counted against `memory`. `replaced`, if any, goes in the very scene
  /// that shows the first frame.
  std::shared_ptr<ClientScene> join(std::uint32_t session, const SceneLimits& limits, MemoryBudget memory,
                                    FrameCallbacks callbacks, std::shared_ptr<ClientScene> replaced = {});
  /// Any thread; returns at once. `uploads`: those that the frame refers to. `memory`: what both take, until it is
  /// built.
  void submit(const std::shared_ptr<ClientScene>& client, proto::Frame frame, Uploads uploads, MemoryShare memory,
              bool answers_force = false);
  /// For a client within this process, which submits no frames: its objects from now on, in the place of those before;
  /// they take `move_ns` to get there. Throws hl::Error, and changes nothing, for bodies and joints that cannot be
  /// made. Any thread, one at a time for a client; it may take long where bodies are new.
  void place(const std::shared_ptr<ClientScene>& client, PlacedShapes placed, std::int64_t move_ns);
  /// Frames that are submitted and not yet shown or refused.
  std::size_t waiting(const std::shared_ptr<ClientScene>& client) const;
  /// No callback is under way or comes after this. The objects stay where they are until remove().
  void detach(const std::shared_ptr<ClientScene>& client);
  void remove(const std::shared_ptr<ClientScene>& client);
  /// The one that was to be replaced, when no frame has been built yet: now it stays. Else null.
  std::shared_ptr<ClientScene> takeReplaced(const std::shared_ptr<ClientScene>& client);
  HierarchyCounts counts() const;

  /// Shows `base` in the place of the one before, fitted to the devices anew, as soon as the loops have taken the scene
  /// before. Returns when it is shown; false: the publisher has stopped before. Throws hl::Error, and changes nothing,
  /// as admitBase(). Any thread but the publisher's own.
  bool replaceBase(const std::shared_ptr<const Snapshot>& base);
  /// Throws hl::Error where the bodies and joints of `base` and those of all clients, also of those that have gone and
  /// left their objects, would be more than a world can have. Any thread.
  void admitBase(const Snapshot& base) const;

  /// Another value for a surface of a volume of the base, by its key in the scene that is shown; 0: the only one. It is
  /// the same object, with the same surface; nothing else changes. Shown as soon as the loops have taken the scene
  /// before; of several choices the last one counts. Throws hl::Error, and changes nothing, if there is no such surface
  /// or if the value is not finite. Any thread; returns at once.
  void setIso(std::uint64_t surface, const IsoChoice& choice);

 private:
  using Waiting = ClientScene::Waiting;
  /// Of the next scene: what one client has in it.
  struct Part;

  void runBuilder();
  void runPublisher();
  std::shared_ptr<ClientScene> sceneToBuild();
  std::shared_ptr<ClientScene> sceneToRebuild();
  void build(ClientScene& client, Waiting waiting);
  void refuse(ClientScene& client, std::uint64_t number, const char* why);
  void rebuild(ClientScene& client);
  bool waitForLoops();
  std::vector<Part> takeParts();
  void giveBack(std::vector<Part>& parts);
  WorldParts partsOfAllBut(const ClientScene* client) const;
  void admit(const WorldParts& base) const;
  void admitBodies(ClientScene& client, const WorldParts& parts) const;
  std::int64_t assemble(std::vector<Part>& parts, std::int64_t begin_ns, std::vector<Instance>& instances) const;
  std::shared_ptr<const Snapshot> makeNext(std::vector<Part>& parts);
  void publish();
  static void listShown(const Snapshot& next, std::vector<Part>& parts);
  void show(const std::shared_ptr<const Snapshot>& next, TouchingLoops::Scenes scenes,
            std::vector<Part>& parts) noexcept;
  void answer(FunctionRef<void()> call);
  void reportShown(const Part& part);
  static std::int64_t moveTime_ns(const Waiting& waiting, std::int64_t last_arrived_ns);

  TouchingLoops loops_;
  mutable std::mutex mutex_;  // of all below and of the places; no thread builds or waits while holding it
  std::condition_variable work_, changed_;
  std::vector<std::shared_ptr<ClientScene>> clients_;
  std::atomic<bool> running_{false};
  bool dirty_ = false;
  HierarchyCounts counts_;
  WorldParts base_parts_;
  std::uint64_t gravities_ = 0;  // frames that have set it
  // Of the publisher's thread:
  std::optional<Vec3> gravity_m_s2_;  // of the clients, for the next scene; absent: as the base has it
  BaseScene base_;                    // guards itself what others use of it
  std::shared_ptr<const Snapshot> shown_;
  std::int64_t shown_begin_ns_ = 0;
  std::int64_t making_ns_ = 0;  // what the last one took
  std::vector<std::thread> threads_;
};

}  // namespace hl
