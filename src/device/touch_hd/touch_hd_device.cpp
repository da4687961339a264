#include "device/touch_hd/touch_hd_device.h"

#include "base/clock.h"
#include "base/error.h"

namespace hl {

namespace {

// Names and codes of the library's own header, hdDefines.h.
constexpr unsigned int kCurrentButtons = 0x2000, kCurrentPosition = 0x2050, kCurrentTransform = 0x2052;
constexpr unsigned int kModelType = 0x2501, kSerialNumber = 0x2504, kInputDof = 0x2553;
constexpr unsigned int kUsableWorkspace = 0x2551, kMaxStiffness = 0x2602, kMaxForce = 0x2603;
constexpr unsigned int kMaxContinuousForce = 0x2604, kMaxDamping = 0x2609, kCurrentForce = 0x2700;
constexpr unsigned int kForceOutput = 0x4000;
constexpr unsigned int kCalibrated = 0x5000, kNeedsUpdate = 0x5001, kCalibrationStyle = 0x2555;
constexpr unsigned int kCallAgain = 1;

constexpr double kMetre_mm = 1000;
constexpr double kTouchFastest_m_s = 3;
// Of the highest values, what a person meets at first.
constexpr double kTouchStiffnessPart = 0.7, kTouchDampingPart = 0.1;

}  // namespace

void TouchHdDevice::open() {
  if (library_) return;
  const std::shared_ptr<HdLibrary> library = HdLibrary::shared();
  const std::lock_guard lock(library->setup());
  seat_ = &library->takeSeat();
  library_ = library;
  info_ = {};
  // The vendor's order: first the devices, then the scheduler.
  library->pause();
  const std::string why = begin();
  if (why.empty()) {
    lifeline_ = std::make_unique<Lifeline>([this] { return reopen(); });
    return;
  }
  leave();
  const std::string named = name_.empty() ? "" : " under the name '" + name_ + "'";
  throw Error("no Touch or PHANToM answers" + named + " (" + why +
              "): check its power, its cable and the vendor's set-up program");
}

// Gives its seat back; the others go on.
void TouchHdDevice::leave() {
  claim_.release();
  library_->leaveSeat(*seat_);
  seat_ = nullptr;
  if (library_->seatsTaken() > 0) library_->start();
  library_.reset();
}

// From nothing to a scheduler that calls frame(). Where it runs for others it goes on: they feel nothing.
std::string TouchHdDevice::begin() {
  const HdCalls& calls = library_->calls();
  const HdCalls::Handle handle = calls.init_device(name_.empty() ? nullptr : name_.c_str());
  seat_->failed = false;
  seat_->handle = handle;
  const unsigned int code = library_->sortErrors(*seat_);
  if (handle == HdLibrary::kNoDevice) return calls.error_string(code);
  if (library_->isOfAnother(*seat_)) {
    seat_->handle = HdLibrary::kNoDevice;  // disabling it would end the other
    return "another name leads to the same device, which is open already";
  }
  handle_ = handle;
  std::string why = seat_->failed ? calls.error_string(code) : "";
  if (why.empty()) library_->between([&] { why = prepare(); });
  if (!why.empty()) {
    disable();
    return why;
  }
  // Until the first frame nothing is known; what the scheduler reported before it was stopped does not count any more.
  exchange_.report(monotonicNow_ns(), Vec3::Zero(), 0, DeviceStatus::kNotReady);
  const auto call = [](void* self) {
    static_cast<TouchHdDevice*>(self)->frame();
    return kCallAgain;
  };
  callback_ = calls.schedule(call, this, HdLibrary::kMaxPriority);
  library_->start();
  return "";
}

// With it as the current device. Returns why it is not to be had.
std::string TouchHdDevice::prepare() {
  const HdCalls& calls = library_->calls();
  calls.make_current(handle_);
  const char* serial = calls.get_string(kSerialNumber);
  const bool has_serial = serial != nullptr && *serial != '\0';
  const std::string key = has_serial ? std::string("hd ") + serial : "hd number " + std::to_string(handle_);
  try {
    if (claim_.key() != key) claim_ = DeviceClaim(key);
  } catch (const Error& error) {
    return error.what();
  }
  if (info_.name.empty()) describe();
  calls.enable(kForceOutput);
  return "";
}

// The last frame is without force, and nothing sets one after it.
void TouchHdDevice::end() {
  if (handle_ == HdLibrary::kNoDevice) return;
  const HdCalls& calls = library_->calls();
  if (library_->seatsTaken() == 1) library_->pause();
  calls.unschedule(callback_);
  library_->between([&] {
    calls.make_current(handle_);
    calls.begin_frame(handle_);
    calls.set_double(kCurrentForce, Vec3(Vec3::Zero()).data());
    calls.end_frame(handle_);
  });
  disable();
}

void TouchHdDevice::disable() {
  library_->calls().disable_device(handle_);
  handle_ = seat_->handle = HdLibrary::kNoDevice;
}

bool TouchHdDevice::reopen() {
  const std::lock_guard lock(library_->setup());
  end();
  return begin().empty();
}

void TouchHdDevice::close() {
  if (!library_) return;
  lifeline_.reset();
  const std::shared_ptr<HdLibrary> library = library_;
  const std::lock_guard lock(library->setup());
  end();
  exchange_.report(monotonicNow_ns(), Vec3::Zero(), 0, DeviceStatus::kNotReady);
  leave();
}

// What the library reports of the device: millimetres, newtons for a millimetre.
void TouchHdDevice::describe() {
  const HdCalls& calls = library_->calls();
  const auto number = [&calls](unsigned int name) {
    double value = 0;
    calls.get_double(name, &value);
    return value;
  };
  double box_mm[6] = {};
  calls.get_double(kUsableWorkspace, box_mm);
  const char* model = calls.get_string(kModelType);
  calls.get_integer(kCalibrationStyle, &calibration_style_);
  info_.name = std::string("3D Systems ") + (model != nullptr ? model : "device");
  info_.workspace_min = Vec3(box_mm[0], box_mm[1], box_mm[2]) / kMetre_mm;
  info_.workspace_max = Vec3(box_mm[3], box_mm[4], box_mm[5]) / kMetre_mm;
  info_.force_max_N = number(kMaxForce);
  info_.force_continuous_N = number(kMaxContinuousForce);
  info_.stiffness_max_N_m = kMetre_mm * number(kMaxStiffness);
  info_.stiffness_N_m = kTouchStiffnessPart * info_.stiffness_max_N_m;
  info_.damping_Ns_m = kTouchDampingPart * kMetre_mm * number(kMaxDamping);
  int degrees_of_freedom = 0;
  calls.get_integer(kInputDof, &degrees_of_freedom);
  info_.has_wrist = degrees_of_freedom >= 6;
  info_.resolution_m = 55e-6;  // the vendor's sheet of the Touch, the coarsest of them
  info_.velocity_max_m_s = kTouchFastest_m_s;
  info_.force_rate_max_N_s = info_.stiffness_max_N_m * kTouchFastest_m_s;
  info_.servo_rate_Hz = HdLibrary::kSchedulerRate_Hz;
}

// Their frame is D: x to the right, y up, z toward the user.
void TouchHdDevice::frame() {
  const HdCalls& calls = library_->calls();
  calls.begin_frame(handle_);
  Vec3 position_mm = Vec3::Zero();
  int buttons = 0;
  Stylus stylus;
  DeviceStatus status = DeviceStatus::kNotReady;
  const std::int64_t asked_ns = monotonicNow_ns();
  const bool its_own = asCurrent([&] {
    calls.get_double(kCurrentPosition, position_mm.data());
    calls.get_integer(kCurrentButtons, &buttons);
    stylus = stylusNow();
    status = calibrate();
  });
  const Vec3 force = seat_->failed ? Vec3(Vec3::Zero()) : exchange_.wantedForce();
  asCurrent([&] { calls.set_double(kCurrentForce, force.data()); });
  calls.end_frame(handle_);
  library_->sortErrors(*seat_);
  if (seat_->failed) status = DeviceStatus::kLost;
  if (its_own || seat_->failed)
    exchange_.report(asked_ns, position_mm / kMetre_mm, static_cast<std::uint32_t>(buttons), status, stylus);
}

// From their transform, of OpenGL's order: column by column.
Stylus TouchHdDevice::stylusNow() const {
  Stylus stylus;
  if (!info_.has_wrist) return stylus;
  double transform[16] = {};
  library_->calls().get_double(kCurrentTransform, transform);
  const Mat3 turned = Eigen::Matrix4d::Map(transform).topLeftCorner<3, 3>();
  stylus.turned = Eigen::Quaterniond(turned);
  return stylus;
}

// A device that is opened meanwhile becomes the current one of the whole process, without force output: what was read
// then may be of it, and is read again.
bool TouchHdDevice::asCurrent(FunctionRef<void()> work) {
  constexpr int kTries = 3;
  const HdCalls& calls = library_->calls();
  for (int i = 0; i < kTries; ++i) {
    calls.make_current(handle_);
    work();
    if (calls.current_device() == handle_) return true;
  }
  return false;
}

// A person may have to put the stylus into its well; the library then wants a call that makes it look again.
DeviceStatus TouchHdDevice::calibrate() {
  const HdCalls& calls = library_->calls();
  const unsigned int calibration = calls.check_calibration();
  if (calibration == kNeedsUpdate) calls.update_calibration(static_cast<unsigned int>(calibration_style_));
  return calibration == kCalibrated ? DeviceStatus::kOk : DeviceStatus::kNotReady;
}

DeviceSample TouchHdDevice::read(std::int64_t now_ns) {
  const DeviceSample sample = exchange_.newest(now_ns);
  if (sample.status == DeviceStatus::kLost && lifeline_ && lifeline_->holds()) lifeline_->lose();
  return sample;
}

void TouchHdDevice::write(const Vec3& force_N) { exchange_.pull(force_N); }

std::string TouchHdDevice::find() {
  TouchHdDevice device;
  device.open();
  return device.info().name;
}

}  // namespace hl
