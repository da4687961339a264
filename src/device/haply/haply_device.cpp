#include "device/haply/haply_device.h"

#include "base/error.h"

namespace hl {

namespace {

// The vendor's examples use springs up to 400 N/m; the rest is not published, and guessed low.
DeviceInfo haplyInfo() {
  DeviceInfo info;
  info.name = "Haply Inverse3";
  info.workspace_max = Vec3::Constant(0.06);
  info.workspace_min = -info.workspace_max;
  info.force_max_N = 10;
  info.force_continuous_N = 4;
  info.stiffness_N_m = 300;
  info.stiffness_max_N_m = 800;
  info.damping_Ns_m = 0.5;
  info.resolution_m = 50e-6;
  info.velocity_max_m_s = 3;
  info.force_rate_max_N_s = info.stiffness_max_N_m * info.velocity_max_m_s;
  return info;
}

}  // namespace

HaplyDevice::HaplyDevice(const std::string& url) : address_(HaplyAddress::parse(url)), info_(haplyInfo()) {}

void HaplyDevice::open() {
  if (link_) return;
  link_ = std::make_unique<HaplyLink>(address_);
  info_.name = "Haply Inverse3 " + link_->deviceId();
  info_.has_wrist = link_->hasGrip();
}

DeviceSample HaplyDevice::read(std::int64_t now_ns) {
  return link_ ? link_->newest(now_ns) : DeviceSample{now_ns, Vec3::Zero(), 0, DeviceStatus::kNotReady};
}

void HaplyDevice::write(const Vec3& force_N) {
  if (link_) link_->pull(force_N);
}

std::string HaplyDevice::find() {
  HaplyDevice device;
  device.open();
  return device.info().name;
}

}  // namespace hl
