// SimulatedDevice: a PHANToM Premium 1.5 in a hand, so that nobody needs hardware.
// Joint dynamics with Coulomb friction, encoders that count, a DAC that rounds, motors that saturate. It lives on the
// clock that read() is given: a virtual one in tests, the real one in hl touch.
#pragma once

#include <atomic>
#include <cstdint>

#include "base/latest.h"
#include "device/device.h"
#include "device/hand.h"
#include "device/phantom.h"
#include "device/simulated_hand.h"

namespace hl {

struct SimulatedDeviceSettings {
  PhantomParameters arm;
  bool held = true;  ///< false: nobody holds the stylus
  bool firm = false;
  double step_s = 10e-6;            ///< of the integration
  double longest_advance_s = 0.02;  ///< per read; a longer gap of the clock is not simulated
};

/// Frame D: x = P's y (right), y = P's z (up), z = P's x (toward the user). Its origin, (0.19, 0, 0) m in P, is where
/// the workspace box of 381 x 267 x 191 mm just fits between the arm's nearest and farthest reach; the tip starts
/// there. The same calls give the same bits.
class SimulatedDevice final : public Device, public SimulatedHand {
 public:
  explicit SimulatedDevice(const SimulatedDeviceSettings& settings = {});

  void open() override {}
  void close() override { write(Vec3::Zero()); }
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read(std::int64_t now_ns) override;
  void write(const Vec3& force_N) override;

  SimulatedHand* hand() override { return this; }
  void setHandGoal(const Vec3& goal_D) override { goal_.write(goal_D); }
  void setHandFirm(bool firm) override { firm_.store(firm, std::memory_order_relaxed); }

  // For tests; on the thread that reads.
  Vec3 trueTip_D() const;
  Vec3 joints() const { return q_; }
  Vec3 motorTorque_Nm() const { return torque_; }  ///< at the joints, after DAC and saturation
  Vec3 motorForce() const;                         ///< that this torque makes at the tip, frame D
  void setJoints(const Vec3& q, const Vec3& qdot);
  /// Kinetic energy of arm and hand plus what the springs of the hand and of the end stops hold.
  double energy_J() const;

 private:
  void step(double dt_s);
  Vec3 countedJoints() const;

  SimulatedDeviceSettings settings_;
  DeviceInfo info_;
  Vec3 origin_P_ = Vec3::Zero();
  Vec3 q_ = Vec3::Zero();
  Vec3 qdot_ = Vec3::Zero();
  Vec3 torque_ = Vec3::Zero();
  Vec3 friction_impulse_ = Vec3::Zero();
  HandState hand_;
  Latest<Vec3> goal_;
  Vec3 goal_D_ = Vec3::Zero();
  std::atomic<bool> firm_{false};
  std::int64_t time_ns_ = 0;
  bool has_time_ = false;
};

}  // namespace hl
