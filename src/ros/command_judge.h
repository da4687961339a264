// CommandJudge: what comes to a hand from ROS 2, made into a pull that the servo may take. Nothing of it is trusted.
#pragma once

#include <cstdint>

#include "control/hand_pull.h"
#include "device/device.h"
#include "ros/packets.h"

namespace hl {

/// So long a command counts, from when it was sent.
inline constexpr std::int64_t kCommandLife_ns = 50'000'000;
/// The spring to a set-point: soft enough to hold with the spring to the proxy on every device.
inline constexpr double kSetPointSpring_N_m = 200;

enum class CommandVerdict : std::uint8_t {
  kTaken,
  kMalformed,   ///< no sample of its topic
  kNotANumber,  ///< a component is none, or infinite
  kOtherFrame,  ///< it is not in the frame of the hand
  kStale,       ///< older than it may be
  kVerdicts     // how many there are
};

/// Of one hand, by one thread.
class CommandJudge {
 public:
  explicit CommandJudge(const DeviceInfo& device);

  /// Of each topic the newest counts. A force is cut to what the device makes, a place to its workspace.
  CommandVerdict judge(const HandCommand& command, std::int64_t now_ns);
  /// Of all that was taken.
  const HandPull& pull() const { return pull_; }
  /// Once after a force or a set-point has ended, as no other came in time.
  bool takeEnd(std::int64_t now_ns);

 private:
  void take(const HandCommand& command, std::int64_t until_ns);

  const DeviceInfo device_;
  HandPull pull_;
  bool pulls_ = false;
};

}  // namespace hl
