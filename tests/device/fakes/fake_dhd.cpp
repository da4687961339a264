// A libdhd.so.3 for tests: the C functions of Force Dimension's library that HL calls, with one or two simulated arms
// behind them. Forces are off until they are enabled, as on the device. Indices count the devices that answer, so they
// shift when one has gone, and one that is open already is given again: the driver has to know its own.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <mutex>

#include "fake_arm.h"
#include "fake_script.h"

namespace {

struct Unit {
  explicit Unit(std::size_t the_number) : number(the_number) {}

  const std::size_t number;
  hl::test::FakeArm arm;
  bool is_open = false;
  bool forces_on = false;
  unsigned char watchdog = 0;
  int off_cause = 0;

  hl::test::FakeScript& script() {
    if (!script_) script_ = std::make_unique<hl::test::FakeScript>(arm, number);
    return *script_;
  }
  int open() {
    script();
    if (!is_open) forces_on = false;
    is_open = true;
    return static_cast<int>(number);
  }

 private:
  std::unique_ptr<hl::test::FakeScript> script_;
};

constexpr int kFirstSerial = 1000;
std::size_t plugged_in = hl::test::fakeDevicesAtFirst();

std::array<Unit, hl::test::kFakeDevices>& units() {
  static std::array<Unit, hl::test::kFakeDevices> the_units{Unit(0), Unit(1)};
  return the_units;
}

bool isThere(const Unit& unit) { return unit.number < plugged_in && !unit.arm.lost; }

// Null when it does not answer.
Unit* unitOf(char id) {
  if (id < 0 || static_cast<std::size_t>(id) >= plugged_in) return nullptr;
  Unit& unit = units()[static_cast<std::size_t>(id)];
  return unit.is_open && isThere(unit) ? &unit : nullptr;
}

}  // namespace

#define HL_EXPORT extern "C" __attribute__((visibility("default")))

HL_EXPORT hl::test::FakeArm* hlFakeArm() { return &units()[0].arm; }
HL_EXPORT hl::test::FakeArm* hlFakeArmNumber(std::size_t number) { return &units()[number].arm; }
HL_EXPORT void hlFakePlugIn(std::size_t count) { plugged_in = count; }
HL_EXPORT int hlFakeWatchdog() { return units()[0].watchdog; }
HL_EXPORT void hlFakeForcesOff(int cause) {
  Unit& unit = units()[0];
  unit.forces_on = false;
  unit.off_cause = cause;
  unit.arm.pull(hl::Vec3::Zero());
}

HL_EXPORT int dhdGetDeviceCount() { return static_cast<int>(std::ranges::count_if(units(), isThere)); }
HL_EXPORT int dhdOpen() {
  for (Unit& unit : units()) {
    if (isThere(unit) && !unit.is_open) return unit.open();
  }
  return -1;
}
HL_EXPORT int dhdOpenID(char index) {
  for (Unit& unit : units()) {
    if (isThere(unit) && index-- == 0) return unit.open();
  }
  return -1;
}
HL_EXPORT int dhdOpenSerial(int serial) {
  for (Unit& unit : units()) {
    if (isThere(unit) && kFirstSerial + static_cast<int>(unit.number) == serial) return unit.open();
  }
  return -1;
}
HL_EXPORT int dhdGetSerialNumber(unsigned short* serial, char id) {
  const Unit* const unit = unitOf(id);
  if (unit == nullptr) return -1;
  *serial = static_cast<unsigned short>(kFirstSerial + static_cast<int>(unit->number));
  return 0;
}
HL_EXPORT int dhdClose(char id) {
  if (id < 0 || static_cast<std::size_t>(id) >= units().size()) return -1;
  Unit& unit = units()[static_cast<std::size_t>(id)];
  if (!unit.is_open) return -1;
  unit.is_open = false;
  unit.forces_on = false;
  unit.arm.pull(hl::Vec3::Zero());
  unit.script().closed();
  return 0;
}
HL_EXPORT int dhdGetSystemType(char id) { return unitOf(id) != nullptr ? 33 : -1; }
HL_EXPORT const char* dhdGetSystemName(char) { return "omega.3"; }
HL_EXPORT int dhdEnableForce(unsigned char on, char id) {
  Unit* const unit = unitOf(id);
  if (unit == nullptr) return -1;
  unit->forces_on = on != 0;
  if (!unit->forces_on) unit->arm.pull(hl::Vec3::Zero());
  return 0;
}
HL_EXPORT int dhdSetGravityCompensation(int, char id) { return unitOf(id) != nullptr ? 0 : -1; }
HL_EXPORT int dhdSetWatchdog(unsigned char periods, char id) {
  Unit* const unit = unitOf(id);
  if (unit == nullptr) return -1;
  unit->watchdog = periods;
  return 0;
}
// Theirs: x toward the user, y to the right, z up.
HL_EXPORT int dhdGetPosition(double* x, double* y, double* z, char id) {
  Unit* const unit = unitOf(id);
  if (unit == nullptr) return -1;
  const hl::Vec3 tip = unit->arm.encoders();
  *x = tip.z();
  *y = tip.x();
  *z = tip.y();
  return 0;
}
HL_EXPORT int dhdSetForce(double x, double y, double z, char id) {
  Unit* const unit = unitOf(id);
  if (unit == nullptr) return -1;
  if (unit->forces_on) unit->arm.pull({y, z, x});
  unit->script().pulled();
  return 0;
}
HL_EXPORT bool dhdHasWrist(char) { return true; }
HL_EXPORT bool dhdHasGripper(char) { return true; }
// In their frame: rows and columns are x toward the user, y to the right, z up.
HL_EXPORT int dhdGetOrientationFrame(double frame[3][3], char id) {
  Unit* const unit = unitOf(id);
  if (unit == nullptr) return -1;
  const hl::Mat3 ours = unit->arm.turned_D().toRotationMatrix();
  const hl::Mat3 to_theirs = (hl::Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();
  const hl::Mat3 theirs = to_theirs * ours * to_theirs.transpose();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) frame[i][j] = theirs(i, j);
  }
  return 0;
}
HL_EXPORT int dhdGetGripperAngleRad(double* angle, char id) {
  const Unit* const unit = unitOf(id);
  if (unit == nullptr) return -1;
  *angle = unit->arm.gripper_rad;
  return 0;
}
HL_EXPORT unsigned int dhdGetButtonMask(char id) {
  const Unit* const unit = unitOf(id);
  return unit != nullptr ? unit->arm.buttons.load() : 0;
}
HL_EXPORT int dhdGetStatus(int* status, char id) {
  const Unit* const unit = unitOf(id);
  if (unit == nullptr) return -1;
  std::fill_n(status, 16, 0);
  status[0] = status[1] = status[2] = 1;    // power, connected, started
  status[3] = unit->arm.not_ready ? 1 : 0;  // reset: to be calibrated
  status[5] = unit->forces_on ? 1 : 0;
  status[14] = unit->forces_on ? 0 : unit->off_cause;
  return 0;
}
HL_EXPORT const char* dhdErrorGetLastStr() { return "timeout"; }
