// A libdhd.so.3 for tests: the C functions of Force Dimension's library that HL calls, with a simulated arm behind
// them. Forces are off until they are enabled, as on the device.
#include <algorithm>
#include <array>
#include <cstdlib>

#include "fake_arm.h"
#include "fake_script.h"

namespace {

hl::test::FakeArm& arm() {
  static hl::test::FakeArm the_arm;
  return the_arm;
}
hl::test::FakeScript& script() {
  static hl::test::FakeScript the_script(arm());
  return the_script;
}
bool is_open = false;
bool forces_on = false;
unsigned char watchdog = 0;
int off_cause = 0;
constexpr char kId = 0;

bool answers(char id) { return is_open && id == kId && !arm().lost; }

}  // namespace

#define HL_EXPORT extern "C" __attribute__((visibility("default")))

HL_EXPORT hl::test::FakeArm* hlFakeArm() { return &arm(); }
HL_EXPORT int hlFakeWatchdog() { return watchdog; }
HL_EXPORT void hlFakeForcesOff(int cause) {
  forces_on = false;
  off_cause = cause;
  arm().pull(hl::Vec3::Zero());
}

HL_EXPORT int dhdGetDeviceCount() { return arm().lost ? 0 : 1; }
HL_EXPORT int dhdOpen() {
  if (arm().lost || is_open) return -1;
  script();
  is_open = true;
  forces_on = false;
  return kId;
}
HL_EXPORT int dhdClose(char id) {
  if (!is_open || id != kId) return -1;
  is_open = false;
  forces_on = false;
  arm().pull(hl::Vec3::Zero());
  script().closed();
  return 0;
}
HL_EXPORT int dhdGetSystemType(char id) { return answers(id) ? 33 : -1; }
HL_EXPORT const char* dhdGetSystemName(char) { return "omega.3"; }
HL_EXPORT int dhdEnableForce(unsigned char on, char id) {
  if (!answers(id)) return -1;
  forces_on = on != 0;
  if (!forces_on) arm().pull(hl::Vec3::Zero());
  return 0;
}
HL_EXPORT int dhdSetGravityCompensation(int, char id) { return answers(id) ? 0 : -1; }
HL_EXPORT int dhdSetWatchdog(unsigned char periods, char id) {
  if (!answers(id)) return -1;
  watchdog = periods;
  return 0;
}
// Theirs: x toward the user, y to the right, z up.
HL_EXPORT int dhdGetPosition(double* x, double* y, double* z, char id) {
  if (!answers(id)) return -1;
  const hl::Vec3 tip = arm().encoders();
  *x = tip.z();
  *y = tip.x();
  *z = tip.y();
  return 0;
}
HL_EXPORT int dhdSetForce(double x, double y, double z, char id) {
  if (!answers(id)) return -1;
  if (forces_on) arm().pull({y, z, x});
  script().pulled();
  return 0;
}
HL_EXPORT unsigned int dhdGetButtonMask(char) { return arm().buttons; }
HL_EXPORT int dhdGetStatus(int* status, char id) {
  if (!answers(id)) return -1;
  std::fill_n(status, 16, 0);
  status[0] = status[1] = status[2] = 1;  // power, connected, started
  status[3] = arm().not_ready ? 1 : 0;    // reset: to be calibrated
  status[5] = forces_on ? 1 : 0;
  status[14] = forces_on ? 0 : off_cause;
  return 0;
}
HL_EXPORT const char* dhdErrorGetLastStr() { return "timeout"; }
