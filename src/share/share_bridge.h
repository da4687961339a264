// ShareBridge: a server in a world that it shares with others. One thread, "share", looks at the server's scene and
// hands 120 times a second, publishes them, and places what the others have in the scene. The servos never
// wait for it. When hl-share ends by itself it is started again.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "base/guarded_thread.h"
#include "ros/start_pauses.h"
#include "session/placed_client.h"
#include "session/touch_server.h"
#include "share/background_work.h"
#include "share/body_actions.h"
#include "share/hand_pushes.h"
#include "share/local_scene.h"
#include "share/replicas_here.h"
#include "share/share_view.h"
#include "share/shared_world.h"

namespace hl {

/// Constructed, started, stopped and destroyed by one thread; started once. view(): any thread.
class ShareBridge {
 public:
  /// For what a person should know: a line without its end. Called by the thread of the bridge.
  using ReportLine = std::function<void(const std::string&)>;
  /// From one look at the server's own scene to the next; a pose that a line loses is soon followed by another one.
  /// What others have is placed as often.
  static constexpr std::int64_t kLook_ns = 8'333'333;

  /// `server` outlives it.
  ShareBridge(std::unique_ptr<ShareLink> link, const std::string& world, const ShareSelf& self, TouchServer& server,
              ReportLine report);
  ~ShareBridge() { stop(); }
  /// After the server.
  void start();
  /// Before the server; safe to call twice. What others have goes from the scene with this object.
  void stop();
  ShareView view() const;

 private:
  ReplicasHere::FitHands fitOfHands();
  void run();
  void startAgain(StartPauses& pauses, std::int64_t deaf_ns);
  void hearAll(std::int64_t now_ns);
  void look(std::int64_t now_ns);
  void publishScene(std::int64_t now_ns);
  void publishHands(std::int64_t now_ns);
  void actOnBodies();
  void showOthers(std::int64_t now_ns);
  void reportPeers(std::int64_t now_ns);
  void writeView(std::int64_t now_ns);
  void endFor(const std::string& why);

  const std::unique_ptr<ShareLink> link_;
  TouchServer& server_;
  const ReportLine report_;
  std::unique_ptr<PlacedClient> client_;
  SharedWorld world_;
  LocalScene local_;
  ReplicasHere replicas_;
  HandPushes pushes_;
  BodyActions actions_;
  std::optional<std::int64_t> free_hands_ns_;  // when those that are above what is placed are let go
  BackgroundWork work_{"share-items"};         // after what it works for
  std::map<ServerId, std::string> reported_peers_;
  mutable std::mutex view_mutex_;
  ShareView view_;
  LoopThread thread_;
};

}  // namespace hl
