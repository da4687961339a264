// TouchServer: everything between HL clients and devices: their sessions, and the world that they share.
#pragma once

#include <hl.pb.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/function_ref.h"
#include "session/client_session.h"
#include "session/hl_session.h"
#include "session/placed_client.h"
#include "session/touch_world.h"

namespace hl {

/// Constructed, started, stopped and destroyed by one thread; it outlives its sessions. connect(): any thread.
class TouchServer final : public SessionHost {
 public:
  /// `base` is touchable besides what clients bring; it may be empty. Throws hl::Error when a device cannot be had.
  TouchServer(std::shared_ptr<const Snapshot> base, const TouchServerSettings& settings);
  ~TouchServer() override;
  void start();
  void stop();  ///< zero force, then the rest; safe to call twice

  std::unique_ptr<ClientSession> connect(WakeSession wake) override;

  /// Another scene of the server's own in the place of the one before, fitted to the devices anew; returns when it is
  /// shown. Throws hl::Error, and changes nothing, while clients are connected, whose scene it would put elsewhere in
  /// their hands, when there is no memory for it, or when the server stops. Any thread; one at a time.
  void replaceScene(const std::shared_ptr<const Snapshot>& scene);

  /// As ScenePublisher::setIso(): another iso value for a surface of the server's own scene. Any thread.
  void setIso(std::uint64_t surface, const IsoChoice& choice) { world_.publisher().setIso(surface, choice); }

  /// A client within this process. Not counted among the sessions; it goes before the server does. Any thread.
  std::unique_ptr<PlacedClient> placeClient();

  /// Fits hands to these bounds, as to a scene of the server's own; simulated ones are above them then, until
  /// freeHands(). Those that have been fitted, or whose workspace a client has set, stay as they are. Waits for them
  /// `most_s` at most.
  void fitHands(const Box& bounds, double most_s) { world_.fitHands(bounds, most_s); }
  void freeHands() { world_.freeHands(); }

  void setRemoteHands(std::vector<proto::OtherDevice> hands) { world_.setRemoteHands(std::move(hands)); }

  TouchSession& device(std::size_t number = 0) { return world_.device(number); }
  std::size_t devices() const { return world_.devices(); }
  std::vector<TouchSession*> otherDevices();  ///< from number 1 on
  std::size_t sessions() const;
  HierarchyCounts hierarchyCounts() const { return world_.clients().counts(); }
  /// Of all clients' scenes, what they have sent ahead and receive, and what pages are shown of it.
  const MemoryBudget& memory() const { return world_.memory(); }
  double time_s() const { return world_.time_s(); }
  /// For clients, as TouchSession::viewsForClients(). Any thread.
  void views(std::uint32_t device, ServoView& servo, ProxyView& proxy) { world_.views(device, servo, proxy); }

 private:
  void leave(const HlSession& session);
  void runEvents();
  void notifyEach(const proto::Event& event, FunctionRef<bool(const HlSession&)> whom);
  void notifyOfTouches(std::uint32_t device);
  void notifyOfBodies(std::uint32_t device);
  void notifyOfButtons(std::uint32_t device);

  TouchWorld world_;
  std::atomic<bool> running_{false};
  std::thread events_;
  std::vector<std::uint32_t> buttons_;  // by device, as last notified; of the events' thread

  mutable std::mutex mutex_;  // of what follows
  std::vector<HlSession*> sessions_;
  std::uint32_t last_session_ = 0;
};

}  // namespace hl
