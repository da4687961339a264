// HaplyDevice: a Haply Inverse3 through the vendor's Inverse Service, over a WebSocket.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "device/device.h"
#include "device/haply/haply_link.h"

namespace hl {

class HaplyDevice final : public Device {
 public:
  /// `url` as HaplyAddress::parse() takes it. Throws hl::Error.
  explicit HaplyDevice(const std::string& url = "");
  ~HaplyDevice() override { close(); }

  void open() override;
  void close() override { link_.reset(); }
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read(std::int64_t now_ns) override;
  void write(const Vec3& force_N) override;

  /// What is there. Throws hl::Error with what to install.
  static std::string find();

 private:
  HaplyAddress address_;
  DeviceInfo info_;
  std::unique_ptr<HaplyLink> link_;  // null: closed
};

}  // namespace hl
