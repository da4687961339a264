// TouchServer: everything between HL clients and devices: sessions, the publisher of their scenes, the devices' loops.
#pragma once

#include <hl.pb.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/client_session.h"
#include "server/hl_session.h"
#include "server/limits.h"
#include "server/scene_publisher.h"
#include "server/touch_session.h"

namespace hl {

struct TouchServerSettings {
  TouchSettings touch;        ///< of each device
  std::uint32_t devices = 1;  ///< 1..16, each with a proxy of its own; more than one only of simulated ones
  Limits limits{};
  std::string version;         ///< of the server, for Welcome
  std::string device = "sim";  ///< as openAnyDevice() takes it
};

/// Constructed, started, stopped and destroyed by one thread; it outlives its sessions. connect(): any thread.
class TouchServer final : public SessionHost {
 public:
  /// `base` is touchable besides what clients bring; it may be empty. Throws hl::Error when a device cannot be had.
  TouchServer(std::shared_ptr<const Snapshot> base, const TouchServerSettings& settings);
  ~TouchServer() override;
  void start();
  void stop();  ///< zero force, then the rest; safe to call twice

  std::unique_ptr<ClientSession> connect(const std::string& peer, WakeCarrier wake) override;

  TouchSession& device(std::size_t number = 0) { return *devices_[number]; }
  std::size_t devices() const { return devices_.size(); }
  std::size_t sessions() const;
  HierarchyCounts hierarchyCounts() const { return publisher_.counts(); }
  /// Of all clients' scenes, what they have sent ahead and are told, and what pages are shown of it.
  const MemoryBudget& memory() const { return memory_; }
  double time_s() const { return devices_[0]->time_s(); }

 private:
  friend class HlSession;

  // A role that one session at a time has.
  bool becomeMaster(std::uint32_t device, std::uint32_t session);
  bool hasMaster(std::uint32_t device) const;
  void leave(HlSession& session);
  // Objects whose client has gone and wanted them to stay. Of a name there are those of the client that left last; when
  // there are too many, those that have been kept longest go.
  void keep(const std::string& client_name, std::shared_ptr<ScenePublisher::Place> place);
  std::shared_ptr<ScenePublisher::Place> takeKept(const std::string& client_name);
  void describe(std::uint32_t device, proto::ClientState& state);
  void setDeviceInfo(std::uint32_t device, proto::DeviceInfo& info) const;
  void runEvents();
  void tellEach(const proto::Event& event, FunctionRef<bool(const HlSession&)> whom);
  void tellTouched(std::uint32_t device);
  void tellButtons(std::uint32_t device);

  const TouchServerSettings settings_;
  const MemoryBudget memory_;
  MemoryShare base_memory_;
  std::vector<std::unique_ptr<TouchSession>> devices_;
  ScenePublisher publisher_;
  std::atomic<bool> running_{false};
  std::thread events_;

  mutable std::mutex mutex_;  // of what follows
  std::vector<HlSession*> sessions_;
  std::uint32_t last_session_ = 0;
  std::vector<std::uint32_t> masters_;                                                // session by device; 0: none
  std::vector<std::pair<std::string, std::shared_ptr<ScenePublisher::Place>>> kept_;  // by name; the oldest first

  std::mutex views_mutex_;              // of the devices' views for clients
  std::vector<std::uint32_t> buttons_;  // as told last; of the events' thread
};

}  // namespace hl
