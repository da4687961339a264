// A libHD.so for tests: the C functions of OpenHaptics that HL calls, with one or two simulated arms behind them:
// "Left Device", the default, and "Right Device". It has a scheduler thread of its own, one current device for the
// whole process, which opening a device changes, and one stack of errors; forces set in a frame arrive when it ends,
// once they are enabled.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

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
using Call = std::pair<Callback*, void*>;

constexpr Handle kNoDevice = 0xFFFFFFFF;
constexpr unsigned int kBadHandle = 0x102, kCommunicationError = 0x302;
constexpr double kMetre_mm = 1000;

struct Unit {
  hl::test::FakeArm arm;
  std::unique_ptr<hl::test::FakeScript> script;
  std::atomic<bool> is_open{false}, forces_on{false};
  bool in_frame = false;
  hl::Vec3 force = hl::Vec3::Zero();
  std::atomic<unsigned> frames{0};
};

std::atomic<std::size_t> plugged_in{hl::test::fakeDevicesAtFirst()};
std::atomic<Handle> current{kNoDevice};
std::atomic<unsigned int> calibration_updates{0};
std::atomic<bool> running{false};
std::atomic<bool> held_up{false};  // the scheduler has started, but does not call yet
std::atomic<unsigned int> starts{0}, rounds{0};
std::thread scheduler;

std::mutex mutex;  // of what follows
std::deque<ErrorInfo> errors;
std::map<unsigned long, Call> calls;
std::vector<std::pair<Call, std::promise<void>*>> waiting;
unsigned long last_call = 0;

std::array<Unit, hl::test::kFakeDevices>& units() {
  static std::array<Unit, hl::test::kFakeDevices> the_units;
  return the_units;
}

void push(unsigned int code, Handle device) {
  const std::lock_guard lock(mutex);
  errors.push_back({code, 0, device});
}

// Null when no device of this handle is open.
Unit* unitOf(Handle device) { return device < plugged_in && units()[device].is_open ? &units()[device] : nullptr; }
Unit& currentUnit() { return units()[current < units().size() ? current.load() : 0]; }

Handle handleOf(const char* name) {
  if (name == nullptr || std::string_view(name) == "Left Device") return 0;
  return std::string_view(name) == "Right Device" && plugged_in > 1 ? 1 : kNoDevice;
}

// What waits to be done between the frames, then the frames.
void callAll() {
  std::map<unsigned long, Call> now;
  std::vector<std::pair<Call, std::promise<void>*>> first;
  {
    const std::lock_guard lock(mutex);
    first = std::exchange(waiting, {});
    now = calls;
  }
  for (auto& [call, done] : first) {
    call.first(call.second);
    done->set_value();
  }
  for (const auto& [number, call] : now) call.first(call.second);
  ++rounds;
}

}  // namespace

#define HL_EXPORT extern "C" __attribute__((visibility("default")))

HL_EXPORT hl::test::FakeArm* hlFakeArm() { return &units()[0].arm; }
HL_EXPORT hl::test::FakeArm* hlFakeArmNumber(std::size_t number) { return &units()[number].arm; }
HL_EXPORT void hlFakePlugIn(std::size_t count) { plugged_in = count; }
HL_EXPORT unsigned int hlFakeCalibrationUpdates() { return calibration_updates; }
HL_EXPORT unsigned int hlFakeStarts() { return starts; }
// Of the scheduler so far, and the frames of a device in them.
HL_EXPORT unsigned int hlFakeRounds() { return rounds; }
HL_EXPORT unsigned int hlFakeFrames(std::size_t number) { return units()[number].frames; }
// The next scheduler that starts calls nobody until it may.
HL_EXPORT void hlFakeHoldUp(bool wait) { held_up = wait; }
HL_EXPORT void hlFakeError(unsigned int code) { push(code, 0); }

HL_EXPORT Handle hdInitDevice(const char* name) {
  const Handle handle = handleOf(name);
  if (handle == kNoDevice || units()[handle].arm.lost) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // it waits for an answer
    push(kCommunicationError, kNoDevice);
    return kNoDevice;
  }
  Unit& unit = units()[handle];
  if (unit.is_open) return handle;  // the driver has to know its own
  if (!unit.script) unit.script = std::make_unique<hl::test::FakeScript>(unit.arm, handle);
  unit.forces_on = false;
  unit.force = hl::Vec3::Zero();
  unit.is_open = true;
  current = handle;
  return handle;
}
HL_EXPORT void hdDisableDevice(Handle device) {
  Unit* const unit = unitOf(device);
  if (unit == nullptr) return;
  unit->is_open = false;
  unit->arm.pull(hl::Vec3::Zero());
  unit->script->closed();
}
HL_EXPORT void hdMakeCurrentDevice(Handle device) {
  if (unitOf(device) == nullptr) return push(kBadHandle, device);
  current = device;
}
HL_EXPORT Handle hdGetCurrentDevice() { return current; }
HL_EXPORT void hdBeginFrame(Handle device) {
  Unit* const unit = unitOf(device);
  if (unit == nullptr) return push(kBadHandle, device);
  unit->in_frame = true;
  ++unit->frames;
  if (unit->arm.lost) push(kCommunicationError, device);
}
HL_EXPORT void hdEndFrame(Handle device) {
  Unit* const unit = unitOf(device);
  if (unit == nullptr) return;
  if (unit->in_frame && unit->forces_on && !unit->arm.lost) unit->arm.pull(unit->force);
  unit->in_frame = false;
  unit->script->pulled();
}
HL_EXPORT void hdEnable(unsigned int capability) {
  if (capability == 0x4000) currentUnit().forces_on = true;
}
HL_EXPORT void hdGetDoublev(unsigned int name, double* values) {
  static const double box_mm[6] = {-80, -60, -35, 80, 60, 35};
  switch (name) {
    case 0x2050:  // current position
      (hl::Vec3::Map(values)) = kMetre_mm * currentUnit().arm.encoders();
      break;
    case 0x2052: {  // current transform, as OpenGL has it
      Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
      transform.topLeftCorner<3, 3>() = currentUnit().arm.turned_D().toRotationMatrix();
      transform.topRightCorner<3, 1>() = kMetre_mm * currentUnit().arm.encoders();
      Eigen::Matrix4d::Map(values) = transform;
      break;
    }
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
      push(0x101, current);  // invalid value
  }
}
HL_EXPORT void hdGetIntegerv(unsigned int name, int* values) {
  *values = name == 0x2000 ? static_cast<int>(currentUnit().arm.buttons) : name == 0x2553 ? 6 : 4;
}
HL_EXPORT void hdSetDoublev(unsigned int name, const double* values) {
  if (name == 0x2700 && currentUnit().in_frame) currentUnit().force = hl::Vec3::Map(values);
}
HL_EXPORT const char* hdGetString(unsigned int name) {
  if (name != 0x2504) return "Touch";
  return current == 0 ? "SN-LEFT" : "SN-RIGHT";
}
HL_EXPORT ErrorInfo hdGetError() {
  const std::lock_guard lock(mutex);
  if (errors.empty()) return {0, 0, kNoDevice};
  const ErrorInfo error = errors.front();
  errors.pop_front();
  return error;
}
HL_EXPORT const char* hdGetErrorString(unsigned int) { return "communication error"; }
HL_EXPORT unsigned int hdCheckCalibration() { return currentUnit().arm.not_ready ? 0x5001 : 0x5000; }
HL_EXPORT void hdUpdateCalibration(unsigned int style) {
  if (style == 4) ++calibration_updates;
}
HL_EXPORT void hdStartScheduler() {
  if (running.exchange(true)) return;
  scheduler = std::thread([late = held_up.load()] {
    ++starts;
    while (late && held_up && running) std::this_thread::yield();
    while (running) {
      callAll();
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
  const std::lock_guard lock(mutex);
  calls[++last_call] = {call, user};
  return last_call;
}
HL_EXPORT void hdScheduleSynchronous(Callback* call, void* user, unsigned short) {
  if (!running) {
    call(user);
    return;
  }
  std::promise<void> done;
  {
    const std::lock_guard lock(mutex);
    waiting.push_back({{call, user}, &done});
  }
  done.get_future().wait();
}
HL_EXPORT void hdUnschedule(unsigned long call) {
  const std::lock_guard lock(mutex);
  calls.erase(call);
}
