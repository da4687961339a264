// TouchEvents: when the proxy comes to an object and when it has left it. Where a surface drops away beneath the proxy,
// or two objects share an edge, the contact comes and goes from tick to tick: an object counts as left only when it has
// not been touched for kLetGo_ns. Then the event has the time and place of the last touch: when its force ended.
#pragma once

#include <cstdint>

#include "base/fixed_vector.h"
#include "base/spsc_ring.h"
#include "base/vec.h"
#include "proxy/solver.h"
#include "scene/snapshot.h"

namespace hl {

/// An object of the scene as its client knows it.
struct ObjectName {
  std::uint64_t key = 0;
  std::uint32_t session = 0, object = 0, name = 0;
};
inline ObjectName nameOf(const Instance& instance) {
  return {instance.key, instance.session, instance.object, instance.name};
}

/// The snap that holds the proxy.
struct HoldingSnap {
  ObjectName object;         ///< key 0: none does
  std::uint32_t number = 0;  ///< among its snaps
};

/// The proxy came to an object or left it.
struct TouchEvent {
  std::int64_t time_ns = 0;
  ObjectName object;
  bool touches = false;
  Vec3 position_W = Vec3::Zero();  ///< of the proxy, at that time
};

/// Shorter than the gap between two taps of a finger, longer than a contact's flicker.
inline constexpr std::int64_t kLetGo_ns = 20'000'000;

/// follow() by one thread, RT-safe; pop() by one other. Events that do not fit wait for none: they are left out.
class TouchEvents {
 public:
  /// What is touched now, by a proxy at `position_W`.
  void follow(std::int64_t now_ns, const FixedVector<ObjectName, kMaxActive>& touched, const Vec3& position_W);
  bool pop(TouchEvent& event) { return events_.pop(event); }

 private:
  struct Felt {
    ObjectName object;
    std::int64_t last_ns;  // when it was touched
    Vec3 position_W;       // of the proxy then
  };
  void come(std::int64_t now_ns, const ObjectName& object, const Vec3& position_W);
  void leave(std::size_t felt);

  FixedVector<Felt, 8> felt_;  // more than can be touched at once: the others are about to be left
  SpscRing<TouchEvent, 1024> events_;
};

}  // namespace hl
