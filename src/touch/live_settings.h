// LiveSettings: what users may change while the loops run. The loops never wait for those who set it.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "base/latest.h"
#include "device/device.h"
#include "geometry/primitive.h"
#include "touch/proxy_loop.h"
#include "touch/touch_settings.h"

namespace hl {

/// Setters and getters: any thread. The loops use proxyCommands() and takeBodyCommands(), by one of them at a time,
/// stiffness_N_m(), ledger() and armRequests(); these are RT-safe.
class LiveSettings {
 public:
  /// The workspace is fitted to `bounds`, or to the first scene that is not empty.
  LiveSettings(const TouchSettings& settings, const DeviceInfo& device, const Box& bounds);

  void setStiffness(double stiffness_N_m);             ///< clamped to what the device accepts
  void setSurfaces(const MaterialOverride& surfaces);  ///< replaces what was set before; numbers out of range are cut
  void setLedger(LedgerMode mode) { ledger_ = mode; }
  /// The proxy's radius stays as it is at the hand; one that was set before the first workspace or scene stays as it is
  /// in the world.
  void setWorkspace(const Workspace& workspace);
  void setRadius(double radius_W);
  /// A scene is about to be shown. As setWorkspace(), where it is the first one.
  void fit(const Box& bounds);
  /// Another scene is about to be shown in the place of the one before: fitted as the first one was, whatever has been
  /// set since.
  void refit(const Box& bounds);
  /// False: too many wait for the loops.
  bool actOnBody(const BodyCommand& command) { return body_commands_.push(command); }
  void rearm() { faults_ ? faults_->rearm() : static_cast<void>(arm_requests_.fetch_add(1)); }

  MaterialOverride surfaces() const;
  Workspace workspace() const;
  double radius_W() const;
  /// Objects of other servers are about to be shown. As fit(), where nobody has placed the workspace; of a scale that
  /// was given it is placed alone.
  void fitToOthers(const Box& bounds);
  /// Whether the workspace has been set, or a scene of this server's own has been shown.
  bool isPlaced() const;
  /// How high a scene of these bounds would reach at the hand, m above its origin, were it fitted.
  double topOfFitted_D(const Box& bounds) const;
  double side_D() const { return side_D_; }  ///< m, of a model that is fitted

  double stiffness_N_m() const { return stiffness_.load(std::memory_order_relaxed); }
  LedgerMode ledger() const { return ledger_.load(std::memory_order_relaxed); }
  /// Counts them.
  std::uint64_t armRequests() const {
    return faults_ ? faults_->armRequests() : arm_requests_.load(std::memory_order_relaxed);
  }
  void proxyCommands(ProxyCommands& commands) { commands_for_proxy_.read(commands); }
  void takeBodyCommands(BodyCommands& out) { body_commands_.takeNext(out); }

 private:
  void restartWith(const Workspace& workspace, double radius_W);  // holding mutex_
  void placeAt(const Box& bounds);  // where nobody has placed the workspace; holding mutex_
  Workspace fitted(const Box& bounds) const;
  double radiusIn(const Workspace& workspace, double radius_D) const;

  const double radius_D_, side_D_, stiffness_max_N_m_;
  const std::optional<double> world_per_device_;  // in the place of what would fit
  const std::shared_ptr<FaultGroup> faults_;      // null: it is armed alone
  std::atomic<double> stiffness_{0};
  std::atomic<LedgerMode> ledger_{LedgerMode::kTank};
  std::atomic<std::uint64_t> arm_requests_{0};

  mutable std::mutex mutex_;  // of what follows; the loops never see it
  ProxyCommands commands_;
  bool placed_ = false;  // the workspace has been set, or a scene has been shown
  bool radius_set_ = false;
  Latest<ProxyCommands> commands_for_proxy_{ProxyCommands{}};
  BodyCommandQueue body_commands_;
};

}  // namespace hl
