// RemoteJudge: what comes from a robot far away, made into an input of the hand's port. Nothing of it is trusted.
#pragma once

#include <array>
#include <cstdint>

#include "control/remote_port.h"
#include "device/device.h"
#include "ros/command_judge.h"
#include "ros/packets.h"
#include "ros/teleop_settings.h"

namespace hl {

/// So long a robot's force counts whole, from when it has come; then it fades, and is gone after as long again.
inline constexpr std::int64_t kRemoteLife_ns = 25'000'000;

/// Of one hand, by one thread.
class RemoteJudge {
 public:
  RemoteJudge(const DeviceInfo& device, const TeleopSettings& settings);

  /// A force counts from when it came, as the clocks of two machines differ: of its age only what is more than the
  /// least of its sender so far is looked at. DDS gives out the samples of a sender in the order in which they were
  /// sent, and leaves out older ones. A total of energy counts by what it has grown, and no more than force and speed
  /// of the device can make of it; that of another sender counts from its first on.
  CommandVerdict judge(const HandCommand& command, std::int64_t now_ns);
  /// The clutch is the caller's.
  const RemoteInput& input() const { return input_; }

 private:
  /// Who writes to one of the topics, and what has come from there.
  struct Sender {
    std::uint64_t writer = 0;
    std::int64_t least_age_ns = 0;
    std::int64_t last_ns = 0;  // when its last sample arrived
    double total_J = 0;
  };
  void takeTotal(Sender& sender, double total_J, std::int64_t arrived_ns, bool anew);

  const DeviceInfo device_;
  const TeleopSettings settings_;
  std::array<Sender, 2> senders_;  // of force and energy
  RemoteInput input_;
};

}  // namespace hl
