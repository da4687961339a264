#include "device/fakes/falcon_line.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "device/falcon/falcon_kinematics.h"

namespace hl::test {

namespace {

constexpr std::uint8_t kLetter = 'A';  // a nibble of zero
constexpr double kRadians = M_PI / 180;

unsigned nibbles(std::span<const std::uint8_t> letters) {
  unsigned value = 0;
  for (std::size_t i = 0; i < 4; ++i) value += static_cast<unsigned>(letters[i] - kLetter) << 4 * i;
  return value;
}

}  // namespace

void FakeFalconLine::open() {
  if (box_.arm.lost) throw Error("no Falcon answers");
  open_ = true;
  replies_.clear();
}

// Without frames the device lets go of its motors.
void FakeFalconLine::close() {
  if (open_) box_.arm.pull(Vec3::Zero());
  open_ = false;
}

bool FakeFalconLine::set(FalconLine line) {
  if (!open_ || box_.arm.lost) return false;
  if (line == FalconLine::kAsk) {
    box_.running = false;
    loading_ = false;
    loaded_.clear();
  }
  if (line == FalconLine::kRun && line_ == FalconLine::kLoad) box_.running = loaded_ == box_.firmware;
  line_ = line;
  return true;
}

bool FakeFalconLine::write(std::span<const std::uint8_t> bytes) {
  if (!open_ || box_.arm.lost) return false;
  constexpr std::uint8_t kQuestion[] = {0x0a, 0x43, 0x0d};
  if (line_ == FalconLine::kAsk && std::ranges::equal(bytes, kQuestion)) {
    for (const std::uint8_t byte : {0x00, 0x0a, 0x44, 0x2c, 0x0d}) replies_.push_back(byte);
  } else if (line_ == FalconLine::kLoad) {
    load(bytes);
  } else if (line_ == FalconLine::kRun && box_.running && bytes.size() == 16) {
    obey(bytes);
    answer();
  }
  return true;
}

void FakeFalconLine::load(std::span<const std::uint8_t> bytes) {
  if (loading_) loaded_.insert(loaded_.end(), bytes.begin(), bytes.end());
  loading_ = loading_ || (bytes.size() == 1 && bytes[0] == kLetter);
  if (loading_) replies_.insert(replies_.end(), bytes.begin(), bytes.end());
}

void FakeFalconLine::obey(std::span<const std::uint8_t> frame) {
  if (frame[0] != '<' || frame[15] != '>') return;
  Vec3 torques_Nm;
  for (int leg = 0; leg < 3; ++leg)
    torques_Nm[leg] =
        -1e-4 * static_cast<std::int16_t>(nibbles(frame.subspan(1 + 4 * static_cast<std::size_t>(leg), 4)));
  box_.asked_to_home = ((frame[13] - kLetter) & 1) != 0;
  const Vec3 tip_F = box_.arm.encoders() + kFalconCentre_F;
  Vec3 angles;
  if (falconAngles(tip_F, angles)) box_.arm.pull(falconAngleRates(tip_F, angles).transpose() * torques_Nm);
}

void FakeFalconLine::answer() {
  Vec3 angles = Vec3::Zero();
  falconAngles(box_.arm.trueTip_D() + kFalconCentre_F, angles);
  replies_.push_back('<');
  for (int leg = 0; leg < 3; ++leg) {
    const double shaft_rad = (angles[leg] - 35 * kRadians) * 110 / 14.25;
    const long count = std::lround(shaft_rad / (2 * M_PI) * 320 * 4);
    for (int i = 0; i < 4; ++i) replies_.push_back(static_cast<std::uint8_t>(kLetter + (count >> 4 * i & 15)));
  }
  replies_.push_back(static_cast<std::uint8_t>(kLetter + (box_.homed << 4) + (box_.arm.buttons & 15U)));
  replies_.push_back(kLetter);
  replies_.push_back('>');
}

std::size_t FakeFalconLine::read(std::span<std::uint8_t> bytes) {
  if (!open_ || box_.arm.lost) return 0;
  const std::size_t count = std::min(bytes.size(), replies_.size());
  std::copy_n(replies_.begin(), count, bytes.begin());
  replies_.erase(replies_.begin(), replies_.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

}  // namespace hl::test
