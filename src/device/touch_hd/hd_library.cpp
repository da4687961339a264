#include "device/touch_hd/hd_library.h"

#include <algorithm>
#include <string>

#include "base/error.h"

namespace hl {

namespace {

// Codes of the library's own header, hdDefines.h: the library has clamped, and the device goes on.
constexpr unsigned int kWarmMotors = 0x200, kExceededMaxForce = 0x201;
constexpr unsigned int kDone = 0;  // a callback that is not called again

HdCalls bindHdCalls(const VendorLibrary& library) {
  HdCalls calls{};
  library.bind(calls.init_device, "hdInitDevice");
  library.bind(calls.disable_device, "hdDisableDevice");
  library.bind(calls.make_current, "hdMakeCurrentDevice");
  library.bind(calls.current_device, "hdGetCurrentDevice");
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
  library.bind(calls.schedule_and_wait, "hdScheduleSynchronous");
  library.bind(calls.unschedule, "hdUnschedule");
  return calls;
}

}  // namespace

HdLibrary::HdLibrary() : library_(kName), calls_(bindHdCalls(library_)) {}

std::shared_ptr<HdLibrary> HdLibrary::shared() {
  static std::mutex mutex;
  static std::weak_ptr<HdLibrary> known;
  const std::lock_guard lock(mutex);
  std::shared_ptr<HdLibrary> library = known.lock();
  if (!library) known = library = std::shared_ptr<HdLibrary>(new HdLibrary);
  return library;
}

HdLibrary::Seat& HdLibrary::takeSeat() {
  for (Seat& seat : seats_) {
    if (seat.taken) continue;
    seat.taken = true;
    ++taken_;
    return seat;
  }
  throw Error("no more than " + std::to_string(kMaxDevices) + " devices of libHD can be open at once");
}

void HdLibrary::leaveSeat(Seat& seat) {
  seat.handle = kNoDevice;
  seat.failed = false;
  seat.taken = false;
  --taken_;
}

bool HdLibrary::isOfAnother(const Seat& seat) const {
  return std::ranges::any_of(seats_, [&](const Seat& one) { return &one != &seat && one.handle == seat.handle; });
}

void HdLibrary::start() {
  if (running_) return;
  calls_.set_scheduler_rate(kSchedulerRate_Hz);
  calls_.start_scheduler();
  running_ = true;
}

void HdLibrary::pause() {
  if (running_) calls_.stop_scheduler();
  running_ = false;
}

void HdLibrary::between(FunctionRef<void()> work) {
  if (!running_) return work();
  const auto call = [](void* argument) {
    (*static_cast<FunctionRef<void()>*>(argument))();
    return kDone;
  };
  calls_.schedule_and_wait(call, &work, kMaxPriority);
}

unsigned int HdLibrary::sortErrors(Seat& own) {
  unsigned int last = 0;
  for (HdCalls::ErrorInfo error = calls_.get_error(); error.code != 0; error = calls_.get_error()) {
    if (error.code == kWarmMotors || error.code == kExceededMaxForce) continue;
    const auto is_its = [&](const Seat& seat) { return error.device != kNoDevice && seat.handle == error.device; };
    const auto its = std::ranges::find_if(seats_, is_its);
    if (its != seats_.end()) its->failed = true;
    if (its == seats_.end() && taken_ == 1) own.failed = true;
    if (its == seats_.end() || &*its == &own) last = error.code;
  }
  return last;
}

}  // namespace hl
