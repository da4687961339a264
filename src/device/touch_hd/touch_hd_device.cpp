#include "device/touch_hd/touch_hd_device.h"

#include "base/clock.h"
#include "base/error.h"

namespace hl {

namespace {

// Names and codes of the library's own header, hdDefines.h.
constexpr unsigned int kInvalidHandle = 0xFFFFFFFF;
constexpr unsigned int kCurrentButtons = 0x2000, kCurrentPosition = 0x2050;
constexpr unsigned int kCurrentTransform = 0x2052, kModelType = 0x2501, kInputDof = 0x2553;
constexpr unsigned int kUsableWorkspace = 0x2551, kMaxStiffness = 0x2602, kMaxForce = 0x2603;
constexpr unsigned int kMaxContinuousForce = 0x2604, kMaxDamping = 0x2609, kCurrentForce = 0x2700;
constexpr unsigned int kForceOutput = 0x4000;
constexpr unsigned int kWarmMotors = 0x200, kExceededMaxForce = 0x201;  // the library has clamped: the device goes on
constexpr unsigned int kCalibrated = 0x5000, kNeedsUpdate = 0x5001, kCalibrationStyle = 0x2555;
constexpr unsigned int kCallAgain = 1;
constexpr unsigned short kMaxPriority = 0xFFFF;  // of a callback: forces are set last of all
constexpr unsigned long kSchedulerRate_Hz = 1000;

constexpr double kMetre_mm = 1000;
constexpr double kFastest_m_s = 3;
// Of the highest values, what a person meets at first.
constexpr double kStiffnessPart = 0.7, kDampingPart = 0.1;

}  // namespace

TouchHdDevice::Calls TouchHdDevice::bindCalls(const VendorLibrary& library) {
  Calls calls{};
  library.bind(calls.init_device, "hdInitDevice");
  library.bind(calls.disable_device, "hdDisableDevice");
  library.bind(calls.make_current, "hdMakeCurrentDevice");
  library.bind(calls.begin_frame, "hdBeginFrame");
  library.bind(calls.end_frame, "hdEndFrame");
  library.bind(calls.enable, "hdEnable");
  library.bind(calls.get_double, "hdGetDoublev");
  library.bind(calls.get_integer, "hdGetIntegerv");
  library.bind(calls.set_double, "hdSetDoublev");
  library.bind(calls.get_string, "hdGetString");
  library.bind(calls.get_error, "hdGetError");
  library.bind(calls.error_string, "hdGetErrorString");
  library.bind(calls.check_calibration, "hdCheckCalibration");
  library.bind(calls.update_calibration, "hdUpdateCalibration");
  library.bind(calls.start_scheduler, "hdStartScheduler");
  library.bind(calls.stop_scheduler, "hdStopScheduler");
  library.bind(calls.set_scheduler_rate, "hdSetSchedulerRate");
  library.bind(calls.schedule, "hdScheduleAsynchronous");
  library.bind(calls.unschedule, "hdUnschedule");
  return calls;
}

void TouchHdDevice::open() {
  if (library_) return;
  auto library = std::make_unique<VendorLibrary>(kLibrary);
  calls_ = bindCalls(*library);
  info_ = {};
  const std::string why = begin();
  if (!why.empty())
    throw Error("no Touch or PHANToM answers (" + why +
                "): check its power, its cable and the vendor's set-up program");
  library_ = std::move(library);
  lifeline_ = std::make_unique<Lifeline>([this] { return reopen(); });
}

// From nothing to a scheduler that calls frame().
std::string TouchHdDevice::begin() {
  handle_ = calls_.init_device(nullptr);  // the default device
  const ErrorInfo error = calls_.get_error();
  if (error.code != 0 || handle_ == kInvalidHandle) return calls_.error_string(error.code);
  calls_.make_current(handle_);
  if (info_.name.empty()) describe();
  calls_.enable(kForceOutput);
  calls_.set_scheduler_rate(kSchedulerRate_Hz);
  failed_ = false;
  // Until the first frame nothing is known; what the scheduler told before it was stopped does not count any more.
  exchange_.tell(monotonicNow_ns(), Vec3::Zero(), 0, DeviceStatus::kNotReady);
  const auto call = [](void* self) {
    static_cast<TouchHdDevice*>(self)->frame();
    return kCallAgain;
  };
  callback_ = calls_.schedule(call, this, kMaxPriority);
  calls_.start_scheduler();
  running_ = true;
  return "";
}

// The last frame ends without force: the scheduler stops, and then nothing sets one.
void TouchHdDevice::end() {
  if (!running_) return;
  calls_.stop_scheduler();
  calls_.unschedule(callback_);
  calls_.make_current(handle_);
  calls_.begin_frame(handle_);
  calls_.set_double(kCurrentForce, Vec3(Vec3::Zero()).data());
  calls_.end_frame(handle_);
  calls_.disable_device(handle_);
  running_ = false;
}

bool TouchHdDevice::reopen() {
  end();
  return begin().empty();
}

void TouchHdDevice::close() {
  if (!library_) return;
  lifeline_.reset();
  end();
  exchange_.tell(monotonicNow_ns(), Vec3::Zero(), 0, DeviceStatus::kNotReady);
  library_.reset();
}

// What the library tells of the device: millimetres, newtons for a millimetre.
void TouchHdDevice::describe() {
  const auto number = [this](unsigned int name) {
    double value = 0;
    calls_.get_double(name, &value);
    return value;
  };
  double box_mm[6] = {};
  calls_.get_double(kUsableWorkspace, box_mm);
  const char* model = calls_.get_string(kModelType);
  calls_.get_integer(kCalibrationStyle, &calibration_style_);
  info_.name = std::string("3D Systems ") + (model != nullptr ? model : "device");
  info_.workspace_min = Vec3(box_mm[0], box_mm[1], box_mm[2]) / kMetre_mm;
  info_.workspace_max = Vec3(box_mm[3], box_mm[4], box_mm[5]) / kMetre_mm;
  info_.force_max_N = number(kMaxForce);
  info_.force_continuous_N = number(kMaxContinuousForce);
  info_.stiffness_max_N_m = kMetre_mm * number(kMaxStiffness);
  info_.stiffness_N_m = kStiffnessPart * info_.stiffness_max_N_m;
  info_.damping_Ns_m = kDampingPart * kMetre_mm * number(kMaxDamping);
  int degrees_of_freedom = 0;
  calls_.get_integer(kInputDof, &degrees_of_freedom);
  info_.has_wrist = degrees_of_freedom >= 6;
  info_.resolution_m = 55e-6;  // the vendor's sheet of the Touch, the coarsest of them
  info_.velocity_max_m_s = kFastest_m_s;
  info_.force_rate_max_N_s = info_.stiffness_max_N_m * kFastest_m_s;
  info_.servo_rate_Hz = static_cast<double>(kSchedulerRate_Hz);
}

// Their frame is D: x to the right, y up, z toward the user.
void TouchHdDevice::frame() {
  calls_.begin_frame(handle_);
  Vec3 position_mm = Vec3::Zero();
  int buttons = 0;
  const std::int64_t asked_ns = monotonicNow_ns();
  calls_.get_double(kCurrentPosition, position_mm.data());
  calls_.get_integer(kCurrentButtons, &buttons);
  const Stylus stylus = stylusNow();
  DeviceStatus status = calibrate();
  const Vec3 force = failed_ ? Vec3(Vec3::Zero()) : exchange_.wantedForce();
  calls_.set_double(kCurrentForce, force.data());
  calls_.end_frame(handle_);
  for (ErrorInfo error = calls_.get_error(); error.code != 0; error = calls_.get_error()) {
    if (error.code != kWarmMotors && error.code != kExceededMaxForce) failed_ = true;
  }
  if (failed_) status = DeviceStatus::kLost;
  exchange_.tell(asked_ns, position_mm / kMetre_mm, static_cast<std::uint32_t>(buttons), status, stylus);
}

// From their transform, of OpenGL's order: column by column.
Stylus TouchHdDevice::stylusNow() {
  Stylus stylus;
  if (!info_.has_wrist) return stylus;
  double transform[16] = {};
  calls_.get_double(kCurrentTransform, transform);
  const Mat3 turned = Eigen::Matrix4d::Map(transform).topLeftCorner<3, 3>();
  stylus.turned = Eigen::Quaterniond(turned);
  return stylus;
}

// A person may have to put the stylus into its well; the library then wants to be told to look again.
DeviceStatus TouchHdDevice::calibrate() {
  const unsigned int calibration = calls_.check_calibration();
  if (calibration == kNeedsUpdate) calls_.update_calibration(static_cast<unsigned int>(calibration_style_));
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
