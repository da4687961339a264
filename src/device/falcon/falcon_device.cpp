#include "device/falcon/falcon_device.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "base/realtime.h"
#include "device/falcon/falcon_firmware.h"
#include "device/falcon/falcon_kinematics.h"

namespace hl {

namespace {

// A sector of 110 mm turns a shaft of 14.25 mm; 320 slots, four counts each. Zero is at about 35 degrees.
constexpr double kCount_rad = 2 * M_PI / (4 * 320) * (14.25 / 110);
constexpr double kZero_rad = 35 * M_PI / 180;
constexpr double kCounts_Nm = 10'000;  // of a motor for one Nm at the thigh, against its angle
constexpr double kMaxCounts = 4096;

constexpr auto kPeriod = std::chrono::microseconds(500);  // between two frames; the USB chip makes it about 1 ms
constexpr auto kRetry = std::chrono::milliseconds(100);
constexpr int kPriority = 75;  // SCHED_FIFO; below the servo, above the proxy
constexpr int kMaxSilences = 3;

// Force, stiffness and damping as CHAI3D assumes them (chai3d/chai3d, src/devices); 4 x 4 x 4 inches and 400 dpi by the
// vendor.
DeviceInfo falconInfo() {
  DeviceInfo info;
  info.name = "Novint Falcon";
  info.workspace_max = Vec3::Constant(0.04);
  info.workspace_min = -info.workspace_max;
  info.force_max_N = 8;
  info.force_continuous_N = 2.5;
  info.stiffness_N_m = 1500;
  info.stiffness_max_N_m = 3000;
  info.damping_Ns_m = 2;
  info.resolution_m = 63.5e-6;
  info.velocity_max_m_s = 3;
  info.force_rate_max_N_s = info.stiffness_max_N_m * info.velocity_max_m_s;
  return info;
}

Vec3 anglesOf(const std::array<std::int16_t, 3>& encoders) {
  return kCount_rad * Vec3(encoders[0], encoders[1], encoders[2]) + Vec3::Constant(kZero_rad);
}

// Too much for one motor makes all of them weaker: the direction of the force stays.
std::array<std::int16_t, 3> motorsFor(const Vec3& torques_Nm) {
  Vec3 counts = -kCounts_Nm * torques_Nm;
  counts *= std::min(1.0, kMaxCounts / std::max(1.0, counts.cwiseAbs().maxCoeff()));
  std::array<std::int16_t, 3> motors{};
  for (int leg = 0; leg < 3; ++leg)
    motors[static_cast<std::size_t>(leg)] = static_cast<std::int16_t>(std::lround(counts[leg]));
  return motors;
}

std::string fileOf(const std::string& firmware) {
  const char* file = std::getenv("HL_FALCON_FIRMWARE");
  return !firmware.empty() || file == nullptr ? firmware : file;
}

}  // namespace

FalconChoice FalconChoice::parse(const std::string& text) {
  constexpr std::size_t kMaxDigits = 2;
  const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  const bool has_index = digits > 0 && (digits == text.size() || text[digits] == ',');
  if (!has_index) return {0, text};
  if (digits > kMaxDigits) throw Error("there is no Falcon '" + text + "': the first is falcon:0, the second falcon:1");
  return {std::stoul(text.substr(0, digits)), text.substr(std::min(digits + 1, text.size()))};
}

FalconDevice::FalconDevice(std::unique_ptr<FalconTransport> transport, const std::string& firmware)
    : transport_(std::move(transport)),
      firmware_file_(fileOf(firmware)),
      info_(falconInfo()),
      exchange_(std::make_unique<Exchange>()),
      tip_F_(kFalconCentre_F) {}

void FalconDevice::open() {
  if (thread_.running()) return;
  begin();
  thread_.start("falcon", [this] { run(); });
}

void FalconDevice::close() {
  if (!thread_.stop()) return;
  exchange_ = std::make_unique<Exchange>();
}

// A device that was used before still has its firmware.
void FalconDevice::begin() {
  transport_->open();
  FalconReply reply;
  home_ = true;
  located_ = false;
  transport_->set(FalconLine::kRun);
  if (talk({}, reply)) return;
  if (firmware_.empty()) firmware_ = readFalconFirmware(firmware_file_);
  if (!loadFalconFirmware(*transport_, firmware_) || !talk({}, reply))
    throw Error("the Falcon does not take its firmware: switch it off and on, and check the file");
}

bool FalconDevice::beginAgain() {
  try {
    transport_->close();
    begin();
    return true;
  } catch (const Error&) {
    return false;
  }
}

// The last frame has no force.
void FalconDevice::run() {
  requestRealtime(kPriority);
  bool here = true;
  int silences = 0;
  while (thread_.running()) {
    const auto next = std::chrono::steady_clock::now() + kPeriod;
    silences = here && step(exchange_->wantedForce()) ? 0 : silences + 1;
    if (silences >= kMaxSilences) {
      exchange_->reportLost();
      here = beginAgain();
      if (here) silences = 0;
      if (!here) std::this_thread::sleep_for(kRetry);
    }
    std::this_thread::sleep_until(next);
  }
  step(Vec3::Zero());
  transport_->close();
}

bool FalconDevice::talk(const FalconCommand& command, FalconReply& reply) {
  const FalconFrame frame = encode(command);
  if (!transport_->write(frame)) return false;
  std::array<std::uint8_t, 64> bytes{};
  const std::size_t count = transport_->read(bytes);
  return decode(std::span(bytes).first(count), reply);
}

// One frame out, with the torques for where the tip was last, and one in.
bool FalconDevice::step(const Vec3& force_D) {
  FalconCommand command;
  command.home = home_;
  Vec3 torques_Nm;
  if (located_ && !home_ && falconTorques(tip_F_, angles_, force_D, torques_Nm)) command.motors = motorsFor(torques_Nm);
  FalconReply reply;
  const std::int64_t asked_ns = monotonicNow_ns();
  if (!talk(command, reply)) return false;
  home_ = reply.homed != kFalconAllHomed;
  angles_ = anglesOf(reply.encoders);
  located_ = falconTip(angles_, tip_F_);
  if (!located_) tip_F_ = kFalconCentre_F;  // from where every place can be found
  exchange_->report(asked_ns, tip_F_ - kFalconCentre_F, reply.buttons,
                    home_ || !located_ ? DeviceStatus::kNotReady : DeviceStatus::kOk);
  return true;
}

std::string FalconDevice::find() {
  const std::size_t count = countFalcons();
  if (count > 1) return std::to_string(count) + " Novint Falcons: falcon:0 to falcon:" + std::to_string(count - 1);
  const auto transport = makeFalconUsb();
  transport->open();
  return "Novint Falcon";
}

}  // namespace hl
