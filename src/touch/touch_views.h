// TouchViews: what the loops show of themselves, to the pages and to HL clients. World frame, unless a name says D.
#pragma once

#include <cstdint>

#include "base/fixed_vector.h"
#include "base/latest.h"
#include "base/ledger.h"
#include "base/log_ring.h"
#include "base/spsc_ring.h"
#include "base/vec.h"
#include "control/safety.h"
#include "device/stylus.h"
#include "proxy/tick_report.h"
#include "scene/snapshot.h"
#include "touch/body_view.h"
#include "touch/ending_counts.h"
#include "touch/felt_contact.h"
#include "touch/loop_meter.h"

namespace hl {

/// What the last tick did.
struct ProxyView {
  Vec3 proxy = Vec3::Zero();
  FixedVector<ProxyContact, kMaxActive> contacts;
  FixedVector<ObjectName, kMaxActive> touched;  ///< of the contacts, one by one
  HoldingSnap snap;
  bool slipping = false;
  Ledger ledger;
  EndingCounts ended;  ///< ticks so far, by why they ended
  BodyView bodies;
  LoopSummary loop;
};

/// What the vibration guard has done.
struct VibrationView {
  double limit_N_m = 0;      ///< the spring is held below it; 0: there is no limit
  std::uint64_t alarms = 0;  ///< how often it has softened the spring since the start
  double dissipated_J = 0;   ///< what it has taken out of the spring and the hand
};

/// What the servo loop last did.
struct ServoView {
  std::uint32_t buttons = 0;  ///< of the device, bit i: button i is down
  Vec3 finger_D = Vec3::Zero();
  Vec3 force_N = Vec3::Zero();
  Stylus stylus{};  ///< D, whose axes are those of the world
  SafetyState safety = SafetyState::kOff;
  FaultReason fault{};
  Ledger late{};  ///< of the hand-over from proxy to servo
  VibrationView vibration{};
  LoopSummary loop;
};

/// One servo step for the plots.
struct TouchSample {
  double time_s = 0;
  float force_N = 0;
  float penetration_m = 0;  ///< |target - finger| at the hand
  float tick_us = 0;        ///< work time of the newest tick
};

/// One servo step, for clients. Frame D.
struct ServoMoment {
  std::int64_t time_ns = 0;  ///< monotonic
  Vec3 finger_D = Vec3::Zero();
  Vec3 force_N = Vec3::Zero();
  std::uint64_t buttons = 0;
  std::uint64_t answered = 1;  ///< 0: the device did not answer, so nobody knows where the finger is
  Stylus stylus{};
  FeltContacts contacts;  ///< their forces add up to force_N, if there are any
};

/// One newest value for two readers.
template <typename T>
struct ForPagesAndClients {
  Latest<T> pages{T{}}, clients{T{}};

  void write(const T& value) {
    pages.write(value);
    clients.write(value);
  }
};

/// Each member has one writer, the loop that it describes, and one reader.
struct TouchViews {
  ForPagesAndClients<ServoView> servo;
  ForPagesAndClients<ProxyView> proxy;
  SpscRing<TouchSample, 1024> samples;  ///< of servo steps, for pages
  LogRing<ServoMoment> moments{1024};   ///< the last servo steps, newer ones in the place of older ones; any reader
};

}  // namespace hl
