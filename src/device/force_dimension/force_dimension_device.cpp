#include "device/force_dimension/force_dimension_device.h"

#include <array>
#include <cstdlib>
#include <mutex>

#include "base/error.h"
#include "device/force_dimension/figures.h"

namespace hl {

namespace {

// Places in the array that dhdGetStatus fills; newer versions fill more than the 16 of SDK 3.
constexpr std::size_t kPower = 0, kConnected = 1, kReset = 3, kForce = 5, kError = 9, kForceOffCause = 14;
constexpr std::size_t kMaxStatuses = 64;
// A person has switched the forces off: nobody else may switch them on.
constexpr int kOffByButton = 1, kOffByDeadMan = 6;

constexpr std::int64_t kExaminePeriod_ns = 100'000'000;
constexpr unsigned char kWatchdogPeriods = 160;  // of 125 us: forces off after 20 ms without a command

// The library opens one device at a time: until its id is claimed nobody may take it for a device of his own.
std::mutex& openingDhd() {
  static std::mutex mutex;
  return mutex;
}

// Force Dimension's frame has x toward the user, y to the right, z up.
Vec3 toDevice(double x, double y, double z) { return {y, z, x}; }

// The axes of their stylus are those of their frame, as ours are those of D, when it is not turned: rows and columns
// change places alike.
Eigen::Quaterniond turnToDevice(const double theirs[3][3]) {
  constexpr int kAxis[3] = {1, 2, 0};
  Mat3 ours;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) ours(i, j) = theirs[kAxis[i]][kAxis[j]];
  }
  return Eigen::Quaterniond(ours);
}

// The library does not say it: about what the grippers of the omega.7 and the sigma.7 open to.
constexpr double kGripperMax_rad = 0.52;

}  // namespace

ForceDimensionDevice::Calls ForceDimensionDevice::bindCalls(const VendorLibrary& library) {
  Calls calls{};
  library.bind(calls.device_count, "dhdGetDeviceCount");
  library.bind(calls.open, "dhdOpen");
  library.bind(calls.open_id, "dhdOpenID");
  library.bindIfPresent(calls.open_serial, "dhdOpenSerial");
  library.bindIfPresent(calls.serial_number, "dhdGetSerialNumber");
  library.bind(calls.close, "dhdClose");
  library.bind(calls.system_type, "dhdGetSystemType");
  library.bind(calls.system_name, "dhdGetSystemName");
  library.bind(calls.enable_force, "dhdEnableForce");
  library.bind(calls.set_gravity_compensation, "dhdSetGravityCompensation");
  library.bindIfPresent(calls.set_watchdog, "dhdSetWatchdog");
  library.bind(calls.position, "dhdGetPosition");
  library.bind(calls.set_force, "dhdSetForce");
  library.bind(calls.button_mask, "dhdGetButtonMask");
  library.bindIfPresent(calls.has_wrist, "dhdHasWrist");
  library.bindIfPresent(calls.has_gripper, "dhdHasGripper");
  library.bindIfPresent(calls.orientation, "dhdGetOrientationFrame");
  library.bindIfPresent(calls.gripper_angle, "dhdGetGripperAngleRad");
  library.bind(calls.status, "dhdGetStatus");
  library.bind(calls.last_error, "dhdErrorGetLastStr");
  return calls;
}

void ForceDimensionDevice::open() {
  if (library_) return;
  auto library = std::make_unique<VendorLibrary>(kLibrary);
  calls_ = bindCalls(*library);
  if (calls_.device_count() <= 0)
    throw Error("no Force Dimension device answers: check its power and USB cable, and that you may use it (udev)");
  if (choice_.index && *choice_.index >= calls_.device_count())
    throw Error("there is no dhd:" + choice_.key() + ": the library finds " + std::to_string(calls_.device_count()) +
                ", counted from 0");
  const ForceDimensionChoice asked = choice_;
  if (const std::string why = begin(); !why.empty()) {
    choice_ = asked;
    throw Error("the Force Dimension device cannot be opened: " + why);
  }
  describe();
  library_ = std::move(library);
  lifeline_ = std::make_unique<Lifeline>([this] { return begin().empty(); });
}

void ForceDimensionDevice::describe() {
  info_ = forceDimensionFigures(calls_.system_type(id_));
  info_.name = std::string("Force Dimension ") + calls_.system_name(id_);
  info_.has_wrist = calls_.has_wrist != nullptr && calls_.orientation != nullptr && calls_.has_wrist(id_);
  if (calls_.has_gripper != nullptr && calls_.gripper_angle != nullptr && calls_.has_gripper(id_))
    info_.gripper_max_rad = kGripperMax_rad;
}

int ForceDimensionDevice::openChosen() const {
  if (choice_.serial && calls_.open_serial != nullptr) return calls_.open_serial(*choice_.serial);
  if (choice_.index) return calls_.open_id(static_cast<char>(*choice_.index));
  return calls_.open();
}

// Opens it with zero force; one that was lost is let go of first.
std::string ForceDimensionDevice::begin() {
  const std::lock_guard lock(openingDhd());
  if (id_ >= 0) calls_.close(id_);
  id_ = -1;
  claim_.release();
  if (choice_.serial && calls_.open_serial == nullptr) return "this version of the library opens none by serial number";
  const int id = openChosen();
  if (id < 0) return calls_.last_error();
  id_ = static_cast<char>(id);
  if (const std::string why = claimIt(); !why.empty()) {
    id_ = -1;
    return why;
  }
  calls_.set_gravity_compensation(1, id_);
  calls_.set_force(0, 0, 0, id_);
  calls_.enable_force(1, id_);
  watched_ = false;
  examined_ns_ = 0;
  return "";
}

// Other devices have other indices when one has gone: from now on this one is asked for by its serial number. An id
// that another device of this process has is left as it is: closing it would end the other.
std::string ForceDimensionDevice::claimIt() {
  try {
    claim_ = DeviceClaim("dhd id " + std::to_string(static_cast<int>(id_)));
  } catch (const Error& error) {
    return error.what();
  }
  unsigned short serial = 0;
  const bool has_serial = calls_.serial_number != nullptr && calls_.serial_number(&serial, id_) >= 0 && serial != 0;
  if (has_serial && calls_.open_serial != nullptr) choice_.serial = serial;
  return "";
}

void ForceDimensionDevice::close() {
  if (!library_) return;
  lifeline_.reset();
  const std::lock_guard lock(openingDhd());
  if (id_ >= 0) {
    calls_.set_force(0, 0, 0, id_);
    if (calls_.set_watchdog != nullptr) calls_.set_watchdog(0, id_);
    calls_.enable_force(0, id_);
    calls_.close(id_);
  }
  id_ = -1;
  claim_.release();
  status_ = DeviceStatus::kNotReady;
  library_.reset();
}

// Forces that went off by themselves (too fast, watchdog) come on again; the servo, which saw it, has begun anew.
DeviceStatus ForceDimensionDevice::examine(std::int64_t now_ns) {
  examined_ns_ = now_ns;
  std::array<int, kMaxStatuses> status{};
  if (calls_.status(status.data(), id_) < 0) return DeviceStatus::kLost;
  if (status[kPower] == 0 || status[kConnected] == 0 || status[kError] != 0) return DeviceStatus::kLost;
  if (status[kReset] != 0) return DeviceStatus::kNotReady;  // its place is not known before it is calibrated
  if (status[kForce] != 0) return DeviceStatus::kOk;
  const int cause = status[kForceOffCause];
  if (cause != kOffByButton && cause != kOffByDeadMan) calls_.enable_force(1, id_);
  return DeviceStatus::kNotReady;
}

void ForceDimensionDevice::lose() {
  status_ = DeviceStatus::kLost;
  lifeline_->lose();
}

DeviceSample ForceDimensionDevice::read(std::int64_t now_ns) {
  DeviceSample sample{now_ns, position_, 0, DeviceStatus::kNotReady};
  if (!library_) return sample;
  sample.status = DeviceStatus::kLost;
  if (!lifeline_->holds()) return sample;
  if (examined_ns_ == 0 || std::abs(now_ns - examined_ns_) >= kExaminePeriod_ns) status_ = examine(now_ns);
  double x = 0, y = 0, z = 0;
  if (status_ == DeviceStatus::kLost || calls_.position(&x, &y, &z, id_) < 0) {
    lose();
    return sample;
  }
  sample.position = position_ = toDevice(x, y, z);
  sample.buttons = calls_.button_mask(id_);
  sample.status = status_;
  readStylus();
  sample.stylus = stylus_;
  return sample;
}

// What the library fails to report stays what it was.
void ForceDimensionDevice::readStylus() {
  double theirs[3][3] = {}, gripper_rad = 0;
  if (info_.has_wrist && calls_.orientation(theirs, id_) >= 0) stylus_.turned = turnToDevice(theirs);
  if (info_.gripper_max_rad > 0 && calls_.gripper_angle(&gripper_rad, id_) >= 0) stylus_.gripper_rad = gripper_rad;
}

void ForceDimensionDevice::write(const Vec3& force_N) {
  if (!library_ || !lifeline_->holds()) return;
  const Vec3 force = force_N.allFinite() ? force_N : Vec3::Zero();
  if (calls_.set_force(force.z(), force.x(), force.y(), id_) < 0) return lose();
  // From the first force on: before it nobody would feed the watchdog.
  if (!watched_ && calls_.set_watchdog != nullptr) calls_.set_watchdog(kWatchdogPeriods, id_);
  watched_ = true;
}

std::string ForceDimensionDevice::find() {
  const VendorLibrary library(kLibrary);
  const Calls calls = bindCalls(library);
  const int count = calls.device_count();
  if (count <= 0) return "none answers: check power and USB cable, and that you may use it (udev)";
  if (count == 1) return "1 Force Dimension device";
  return std::to_string(count) + " Force Dimension devices: dhd:0 to dhd:" + std::to_string(count - 1);
}

}  // namespace hl
