// SimulatedDevice: a force-feedback device in a hand, so that nobody needs hardware.
// An arm with friction, encoders that count, a DAC that rounds, motors that saturate; if wanted also what real devices
// have beside that: a bending stylus, a lagging current, ticks of delay, samples that are not taken on time. It lives
// on the clock that read() is given: a virtual one in tests, the real one in hl touch.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>

#include "device/arm.h"
#include "device/device.h"
#include "device/device_models.h"
#include "device/hand.h"
#include "device/hand_orders.h"
#include "device/simulated_hand.h"
#include "device/wrist.h"

namespace hl {

/// The arm bends between where its encoders measure and where the hand holds it: a spring with a light mass behind it.
struct Bending {
  double stiffness_N_m = 3500;  ///< the vendor's figure of the PHANToM, unverified
  double damping_ratio = 0.02;  ///< of the mode
  double stylus_kg = 0.010;     ///< what the hand holds; assumed
};

struct SimulatedDeviceSettings {
  DeviceModel model = premium15();
  bool held = true;  ///< false: nobody holds the stylus
  bool firm = false;
  Vec3 load_N = Vec3::Zero();  ///< a constant force on the tip, as of a weight hung on it
  bool bends = false;
  Bending bending;
  double current_lag_s = 0;         ///< of the motors; 0.25 ms is usual
  int delay_steps = 0;              ///< writes after which a force reaches the motors, 0..kMaxDelay
  double jitter_s = 0;              ///< a reading is taken so much later than it says, at most
  std::uint32_t seed = 1;           ///< of the jitter
  double step_s = 10e-6;            ///< of the integration
  double longest_advance_s = 0.02;  ///< per read; a longer gap of the clock is not simulated

  static constexpr int kMaxDelay = 15;
};

/// The tip starts at the origin of D. The same calls give the same bits.
class SimulatedDevice final : public Device, public SimulatedHand {
 public:
  explicit SimulatedDevice(const SimulatedDeviceSettings& settings = {});

  void open() override {}
  void close() override { write(Vec3::Zero()); }
  const DeviceInfo& info() const override { return settings_.model.info; }
  DeviceSample read(std::int64_t now_ns) override;
  void write(const Vec3& force_N) override;
  void stop() noexcept override { stopped_.store(true, std::memory_order_release); }

  SimulatedHand* hand() override { return this; }
  void setHandGoal(const Vec3& goal_D) override { orders_.goal_D.write(goal_D); }
  void setHandFirm(bool firm) override { orders_.firm = firm; }
  void setHandHolds(bool holds) override { orders_.holds = holds; }
  void setHandButtons(std::uint32_t buttons) override { orders_.buttons = buttons; }
  void setHandTurn(const Eigen::Quaterniond& goal_D) override { orders_.turn_D.write(goal_D); }
  void setHandGripper(double goal_rad) override { orders_.gripper_rad = goal_rad; }

  // For tests and benches; on the thread that reads.
  Arm& arm() { return *arm_; }
  void setLoad(const Vec3& load_N) { settings_.load_N = load_N; }
  Vec3 trueTip_D() const { return settings_.bends ? stylus_ : arm_->tip_D(); }
  Vec3 trueVelocity_D() const { return settings_.bends ? stylus_velocity_ : arm_->velocity_D(); }
  /// Arm, stylus and hand together at one place, moving alike; the hand goes on from there.
  void place(const Vec3& tip_D, const Vec3& velocity_m_s);
  /// Kinetic energy of arm, stylus and hand plus what the springs of the hand, the stylus and the end stops hold.
  double energy_J() const;

 private:
  const GripParameters& grip() const { return orders_.firm ? kFirmGrip : kLightGrip; }
  void takeHold();
  void step(double dt_s);
  void dropForce();
  void turnWrist(double dt_s);
  Vec3 stepHeld(double dt_s);
  Vec3 stepStylus(const Vec3& pull_N, double dt_s);
  double jitter_ns();

  SimulatedDeviceSettings settings_;
  std::unique_ptr<Arm> arm_;
  Wrist wrist_;
  Vec3 stylus_ = Vec3::Zero();  // the tip, where it bends
  Vec3 stylus_velocity_ = Vec3::Zero();
  HandState hand_;
  bool held_ = true;
  Vec3 goal_D_ = Vec3::Zero();
  HandOrders orders_;
  std::array<Vec3, SimulatedDeviceSettings::kMaxDelay + 1> on_the_way_;  // forces, a ring
  std::size_t written_ = 0;
  std::mt19937 random_;
  std::atomic<bool> stopped_{false};     // the motors are without current from the next advance on
  std::optional<std::int64_t> time_ns_;  // of the last reading
};

}  // namespace hl
