// A libHD.so for tests: the C functions of OpenHaptics that HL calls, with a simulated arm behind them. It has a
// scheduler thread of its own; forces set in a frame arrive when it ends, once they are enabled.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include "fake_arm.h"
#include "fake_script.h"

namespace {

using Handle = unsigned int;
struct ErrorInfo {
  unsigned int code;
  int internal;
  Handle device;
};
using Callback = unsigned int(void*);

constexpr Handle kDevice = 0, kNoDevice = 0xFFFFFFFF;
constexpr unsigned int kBadHandle = 0x102, kCommunicationError = 0x302;
constexpr double kMetre_mm = 1000;

hl::test::FakeArm& arm() {
  static hl::test::FakeArm the_arm;
  return the_arm;
}
hl::test::FakeScript& script() {
  static hl::test::FakeScript the_script(arm());
  return the_script;
}

bool is_open = false, in_frame = false, forces_on = false;
std::atomic<unsigned int> error{0}, calibration_updates{0};
hl::Vec3 force = hl::Vec3::Zero();
Callback* callback = nullptr;
void* callback_user = nullptr;
std::atomic<bool> running{false};
std::atomic<bool> held_up{false};  // the scheduler has started, but does not call yet
std::atomic<unsigned int> starts{0};
std::thread scheduler;

}  // namespace

#define HL_EXPORT extern "C" __attribute__((visibility("default")))

HL_EXPORT hl::test::FakeArm* hlFakeArm() { return &arm(); }
HL_EXPORT unsigned int hlFakeCalibrationUpdates() { return calibration_updates; }
HL_EXPORT unsigned int hlFakeStarts() { return starts; }
// The next scheduler that starts calls nobody until it may.
HL_EXPORT void hlFakeHoldUp(bool wait) { held_up = wait; }
HL_EXPORT void hlFakeError(unsigned int code) { error = code; }

HL_EXPORT Handle hdInitDevice(const char*) {
  if (arm().lost || is_open) {
    error = kCommunicationError;
    return kNoDevice;
  }
  script();
  is_open = true;
  forces_on = false;
  return kDevice;
}
HL_EXPORT void hdDisableDevice(Handle) {
  is_open = false;
  arm().pull(hl::Vec3::Zero());
  script().closed();
}
HL_EXPORT void hdMakeCurrentDevice(Handle device) {
  if (device != kDevice) error = kBadHandle;
}
HL_EXPORT void hdBeginFrame(Handle) {
  in_frame = true;
  if (arm().lost) error = kCommunicationError;
}
HL_EXPORT void hdEndFrame(Handle) {
  if (in_frame && forces_on && !arm().lost) arm().pull(force);
  in_frame = false;
  script().pulled();
}
HL_EXPORT void hdEnable(unsigned int capability) { forces_on = forces_on || capability == 0x4000; }
HL_EXPORT void hdGetDoublev(unsigned int name, double* values) {
  static const double box_mm[6] = {-80, -60, -35, 80, 60, 35};
  switch (name) {
    case 0x2050:  // current position
      (hl::Vec3::Map(values)) = kMetre_mm * arm().encoders();
      break;
    case 0x2551:  // usable workspace
      std::copy_n(box_mm, 6, values);
      break;
    case 0x2602:  // nominal highest stiffness, N/mm
      *values = 1.2;
      break;
    case 0x2603:  // highest force
      *values = 3.3;
      break;
    case 0x2604:  // highest continuous force
      *values = 0.88;
      break;
    case 0x2609:  // nominal highest damping, N s/mm
      *values = 0.005;
      break;
    default:
      error = 0x101;  // invalid value
  }
}
HL_EXPORT void hdGetIntegerv(unsigned int name, int* values) {
  *values = name == 0x2000 ? static_cast<int>(arm().buttons) : 4;
}
HL_EXPORT void hdSetDoublev(unsigned int name, const double* values) {
  if (name == 0x2700 && in_frame) force = hl::Vec3::Map(values);
}
HL_EXPORT const char* hdGetString(unsigned int) { return "Touch"; }
HL_EXPORT ErrorInfo hdGetError() { return {error.exchange(0), 0, kDevice}; }
HL_EXPORT const char* hdGetErrorString(unsigned int) { return "communication error"; }
HL_EXPORT unsigned int hdCheckCalibration() { return arm().not_ready ? 0x5001 : 0x5000; }
HL_EXPORT void hdUpdateCalibration(unsigned int style) {
  if (style == 4) ++calibration_updates;
}
HL_EXPORT void hdStartScheduler() {
  if (running.exchange(true)) return;
  scheduler = std::thread([late = held_up.load()] {
    ++starts;
    while (late && held_up && running) std::this_thread::yield();
    while (running) {
      if (callback != nullptr) callback(callback_user);
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  });
}
HL_EXPORT void hdStopScheduler() {
  running = false;
  if (scheduler.joinable()) scheduler.join();
}
HL_EXPORT void hdSetSchedulerRate(unsigned long) {}
HL_EXPORT unsigned long hdScheduleAsynchronous(Callback* call, void* user, unsigned short) {
  callback = call;
  callback_user = user;
  return 1;
}
HL_EXPORT void hdUnschedule(unsigned long) { callback = nullptr; }
