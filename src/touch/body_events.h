// BodyEvents: when bodies fall asleep and wake, and when something hits them. An impact may take a few steps, as a body
// that comes to a surface first goes the way that is left: its impulse is the sum of all, with the step before and the
// step after, which may have a small part of it.
#pragma once

#include <cstdint>

#include "base/fixed_vector.h"
#include "base/spsc_ring.h"
#include "touch/body_world.h"
#include "touch/touch_events.h"

namespace hl {

enum class BodyEventKind : std::uint8_t { kSleep, kWake, kImpact };

struct BodyEvent {
  BodyEventKind kind{};
  std::int64_t time_ns = 0;  ///< of an impact: of its first step
  ObjectName object;
  double impulse_N_s = 0;          ///< of an impact: what contacts, hand and joints gave the body
  Vec3 position_W = Vec3::Zero();  ///< of the centre of mass
};

/// begin() and end() by one thread, RT-safe; pop() by one other. Events that do not fit wait for none: they are left
/// out.
class BodyEvents {
 public:
  /// Beyond what gravity does in a step: less is a push.
  static constexpr double kStruck_m_s = 0.05;
  /// A body that is hit again within this time is not reported again.
  static constexpr std::int64_t kQuiet_ns = 20'000'000;

  /// Before a step of these bodies, after what clients did to them.
  void begin(const Snapshot& scene, const BodyWorld& bodies);
  void end(std::int64_t now_ns, double period_s, const BodyWorld& bodies);
  /// There are no bodies.
  void forget();
  bool pop(BodyEvent& event) { return events_.pop(event); }

 private:
  static constexpr std::int64_t kNever_ns = -kQuiet_ns;
  struct Seen {
    ObjectName object;
    bool asleep = false, struck = false;
    Vec3 velocity = Vec3::Zero();          // m/s, before the step
    Vec3 last_m_s = Vec3::Zero();          // given in the last step
    Vec3 given_m_s = Vec3::Zero();         // in the impact that goes on
    std::int64_t struck_ns = 0;            // when that began
    std::int64_t reported_ns = kNever_ns;  // the last impact
  };
  void follow(const Snapshot& scene, const BodyWorld& bodies);
  void strike(Seen& seen, std::int64_t now_ns, const Vec3& given_m_s, double most_m_s, std::size_t i,
              const BodyWorld& bodies);

  FixedVector<Seen, kMaxBodies> seen_, before_;  // as World::bodies
  std::uint64_t scene_ = 0;                      // identity
  std::uint64_t returned_ = 0;                   // BodyView::returned before the step
  SpscRing<BodyEvent, 1024> events_;
};

}  // namespace hl
