// TouchWorld: what the sessions of all clients share: the devices with their loops and masters, the publisher of
// scenes, and the objects of clients that have gone.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "device/named_device.h"
#include "session/limits.h"
#include "session/scene_publisher.h"
#include "touch/hand_group.h"
#include "touch/touch_session.h"

namespace hl {

struct TouchServerSettings {
  static constexpr std::size_t kMaxDevices = 16;
  static_assert(kMaxDevices <= FaultGroup::kMaxDevices);

  TouchSettings touch;  ///< of each device, but for its label
  /// 1 to kMaxDevices, with different names where there are several; specs as openAnyDevice() takes them. Each has a
  /// proxy and loops of its own.
  std::vector<NamedDevice> devices{{"", "sim"}};
  Limits limits{};
  std::string version;         ///< of the server, for Welcome
  bool faults_joined = false;  ///< while one device is in fault, none makes force
};

/// Constructed, started, stopped and destroyed by one thread. The rest: any thread.
class TouchWorld {
 public:
  /// `base` is touchable besides what clients bring; it may be empty. Throws hl::Error when a device cannot be had.
  TouchWorld(std::shared_ptr<const Snapshot> base, const TouchServerSettings& settings);
  TouchWorld(const TouchWorld&) = delete;
  TouchWorld& operator=(const TouchWorld&) = delete;
  ~TouchWorld() { stop(); }
  void start();
  void stop();  ///< zero force, then the rest; safe to call twice

  const TouchServerSettings& settings() const { return settings_; }
  const Limits& limits() const { return settings_.limits; }
  TouchSession& device(std::size_t number) { return *devices_[number]; }
  std::size_t devices() const { return devices_.size(); }
  /// The number of the device that has this name; none: nothing.
  std::optional<std::uint32_t> deviceNamed(const std::string& name) const;
  ScenePublisher& publisher() { return publisher_; }
  ClientTable& clients() { return publisher_.clients(); }
  const ClientTable& clients() const { return publisher_.clients(); }
  const MemoryBudget& memory() const { return memory_; }
  double time_s() const { return devices_[0]->time_s(); }

  /// See TouchServer::replaceScene(). A simulated hand is above both scenes meanwhile: of a soup of triangles nobody
  /// can say whether a finger is inside.
  void replaceBase(const std::shared_ptr<const Snapshot>& base);

  void fitHands(const Box& bounds, double most_s);
  void freeHands();

  /// A role that one session at a time has; whether this one has it now.
  bool becomeMaster(std::uint32_t device, std::uint32_t session);
  bool hasMaster(std::uint32_t device) const;
  /// The session has ended: it is no master any more.
  void giveUpMaster(std::uint32_t session);

  /// Objects whose client has gone and wanted them to stay. Of a name there are those of the client that left last;
  /// when there are too many, those that have been kept longest go.
  void keep(const std::string& client_name, std::shared_ptr<ClientScene> place);
  /// Null when there are none of this name.
  std::shared_ptr<ClientScene> takeKept(const std::string& client_name);

  /// Hands of other servers of a shared world, in the place of those before: all clients are sent them.
  void setRemoteHands(std::vector<proto::OtherDevice> hands);

  void views(std::uint32_t device, ServoView& servo, ProxyView& proxy);
  void describe(std::uint32_t device, proto::ClientState& state);

 private:
  class HandsAside;

  bool moveHandsAside(const Box& bounds, double most_s);
  bool showBase(const std::shared_ptr<const Snapshot>& base);

  const TouchServerSettings settings_;
  const MemoryBudget memory_;
  MemoryShare base_memory_;
  const std::shared_ptr<HandGroup> hands_;  // of several devices; null: there is one
  std::vector<std::unique_ptr<TouchSession>> devices_;
  ScenePublisher publisher_;

  mutable std::mutex mutex_;                                                // of what follows
  std::vector<std::uint32_t> masters_;                                      // session by device; 0: none
  std::vector<std::pair<std::string, std::shared_ptr<ClientScene>>> kept_;  // by name; the oldest first
  std::vector<proto::OtherDevice> remote_;                                  // hands of other servers

  std::mutex views_mutex_;  // of the devices' views for clients
};

}  // namespace hl
