// Sources. Workspaces, peak and continuous forces, resolutions and tip masses are the vendors' sheets as commonly
// quoted, and unverified, but for the Falcon's. Where nothing is published a comment says what is assumed.
#include "device/device_models.h"

#include <numbers>
#include <string>

#include "base/error.h"
#include "device/phantom_arm.h"

namespace hl {

namespace {

// Every device here: an unhurried hand is at 0.3 m/s, a fast one at 1 m/s.
constexpr double kVelocityMax_m_s = 3;

struct Sheet {
  const char* name;
  Vec3 workspace_m;  // edges of the box
  double force_max_N, force_continuous_N, friction_N, resolution_m;
  double stiffness_N_m, stiffness_max_N_m, damping_Ns_m;
};

DeviceInfo infoOf(const Sheet& sheet) {
  DeviceInfo info;
  info.name = std::string("simulated ") + sheet.name;
  info.workspace_min = -0.5 * sheet.workspace_m;
  info.workspace_max = 0.5 * sheet.workspace_m;
  info.force_max_N = sheet.force_max_N;
  info.force_continuous_N = sheet.force_continuous_N;
  info.friction_N = sheet.friction_N;
  info.resolution_m = sheet.resolution_m;
  info.stiffness_N_m = sheet.stiffness_N_m;
  info.stiffness_max_N_m = sheet.stiffness_max_N_m;
  info.damping_Ns_m = sheet.damping_Ns_m;
  info.velocity_max_m_s = kVelocityMax_m_s;
  // What 3500 N/m, the stiffest of touch for long, ask for under the fastest hand.
  info.force_rate_max_N_s = 3500 * kVelocityMax_m_s;
  info.servo_rate_Hz = 1000;
  info.servo_rate_max_Hz = 10'000;
  return info;
}

MassParameters massOf(const Sheet& sheet, double mass_kg, double damping_Ns_m) {
  MassParameters mass;
  mass.mass_kg = mass_kg;
  mass.damping_Ns_m = damping_Ns_m;
  mass.friction_N = sheet.friction_N;
  mass.resolution_m = sheet.resolution_m;
  mass.force_peak_N = sheet.force_max_N;
  mass.low_D = -0.5 * sheet.workspace_m;
  mass.high_D = 0.5 * sheet.workspace_m;
  return mass;
}

DeviceModel withWrist(DeviceModel model, const WristParameters& wrist) {
  model.info.has_wrist = wrist.resolution_rad > 0;
  model.info.gripper_max_rad = wrist.gripper_max_rad;
  model.wrist = wrist;
  return model;
}

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

// Mass, damping, friction and encoder step: the set of one axis that Diolaiti, Niemeyer, Barbagli and Salisbury
// (Stability of Haptic Rendering, IEEE Trans. Robotics 22(2), 2006) are quoted with; their table has not been seen.
DeviceModel premium10() {
  const Sheet sheet{"PHANToM Premium 1.0", {0.254, 0.178, 0.127}, 8.5, 1.4, 0.038, 32e-6, 1000, 12000, 0.5};
  return {"premium1.0", infoOf(sheet), massOf(sheet, 0.072, 0.005)};
}

// The published joint-space model (phantom.h). Friction: the vendor's figure; the joints' .01 Nm make .047 to .059 N.
// With the encoder gimbal, which is not driven: 0.0023 degrees of pitch and yaw, by the vendor's sheet.
DeviceModel premium15() {
  const PhantomParameters arm;
  const double force_max_N = arm.motor_torque_peak_Nm * arm.gear.y() / arm.l2;
  const Sheet sheet{"PHANToM Premium 1.5", {0.381, 0.267, 0.191}, force_max_N, 1.4, 0.04, 30e-6, 1000, 12000, 0.5};
  return withWrist({"premium1.5", infoOf(sheet), arm}, {0.0023 * kDegree});
}

// Vendor's figures of the Omni, now Touch; friction is "< 0.26 N", taken as 0.26. Damping is not published: that of the
// PHANToM 1.0. The recommended stiffness is what CHAI3D uses for the Touch. The gimbal has potentiometers; how fine
// they are is not published: 10 bits of 300 degrees are assumed.
DeviceModel touchDevice() {
  const Sheet sheet{"3D Systems Touch", {0.160, 0.120, 0.070}, 3.3, 0.88, 0.26, 55e-6, 400, 3000, 0.5};
  return withWrist({"touch", infoOf(sheet), massOf(sheet, 0.045, 0.005)}, {300 * kDegree / 1024});
}

// Workspace, force and resolution (400 dpi) as the H3D documentation gives them; CHAI3D uses at most 8 N. Mass, damping
// and friction are not published: guesses from its plastic arms and geared-down motors, and no more than that.
DeviceModel falcon() {
  const Sheet sheet{"Novint Falcon", {0.1, 0.1, 0.1}, 8, 2.5, 0.5, 63.5e-6, 1000, 5000, 0.5};
  return {"falcon", infoOf(sheet), massOf(sheet, 0.25, 0.5)};
}

// Vendor's figures; the mass of about 0.2 kg is quoted, not measured. Friction and damping are not published: guesses
// for a delta of cable drives. The resolution is "< 0.01 mm", taken as 0.01.
DeviceModel omega3() {
  const Sheet sheet{"Force Dimension omega.3", {0.160, 0.160, 0.110}, 12, 12, 0.1, 10e-6, 2000, 14500, 1};
  return {"omega3", infoOf(sheet), massOf(sheet, 0.2, 0.02)};
}

// As the omega.3, with a wrist of 0.09 degrees and a gripper that opens by 25 mm: 0.006 mm of it, reported as angles of
// fingers assumed 50 mm long. Its mass with the wrist, 0.25 kg, is a guess.
DeviceModel omega7() {
  const Sheet sheet{"Force Dimension omega.7", {0.160, 0.160, 0.110}, 12, 12, 0.1, 10e-6, 2000, 14500, 1};
  return withWrist({"omega7", infoOf(sheet), massOf(sheet, 0.25, 0.02)}, {0.09 * kDegree, 0.5, 0.006 / 50});
}

DeviceModel linearDevice(double mass_kg, double damping_Ns_m) {
  const Sheet sheet{"linear device", {1, 1, 1}, 1000, 1000, 0, 0, 1000, 1e6, 0};
  MassParameters mass = massOf(sheet, mass_kg, damping_Ns_m);
  mass.dac_bits = 0;
  DeviceInfo info = infoOf(sheet);
  info.force_rate_max_N_s = 1e6;
  return {"linear", info, mass};
}

std::array<DeviceModel, 6> deviceModels() {
  return {premium15(), premium10(), touchDevice(), falcon(), omega3(), omega7()};
}

std::string simulatedModelNames() {
  std::string names;
  for (const DeviceModel& model : deviceModels()) names += (names.empty() ? "" : ", ") + std::string(model.name);
  return names;
}

DeviceModel deviceModel(std::string_view name) {
  for (const DeviceModel& model : deviceModels()) {
    if (model.name == name) return model;
  }
  throw Error("no simulated device is called '" + std::string(name) + "': there are " + simulatedModelNames());
}

std::unique_ptr<Arm> makeArm(const DeviceModel& model, double current_lag_s) {
  if (const auto* phantom = std::get_if<PhantomParameters>(&model.arm)) {
    return std::make_unique<PhantomArm>(*phantom, current_lag_s);
  }
  return std::make_unique<MassArm>(std::get<MassParameters>(model.arm), current_lag_s);
}

}  // namespace hl
