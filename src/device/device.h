// Device: what every force-feedback device, simulated or real, gives to the servo. All values in the device frame D:
// x to the user's right, y up, z toward the user; metres, newtons, seconds.
#pragma once

#include <cstdint>
#include <string>

#include "base/vec.h"
#include "device/stylus.h"

namespace hl {

class SimulatedHand;

/// Fixed properties of an open device.
struct DeviceInfo {
  std::string name;
  Vec3 workspace_min = Vec3::Zero();  ///< m, box in which the tip moves freely
  Vec3 workspace_max = Vec3::Zero();
  double smallestReach_D() const { return (workspace_max - workspace_min).minCoeff(); }  ///< m, of its sides
  double force_max_N = 0;           ///< peak force at the tip, any direction, nominal pose; less may be had elsewhere
  double force_continuous_N = 0;    ///< force that may be held for ever
  double force_rate_max_N_s = 0;    ///< the servo never changes force faster
  double stiffness_N_m = 0;         ///< recommended K of the servo
  double stiffness_max_N_m = 0;     ///< highest K the servo accepts
  double damping_Ns_m = 0;          ///< recommended B of the servo
  double friction_N = 0;            ///< of the device itself at the tip, the least of any direction; 0: not known
  double resolution_m = 0;          ///< of position, nominal pose
  double velocity_max_m_s = 0;      ///< faster than this is a fault
  double servo_rate_Hz = 1000;      ///< recommended rate of the servo
  double servo_rate_max_Hz = 1000;  ///< at more it feels no better, or nobody has tried
  bool has_wrist = false;           ///< it reports how the stylus is turned
  double gripper_max_rad = 0;       ///< how far its gripper opens; 0: it has none
};

enum class DeviceStatus : std::uint8_t { kOk, kNotReady, kLost };

/// One reading. `position` is what the encoders say; valid only when status is kOk.
struct DeviceSample {
  std::int64_t time_ns = 0;  ///< on the clock of the loop that reads
  Vec3 position = Vec3::Zero();
  std::uint32_t buttons = 0;  ///< bit i = button i pressed
  DeviceStatus status = DeviceStatus::kNotReady;
  bool held = true;              ///< false: the device can report this, and nobody holds it
  Vec3 weight_N = Vec3::Zero();  ///< force that holds up the device itself here; zero where it needs none
  std::int64_t age_ns = 0;  ///< how long before time_ns the tip was there; a driver with a thread of its own is late
  Stylus stylus{};          ///< of a driver without its spin: StylusReader
};

/// open, close and info: setup thread only. read and write: the servo thread only, RT-safe; before it runs and after it
/// has ended, the setup thread. stop: any thread. The destructor closes.
class Device {
 public:
  virtual ~Device() = default;
  /// Throws hl::Error with what to do when the device cannot be had.
  virtual void open() = 0;
  /// Zero force, then lets go of the device. Safe to call twice.
  virtual void close() = 0;
  virtual const DeviceInfo& info() const = 0;
  /// Position at `now_ns`. Never blocks for longer than a fraction of the servo period.
  virtual DeviceSample read(std::int64_t now_ns) = 0;
  /// The hand that holds it, to be moved; null when a person does. Lives as long as the device.
  virtual SimulatedHand* hand() { return nullptr; }
  /// Holds `force_N` at the tip until the next write. Non-finite components are taken as zero force.
  virtual void write(const Vec3& force_N) = 0;
  /// Zero force now and until the next write(), asked for by the watchdog because the servo thread stands still,
  /// perhaps in read() or write(): any thread, RT-safe, never waits. A driver that cannot, leaves it to what the device
  /// itself does when no force comes for a while, and says so in its README.
  virtual void stop() noexcept {}
};

}  // namespace hl
