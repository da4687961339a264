// ProxyLoop: what the proxy's real-time thread does at each period, without the thread: takes the newest scene and
// settings, ticks, and tells the servo where to pull, and the server what was touched.
#pragma once

#include <cstdint>

#include "base/spsc_ring.h"
#include "control/servo.h"
#include "proxy/proxy.h"
#include "server/snapshot_slot.h"
#include "server/target_blend.h"
#include "server/workspace.h"

namespace hl {

/// What may change while the loop runs.
struct ProxyCommands {
  MaterialOverride surfaces{};
  Workspace workspace;
  double radius_W = 0.002;  ///< m, world, > 0
  std::uint64_t restarts =
      0;  ///< counts changes of workspace or radius: the proxy then starts anew where the finger is
};

/// An object of the scene as its client knows it.
struct ObjectName {
  std::uint64_t key = 0;
  std::uint32_t session = 0, object = 0, name = 0;
};

/// The proxy came to an object or left it.
struct TouchEvent {
  std::int64_t time_ns = 0;
  ObjectName object;
  bool touches = false;
  Vec3 position_W = Vec3::Zero();  ///< of the proxy
};

struct ProxyStep {
  ServoTarget target;
  TickReport report;
  FixedVector<ObjectName, 3> touched;  ///< of report.contacts, one by one
};

/// step() by one thread, RT-safe; popEvent() by one other.
class ProxyLoop {
 public:
  /// `settings`: period and passes; the rest comes with each step.
  ProxyLoop(SnapshotSlot& scenes, const ProxySettings& settings) : scenes_(scenes), settings_(settings) {}

  /// One period at `now_ns` with the finger at `finger_D`.
  ProxyStep step(std::int64_t now_ns, const Vec3& finger_D, const ProxyCommands& commands, double stiffness_N_m,
                 LedgerMode ledger);
  const ProxyState& state() const { return state_; }
  bool popEvent(TouchEvent& event) { return events_.pop(event); }

 private:
  void follow(const ProxyCommands& commands, double stiffness_N_m, LedgerMode ledger);
  ServoTarget targetOf(std::int64_t now_ns, const Vec3& finger_D, const TickReport& report, bool abrupt);
  void tellEvents(std::int64_t now_ns, const FixedVector<ObjectName, 3>& touched);

  SnapshotSlot& scenes_;
  ProxySettings settings_;
  Workspace workspace_;
  ProxyState state_;
  TargetBlend blend_;
  double last_stiffness_ = 1;  // s that the servo was told
  bool pulled_ = false;        // the servo was told to pull
  std::uint64_t scene_ = 0;    // number of the last scene; 0: none yet
  std::uint64_t restarts_ = 0;
  FixedVector<ObjectName, 3> touched_;
  SpscRing<TouchEvent, 1024> events_;
};

}  // namespace hl
